// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "datasets/living_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "scene/camera_path.h"
#include "scene/living_room.h"
#include "scene/renderer.h"
#include "support/environment.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::message_of;
using testing::TemporaryFolder;

/// Every test has an empty cache of its own.
class LivingRoom : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!can_render()) GTEST_SKIP() << "built without Embree";
    ::setenv("XDG_CACHE_HOME", cache_.path().c_str(), 1);
  }
  void TearDown() override { ::unsetenv("XDG_CACHE_HOME"); }

  static std::unique_ptr<Source> open(const std::string& name = "living-room/2",
                                      const SourceParameters& parameters = {}) {
    return open_source(name, parameters);
  }
  static Frame frame(Source& source, int index) {
    Frame frame;
    source.read(index, frame);
    return frame;
  }
  /// How many frames a call of prepare renders.
  static int rendered(Source& source, int frames) {
    int count = 0;
    source.prepare(frames, [&](int done, int) {
      count = done;
      return true;
    });
    return count;
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::recursive_directory_iterator(cache_.path())) {
      if (entry.is_regular_file()) paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    return paths;
  }

  const TemporaryFolder cache_;
};

TEST_F(LivingRoom, SaysWhatItIs) {
  const auto source = open("living-room/3");
  const SequenceInfo& info = source->info();
  EXPECT_EQ(info.name, "living-room/3");
  EXPECT_EQ(info.layout, "living-room");
  EXPECT_EQ(info.frame_count, 1242);
  EXPECT_EQ(info.depth_size, (Size{640, 480}));
  EXPECT_EQ(info.camera, (Intrinsics{481.2f, 480, 319.5f, 239.5f}));
  EXPECT_EQ(info.units_per_m, 5000);
  EXPECT_EQ(info.ground_truth.size(), 1242u);
  EXPECT_EQ(info.frames_with_ground_truth, 1242);
  EXPECT_TRUE(info.own_from_camera.isIdentity());
  EXPECT_THAT(info.suggested, Contains(std::pair<std::string, std::string>("volume-size", "4.8")));
  EXPECT_THAT(info.notes, IsEmpty());
  EXPECT_THAT(files(), IsEmpty()) << "nothing is rendered before it is needed";
  EXPECT_DOUBLE_EQ(source->time_s(60), 2);
}

TEST_F(LivingRoom, MeansPathTwoWithoutANumber) {
  EXPECT_EQ(open("living-room")->info().name, "living-room/2");
}

TEST_F(LivingRoom, RejectsOtherPaths) {
  for (const char* name : {"living-room/4", "living-room/-1", "living-room/x", "living-room/22"}) {
    EXPECT_THAT(message_of<InputError>([&] { open(name); }), HasSubstr("expected 0 to 3")) << name;
  }
}

TEST_F(LivingRoom, SuggestsAVolumeThatHoldsTheRoom) {
  for (int path = 0; path < living_room_path_count; ++path) {
    const Pose start = living_room_path(path)[0].T_world_camera;
    const auto settings = living_room_settings(start);
    Eigen::Vector3d factors;
    ASSERT_EQ(settings.at(2).first, "init-pose");
    ASSERT_EQ(std::sscanf(settings[2].second.c_str(), "%lf,%lf,%lf", &factors.x(), &factors.y(),
                          &factors.z()),
              3);
    for (const double x : {-1, 1}) {
      for (const double z : {-1, 1}) {
        for (const double y : {0.0, -1.0}) {
          const Eigen::Vector3d corner(x * living_room_half_m, y * living_room_height_m,
                                       z * living_room_half_m);
          const Eigen::Vector3d in_volume = start.inverse() * corner + 4.8 * factors;
          EXPECT_GT(in_volume.minCoeff(), 0.099) << path;
          EXPECT_LT(in_volume.maxCoeff(), 4.8 - 0.099) << path;
        }
      }
    }
  }
}

TEST_F(LivingRoom, RendersOnceAndOnlyWhatIsNeeded) {
  EXPECT_EQ(rendered(*open(), 20), 32) << "whole chunks of 16";
  EXPECT_EQ(files().size(), 2u);
  EXPECT_EQ(rendered(*open(), 32), 0);
  EXPECT_EQ(rendered(*open(), 33), 16);
  EXPECT_EQ(rendered(*open("living-room/1"), 1), 16) << "paths do not share frames";
}

TEST_F(LivingRoom, GivesTheSameFramesFromTheCacheAndWithoutPreparing) {
  const auto prepared = open();
  prepared->prepare(16, {});
  const Frame first = frame(*prepared, 9);
  EXPECT_EQ(first.index, 9);
  EXPECT_DOUBLE_EQ(first.time_s, 0.3);
  EXPECT_TRUE(first.color.empty());
  EXPECT_GT(*std::min_element(first.depth.begin(), first.depth.end()), 0.45 * 5000);
  fs::remove_all(cache_.path("slambench"));
  EXPECT_EQ(frame(*open(), 9).depth, first.depth);
  EXPECT_EQ(files().size(), 1u);
  EXPECT_EQ(frame(*open(), 9).depth, first.depth);
}

TEST_F(LivingRoom, GivesColourWhenAsked) {
  const auto source = open();
  const Frame without = frame(*source, 3);
  source->set_color(true);
  const Frame with = frame(*source, 3);
  EXPECT_EQ(with.depth, without.depth);
  ASSERT_EQ(with.color.size(), (Size{640, 480}));
  double sum = 0;
  for (const Rgb8& pixel : with.color) sum += pixel.g;
  EXPECT_GT(sum / static_cast<double>(with.color.count()), 50);
  source->set_color(false);
  EXPECT_TRUE(frame(*source, 3).color.empty());
}

TEST_F(LivingRoom, NoiseHasItsOwnFramesASeed) {
  SourceParameters noisy, other;
  noisy.noise = other.noise = true;
  other.noise_seed = 1;
  const Frame exact = frame(*open(), 2);
  const Frame first = frame(*open("living-room/2", noisy), 2);
  EXPECT_NE(first.depth, exact.depth);
  EXPECT_NE(first.depth, frame(*open("living-room/2", other), 2).depth);
  EXPECT_EQ(first.depth, frame(*open("living-room/2", noisy), 2).depth);
  EXPECT_EQ(files().size(), 3u);
}

TEST_F(LivingRoom, RendersAgainWhatIsDamaged) {
  const Frame good = [&] { return frame(*open(), 5); }();
  ASSERT_EQ(files().size(), 1u);
  const fs::path file = files()[0];
  const auto size = fs::file_size(file);
  const auto damage_at = [&](std::uintmax_t offset) {
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(static_cast<std::streamoff>(offset));
    stream.put('\x5a');
    stream.put('\xa5');
  };
  // In the header, the table, and the last frame.
  for (const auto offset : {std::uintmax_t{9}, std::uintmax_t{40}, size - 2}) {
    damage_at(offset);
    EXPECT_EQ(rendered(*open(), 16), 16) << offset;
  }
  damage_at(size / 3 + 1000);
  EXPECT_EQ(frame(*open(), 5).depth, good.depth) << "without preparing";
  for (const auto kept : {std::uintmax_t{100}, size - 1}) {
    fs::resize_file(file, kept);
    EXPECT_EQ(rendered(*open(), 16), 16) << kept;
  }
  EXPECT_EQ(frame(*open(), 5).depth, good.depth);
}

TEST_F(LivingRoom, TwoProcessesAtOnceDoNotDisturbEachOther) {
  const pid_t child = ::fork();
  if (child == 0) {
    open()->prepare(32, {});
    ::_exit(0);
  }
  const auto source = open();
  source->prepare(32, {});
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(files().size(), 2u) << "no temporary files";
  EXPECT_EQ(rendered(*open(), 32), 0);
}

TEST_F(LivingRoom, AKilledProcessLeavesWholeChunks) {
  const pid_t child = ::fork();
  if (child == 0) {
    open()->prepare(48, [](int done, int) {
      if (done > 20) ::_exit(9);
      return true;
    });
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_NE(status, 0);
  const auto source = open();
  const int again = rendered(*source, 48);
  EXPECT_GE(again, 32);
  EXPECT_EQ(again % 16, 0);
  EXPECT_EQ(rendered(*open(), 48), 0);
}

TEST_F(LivingRoom, EndsEarlyWhenToldAndKeepsWhatIsReady) {
  const auto source = open();
  const auto stop = [&] { source->prepare(80, [](int done, int) { return done < 40; }); };
  EXPECT_THAT(message_of<Error>(stop), HasSubstr("interrupted"));
  EXPECT_THAT(files(), ::testing::Not(IsEmpty()));
}

TEST_F(LivingRoom, HoldsFramesInMemoryWhenTheCacheCannotBeWritten) {
  const Frame good = frame(*open(), 7);
  fs::remove_all(cache_.path("slambench"));
  cache_.write("slambench", "a file where a folder should be");
  const auto source = open();
  EXPECT_EQ(rendered(*source, 32), 32);
  EXPECT_THAT(source->info().notes, Contains(HasSubstr("held in memory")));
  EXPECT_EQ(source->info().notes.size(), 1u);
  EXPECT_EQ(frame(*source, 7).depth, good.depth);
  EXPECT_EQ(rendered(*source, 32), 0);
}

TEST_F(LivingRoom, NeedsNoHome) {
  const testing::Environment no_cache("XDG_CACHE_HOME", nullptr), no_home("HOME", nullptr);
  const auto source = open();
  EXPECT_EQ(rendered(*source, 16), 16);
  EXPECT_THAT(source->info().notes, Contains(HasSubstr("held in memory")));
}

TEST_F(LivingRoom, RemovesOldLeftovers) {
  const std::string old = cache_.write("slambench/living-room/.slambench-1-0.tmp", "half a chunk");
  const std::string young = cache_.write("slambench/living-room/.slambench-2-0.tmp", "running");
  fs::last_write_time(old, fs::file_time_type::clock::now() - std::chrono::hours(48));
  open()->prepare(1, {});
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(young));
}

TEST_F(LivingRoom, TakesTheUsersCameraScaleAndGroundTruth) {
  SourceParameters parameters;
  parameters.camera = std::array<double, 4>{500, 500, 320, 240};
  parameters.depth_scale = 1000;
  parameters.ground_truth = cache_.write("own.txt", "0 1 2 3 0 0 0 1\n");
  const auto source = open("living-room/0", parameters);
  EXPECT_EQ(source->info().camera.fx, 500);
  EXPECT_EQ(source->info().units_per_m, 1000);
  EXPECT_EQ(source->info().ground_truth.size(), 1u);
}

}  // namespace
}  // namespace slambench
