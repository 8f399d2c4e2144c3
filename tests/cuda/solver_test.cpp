// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/cuda/solver.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "backends/cuda/device_backend.h"
#include "backends/serial/serial_backend.h"

namespace slambench {
namespace {

constexpr double condition = 1e6;

/// The sums of random rows of which `free` components of the motion leave no trace.
Reduction random_sums(int free, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Reduction sums;
  for (int row = 0; row < 100; ++row) {
    double j[6] = {};
    for (int i = 0; i < 6 - free; ++i) j[i] = uniform(random);
    // The free directions are not those of the axes.
    for (int i = 6 - free; i < 6; ++i) j[i] = 0.5 * j[0] - 0.25 * j[1];
    const double error = 0.01 * uniform(random);
    double* entry = sums.jt_j;
    for (int a = 0; a < 6; ++a) {
      sums.jt_error[a] += error * j[a];
      for (int b = a; b < 6; ++b) *entry++ += j[a] * j[b];
    }
  }
  return sums;
}

Twist solved_as_on_the_device(const Reduction& sums) {
  cuda::Equations equations{};
  cuda::set_up(sums.jt_j, sums.jt_error, &equations);
  cuda::factor(&equations);
  for (int column = 0; column <= 6; ++column) cuda::solve_column(&equations, column);
  return cuda::solution(&equations, condition);
}

void expect_same(const Twist& expected, const Twist& found) {
  const double scale = slambench::norm(expected);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(found.v[i], expected.v[i], 1e-9 * scale) << i;
}

TEST(CudaSolver, AnswersWhatTheHostAnswers) {
  SerialBackend serial;
  for (int free = 0; free <= 6; ++free) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      SCOPED_TRACE(::testing::Message() << free << " free, seed " << seed);
      const Reduction sums = random_sums(free, seed);
      expect_same(serial.solve(sums, condition), solved_as_on_the_device(sums));
    }
  }
}

/// One direction that all but does not count, and one that just does not.
TEST(CudaSolver, CutsWhereTheHostCuts) {
  SerialBackend serial;
  for (const double smallest : {1e-3, 2e-6, 0.5e-6, 1e-9, 0.0}) {
    SCOPED_TRACE(smallest);
    Reduction sums;
    const int diagonal[] = {0, 6, 11, 15, 18, 20};
    for (int i = 0; i < 6; ++i) {
      sums.jt_j[diagonal[i]] = i == 4 ? smallest : 1.0;
      sums.jt_error[i] = 0.01 * (i + 1) * (i == 4 ? smallest : 1.0);
    }
    expect_same(serial.solve(sums, condition), solved_as_on_the_device(sums));
  }
}

TEST(CudaSolver, DoesNotMoveByWhatIsNotFinite) {
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Reduction matrix = random_sums(0, 1), right = matrix;
    matrix.jt_j[7] = value;
    right.jt_error[2] = value;
    EXPECT_EQ(slambench::norm(solved_as_on_the_device(matrix)), 0);
    EXPECT_EQ(slambench::norm(solved_as_on_the_device(right)), 0);
  }
}

TEST(CudaSolver, MovesAsTheHostMoves) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Pose pose = Pose::Identity();
  for (const double scale : {0.0, 1e-9, 1e-5, 0.99e-4, 1.01e-4, 1e-2, 1.0}) {
    for (int i = 0; i < 50; ++i) {
      Twist twist;
      for (double& component : twist.v) component = scale * uniform(random);
      const Pose expected = moved(pose, twist);
      const Pose found = cuda::to_pose(cuda::moved(cuda::to_pose_d(pose), twist));
      EXPECT_LT((expected.matrix() - found.matrix()).cwiseAbs().maxCoeff(), 1e-13) << scale;
      pose = expected;
    }
  }
}

}  // namespace
}  // namespace slambench
