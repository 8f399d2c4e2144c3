// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// The figures of the TUM benchmark's and evo's own programs on public trajectories, to all the
// digits they print.
#include <gtest/gtest.h>

#include "io/trajectory_file.h"
#include "metrics/trajectory_metrics.h"
#include "support/reference_data.h"

namespace slambench {
namespace {

using testing::reference_data;

constexpr double printed = 0.5e-6;  // half of the last digit

struct Example {
  Trajectory estimate, ground_truth;
};

Example fr2_desk() {
  return {read_trajectory(reference_data("trajectories/fr2_desk_ORB.txt")),
          read_trajectory(reference_data("trajectories/fr2_desk_groundtruth.txt"))};
}

Example fr1_xyz() {
  return {read_trajectory(reference_data("trajectories/freiburg1_xyz-rgbdslam.txt")),
          read_trajectory(reference_data("trajectories/freiburg1_xyz-groundtruth.txt"))};
}

void expect_ate(const Example& example, Association rule, Alignment alignment, std::size_t count,
                double rmse_m) {
  const auto pairs = associate(example.estimate, example.ground_truth, rule, default_limit_s(rule));
  EXPECT_EQ(pairs.size(), count);
  const auto paired = select(example.estimate, example.ground_truth, pairs);
  const auto result = absolute_trajectory_error(paired.estimate, paired.ground_truth, alignment);
  EXPECT_NEAR(result.statistics.rmse, rmse_m, printed);
}

TEST(Golden, Fr2DeskByTheRuleOfTum) {
  SLAMBENCH_REQUIRE_DATA();
  expect_ate(fr2_desk(), Association::tum, Alignment::se3, 2223, 0.008144);
}

TEST(Golden, Fr2DeskByTheRuleOfEvo) {
  SLAMBENCH_REQUIRE_DATA();
  expect_ate(fr2_desk(), Association::evo, Alignment::se3, 2174, 0.008119);
  expect_ate(fr2_desk(), Association::evo, Alignment::sim3, 2174, 0.006123);
}

TEST(Golden, Fr1XyzByTheRuleOfTum) {
  SLAMBENCH_REQUIRE_DATA();
  expect_ate(fr1_xyz(), Association::tum, Alignment::se3, 786, 0.013473);
}

TEST(Golden, Fr1XyzRelativeErrorOverOneSecond) {
  SLAMBENCH_REQUIRE_DATA();
  const auto example = fr1_xyz();
  const auto result =
      tum_relative_pose_error(example.estimate, example.ground_truth, 1, DeltaUnit::seconds);
  EXPECT_EQ(result.translation_m.count, 753u);
  EXPECT_NEAR(result.translation_m.rmse, 0.021217, printed);
  EXPECT_NEAR(result.rotation_deg.rmse, 0.934480, printed);
}

}  // namespace
}  // namespace slambench
