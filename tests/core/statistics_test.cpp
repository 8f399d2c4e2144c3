// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "core/statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace slambench {
namespace {

TEST(Statistics, OfAKnownSample) {
  constexpr std::array<double, 5> values = {5, 1, 4, 2, 3};
  const Statistics s = summarize(values);
  EXPECT_EQ(s.count, 5u);
  EXPECT_DOUBLE_EQ(s.mean, 3);
  EXPECT_DOUBLE_EQ(s.median, 3);
  EXPECT_DOUBLE_EQ(s.min, 1);
  EXPECT_DOUBLE_EQ(s.max, 5);
  EXPECT_DOUBLE_EQ(s.p95, 4.8);
  EXPECT_DOUBLE_EQ(s.p99, 4.96);
  EXPECT_DOUBLE_EQ(s.std, std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(11.0));
}

TEST(Statistics, OfTwoValuesTakesTheMiddleAsMedian) {
  constexpr std::array<double, 2> values = {1, 2};
  EXPECT_DOUBLE_EQ(summarize(values).median, 1.5);
}

TEST(Statistics, OfNothingCountsZero) { EXPECT_EQ(summarize({}).count, 0u); }

}  // namespace
}  // namespace slambench
