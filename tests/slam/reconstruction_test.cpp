// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "backends/registry.h"
#include "core/se3.h"
#include "slam/kinect_fusion.h"
#include "support/synthetic_scene.h"
#include "support/temporary_folder.h"

/// The whole pipeline on the serial backend, over a scene whose depth and motion are known.
namespace slambench {
namespace {

constexpr Size input{160, 120};
constexpr Intrinsics camera{140, 140, 80, 60};
constexpr double units_per_m = 20000;
constexpr double room_m = 2;

KinectFusionParameters parameters() {
  KinectFusionParameters p;
  p.volume_resolution = {64, 64, 64};
  p.volume_size_m = {room_m, room_m, room_m};
  p.init_pose = {0.5, 0.5, 0};
  p.integration_rate = 1;
  return p;
}

/// A hand that stands still for the four first frames and then moves about 6 mm and 0.3 degrees
/// a frame; from the start.
Pose motion(int frame) {
  const double t = std::max(0, frame - 3);
  Eigen::Matrix<double, 6, 1> xi;
  xi << 0.004 * t, -0.003 * t, 0.003 * t, 0.003 * t, 0.004 * t, -0.002 * t;
  return se3_exp(xi);
}

Frame frame_at(int index, Size size = input, Intrinsics k = camera) {
  Pose T_scene_start = Pose::Identity();
  T_scene_start.translation() = Eigen::Vector3d(0.5 * room_m, 0.5 * room_m, 0);
  Frame frame;
  frame.index = index;
  frame.depth = testing::depth_units_of(testing::furnished_corner(room_m),
                                        T_scene_start * motion(index), k, size, units_per_m);
  return frame;
}

struct Journey {
  std::vector<FrameResult> results;
  Pictures pictures;
  std::string volume;
};

Journey run(const KinectFusionParameters& p, int frames, Size size = input, Intrinsics k = camera) {
  const auto backend = create_backend("serial", {});
  KinectFusion fusion(*backend, p, size, k, static_cast<float>(units_per_m), nullptr);
  Journey journey;
  for (int i = 0; i < frames; ++i) {
    journey.results.push_back(fusion.process(frame_at(i, size, k)));
    fusion.render();
  }
  journey.pictures = fusion.pictures();
  const testing::TemporaryFolder folder;
  fusion.dump_volume(folder.path("volume.raw"));
  std::ifstream file(folder.path("volume.raw"), std::ios::binary);
  journey.volume.assign(std::istreambuf_iterator<char>(file), {});
  return journey;
}

double error_m(const Journey& run, int frame) {
  return (run.results[static_cast<std::size_t>(frame)].T_start_camera.translation() -
          motion(frame).translation())
      .norm();
}

void expect_tracked(const Journey& run, double limit_m) {
  for (int i = 0; i < static_cast<int>(run.results.size()); ++i) {
    const FrameResult& result = run.results[static_cast<std::size_t>(i)];
    EXPECT_EQ(result.tracked, i >= 4) << i;
    EXPECT_LT(error_m(run, i), limit_m) << i;
    const Eigen::AngleAxisd turn(result.T_start_camera.linear().transpose() * motion(i).linear());
    EXPECT_LT(turn.angle(), limit_m) << i;
    if (i >= 4) {
      EXPECT_GT(result.inlier_fraction, 0.8) << i;
    }
  }
}

TEST(Reconstruction, FollowsAKnownMotion) {
  const Journey found = run(parameters(), 12);
  expect_tracked(found, 0.002);
  // It did move: ten times what the error may be.
  EXPECT_GT(found.results.back().T_start_camera.translation().norm(), 0.04);
}

/// Pixels twice as wide mix the surfaces at edges twice as far.
TEST(Reconstruction, FollowsItAtHalfTheSize) {
  KinectFusionParameters p = parameters();
  p.compute_size_ratio = 2;
  expect_tracked(run(p, 9), 0.006);
}

/// The coarser levels alone track as well: they are judged by their own size. They stand half a
/// pixel (6 mm at 1.7 m) aside, as halving the image does not move its principal point.
TEST(Reconstruction, FollowsItWithoutTheFinestLevel) {
  KinectFusionParameters p = parameters();
  p.pyramid_levels = {0, 5, 4};
  const Journey found = run(p, 9);
  expect_tracked(found, 0.012);
  EXPECT_EQ(found.results.back().iterations[0], 0);
  EXPECT_GT(found.results.back().iterations[1], 0);
}

TEST(Reconstruction, DrawsWhatItSees) {
  const Journey found = run(parameters(), 5);
  ASSERT_EQ(found.pictures.depth.size(), input);
  std::size_t coloured = 0, grey = 0, lit = 0;
  for (std::size_t i = 0; i < input.count(); ++i) {
    const Rgba8 depth = found.pictures.depth.data()[i];
    coloured += depth.r != depth.g || depth.g != depth.b ? 1 : 0;
    grey += found.pictures.track.data()[i] == Rgba8{128, 128, 128, 255} ? 1 : 0;
    lit += found.pictures.volume.data()[i].r > 50 ? 1 : 0;
  }
  EXPECT_GT(coloured, input.count() * 9 / 10);
  EXPECT_GT(grey, input.count() * 7 / 10);
  EXPECT_GT(lit, input.count() * 7 / 10);
}

TEST(Reconstruction, GivesTheSameBytesTwice) {
  const Journey first = run(parameters(), 7), second = run(parameters(), 7);
  EXPECT_EQ(first.volume, second.volume);
  EXPECT_EQ(first.pictures.volume, second.pictures.volume);
  for (std::size_t i = 0; i < first.results.size(); ++i) {
    EXPECT_EQ(std::memcmp(first.results[i].T_start_camera.data(),
                          second.results[i].T_start_camera.data(), sizeof(double) * 16),
              0);
    EXPECT_EQ(first.results[i].residual_m, second.results[i].residual_m);
  }
}

/// 16-bit distances, little endian, x fastest, then y, then z: near the wall at z = 0.85 of the
/// room they are those of the scene.
TEST(Reconstruction, DumpsDistancesWithXFastest) {
  KinectFusionParameters p = parameters();
  p.volume_resolution = {32, 16, 64};
  const Journey found = run(p, 1);
  ASSERT_EQ(found.volume.size(), 2u * 32 * 16 * 64);
  const auto tsdf = [&](int x, int y, int z) {
    const std::size_t at =
        2 * (static_cast<std::size_t>(z * 16 + y) * 32 + static_cast<std::size_t>(x));
    const auto low = static_cast<std::uint8_t>(found.volume[at]);
    const auto high = static_cast<std::uint8_t>(found.volume[at + 1]);
    return static_cast<std::int16_t>(low | (high << 8)) / 32766.0;
  };
  // Before the middle of the wall, and past the floor's and the left wall's bands.
  const double voxel_m = room_m / 64;
  for (int z = 51; z < 57; ++z) {
    const double distance = 0.85 * room_m - (z + 0.5) * voxel_m;
    EXPECT_NEAR(tsdf(12, 6, z), std::min(1.0, distance / 0.1), 0.02) << z;
  }
  EXPECT_EQ(tsdf(12, 6, 30), 1.0);
  EXPECT_EQ(tsdf(12, 6, 60), 1.0);  // never seen
}

/// What suddenly looks elsewhere is lost, keeps its pose, and is found again.
TEST(Reconstruction, IsLostAndFoundAgain) {
  const auto backend = create_backend("serial", {});
  KinectFusion fusion(*backend, parameters(), input, camera, static_cast<float>(units_per_m),
                      nullptr);
  for (int i = 0; i < 6; ++i) fusion.process(frame_at(i));
  const Pose before = fusion.process(frame_at(6)).T_start_camera;
  Frame elsewhere;
  elsewhere.depth = Image<std::uint16_t>(input, 9000);  // a wall close by
  const FrameResult lost = fusion.process(elsewhere);
  EXPECT_FALSE(lost.tracked);
  EXPECT_FALSE(lost.integrated);
  EXPECT_TRUE(lost.T_start_camera.isApprox(before, 0));
  Frame blind;
  blind.depth = Image<std::uint16_t>(input);
  EXPECT_FALSE(fusion.process(blind).tracked);
  const FrameResult found = fusion.process(frame_at(7));
  EXPECT_TRUE(found.tracked);
  EXPECT_LT((found.T_start_camera.translation() - motion(7).translation()).norm(), 0.002);
}

}  // namespace
}  // namespace slambench
