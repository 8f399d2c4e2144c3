// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/error.h"
#include "metrics/trajectory_metrics.h"

namespace slambench {
namespace {

using Points = Eigen::Matrix3Xd;

Points positions(const Trajectory& trajectory) {
  Points points(3, static_cast<Eigen::Index>(trajectory.size()));
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    points.col(static_cast<Eigen::Index>(i)) = trajectory[i].T_world_camera.translation();
  }
  return points;
}

/// Below this share of the largest singular value of the covariance the second one is noise: the
/// positions lie on a line to a millionth of its length, and any turn about it fits as well.
constexpr double collinear_share = 1e-12;

/// The covariance of two point sets that do not vary but for the rounding of their coordinates.
double rounding_noise(const Points& x, const Points& y) {
  const double unit = 8 * std::numeric_limits<double>::epsilon();
  return unit * x.cwiseAbs().maxCoeff() * unit * y.cwiseAbs().maxCoeff();
}

/// Umeyama, PAMI 1991, eq. 34 to 43: the similarity that takes x to y with least squares.
Similarity umeyama(const Points& x, const Points& y, bool with_scale) {
  const double n = static_cast<double>(x.cols());
  const Eigen::Vector3d mean_x = x.rowwise().mean();
  const Eigen::Vector3d mean_y = y.rowwise().mean();
  const Points centered_x = x.colwise() - mean_x;
  const Eigen::Matrix3d covariance = (y.colwise() - mean_y) * centered_x.transpose() / n;
  const double variance_x = centered_x.squaredNorm() / n;
  if (!covariance.allFinite() || !std::isfinite(variance_x)) {
    throw InputError("alignment: the positions are too large to be aligned");
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& values = svd.singularValues();
  if (values[1] <= std::max(collinear_share * values[0], rounding_noise(x, y))) {
    throw InputError(
        "alignment: the paired positions lie on one line or in one point, which leaves the "
        "rotation undetermined");
  }
  Eigen::Vector3d signs(1, 1, 1);
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) signs[2] = -1;

  Similarity similarity;
  similarity.rigid.linear() = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  if (with_scale) similarity.scale = values.dot(signs) / variance_x;
  similarity.rigid.translation() = mean_y - similarity.scale * (similarity.rigid.linear() * mean_x);
  return similarity;
}

void require_pairs(const Trajectory& estimate, const Trajectory& ground_truth,
                   std::size_t at_least) {
  if (estimate.size() != ground_truth.size()) {
    throw std::invalid_argument("trajectories that are paired by index differ in length");
  }
  if (estimate.size() < at_least) {
    throw InputError(fmt::format("alignment: found {} pairs of poses, expected {} at least",
                                 estimate.size(), at_least));
  }
}

}  // namespace

std::string_view name(Alignment alignment) {
  switch (alignment) {
    case Alignment::none:
      return "none";
    case Alignment::first_pose:
      return "first_pose";
    case Alignment::se3:
      return "se3";
    case Alignment::sim3:
      return "sim3";
  }
  return "";
}

Similarity align(const Trajectory& estimate, const Trajectory& ground_truth, Alignment alignment) {
  const bool fitted = alignment == Alignment::se3 || alignment == Alignment::sim3;
  require_pairs(estimate, ground_truth, fitted ? 3 : 1);
  if (fitted) {
    return umeyama(positions(estimate), positions(ground_truth), alignment == Alignment::sim3);
  }
  Similarity similarity;
  if (alignment == Alignment::first_pose) {
    require_pairs(estimate, ground_truth, 2);  // one fits whatever it is
    similarity.rigid =
        ground_truth.front().T_world_camera * estimate.front().T_world_camera.inverse();
  }
  return similarity;
}

AteResult absolute_trajectory_error(const Trajectory& estimate, const Trajectory& ground_truth,
                                    Alignment alignment) {
  AteResult result;
  result.alignment = align(estimate, ground_truth, alignment);
  const Points aligned =
      (result.alignment.scale * (result.alignment.rigid.linear() * positions(estimate))).colwise() +
      result.alignment.rigid.translation();
  const Eigen::VectorXd errors = (aligned - positions(ground_truth)).colwise().norm();
  if (!std::isfinite(errors.squaredNorm())) {
    throw InputError("absolute trajectory error: the positions are too large to be compared");
  }
  result.errors_m.assign(errors.begin(), errors.end());
  result.statistics = summarize(result.errors_m);
  return result;
}

Statistics slambench1_ate(std::span<const Eigen::Vector3d> positions_before_frame,
                          std::span<const Eigen::Vector3d> ground_truth_rows,
                          const Eigen::Matrix3d& own_from_camera) {
  const std::size_t rows = std::min(positions_before_frame.size(), ground_truth_rows.size());
  std::vector<double> errors_m(rows);
  for (std::size_t p = 0; p < rows; ++p) {
    const Eigen::Vector3d shifted =
        own_from_camera * positions_before_frame[p] + ground_truth_rows[0];
    errors_m[p] = (shifted - ground_truth_rows[p]).norm();
  }
  return summarize(errors_m);
}

}  // namespace slambench
