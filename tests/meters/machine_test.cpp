// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/machine.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "meters/fma.h"

namespace slambench {
namespace {

TEST(Machine, ReachesWhatAnyMachineReaches) {
  const double begin_s = steady_clock().now_s();
  const MachineCeiling ceiling = measure_machine(steady_clock(), 2);
  EXPECT_EQ(ceiling.threads, 2);
  EXPECT_FALSE(ceiling.instruction_set.empty());
  // From the slowest board to several times the fastest server, per two threads.
  EXPECT_GT(ceiling.copy_bytes_per_s, 1e8);
  EXPECT_LT(ceiling.copy_bytes_per_s, 1e13);
  EXPECT_GT(ceiling.fma_flops_per_s, 1e8);
  EXPECT_LT(ceiling.fma_flops_per_s, 1e13);
  EXPECT_LT(steady_clock().now_s() - begin_s, 30);
}

TEST(Machine, UsesTheCoresItMay) { EXPECT_GE(measure_machine(steady_clock(), 0).threads, 1); }

TEST(MultiplyAdd, CountsWhatItDoes) {
  float sink = 0;
  const double flops = multiply_add(100, &sink);
  // 12 sums of 2 operations in registers of 1 to 64 floats.
  EXPECT_EQ(flops / (100 * 12 * 2), static_cast<int>(flops / (100 * 12 * 2)));
  EXPECT_GE(flops, 100 * 12 * 2);
  // Every sum tends to 1.
  EXPECT_NEAR(sink, flops / (100 * 2), 1e-3);
  EXPECT_EQ(multiply_add(200, &sink), 2 * flops);
}

}  // namespace
}  // namespace slambench
