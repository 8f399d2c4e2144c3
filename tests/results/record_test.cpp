// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/record.h"

#include <gtest/gtest.h>

#include <limits>

namespace slambench {
namespace {

FrameRecord frame_at(double time_s, const Pose& T) {
  FrameRecord frame;
  frame.time_s = time_s;
  frame.T_start_camera = T;
  return frame;
}

/// Right, down and forward by 1, 2 and 3 m, after a quarter turn about the optical axis that takes
/// right to down.
Pose quarter_turn() {
  Pose T = Pose::Identity();
  T.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  T.translation() << 1, 2, 3;
  return T;
}

TEST(EstimatedTrajectory, KeepsYDownPosesOfASequenceWithTheSameAxes) {
  Record record;
  record.frames = {frame_at(0.5, quarter_turn())};
  const Trajectory trajectory = estimated_trajectory(record);
  ASSERT_EQ(trajectory.size(), 1u);
  EXPECT_EQ(trajectory[0].time_s, 0.5);
  EXPECT_EQ(trajectory[0].T_world_camera.matrix(), quarter_turn().matrix());
}

TEST(EstimatedTrajectory, TurnsPosesIntoTheSequencesYUpAxes) {
  Record record;
  record.own_from_camera = Eigen::Vector3d(1, -1, 1).asDiagonal();
  record.frames = {frame_at(1, quarter_turn())};
  Eigen::Matrix4d expected;  // right turns to what is down, which is -y there
  expected << 0, 1, 0, 1, -1, 0, 0, -2, 0, 0, 1, 3, 0, 0, 0, 1;
  EXPECT_EQ(estimated_trajectory(record).at(0).T_world_camera.matrix(), expected);
}

TEST(EstimatedTrajectory, InvertsAxesThatAreNotTheirOwnInverse) {
  Record record;  // own x, y, z = camera z, -x, -y
  record.own_from_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  record.frames = {frame_at(1, quarter_turn())};
  Eigen::Matrix4d expected;  // a quarter turn about x now, -y to -z
  expected << 1, 0, 0, 3, 0, 0, -1, -1, 0, 1, 0, -2, 0, 0, 0, 1;
  EXPECT_EQ(estimated_trajectory(record).at(0).T_world_camera.matrix(), expected);
}

TEST(EstimatedTrajectory, LeavesOutDroppedFramesAndPosesThatAreNotNumbers) {
  Record record;
  record.frames = {frame_at(0, Pose::Identity()), frame_at(1, Pose::Identity()),
                   frame_at(2, Pose::Identity()), frame_at(3, Pose::Identity())};
  record.frames[1].dropped = true;
  record.frames[2].T_start_camera.translation().x() = std::numeric_limits<double>::quiet_NaN();
  const Trajectory trajectory = estimated_trajectory(record);
  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(trajectory[0].time_s, 0);
  EXPECT_EQ(trajectory[1].time_s, 3);
}

}  // namespace
}  // namespace slambench
