// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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

constexpr DeltaUnit all_units[] = {DeltaUnit::frames, DeltaUnit::seconds, DeltaUnit::meters};

TEST(RelativeError, OfEqualMotionIsZeroWhereverTheWorldsAre) {
  const auto truth = winding_path(90);
  const auto estimate = moved(truth, pose_at(5, 6, 7) * turned_by(100, {3, 1, 2}));
  for (const auto unit : all_units) {
    for (const auto& result : {relative_pose_error(estimate, truth, 1, unit),
                               tum_relative_pose_error(estimate, truth, 1, unit)}) {
      EXPECT_GT(result.translation_m.count, 10u);
      EXPECT_NEAR(result.translation_m.max, 0, 1e-12);
      EXPECT_NEAR(result.rotation_deg.max, 0, 1e-9);
    }
  }
}

TEST(RelativeError, OfAPureTranslationIsThatOfEachStep) {
  const auto truth = positions_each_second({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  const auto estimate = positions_each_second({{0, 0, 0}, {1.5, 0, 0}, {2, 0, 2}});
  const auto result = relative_pose_error(estimate, truth, 1, DeltaUnit::frames);
  EXPECT_THAT(result.translations_m, ::testing::ElementsAre(::testing::DoubleEq(0.5),
                                                            ::testing::DoubleEq(std::sqrt(4.25))));
  EXPECT_THAT(result.rotations_deg, ::testing::ElementsAre(0, 0));
}

TEST(RelativeError, OfAPureRotationIsItsAngle) {
  const Trajectory truth(3, {0, Pose::Identity()});
  for (const double degrees : {1e-6, 1.0, 90.0, 179.0, 180.0}) {
    Trajectory estimate = truth;
    for (std::size_t i = 0; i < 3; ++i) {
      estimate[i].time_s = static_cast<double>(i);
      estimate[i].T_world_camera = turned_by(degrees * static_cast<double>(i), {1, 2, 2});
    }
    const auto result = relative_pose_error(estimate, truth, 1, DeltaUnit::frames);
    EXPECT_NEAR(result.rotation_deg.min, degrees, 1e-7);
    EXPECT_NEAR(result.rotation_deg.max, degrees, 1e-7);
    EXPECT_EQ(result.translation_m.max, 0);
  }
}

TEST(RelativeError, LooksForwardAndTheBenchmarkOfTumBackward) {
  // True: one metre ahead. Estimated: the same metre, but also a quarter turn on the way.
  const Trajectory truth = {{0, pose_at(0, 0, 0)}, {1, pose_at(0, 0, 1)}, {2, pose_at(0, 0, 2)}};
  Trajectory estimate = truth;
  estimate[1].T_world_camera = pose_at(0, 0, 1) * turned_by(90, {0, 1, 0});
  estimate[2].T_world_camera = pose_at(0, 0, 2) * turned_by(90, {0, 1, 0});
  const auto forward = relative_pose_error(estimate, truth, 1, DeltaUnit::frames);
  EXPECT_NEAR(forward.translations_m[0], 0, 1e-12);
  EXPECT_NEAR(forward.rotations_deg[0], 90, 1e-9);
  const auto backward = tum_relative_pose_error(estimate, truth, 1, DeltaUnit::frames);
  ASSERT_EQ(backward.translations_m.size(), 1u)
      << "the pair that ends in the last pose is left out";
  EXPECT_NEAR(backward.translations_m[0], std::numbers::sqrt2, 1e-12);
  EXPECT_NEAR(backward.rotations_deg[0], 90, 1e-9);
}

TEST(RelativeError, CountsFrames) {
  const auto path = winding_path(10);
  EXPECT_EQ(relative_pose_error(path, path, 1, DeltaUnit::frames).translation_m.count, 9u);
  EXPECT_EQ(relative_pose_error(path, path, 9, DeltaUnit::frames).translation_m.count, 1u);
  EXPECT_EQ(relative_pose_error(path, path, 10, DeltaUnit::frames).translation_m.count, 0u);
  EXPECT_EQ(tum_relative_pose_error(path, path, 1, DeltaUnit::frames).translation_m.count, 8u);
}

TEST(RelativeError, CountsSecondsToATenth) {
  Trajectory path = winding_path(4);
  const double times[] = {0, 1.09, 2.2, 2.9};
  for (std::size_t i = 0; i < 4; ++i) path[i].time_s = times[i];
  // 0 -> 1.09 and 1.09 -> 2.2 miss by 0.09 and 0.11; 2.2 -> 2.9 by 0.3.
  EXPECT_EQ(relative_pose_error(path, path, 1, DeltaUnit::seconds).translation_m.count, 1u);
}

TEST(RelativeError, CountsMetersAlongTheEstimate) {
  const auto estimate = positions_each_second({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const auto truth = positions_each_second({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  const auto result = relative_pose_error(estimate, truth, 2, DeltaUnit::meters);
  EXPECT_THAT(result.translations_m,
              ::testing::ElementsAre(::testing::DoubleEq(std::numbers::sqrt2),
                                     ::testing::DoubleEq(std::numbers::sqrt2)));
}

TEST(RelativeError, OfTumLeavesOutWhatHasNoGroundTruthNearby) {
  const auto estimate = winding_path(10, 1);
  auto truth = winding_path(10, 1);
  for (std::size_t i = 5; i < 10; ++i) truth[i].time_s += 4;  // a gap: 0..4, then 9..13
  EXPECT_EQ(tum_relative_pose_error(estimate, truth, 1, DeltaUnit::seconds).translation_m.count,
            8u);
  truth.resize(5);
  EXPECT_EQ(tum_relative_pose_error(estimate, truth, 1, DeltaUnit::seconds).translation_m.count, 6u)
      << "5 and 6 are within two intervals of 4";
}

TEST(RelativeError, OfTumSortsWhatIsNot) {
  const auto truth = winding_path(60);
  auto estimate = moved(truth, turned_by(3, {0, 0, 1}));
  estimate[20].T_world_camera = estimate[20].T_world_camera * pose_at(0.1, 0, 0);
  const auto expected = tum_relative_pose_error(estimate, truth, 1, DeltaUnit::seconds);
  std::reverse(estimate.begin(), estimate.end());
  const auto reversed = tum_relative_pose_error(estimate, truth, 1, DeltaUnit::seconds);
  EXPECT_EQ(reversed.translations_m, expected.translations_m);
  EXPECT_NEAR(expected.translation_m.max, 0.1, 1e-9);
}

TEST(RelativeError, OfFewerThanTwoPosesIsEmpty) {
  for (const auto unit : all_units) {
    for (const int count : {0, 1}) {
      const auto path = winding_path(count);
      EXPECT_EQ(relative_pose_error(path, path, 1, unit).translation_m.count, 0u);
      EXPECT_EQ(tum_relative_pose_error(path, path, 1, unit).translation_m.count, 0u);
    }
  }
  EXPECT_EQ(tum_relative_pose_error(winding_path(9), {}, 1, DeltaUnit::frames).translation_m.count,
            0u);
}

TEST(RelativeError, RejectsADeltaThatIsNone) {
  const auto path = winding_path(9);
  for (const auto unit : all_units) {
    for (const double delta : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
      EXPECT_THROW(relative_pose_error(path, path, delta, unit), UsageError);
      EXPECT_THROW(tum_relative_pose_error(path, path, delta, unit), UsageError);
    }
  }
  EXPECT_THROW(relative_pose_error(path, path, 1.5, DeltaUnit::frames), UsageError);
}

TEST(RelativeError, NeverReturnsWhatIsNotFinite) {
  const auto huge = positions_each_second({{1e308, 0, 0}, {-1e308, 0, 0}, {1e308, 0, 0}});
  const auto truth = positions_each_second({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  EXPECT_THROW(relative_pose_error(huge, truth, 1, DeltaUnit::frames), InputError);
  EXPECT_THROW(tum_relative_pose_error(huge, truth, 1, DeltaUnit::frames), InputError);
}

}  // namespace
}  // namespace slambench
