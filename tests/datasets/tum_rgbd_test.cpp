// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "datasets/tum_rgbd.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>

#include "core/error.h"
#include "datasets/sample_images.h"
#include "io/png.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::message_of;
using testing::sample_color;
using testing::sample_depth;
using testing::TemporaryFolder;

constexpr Size size = {8, 6};

void write_depth(const TemporaryFolder& folder, const std::string& name, int frame,
                 Size of = size) {
  folder.write(name, png_bytes(sample_depth(of, frame)));
}

void write_color(const TemporaryFolder& folder, const std::string& name, int frame) {
  folder.write(name, png_bytes(sample_color(size, frame)));
}

/// Three frames at 10 Hz in a folder of this name.
std::string write_sequence(const TemporaryFolder& folder,
                           const std::string& name = "rgbd_dataset_freiburg1_xyz") {
  for (int i = 0; i < 3; ++i) write_depth(folder, fmt::format("{}/depth/1.{}.png", name, i), i);
  folder.write(name + "/depth.txt",
               "# depth maps\n# timestamp filename\n1.0 depth/1.0.png\n1.1\tdepth/1.1.png\r\n"
               "1.2 depth/1.2.png\n");
  folder.write(name + "/groundtruth.txt",
               "# ground truth\n0.99 1 2 3 0 0 0 1\n1.105 1 2 4 0 0 0 1\n1.5 1 2 5 0 0 0 1\n");
  return folder.path(name);
}

std::string error_of(const std::string& path, const SourceParameters& parameters = {}) {
  const std::string message = message_of<InputError>([&] { open_source(path, parameters); });
  EXPECT_TRUE(message.starts_with(path)) << message;
  return message.substr(std::min(message.size(), path.size()));
}

TEST(TumRgbd, ReadsFramesGroundTruthAndRate) {
  const TemporaryFolder folder;
  const auto source = open_source(write_sequence(folder) + "/", {});
  const SequenceInfo& info = source->info();
  EXPECT_EQ(info.layout, "tum-rgbd");
  EXPECT_EQ(info.name, "freiburg1_xyz");
  EXPECT_EQ(info.path, folder.path("rgbd_dataset_freiburg1_xyz"));
  EXPECT_EQ(info.frame_count, 3);
  EXPECT_EQ(info.depth_size, size);
  EXPECT_EQ(info.units_per_m, 5000);
  EXPECT_FALSE(info.has_color);
  EXPECT_NEAR(info.fps, 10, 1e-9);
  EXPECT_EQ(info.first_time_s, 1.0);
  EXPECT_EQ(info.last_time_s, 1.2);
  EXPECT_TRUE(info.own_from_camera.isIdentity());
  EXPECT_EQ(info.axes, "x right, y down, z forward");
  EXPECT_EQ(info.ground_truth.size(), 3u);
  EXPECT_EQ(info.frames_with_ground_truth, 2);
  EXPECT_THAT(info.suggested,
              ElementsAre(std::pair("compute-size-ratio", "2"), std::pair("volume-size", "6"),
                          std::pair("init-pose", "0.5,0.5,0.35")));
  Frame frame;
  for (const int i : {0, 2, 1}) {
    source->read(i, frame);
    EXPECT_EQ(frame.index, i);
    EXPECT_EQ(source->time_s(i), frame.time_s);
    EXPECT_EQ(frame.depth, sample_depth(size, i));
    EXPECT_TRUE(frame.color.empty());
  }
  EXPECT_EQ(frame.time_s, 1.1);
}

TEST(TumRgbd, KnowsTheCamerasOfTheSeries) {
  const TemporaryFolder folder;
  const auto camera = [&](const std::string& name) {
    SequenceInfo info = open_source(write_sequence(folder, name), {})->info();
    const float x = 640.0F / size.width, y = 480.0F / size.height;
    return Intrinsics{info.camera.fx * x, info.camera.fy * y, info.camera.cx * x,
                      info.camera.cy * y};
  };
  const auto expect_near = [](Intrinsics a, Intrinsics b) {
    EXPECT_NEAR(a.fx, b.fx, 1e-3);
    EXPECT_NEAR(a.fy, b.fy, 1e-3);
    EXPECT_NEAR(a.cx, b.cx, 1e-3);
    EXPECT_NEAR(a.cy, b.cy, 1e-3);
  };
  expect_near(camera("rgbd_dataset_freiburg1_desk"), {517.3F, 516.5F, 318.6F, 255.3F});
  expect_near(camera("tum_fr1_xyz_300"), {517.3F, 516.5F, 318.6F, 255.3F});
  expect_near(camera("FR2-desk"), {520.9F, 521.0F, 325.1F, 249.7F});
  expect_near(camera("rgbd_dataset_freiburg3_walking"), {535.4F, 539.2F, 320.1F, 247.6F});
  expect_near(camera("my_recording"), {525, 525, 319.5F, 239.5F});
  expect_near(camera("afr1ca"), {525, 525, 319.5F, 239.5F});
  expect_near(camera("fr12"), {525, 525, 319.5F, 239.5F});
}

TEST(TumRgbd, SaysThatTheCameraIsAGuess) {
  const TemporaryFolder folder;
  EXPECT_THAT(open_source(write_sequence(folder, "mine"), {})->info().notes,
              Contains(HasSubstr("tells no series")));
  EXPECT_THAT(open_source(write_sequence(folder), {})->info().notes,
              ::testing::Not(Contains(HasSubstr("tells no series"))));
}

TEST(TumRgbd, GivesEveryDepthTheNearestColorOnce) {
  const TemporaryFolder folder;
  const std::string path = write_sequence(folder);
  // 1.0 and 1.1 would both like 1.05 if it were near enough; 1.011 is nearer to 1.0 than 0.985.
  folder.write("rgbd_dataset_freiburg1_xyz/rgb.txt",
               "0.985 rgb/a.png\n1.011 rgb/b.png\n1.05 rgb/c.png\n1.119 rgb/d.png\n"
               "1.221 rgb/e.png\n");
  for (int i = 0; i < 5; ++i) {
    write_color(folder, fmt::format("rgbd_dataset_freiburg1_xyz/rgb/{}.png", "abcde"[i]), i);
  }
  const auto source = open_source(path, {});
  EXPECT_TRUE(source->info().has_color);
  source->set_color(true);
  Frame frame;
  source->read(0, frame);
  EXPECT_EQ(frame.color, sample_color(size, 1));
  source->read(1, frame);
  EXPECT_EQ(frame.color, sample_color(size, 3));
  source->read(2, frame);
  EXPECT_TRUE(frame.color.empty());
}

TEST(TumRgbd, OneColorImageGoesToTheNearestDepthOnly) {
  const TemporaryFolder folder;
  for (int i = 0; i < 2; ++i) write_depth(folder, fmt::format("s/depth/{}.png", i), i);
  folder.write("s/depth.txt", "1.000 depth/0.png\n1.010 depth/1.png\n");
  folder.write("s/rgb.txt", "1.008 rgb/a.png\n");
  write_color(folder, "s/rgb/a.png", 0);
  const auto source = open_source(folder.path("s"), {});
  source->set_color(true);
  Frame frame;
  source->read(0, frame);
  EXPECT_TRUE(frame.color.empty());
  source->read(1, frame);
  EXPECT_FALSE(frame.color.empty());
}

TEST(TumRgbd, MissingColorIsFine) {
  const TemporaryFolder folder;
  const std::string path = write_sequence(folder);
  folder.write("rgbd_dataset_freiburg1_xyz/rgb.txt", "1.0 rgb/a.png\n1.1 rgb/b.png\n");
  const auto source = open_source(path, {});
  EXPECT_FALSE(source->info().has_color);
  EXPECT_THAT(source->info().notes, Contains("2 colour images are named but do not exist"));
}

TEST(TumRgbd, SortsByTimeAndSaysSo) {
  const TemporaryFolder folder;
  const std::string path = write_sequence(folder);
  folder.write("rgbd_dataset_freiburg1_xyz/depth.txt",
               "1.2 depth/1.2.png\n1.0 depth/1.0.png\n1.1 depth/1.1.png\n");
  const auto source = open_source(path, {});
  EXPECT_THAT(source->info().notes, Contains("depth.txt is not in the order of time: sorted"));
  Frame frame;
  source->read(2, frame);
  EXPECT_EQ(frame.depth, sample_depth(size, 2));
}

TEST(TumRgbd, RejectsBadLists) {
  const TemporaryFolder folder;
  const std::string path = write_sequence(folder);
  const auto error_with = [&](std::string_view list) {
    folder.write("rgbd_dataset_freiburg1_xyz/depth.txt", list);
    return error_of(path);
  };
  EXPECT_EQ(error_with("1.0 depth/1.0.png\n1.1 depth/1.1.png\n1.0 depth/1.2.png\n"),
            "/depth.txt:3: time stamp: found 1 again, expected each once (it is in line 1)");
  EXPECT_EQ(error_with("# c\n1.0 depth/1.0.png extra\n"),
            "/depth.txt:2: fields: found 3, expected 2: stamp file");
  EXPECT_EQ(error_with("1.0\n"), "/depth.txt:1: fields: found 1, expected 2: stamp file");
  EXPECT_EQ(error_with("nan depth/1.0.png\n"),
            "/depth.txt:1: time stamp: found 'nan', expected a finite number");
  EXPECT_EQ(error_with(""), "/depth.txt: images: found none, expected at least one");
  EXPECT_EQ(error_with("1.0 depth/none.png\n"), "/depth.txt:1: image: found no file " + path +
                                                    "/depth/none.png, expected a 16-bit PNG");
}

TEST(TumRgbd, ABadImageIsAnErrorWhenItIsRead) {
  const TemporaryFolder folder;
  const std::string path = write_sequence(folder);
  const std::string name = "rgbd_dataset_freiburg1_xyz/depth/1.2.png";
  Frame frame;
  const auto error_with = [&] {
    const auto source = open_source(path, {});
    EXPECT_NO_THROW(source->read(1, frame));
    return message_of<InputError>([&] { source->read(2, frame); });
  };
  write_depth(folder, name, 0, {4, 3});
  EXPECT_EQ(error_with(),
            path + "/depth/1.2.png: size: found 4x3, expected 8x6 as in the first frame");
  write_color(folder, name, 0);
  EXPECT_EQ(error_with(),
            path + "/depth/1.2.png: PNG: found 8 bits RGB, expected 16 bits greyscale");
  folder.write(name, png_bytes(sample_depth(size, 0)).substr(0, 60));
  EXPECT_EQ(error_with(), path + "/depth/1.2.png: truncated PNG: no end mark within its 60 bytes");
  std::filesystem::remove(folder.path(name));
  EXPECT_EQ(error_with(), path + "/depth/1.2.png: cannot read: No such file or directory");
}

TEST(TumRgbd, ABadFirstImageIsAnErrorAtOnce) {
  const TemporaryFolder folder;
  const std::string path = write_sequence(folder);
  write_color(folder, "rgbd_dataset_freiburg1_xyz/depth/1.0.png", 0);
  EXPECT_EQ(error_of(path), "/depth/1.0.png: PNG: found 8 bits RGB, expected 16 bits greyscale");
}

TEST(TumRgbd, GroundTruthMustBelongToTheFrames) {
  const TemporaryFolder folder;
  const std::string path = write_sequence(folder);
  folder.write("rgbd_dataset_freiburg1_xyz/groundtruth.txt", "5 1 2 3 0 0 0 1\n7 1 2 3 0 0 0 1\n");
  EXPECT_EQ(error_of(path),
            "/groundtruth.txt: time stamps: found 5 to 7, expected those of the frames, 1 to 1.2");
  folder.write("rgbd_dataset_freiburg1_xyz/groundtruth.txt", "1 1 2 3 0 0 0\n");
  EXPECT_THAT(error_of(path), HasSubstr("/groundtruth.txt:1: fields: found 7"));
  std::filesystem::remove(path + "/groundtruth.txt");
  EXPECT_TRUE(open_source(path, {})->info().ground_truth.empty());
}

TEST(TumRgbd, RealSequence) {
  const char* const data = std::getenv("SLAMBENCH_DATA");
  if (data == nullptr) GTEST_SKIP() << "SLAMBENCH_DATA is not set";
  const auto source = open_source(std::string(data) + "/tum_fr1_xyz_300", {});
  const SequenceInfo& info = source->info();
  EXPECT_EQ(info.layout, "tum-rgbd");
  EXPECT_EQ(info.frame_count, 300);
  EXPECT_EQ(info.depth_size, (Size{640, 480}));
  EXPECT_EQ(info.camera, (Intrinsics{517.3F, 516.5F, 318.6F, 255.3F}));
  EXPECT_NEAR(info.fps, 30, 1);
  EXPECT_TRUE(info.has_color);
  EXPECT_EQ(info.frames_with_ground_truth, 298);
  Frame frame;
  source->set_color(true);
  source->read(0, frame);
  EXPECT_EQ(frame.time_s, 1305031102.160407);
  EXPECT_EQ(frame.color.size(), (Size{640, 480}));
  source->read(299, frame);
  EXPECT_EQ(frame.depth.size(), (Size{640, 480}));
}

}  // namespace
}  // namespace slambench
