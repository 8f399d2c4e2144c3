// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "verify/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "backends/registry.h"
#include "slam/kinect_fusion.h"
#include "verify/inputs.h"
#include "verify/random.h"
#include "verify/recording.h"

namespace slambench {
namespace {

TEST(Random, IsTheSameEverywhere) {
  // The first number of the 64-bit Mersenne Twister (Nishimura EXPECT_EQ(random.uniform(), 13480155
  // * 0x1p-24); Matsumoto), its upper 24 bits.
  EXPECT_EQ(Random(5489).uniform(), 13200665 * 0x1p-24);
  EXPECT_EQ(Random(1, "track").index(1000), Random(1, "track").index(1000));
  EXPECT_NE(Random(1, "track").uniform(), Random(1, "reduce").uniform());
  EXPECT_NE(Random(1, "track").uniform(), Random(2, "track").uniform());
}

TEST(Scenes, APlaneIsFlat) {
  const Size size{64, 48};
  const Intrinsics camera = camera_for(size);
  const Image<float> depth = depth_of(plane_scene(2.0), Pose::Identity(), camera, size);
  const Image<Float3> vertices = vertices_of(depth, camera);
  for (const Float3& v : vertices) EXPECT_NEAR(0.2 * v.x - 0.1 * v.y - (v.z - 2.0), 0, 1e-5);
}

TEST(Scenes, ASphereIsRound) {
  const Size size{64, 48};
  const Intrinsics camera = camera_for(size);
  const Image<float> depth =
      depth_of(sphere_scene({0.1, -0.1, 1.5}, 0.4), Pose::Identity(), camera, size);
  int hits = 0;
  for (const Float3& v : vertices_of(depth, camera)) {
    if (v.z == 0) continue;
    ++hits;
    EXPECT_NEAR(std::hypot(v.x - 0.1, v.y + 0.1, v.z - 1.5), 0.4, 1e-5);
    EXPECT_LT(v.z, 1.5);
  }
  EXPECT_GT(hits, 100);
  EXPECT_LT(hits, 64 * 48);
}

TEST(Scenes, WhatIsSeenLiesInTheRoom) {
  const Size size{97, 41};
  Pose pose = Pose::Identity();
  pose.translation() << 1.9, 2.1, 0.9;
  const Image<float> depth = depth_of(room_scene(4.0), pose, camera_for(size), size);
  float nearest = 100, farthest = 0;
  for (const Float3& v : vertices_of(depth, camera_for(size))) {
    const Eigen::Vector3d point = pose * Eigen::Vector3d(v.x, v.y, v.z);
    EXPECT_GT(v.z, 0);
    EXPECT_GE(point.minCoeff(), 0.08 - 1e-5);
    EXPECT_LE(point.maxCoeff(), 3.92 + 1e-5);
    nearest = std::min(nearest, v.z);
    farthest = std::max(farthest, v.z);
  }
  EXPECT_GT(farthest - nearest, 1.0f);  // solids stand before the wall
}

/// Without this the pipeline check could agree on nothing.
TEST(SyntheticRecording, TheReferenceTracksIt) {
  const Recording recording = synthetic_recording({160, 120}, 12);
  const auto backend = create_backend("serial", {});
  KinectFusion system(*backend, recording.parameters, recording.frames[0].depth.size(),
                      recording.camera, recording.units_per_m, nullptr);
  const Pose start = start_pose(recording.parameters);
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    const FrameResult result = system.process(recording.frames[i]);
    EXPECT_EQ(result.tracked, i >= 4) << i;
    const Pose error = (start * result.T_start_camera).inverse() * recording.T_volume_camera[i];
    EXPECT_LT(error.translation().norm(), 0.01) << i;
  }
  const Pose moved = start.inverse() * recording.T_volume_camera.back();
  EXPECT_GT(moved.translation().norm(), 0.05);
}

TEST(TrackedRecording, TakesThePosesOfTheReference) {
  const Recording made = synthetic_recording({127, 65}, 6);
  const Recording tracked =
      tracked_recording("copy", made.frames, made.camera, made.units_per_m, made.parameters);
  ASSERT_EQ(tracked.T_volume_camera.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const Pose error = tracked.T_volume_camera[i].inverse() * made.T_volume_camera[i];
    EXPECT_LT(error.translation().norm(), 0.01) << i;
  }
}

}  // namespace
}  // namespace slambench
