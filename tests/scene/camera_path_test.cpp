// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "scene/camera_path.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "scene/living_room.h"

namespace slambench {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

struct Expected {
  std::size_t frames;
  double length_m;
};
constexpr std::array<Expected, living_room_path_count> expected = {
    Expected{1510, 6.5}, {967, 2.1}, {882, 8.4}, {1242, 11.3}};

Pose step(const Trajectory& path, std::size_t i) {
  return path[i - 1].T_world_camera.inverse() * path[i].T_world_camera;
}

double angle_deg(const Pose& pose) { return Eigen::AngleAxisd(pose.linear()).angle() * degrees; }

class CameraPath : public ::testing::TestWithParam<int> {
 protected:
  const Trajectory path_ = living_room_path(GetParam());
  const Expected& expected_ = expected[static_cast<std::size_t>(GetParam())];
};

TEST_P(CameraPath, HasThePublishedFrameCountLengthAndRate) {
  ASSERT_EQ(path_.size(), expected_.frames);
  EXPECT_NEAR(path_length(path_), expected_.length_m, 0.01 * expected_.length_m);
  for (std::size_t i = 0; i < path_.size(); ++i) {
    ASSERT_DOUBLE_EQ(path_[i].time_s, static_cast<double>(i) / 30);
  }
}

TEST_P(CameraPath, MovesSlowlyEnoughToBeTracked) {
  for (std::size_t i = 1; i < path_.size(); ++i) {
    const Pose motion = step(path_, i);
    ASSERT_LE(motion.translation().norm(), 0.015) << "frame " << i;
    ASSERT_LE(angle_deg(motion), 1.0) << "frame " << i;
  }
}

TEST_P(CameraPath, HasNoJerks) {
  for (std::size_t i = 2; i < path_.size(); ++i) {
    const Pose change = step(path_, i - 1).inverse() * step(path_, i);
    ASSERT_LE(change.translation().norm(), 0.0008) << "frame " << i;
    ASSERT_LE(angle_deg(change), 0.06) << "frame " << i;
  }
}

TEST_P(CameraPath, StartsAtRestAlongAnAxisOfTheRoom) {
  const Pose& start = path_[0].T_world_camera;
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(start.linear().col(k).cwiseAbs().maxCoeff(), 1, 1e-12);
  }
  EXPECT_NEAR(start.linear()(1, 1), 1, 1e-12) << "not level";
  for (std::size_t i = 1; i <= 4; ++i) {
    const Pose moved = start.inverse() * path_[i].T_world_camera;
    EXPECT_LT(moved.translation().norm(), 2e-4);
    EXPECT_LT(angle_deg(moved), 0.01);
  }
}

TEST_P(CameraPath, StaysInTheRoomWithRigidPoses) {
  for (const StampedPose& stamped : path_) {
    const Eigen::Vector3d p = stamped.T_world_camera.translation();
    ASSERT_LT(std::abs(p.x()), living_room_half_m - 0.5);
    ASSERT_LT(std::abs(p.z()), living_room_half_m - 0.5);
    ASSERT_GT(p.y(), -living_room_height_m + 0.5);
    ASSERT_LT(p.y(), -0.5);
    const Eigen::Matrix3d r = stamped.T_world_camera.linear();
    ASSERT_LT((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    ASSERT_NEAR(r.determinant(), 1, 1e-12);
  }
}

TEST_P(CameraPath, IsTheSameEveryTime) {
  const Trajectory again = living_room_path(GetParam());
  for (std::size_t i = 0; i < path_.size(); ++i) {
    ASSERT_EQ(path_[i].T_world_camera.matrix(), again[i].T_world_camera.matrix());
  }
}

INSTANTIATE_TEST_SUITE_P(All, CameraPath, ::testing::Range(0, living_room_path_count));

TEST(CameraPathLoop, OfPathThreeCloses) {
  const Trajectory path = living_room_path(3);
  const Pose gap = path.front().T_world_camera.inverse() * path.back().T_world_camera;
  EXPECT_LT(gap.translation().norm(), 0.01);
  EXPECT_LT(angle_deg(gap), 0.5);
  double turned_deg = 0;
  for (std::size_t i = 1; i < path.size(); ++i) turned_deg += angle_deg(step(path, i));
  EXPECT_GT(turned_deg, 360);
}

}  // namespace
}  // namespace slambench
