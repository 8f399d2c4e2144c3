// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "analysis/interval.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace slambench {
namespace {

TEST(StudentT, EqualsTheTables) {
  EXPECT_NEAR(student_t(0.05, 1), 12.7062, 1e-3);
  EXPECT_NEAR(student_t(0.05, 2), 4.30265, 1e-4);
  EXPECT_NEAR(student_t(0.05, 9), 2.26216, 1e-5);
  EXPECT_NEAR(student_t(0.01, 4), 4.60409, 1e-4);
  EXPECT_NEAR(student_t(0.002, 30), 3.38518, 1e-4);
  EXPECT_NEAR(student_t(0.05, 1e4), 1.96020, 1e-4);
}

TEST(RatioOfRuns, IsWelchsIntervalOfTheLogarithms) {
  // Logarithms 0, 1, 2 and 2, 4: means 1 and 3, variances of the means 1/3 and 1; degrees of
  // freedom (4/3)^2 / (1/9/2 + 1/1) = 1.6842.
  const std::array<double, 3> base = {1, std::exp(1.0), std::exp(2.0)};
  const std::array<double, 2> other = {std::exp(2.0), std::exp(4.0)};
  const RatioInterval interval = ratio_of_runs(base, other, 0.05);
  EXPECT_NEAR(std::log(interval.ratio), 2, 1e-12);
  const double half_width = student_t(0.05, (16.0 / 9) / (1.0 / 18 + 1)) * std::sqrt(4.0 / 3);
  EXPECT_NEAR(std::log(interval.low), 2 - half_width, 1e-9);
  EXPECT_NEAR(std::log(interval.high), 2 + half_width, 1e-9);
}

TEST(RatioOfRuns, LetsASingleRunScatterAsTheOthersDo) {
  const std::array<double, 3> base = {1, std::exp(1.0), std::exp(2.0)};  // variance 1
  const std::array<double, 1> other = {std::exp(1.0)};
  const RatioInterval interval = ratio_of_runs(base, other, 0.05);
  EXPECT_NEAR(std::log(interval.high), student_t(0.05, 2) * std::sqrt(1.0 / 3 + 1), 1e-9);
  const RatioInterval turned = ratio_of_runs(other, base, 0.05);
  EXPECT_NEAR(turned.high, 1 / interval.low, 1e-9);
}

TEST(RatioOfPairs, DoesNotCountWhatChangesForBoth) {
  std::vector<double> base, other;
  for (int i = 0; i < 8; ++i) {
    base.push_back(std::exp(i));  // the machine becomes slower and slower
    other.push_back(1.1 * std::exp(i) * (i % 2 == 0 ? 1.01 : 1 / 1.01));
  }
  const RatioInterval pairs = ratio_of_pairs(base, other, 0.05);
  EXPECT_NEAR(pairs.ratio, 1.1, 1e-9);
  EXPECT_GT(pairs.low, 1.08);
  EXPECT_LT(pairs.high, 1.12);
  EXPECT_TRUE(ratio_of_runs(base, other, 0.05).contains_one());
}

/// How often the interval holds the true ratio, 1, of 1000 tries.
template <class Interval>
int coverage(Interval interval) {
  int covered = 0;
  for (int i = 0; i < 1000; ++i) covered += interval().contains_one() ? 1 : 0;
  return covered;
}

TEST(RatioOfRuns, HoldsTheTruthAsOftenAsItSays) {
  std::mt19937_64 random(1);
  std::lognormal_distribution<double> little(0, 0.02), much(0, 0.1);
  const int covered = coverage([&] {
    std::array<double, 5> base{}, other{};
    for (double& v : base) v = little(random);
    for (double& v : other) v = much(random);
    return ratio_of_runs(base, other, 0.05);
  });
  EXPECT_GT(covered, 930);
  EXPECT_LT(covered, 975);
}

TEST(RatioOfFrames, HoldsTheTruthAlsoWhenNeighboursAreAlike) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto frames = [&] {
    std::vector<double> values;
    double disturbance = 0;
    for (int i = 0; i < 400; ++i) {
      disturbance = 0.6 * disturbance + normal(random);
      values.push_back((i % 2 == 0 ? 30 : 10) + disturbance);
    }
    return values;
  };
  int covered = 0;
  for (int i = 0; i < 200; ++i) {
    const auto base = frames(), other = frames();
    covered += ratio_of_frames(base, other, 0.05).contains_one() ? 1 : 0;
  }
  EXPECT_GT(covered, 180);
  EXPECT_LT(covered, 200);
}

TEST(RatioOfFrames, IsTheRatioOfTheMeansAndTheSameEachTime) {
  const std::array<double, 4> base = {1, 2, 3, 4}, other = {2, 4, 6, 8};
  const RatioInterval a = ratio_of_frames(base, other, 0.05);
  EXPECT_NEAR(a.ratio, 2, 1e-12);
  EXPECT_NEAR(a.low, 2, 1e-9) << "twice as long in each frame";
  const std::array<double, 3> fewer = {2, 4, 9};
  const RatioInterval b = ratio_of_frames(base, fewer, 0.05),
                      c = ratio_of_frames(base, fewer, 0.05);
  EXPECT_NEAR(b.ratio, 2, 1e-12);
  EXPECT_LE(b.low, 2);
  EXPECT_EQ(b.low, c.low);
}

TEST(BlockLength, IsLongerThanAnyRateAndGrows) {
  EXPECT_EQ(block_length(4), 4u);
  EXPECT_EQ(block_length(50), 10u);
  EXPECT_EQ(block_length(900), 30u);
}

}  // namespace
}  // namespace slambench
