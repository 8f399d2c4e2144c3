// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "datasets/source.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "core/error.h"
#include "datasets/living_room.h"
#include "datasets/sample_images.h"
#include "io/png.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::message_of;
using testing::sample_depth;
using testing::TemporaryFolder;

constexpr Size size = {8, 6};

std::string error_of(const std::string& sequence) {
  return message_of<InputError>([&] { open_source(sequence, {}); });
}

/// Two frames in the layout of TUM RGB-D.
std::string write_sequence(const TemporaryFolder& folder) {
  for (const std::string i : {"0", "1"}) {
    folder.write("fr1/depth/1." + i + ".png", png_bytes(sample_depth(size, 0)));
  }
  folder.write("fr1/depth.txt", "1.0 depth/1.0.png\n1.1 depth/1.1.png\n");
  return folder.path("fr1");
}

TEST(OpenSource, SaysWhenThereIsNothing) {
  const TemporaryFolder folder;
  EXPECT_EQ(
      error_of(folder.path("none")),
      folder.path("none") + ": No such file or directory, and no built-in sequence has this name");
  EXPECT_EQ(
      error_of(std::string(5000, 'x')),
      std::string(5000, 'x') + ": File name too long, and no built-in sequence has this name");
  EXPECT_EQ(
      error_of(folder.write("file", "") + "/below"),
      folder.path("file/below") + ": Not a directory, and no built-in sequence has this name");
  EXPECT_EQ(error_of(""), "'': No such file or directory, and no built-in sequence has this name");
}

TEST(OpenSource, SaysWhatItFoundAndWhatItLookedFor) {
  const TemporaryFolder folder;
  const std::string empty = error_of(folder.path());
  EXPECT_TRUE(
      empty.starts_with(folder.path() + ": layout: found an empty folder, expected one of: "))
      << empty;
  for (const char* name : {"a.png", "b", "c", "d", "e", "f"}) folder.write(name, "");
  const std::string full = error_of(folder.path());
  EXPECT_THAT(full, HasSubstr("found a folder with 'a.png', 'b', 'c', 'd' and 2 more, expected"));
  for (const SourceEntry& entry : source_table()) {
    EXPECT_THAT(full, HasSubstr(std::string(entry.layout)));
    EXPECT_THAT(full, HasSubstr(std::string(entry.sentence)));
  }
  EXPECT_EQ(full.find('\n'), std::string::npos);
  EXPECT_THAT(error_of(folder.write("notes.txt", "hello, this is text")),
              HasSubstr("found a file that is no sequence of frames"));
}

TEST(OpenSource, LayoutsHaveUniqueNames) {
  std::vector<std::string_view> names;
  for (const SourceEntry& entry : source_table()) {
    EXPECT_THAT(names, ::testing::Not(Contains(entry.layout)));
    EXPECT_FALSE(entry.sentence.empty());
    names.push_back(entry.layout);
  }
  for (const char* name : {"icl-nuim", "icl-nuim-tum", "tum-rgbd", "slambench-raw"}) {
    EXPECT_THAT(names, Contains(name));
  }
}

TEST(SourceParameters, AreDescribed) {
  SourceParameters parameters;
  const std::vector<ParameterList> lists = {parameters.describe()};
  EXPECT_EQ(lists[0].group, "source");
  const auto set = [&](std::string_view name, std::string_view text) {
    const Parameter* parameter = find(lists, name);
    ASSERT_NE(parameter, nullptr) << name;
    set_from_text(*parameter, text);
  };
  set("camera", "481.2,-480,320,240");
  set("depth-scale", "1000");
  set("ground-truth", "a file.txt");
  set("noise", "true");
  set("noise-seed", "7");
  EXPECT_EQ(parameters.camera, (std::array<double, 4>{481.2, -480, 320, 240}));
  EXPECT_EQ(parameters.depth_scale, 1000);
  EXPECT_EQ(parameters.ground_truth, "a file.txt");
  EXPECT_TRUE(parameters.noise);
  EXPECT_EQ(parameters.noise_seed, 7);
  EXPECT_EQ(find(lists, "camera")->flag, 'k');
  EXPECT_THROW(set_from_text(*find(lists, "depth-scale"), "0"), UsageError);
  EXPECT_THROW(set_from_text(*find(lists, "noise-seed"), "-1"), UsageError);
}

TEST(SourceParameters, OverrideCameraScaleAndGroundTruth) {
  const TemporaryFolder folder;
  const std::string path = write_sequence(folder);
  folder.write("fr1/groundtruth.txt", "1 0 0 0 0 0 0 1\n");
  SourceParameters parameters;
  parameters.camera = {5, 6, 3, 2};
  parameters.depth_scale = 1000;
  parameters.ground_truth = folder.write("other.txt", "1.1 1 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n");
  const SequenceInfo info = open_source(path, parameters)->info();
  EXPECT_EQ(info.camera, (Intrinsics{5, 6, 3, 2}));
  EXPECT_EQ(info.units_per_m, 1000);
  EXPECT_EQ(info.ground_truth_file, parameters.ground_truth);
  EXPECT_EQ(info.ground_truth.size(), 2u);
  EXPECT_EQ(info.frames_with_ground_truth, 2);
  EXPECT_TRUE(info.own_from_camera.isIdentity());
}

TEST(SourceParameters, NegativeFyMeansYUp) {
  const TemporaryFolder folder;
  SourceParameters parameters;
  parameters.camera = {481.2, -480, 319.5, 239.5};
  const SequenceInfo info = open_source(write_sequence(folder), parameters)->info();
  EXPECT_EQ(info.camera, (Intrinsics{481.2F, 480, 319.5F, 239.5F}));
  EXPECT_EQ(info.own_from_camera, Eigen::Vector3d(1, -1, 1).asDiagonal().toDenseMatrix());
  EXPECT_EQ(info.axes, "x right, y up, z forward");
  EXPECT_THAT(info.notes, Contains(HasSubstr("negative fy")));
}

TEST(SourceParameters, RejectACameraWithoutFocalLength) {
  const TemporaryFolder folder;
  const std::string path = write_sequence(folder);
  for (const std::array<double, 4> camera :
       {std::array{0.0, 480.0, 1.0, 1.0}, {480, 0, 1, 1}, {-480, 480, 1, 1}}) {
    SourceParameters parameters;
    parameters.camera = camera;
    EXPECT_THAT(message_of<UsageError>([&] { open_source(path, parameters); }),
                HasSubstr("--camera: found '"));
  }
}

TEST(SourceParameters, GroundTruthMustExistAndBelongToTheFrames) {
  const TemporaryFolder folder;
  const std::string path = write_sequence(folder);
  SourceParameters parameters;
  parameters.ground_truth = folder.path("none.txt");
  EXPECT_EQ(message_of<InputError>([&] { open_source(path, parameters); }),
            folder.path("none.txt") + ": cannot read: No such file or directory");
  parameters.ground_truth = folder.write("late.txt", "1.13 0 0 0 0 0 0 1\n");
  EXPECT_EQ(message_of<InputError>([&] { open_source(path, parameters); }),
            folder.path("late.txt") +
                ": time stamps: found 1.13 to 1.13, expected those of the frames, 1 to 1.1");
  parameters.ground_truth = folder.write("near.txt", "1.119 0 0 0 0 0 0 1\n");
  EXPECT_EQ(open_source(path, parameters)->info().frames_with_ground_truth, 1);
}

TEST(OpenSource, SuggestsNoRatioForOddSizes) {
  const TemporaryFolder folder;
  folder.write("fr1/depth/1.0.png", png_bytes(sample_depth({7, 6}, 0)));
  folder.write("fr1/depth.txt", "1.0 depth/1.0.png\n");
  const auto suggested = open_source(folder.path("fr1"), {})->info().suggested;
  EXPECT_FALSE(suggested.empty());
  for (const auto& [name, value] : suggested) {
    EXPECT_NE(name, "compute-size-ratio");
  }
}

TEST(OpenSource, SuggestsWhatTheHelpTells) {
  const TemporaryFolder folder;
  std::vector<std::string_view> names;
  const auto source = open_source(write_sequence(folder), {});
  for (const auto& [name, value] : source->info().suggested) names.push_back(name);
  EXPECT_THAT(names, ::testing::ElementsAreArray(suggested_parameters));
  for (const auto& [name, value] : living_room_settings(Pose::Identity())) {
    EXPECT_THAT(suggested_parameters, ::testing::Contains(name));
  }
}

TEST(SequenceSettings, LieInTheFolderOrBesideTheFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(sequence_settings_file(folder.path()), "");
  const std::string file = folder.write("slambench.toml", "");
  EXPECT_EQ(sequence_settings_file(folder.path()), file);
  EXPECT_EQ(sequence_settings_file(folder.path("")), file) << "with a slash at the end";
  EXPECT_EQ(sequence_settings_file(folder.path("sequence.raw")), file);
  EXPECT_EQ(sequence_settings_file(""), "");
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  folder.write("living-room/slambench.toml", "");
  EXPECT_EQ(sequence_settings_file("living-room/2"), "") << "that is built in";
  EXPECT_EQ(sequence_settings_file("living-room"), "");
  EXPECT_EQ(sequence_settings_file("sequence.raw"), "slambench.toml");
  std::filesystem::current_path(before);
}

TEST(OpenSource, NamesACurrentFolder) {
  const TemporaryFolder folder;
  const std::string path = write_sequence(folder);
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(path);
  const std::string name = open_source(".", {})->info().name;
  std::filesystem::current_path(before);
  EXPECT_EQ(name, "fr1");
}

TEST(OpenSource, TakesNamesThatAreNotAscii) {
  const TemporaryFolder folder;
  std::filesystem::rename(write_sequence(folder), folder.path("fr1_ä_測試 x"));
  EXPECT_EQ(open_source(folder.path("fr1_ä_測試 x"), {})->info().frame_count, 2);
}

}  // namespace
}  // namespace slambench
