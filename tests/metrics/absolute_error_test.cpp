// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "metrics/trajectory_metrics.h"
#include "support/trajectories.h"

namespace slambench {
namespace {

using testing::moved;
using testing::pose_at;
using testing::positions_each_second;
using testing::turned_by;
using testing::winding_path;

constexpr Alignment all_alignments[] = {Alignment::none, Alignment::first_pose, Alignment::se3,
                                        Alignment::sim3};

Trajectory scaled(Trajectory trajectory, double by) {
  for (auto& pose : trajectory) pose.T_world_camera.translation() *= by;
  return trajectory;
}

TEST(AbsoluteError, OfEqualTrajectoriesIsZero) {
  const auto path = winding_path(60);
  for (const auto alignment : all_alignments) {
    const auto result = absolute_trajectory_error(path, path, alignment);
    EXPECT_EQ(result.errors_m.size(), 60u);
    EXPECT_NEAR(result.statistics.max, 0, 1e-12) << name(alignment);
  }
}

TEST(AbsoluteError, OfAShiftIsItsLengthUnlessAligned) {
  const auto truth = winding_path(60);
  const auto estimate = moved(truth, pose_at(3, 0, 4));
  const auto none = absolute_trajectory_error(estimate, truth, Alignment::none);
  EXPECT_NEAR(none.statistics.min, 5, 1e-12);
  EXPECT_NEAR(none.statistics.max, 5, 1e-12);
  for (const auto alignment : {Alignment::first_pose, Alignment::se3, Alignment::sim3}) {
    const auto result = absolute_trajectory_error(estimate, truth, alignment);
    EXPECT_NEAR(result.statistics.max, 0, 1e-12) << name(alignment);
    EXPECT_TRUE(result.alignment.rigid.translation().isApprox(Eigen::Vector3d(-3, 0, -4), 1e-9));
  }
}

TEST(AbsoluteError, OfHandComputedDistances) {
  const auto truth = positions_each_second({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
  const auto estimate = positions_each_second({{0, 0, 0}, {1, 0, 3}, {1, 1, 4}});
  const auto result = absolute_trajectory_error(estimate, truth, Alignment::none);
  EXPECT_THAT(result.errors_m, ::testing::ElementsAre(0, 3, 4));
  EXPECT_DOUBLE_EQ(result.statistics.rmse, std::sqrt(25.0 / 3));
}

TEST(AbsoluteError, AlignsAnyRotationHalfTurnsIncluded) {
  const auto truth = winding_path(60);
  const Eigen::Vector3d axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, -2, 0.5}};
  for (const auto& axis : axes) {
    for (const double degrees : {1.0, 90.0, 179.999, 180.0, -120.0}) {
      const Pose motion = pose_at(1, -2, 3) * turned_by(degrees, axis);
      for (const auto alignment : {Alignment::first_pose, Alignment::se3, Alignment::sim3}) {
        const auto found = align(moved(truth, motion), truth, alignment);
        EXPECT_TRUE(found.rigid.isApprox(motion.inverse(), 1e-9)) << name(alignment) << degrees;
        EXPECT_NEAR(found.scale, 1, 1e-12);
      }
    }
  }
}

TEST(AbsoluteError, FindsTheScaleOnlyWhenAsked) {
  const auto truth = winding_path(60);
  const auto estimate = moved(scaled(truth, 4), turned_by(30, {0, 1, 0}));
  const auto sim3 = absolute_trajectory_error(estimate, truth, Alignment::sim3);
  EXPECT_NEAR(sim3.alignment.scale, 0.25, 1e-12);
  EXPECT_NEAR(sim3.statistics.max, 0, 1e-12);
  const auto se3 = absolute_trajectory_error(estimate, truth, Alignment::se3);
  EXPECT_EQ(se3.alignment.scale, 1);
  EXPECT_GT(se3.statistics.rmse, 0.5);
}

TEST(AbsoluteError, NeverReflects) {
  const auto truth = winding_path(60);
  auto estimate = truth;
  for (auto& pose : estimate) pose.T_world_camera.translation().x() *= -1;
  for (const auto alignment : {Alignment::se3, Alignment::sim3}) {
    const auto result = absolute_trajectory_error(estimate, truth, alignment);
    EXPECT_NEAR(result.alignment.rigid.linear().determinant(), 1, 1e-12);
    EXPECT_GT(result.alignment.scale, 0);
    EXPECT_GT(result.statistics.rmse, 0.01) << "a mirrored path fits only after a reflection";
  }
}

TEST(AbsoluteError, OfPositionsInAPlaneIsWellDefined) {
  const auto truth = positions_each_second({{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 3, 1}});
  const auto estimate = moved(truth, turned_by(180, {1, 1, 0}));
  const auto result = absolute_trajectory_error(estimate, truth, Alignment::se3);
  EXPECT_NEAR(result.statistics.max, 0, 1e-12);
  EXPECT_NEAR(result.alignment.rigid.linear().determinant(), 1, 1e-12);
}

TEST(AbsoluteError, IsTheLeastOfAllRigidMotions) {
  const auto truth = winding_path(40);
  auto estimate = truth;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    estimate[i].T_world_camera.translation().y() += 0.05 * std::sin(7.0 * static_cast<double>(i));
  }
  const auto best = absolute_trajectory_error(estimate, truth, Alignment::se3);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double step : {-1e-3, 1e-3}) {
      Eigen::Vector3d unit = Eigen::Vector3d::Zero();
      unit[axis] = 1;
      for (const Pose& nudge :
           {Pose(Eigen::Translation3d(step * unit)), Pose(Eigen::AngleAxisd(step, unit))}) {
        const auto other = absolute_trajectory_error(moved(estimate, nudge * best.alignment.rigid),
                                                     truth, Alignment::none);
        EXPECT_GT(other.statistics.rmse, best.statistics.rmse);
      }
    }
  }
}

TEST(AbsoluteError, FirstPoseMakesTheFirstPosesEqual) {
  const auto truth = moved(winding_path(10), turned_by(70, {1, 0, 1}));
  auto estimate = winding_path(10);
  estimate.front().T_world_camera = pose_at(0.1, 0, 0) * estimate.front().T_world_camera;
  const auto similarity = align(estimate, truth, Alignment::first_pose);
  EXPECT_TRUE((similarity.rigid * estimate.front().T_world_camera)
                  .isApprox(truth.front().T_world_camera, 1e-12));
}

TEST(AbsoluteError, RejectsWhatDoesNotDetermineTheRotation) {
  const auto line = positions_each_second({{0, 0, 0}, {0.1, 0.2, 0.3}, {0.2, 0.4, 0.6}});
  const auto point = positions_each_second({{0.1, 0.7, 0.3}, {0.1, 0.7, 0.3}, {0.1, 0.7, 0.3}});
  const auto nearly = positions_each_second({{0, 0, 0}, {0.5, 1e-8, 0}, {1, 0, 1e-8}});
  const auto two = positions_each_second({{0, 0, 0}, {1, 0, 0}});
  const auto triangle = positions_each_second({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  for (const auto alignment : {Alignment::se3, Alignment::sim3}) {
    EXPECT_THROW(align(line, line, alignment), InputError);
    EXPECT_THROW(align(line, triangle, alignment), InputError);
    EXPECT_THROW(align(nearly, nearly, alignment), InputError);
    EXPECT_THROW(align(point, triangle, alignment), InputError);
    EXPECT_THROW(align(triangle, point, alignment), InputError);
    EXPECT_THROW(align(point, point, alignment), InputError);
    EXPECT_THROW(align(two, two, alignment), InputError);
  }
  EXPECT_NO_THROW(align(triangle, triangle, Alignment::sim3));
  EXPECT_NO_THROW(align(point, triangle, Alignment::first_pose));
  EXPECT_NO_THROW(align(two, two, Alignment::none));
}

TEST(AbsoluteError, OfASinglePairAlignedToItselfDoesNotExist) {
  const auto one = positions_each_second({{1, 2, 3}}), other = positions_each_second({{0, 0, 0}});
  EXPECT_THROW(absolute_trajectory_error(one, other, Alignment::first_pose), InputError);
  EXPECT_EQ(absolute_trajectory_error(one, other, Alignment::none).statistics.count, 1u);
}

TEST(AbsoluteError, RejectsNoPairsAtAll) {
  for (const auto alignment : all_alignments) {
    EXPECT_THROW(absolute_trajectory_error({}, {}, alignment), InputError) << name(alignment);
  }
}

TEST(AbsoluteError, RejectsTrajectoriesThatAreNotPaired) {
  EXPECT_THROW(align(winding_path(3), winding_path(4), Alignment::se3), std::invalid_argument);
}

TEST(AbsoluteError, NeverReturnsWhatIsNotFinite) {
  const auto huge = positions_each_second(
      {{1e300, 0, 0}, {-1e300, 1e300, 0}, {0, -1e300, 1e300}, {0, 0, -1e300}});
  const auto truth = positions_each_second({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  for (const auto alignment : all_alignments) {
    EXPECT_THROW(absolute_trajectory_error(huge, truth, alignment), InputError) << name(alignment);
  }
}

TEST(Slambench1Ate, ComparesRowByRowAfterShiftAndFlip) {
  const std::vector<Eigen::Vector3d> before = {{0, 0, 0}, {0, 0, 0}, {0.1, 0.2, 0.3}};
  const std::vector<Eigen::Vector3d> rows = {{0, 0.5, -2.25}, {0.3, 0.5, -2.25}, {0.1, 0.3, -1.95}};
  const Eigen::Matrix3d y_up = Eigen::Vector3d(1, -1, 1).asDiagonal();
  const auto s = slambench1_ate(before, rows, y_up);
  EXPECT_EQ(s.count, 3u);
  EXPECT_NEAR(s.min, 0, 1e-12);
  EXPECT_NEAR(s.max, 0.3, 1e-12);
  EXPECT_NEAR(s.mean, 0.1, 1e-12);
  EXPECT_NEAR(slambench1_ate(before, rows, Eigen::Matrix3d::Identity()).max, 0.4, 1e-12);
}

TEST(Slambench1Ate, IsTwoFramesLateOnAPerfectEstimate) {
  // The camera rests in frames 0 and 1 and then moves on by one step a frame.
  constexpr double step_m = 0.01;
  const auto position = [](int frame) {
    return Eigen::Vector3d(std::max(0, frame - 1) * step_m, 0, 0);
  };
  std::vector<Eigen::Vector3d> before, rows;
  for (int p = 0; p < 10; ++p) {
    before.push_back(position(p - 1));
    rows.push_back(position(p + 1) + Eigen::Vector3d(0, 0, -2.25));
  }
  const auto s = slambench1_ate(before, rows, Eigen::Matrix3d::Identity());
  EXPECT_NEAR(s.max, 2 * step_m, 1e-12);
  EXPECT_NEAR(s.median, 2 * step_m, 1e-12);
  EXPECT_EQ(s.min, 0);
}

TEST(Slambench1Ate, LeavesRowsOutThatOnlyOneSideHas) {
  const std::vector<Eigen::Vector3d> three(3, Eigen::Vector3d::Zero()), two(2, three[0]);
  EXPECT_EQ(slambench1_ate(three, two, Eigen::Matrix3d::Identity()).count, 2u);
  EXPECT_EQ(slambench1_ate(two, three, Eigen::Matrix3d::Identity()).count, 2u);
  EXPECT_EQ(slambench1_ate({}, three, Eigen::Matrix3d::Identity()).count, 0u);
}

}  // namespace
}  // namespace slambench
