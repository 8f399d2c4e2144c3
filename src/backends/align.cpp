// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/align.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>

namespace slambench {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

Matrix6 normal_matrix(const Reduction& reduction) {
  Matrix6 m;
  const double* next = reduction.jt_j;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      m(row, column) = *next;
      m(column, row) = *next++;
    }
  }
  return m;
}

}  // namespace

AlignResult iterate_align(const AlignInput& input, const MatchLevel& match,
                          const SolveMotion& solve) {
  AlignResult result;
  result.T_volume_camera = input.T_volume_camera;
  result.iterations.assign(input.iterations.size(), 0);
  TrackParameters parameters = input.parameters;
  for (std::size_t level = input.iterations.size(); level-- > 0;) {
    for (int i = 0; i < input.iterations[level]; ++i) {
      parameters.T_volume_camera = to_rigid3f(result.T_volume_camera);
      result.last = match(level, parameters);
      result.last_level = static_cast<int>(level);
      ++result.iterations[level];
      const Twist twist = solve(result.last);
      result.T_volume_camera = moved(result.T_volume_camera, twist);
      if (norm(twist) < input.convergence) break;
    }
  }
  return result;
}

Twist solve_motion(const Reduction& sums, double condition) {
  const Matrix6 jt_j = normal_matrix(sums);
  const Vector6 jt_error = Eigen::Map<const Vector6>(sums.jt_error);
  Twist twist;
  if (!jt_j.allFinite() || !jt_error.allFinite()) return twist;
  Eigen::JacobiSVD<Matrix6> svd(jt_j, Eigen::ComputeFullU | Eigen::ComputeFullV);
  svd.setThreshold(1 / condition);
  Eigen::Map<Vector6>(twist.v) = svd.solve(jt_error);
  return twist;
}

Twist solve_motion_quickly(const Reduction& sums, double condition) {
  const Matrix6 jt_j = normal_matrix(sums);
  const Vector6 jt_error = Eigen::Map<const Vector6>(sums.jt_error);
  const Eigen::LLT<Matrix6> factors(jt_j);
  // The norms' product is at least the quotient of the greatest and the least singular value.
  const bool surely_within = factors.info() == Eigen::Success && jt_error.allFinite() &&
                             jt_j.norm() * factors.solve(Matrix6::Identity()).norm() < condition;
  if (!surely_within) return solve_motion(sums, condition);
  Twist twist;
  Eigen::Map<Vector6>(twist.v) = factors.solve(jt_error);
  return twist;
}

}  // namespace slambench
