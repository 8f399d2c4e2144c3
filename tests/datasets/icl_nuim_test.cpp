// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "datasets/icl_nuim.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
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
using ::testing::IsEmpty;
using testing::message_of;
using testing::sample_color;
using testing::sample_depth;
using testing::TemporaryFolder;

constexpr Size size = {8, 6};
const Eigen::Matrix3d y_up = Eigen::Vector3d(1, -1, 1).asDiagonal();

/// The distances of a wall at z = `depth_m` from the camera, as ICL-NUIM writes them.
std::string wall(double depth_m, Size of = size) {
  const double scale = of.width / 640.0;
  std::string text;
  for (int v = 0; v < of.height; ++v) {
    for (int u = 0; u < of.width; ++u) {
      const double x = (u - 319.5 * scale) / (481.2 * scale);
      const double y = (v - 239.5 * scale) / (-480 * scale);
      text += fmt::format("{} ", depth_m * std::sqrt(x * x + y * y + 1));
    }
    text += "\n";
  }
  return text;
}

std::string error_of(const std::string& path, const SourceParameters& parameters = {}) {
  const std::string message = message_of<InputError>([&] { open_source(path, parameters); });
  EXPECT_TRUE(message.starts_with(path)) << message;
  return message.substr(std::min(message.size(), path.size()));
}

std::string write_native(const TemporaryFolder& folder, int frames = 3) {
  for (int i = 0; i < frames; ++i) {
    folder.write(fmt::format("kt/scene_00_{:04}.depth", i), wall(1.5 + i));
  }
  return folder.path("kt");
}

TEST(IclNuim, ConvertsDistancesToDepth) {
  const TemporaryFolder folder;
  const auto source = open_source(write_native(folder), {});
  const SequenceInfo& info = source->info();
  EXPECT_EQ(info.layout, "icl-nuim");
  EXPECT_EQ(info.frame_count, 3);
  EXPECT_EQ(info.depth_size, size);
  EXPECT_EQ(info.units_per_m, 5000);
  EXPECT_EQ(info.own_from_camera, y_up);
  EXPECT_EQ(info.axes, "x right, y up, z forward");
  EXPECT_FALSE(info.has_color);
  EXPECT_TRUE(info.ground_truth.empty());
  EXPECT_THAT(info.notes, Contains(HasSubstr("1/5000 m")));
  Frame frame;
  for (const int i : {2, 0, 1}) {
    source->read(i, frame);
    EXPECT_EQ(frame.index, i);
    EXPECT_EQ(source->time_s(i), frame.time_s);
    EXPECT_EQ(frame.time_s, i);
    EXPECT_EQ(frame.depth, Image<std::uint16_t>(size, static_cast<std::uint16_t>(7500 + 5000 * i)));
  }
}

TEST(IclNuim, TakesTheFullSizeWithThePublishedCamera) {
  const TemporaryFolder folder;
  folder.write("kt/scene_00_0000.depth", wall(2, {640, 480}));
  const auto source = open_source(folder.path("kt"), {});
  EXPECT_EQ(source->info().depth_size, (Size{640, 480}));
  EXPECT_EQ(source->info().camera, (Intrinsics{481.2F, 480, 319.5F, 239.5F}));
  Frame frame;
  source->read(0, frame);
  EXPECT_EQ(frame.depth, Image<std::uint16_t>(Size{640, 480}, 10000));
}

TEST(IclNuim, ZeroAndFarAreNotMeasured) {
  const TemporaryFolder folder;
  std::string text = "0 14 13 ";
  for (int i = 3; i < 12; ++i) text += "1 ";
  folder.write("kt/scene_00_0000.depth", text);
  SourceParameters parameters;
  parameters.camera = {1e6, 1e6, 0, 0};  // no difference between distance and depth
  const auto source = open_source(folder.path("kt"), parameters);
  Frame frame;
  source->read(0, frame);
  EXPECT_EQ(frame.depth(0, 0), 0);
  EXPECT_EQ(frame.depth(1, 0), 0);
  EXPECT_EQ(frame.depth(2, 0), 65000);
}

TEST(IclNuim, DepthScaleIsTheUnitOfTheText) {
  const TemporaryFolder folder;
  folder.write("kt/scene_00_0000.depth", wall(250));
  folder.write("kt/scene_00_0000.txt",
               "cam_pos = [100, 0, -50]';\ncam_dir = [0, 0, 1]';\ncam_up = [0, 1, 0]';\n");
  SourceParameters parameters;
  parameters.depth_scale = 100;
  const auto source = open_source(folder.path("kt"), parameters);
  EXPECT_EQ(source->info().units_per_m, 5000);
  EXPECT_EQ(source->info().ground_truth.at(0).T_world_camera.translation(),
            Eigen::Vector3d(1, 0, -0.5));
  Frame frame;
  source->read(0, frame);
  EXPECT_EQ(frame.depth, Image<std::uint16_t>(size, 12500));
}

TEST(IclNuim, ReadsColorWhereThereIsAny) {
  const TemporaryFolder folder;
  const std::string path = write_native(folder);
  folder.write("kt/scene_00_0001.png", png_bytes(sample_color(size, 1)));
  const auto source = open_source(path, {});
  EXPECT_TRUE(source->info().has_color);
  Frame frame;
  source->read(1, frame);
  EXPECT_TRUE(frame.color.empty());
  source->set_color(true);
  source->read(1, frame);
  EXPECT_EQ(frame.color, sample_color(size, 1));
  source->read(0, frame);
  EXPECT_TRUE(frame.color.empty());
}

TEST(IclNuim, ReadsThePosesOfPovRay) {
  const TemporaryFolder folder;
  const std::string path = write_native(folder);
  // Looks along +x with y up: its right is then -z.
  folder.write("kt/scene_00_0002.txt",
               "cam_pos      = [1, 2.5, -3]';\r\ncam_dir      = [2, 0, 0]';\r\n"
               "cam_up       = [0, 1, 0]';\r\ncam_angle    = 90;\r\n");
  const auto source = open_source(path, {});
  const SequenceInfo& info = source->info();
  ASSERT_EQ(info.ground_truth.size(), 1u);
  EXPECT_EQ(info.ground_truth[0].time_s, 2);
  EXPECT_EQ(info.frames_with_ground_truth, 1);
  const Pose& pose = info.ground_truth[0].T_world_camera;
  EXPECT_EQ(pose.translation(), Eigen::Vector3d(1, 2.5, -3));
  EXPECT_EQ(pose * Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(2, 2.5, -3));
  EXPECT_EQ(pose * Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(1, 3.5, -3));
  EXPECT_EQ(pose * Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(1, 2.5, -4));
}

TEST(IclNuim, RejectsBadPovRayText) {
  const TemporaryFolder folder;
  const std::string path = write_native(folder);
  const auto error_with = [&](std::string_view text) {
    folder.write("kt/scene_00_0000.txt", text);
    return error_of(path);
  };
  EXPECT_EQ(error_with("cam_pos = [0, 0, 0]'\ncam_dir = [0, 0, 1]'\n"),
            "/scene_00_0000.txt: cam_up: found nothing, expected cam_up = [x, y, z]'");
  EXPECT_EQ(error_with("cam_dir = [0, nan, 1]'\n"),
            "/scene_00_0000.txt: cam_dir: found 'cam_dir = [0, nan, 1]'', expected cam_dir = [x, "
            "y, z]'");
  EXPECT_THAT(error_with("cam_dir = [0, 1]'\n"), HasSubstr("cam_dir: found"));
  EXPECT_THAT(error_with("cam_dir = ]0, 1, 0["), HasSubstr("cam_dir: found"));
  EXPECT_THAT(error_with("cam_pos = [0, 0, 0]'\ncam_dir = [0, 0, 1]'\ncam_up = [0, 0, 2]'\n"),
              HasSubstr("zero or parallel vectors"));
}

TEST(IclNuim, PrefersTheGroundTruthFile) {
  const TemporaryFolder folder;
  const std::string path = write_native(folder);
  folder.write("kt/scene_00_0001.txt", "garbage that nobody needs");
  folder.write("kt/traj1.gt.freiburg", "1 0 0 -2.25 0 0 0 1\n2 0 0 -2.2 0 0 0 1\n");
  const auto source = open_source(path, {});
  const SequenceInfo& info = source->info();
  EXPECT_EQ(info.ground_truth.size(), 2u);
  EXPECT_EQ(info.ground_truth_file, path + "/traj1.gt.freiburg");
  EXPECT_EQ(info.frames_with_ground_truth, 2);
  EXPECT_THAT(info.suggested,
              ElementsAre(std::pair("compute-size-ratio", "2"), std::pair("volume-size", "5"),
                          std::pair("init-pose", "0.485,0.5,0.55")));
}

TEST(IclNuim, TakesOtherScenesAndGapsInTheOrderOfNumbers) {
  const TemporaryFolder folder;
  for (const int number : {10000, 7, 100}) {
    folder.write(fmt::format("kt/scene_01_{:04}.depth", number), wall(number / 5000.0));
  }
  const auto source = open_source(folder.path("kt"), {});
  EXPECT_EQ(source->info().frame_count, 3);
  EXPECT_EQ(source->info().last_time_s, 10000);
  Frame frame;
  source->read(1, frame);
  EXPECT_EQ(frame.time_s, 100);
  EXPECT_EQ(frame.depth(3, 3), 100);
  folder.write("kt/scene_00_0000.depth", wall(1));
  EXPECT_THAT(error_of(folder.path("kt")), HasSubstr("expected one scene in a folder"));
}

TEST(IclNuim, RejectsBadDistances) {
  const TemporaryFolder folder;
  const std::string path = write_native(folder, 1);
  const auto error_with = [&](std::string_view text) {
    folder.write("kt/scene_00_0000.depth", text);
    return error_of(path);
  };
  for (const std::string word : {"nan", "inf", "-1", "abc", "1,5", "1.5x", "1e99"}) {
    EXPECT_EQ(error_with("1 2 " + word + " 4"),
              "/scene_00_0000.depth: value 2 (at byte 4): found '" + word +
                  "', expected a distance in metres");
  }
  const char* const wrong_count = "307200 for 640x480, or another image of these proportions";
  EXPECT_EQ(error_with("1 2 3"),
            fmt::format("/scene_00_0000.depth: values: found 3, expected {}", wrong_count));
  EXPECT_EQ(error_with(""),
            fmt::format("/scene_00_0000.depth: values: found 0, expected {}", wrong_count));
}

TEST(IclNuim, ATruncatedFrameIsAnErrorWhenItIsRead) {
  const TemporaryFolder folder;
  const std::string path = write_native(folder);
  const std::string text = wall(1);
  folder.write("kt/scene_00_0001.depth", std::string_view(text).substr(0, text.size() / 2));
  const auto source = open_source(path, {});
  Frame frame;
  const std::string message = message_of<InputError>([&] { source->read(1, frame); });
  EXPECT_THAT(message, HasSubstr("/scene_00_0001.depth: values: found "));
  EXPECT_THAT(message, HasSubstr("expected 48 for 8x6 as in the first frame"));
}

// The TUM-compatible layout.

std::string write_tum(const TemporaryFolder& folder, int frames = 12) {
  for (int i = 0; i < frames; ++i) {
    folder.write(fmt::format("kt/depth/{}.png", i), png_bytes(sample_depth(size, i)));
  }
  folder.write("kt/livingRoom3.gt.freiburg",
               "1 0 0 -2.25 0 0 0 1\n2 0 0.1 -2.2 0 0 0 1\n3 0 0 -2.2 0 0 0 1\n");
  return folder.path("kt");
}

TEST(IclNuimTum, ReadsNumberedImagesWithoutAList) {
  const TemporaryFolder folder;
  const auto source = open_source(write_tum(folder), {});
  const SequenceInfo& info = source->info();
  EXPECT_EQ(info.layout, "icl-nuim-tum");
  EXPECT_EQ(info.frame_count, 12);
  EXPECT_EQ(info.depth_size, size);
  EXPECT_EQ(info.units_per_m, 5000);
  EXPECT_EQ(info.fps, 30);
  EXPECT_EQ(info.own_from_camera, y_up);
  EXPECT_EQ(info.ground_truth.size(), 3u);
  EXPECT_EQ(info.ground_truth_file, folder.path("kt/livingRoom3.gt.freiburg"));
  EXPECT_EQ(info.frames_with_ground_truth, 3);
  EXPECT_FALSE(info.has_color);
  EXPECT_THAT(info.suggested,
              ElementsAre(std::pair("compute-size-ratio", "2"), std::pair("volume-size", "5"),
                          std::pair("init-pose", "0.2685,0.5,0.4")));
  Frame frame;
  for (const int i : {11, 2, 0}) {  // 11 comes after 2, and stamp N is image N
    source->read(i, frame);
    EXPECT_EQ(frame.time_s, i);
    EXPECT_EQ(frame.depth, sample_depth(size, i));
  }
}

TEST(IclNuimTum, ReadsDepthTxtAndColorByName) {
  const TemporaryFolder folder;
  const std::string path = write_tum(folder);
  folder.write("kt/depth.txt", "# timestamp filename\n1 depth/1.png\n2 depth/2.png\n");
  folder.write("kt/rgb/2.png", png_bytes(sample_color(size, 2)));
  const auto source = open_source(path, {});
  EXPECT_EQ(source->info().layout, "icl-nuim-tum");
  EXPECT_EQ(source->info().frame_count, 2);
  EXPECT_TRUE(source->info().has_color);
  source->set_color(true);
  Frame frame;
  source->read(0, frame);
  EXPECT_EQ(frame.time_s, 1);
  EXPECT_EQ(frame.depth, sample_depth(size, 1));
  EXPECT_TRUE(frame.color.empty());
  source->read(1, frame);
  EXPECT_EQ(frame.color, sample_color(size, 2));
}

TEST(IclNuimTum, ReadsAssociationsInEitherOrder) {
  const TemporaryFolder folder;
  const std::string path = write_tum(folder);
  folder.write("kt/rgb/2.png", png_bytes(sample_color(size, 2)));
  for (const char* lines : {"1 depth/1.png 1 rgb/1.png\n2 depth/2.png 2 rgb/2.png\n",
                            "1 rgb/1.png 1 depth/1.png\n2 rgb/2.png 2 depth/2.png\n"}) {
    folder.write("kt/associations.txt", lines);
    const auto source = open_source(path, {});
    EXPECT_EQ(source->info().frame_count, 2);
    EXPECT_THAT(source->info().notes, Contains("1 colour images are named but do not exist"));
    source->set_color(true);
    Frame frame;
    source->read(1, frame);
    EXPECT_EQ(frame.depth, sample_depth(size, 2));
    EXPECT_EQ(frame.color, sample_color(size, 2));
  }
  folder.write("kt/associations.txt", "1 depth/1.png 1\n");
  EXPECT_EQ(error_of(path),
            "/associations.txt:1: fields: found 3, expected 4: stamp depth-file stamp colour-file");
  folder.write("kt/associations.txt", "1 depth/1.png x rgb/1.png\n");
  EXPECT_EQ(error_of(path), "/associations.txt:1: time stamp: found 'x', expected a finite number");
}

TEST(IclNuimTum, IsKnownByNumbersWithoutGroundTruth) {
  const TemporaryFolder folder;
  const std::string path = write_tum(folder);
  std::filesystem::remove(folder.path("kt/livingRoom3.gt.freiburg"));
  EXPECT_EQ(open_source(path, {})->info().layout, "icl-nuim-tum");
  folder.write("kt/depth.txt", "0 depth/0.png\n1 depth/1.png\n");
  EXPECT_EQ(open_source(path, {})->info().layout, "icl-nuim-tum");
  folder.write("kt/depth.txt", "0.5 depth/0.png\n1.5 depth/1.png\n");
  EXPECT_EQ(open_source(path, {})->info().layout, "tum-rgbd");
  folder.write("kt/depth.txt", "0 depth/0.png\n1 depth/1.png\n");
  folder.write("kt/groundtruth.txt", "0 0 0 0 0 0 0 1\n");
  EXPECT_EQ(open_source(path, {})->info().layout, "tum-rgbd");
}

TEST(IclNuimTum, RejectsImagesOfOneNumber) {
  const TemporaryFolder folder;
  const std::string path = write_tum(folder);
  folder.write("kt/depth/01.png", png_bytes(sample_depth(size, 1)));
  EXPECT_EQ(error_of(path),
            ": images of one number: found depth/01.png and depth/1.png, expected each number "
            "once");
}

TEST(IclNuimTum, AFolderWithGroundTruthAndNoImagesIsAnError) {
  const TemporaryFolder folder;
  folder.write("kt/livingRoom1.gt.freiburg", "1 0 0 0 0 0 0 1\n");
  folder.write("kt/depth/readme", "");
  EXPECT_EQ(error_of(folder.path("kt")), "/depth: images N.png: found none, expected at least one");
}

TEST(IclNuimTum, SuggestsNothingOfTheLivingRoomForOthers) {
  const TemporaryFolder folder;
  const std::string path = write_tum(folder);
  std::filesystem::rename(folder.path("kt/livingRoom3.gt.freiburg"),
                          folder.path("kt/traj3.gt.freiburg"));
  const auto volume = [](const std::string& folder_of) {
    const auto suggested = open_source(folder_of, {})->info().suggested;
    for (const auto& [name, value] : suggested) {
      if (name == "init-pose") return value;
    }
    return std::string();
  };
  EXPECT_EQ(volume(path), "0.2685,0.5,0.4");
  std::filesystem::rename(path, folder.path("office_kt3"));
  EXPECT_EQ(volume(folder.path("office_kt3")), "0.5,0.5,0.35");
}

TEST(IclNuimTum, TakesTheFirstOfSeveralGroundTruths) {
  const TemporaryFolder folder;
  const std::string path = write_tum(folder);
  folder.write("kt/livingRoom0.gt.freiburg", "1 0 0 0 0 0 0 1\n");
  const auto source = open_source(path, {});
  EXPECT_EQ(source->info().ground_truth.size(), 1u);
  EXPECT_THAT(source->info().notes, Contains(HasSubstr("the first, livingRoom0.gt.freiburg")));
}

TEST(IclNuim, TakesTheCameraOfSlambench1WhenAsked) {
  const TemporaryFolder folder, other_folder;
  folder.write("kt/scene_00_0000.depth", wall(2, {640, 480}));
  const std::string native = folder.path("kt");
  const std::string tum = write_tum(other_folder);
  SourceParameters parameters;
  parameters.icl_nuim_camera = "slambench1";
  EXPECT_EQ(open_source(native, parameters)->info().camera, (Intrinsics{481.2F, 480, 320, 240}));
  const auto source = open_source(tum, parameters);
  const float scale = static_cast<float>(source->info().depth_size.width) / 640;
  EXPECT_EQ(source->info().camera.cx, 320 * scale);
  EXPECT_EQ(source->info().camera.cy, 240 * scale);
}

TEST(IclNuimTum, RealSequence) {
  const char* const data = std::getenv("SLAMBENCH_DATA");
  if (data == nullptr) GTEST_SKIP() << "SLAMBENCH_DATA is not set";
  const auto source = open_source(std::string(data) + "/icl_nuim_lr_kt3_400", {});
  const SequenceInfo& info = source->info();
  EXPECT_EQ(info.layout, "icl-nuim-tum");
  EXPECT_EQ(info.frame_count, 400);
  EXPECT_EQ(info.depth_size, (Size{640, 480}));
  EXPECT_EQ(info.camera, (Intrinsics{481.2F, 480, 319.5F, 239.5F}));
  EXPECT_EQ(info.ground_truth.size(), 399u);
  EXPECT_EQ(info.frames_with_ground_truth, 399);
  EXPECT_THAT(info.suggested, Contains(std::pair<std::string, std::string>("volume-size", "5")));
  Frame frame;
  source->read(399, frame);
  EXPECT_EQ(frame.time_s, 399);
  EXPECT_EQ(frame.depth.size(), (Size{640, 480}));
}

}  // namespace
}  // namespace slambench
