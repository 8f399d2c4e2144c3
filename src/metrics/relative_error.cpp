// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "core/error.h"
#include "metrics/trajectory_metrics.h"

namespace slambench {
namespace {

/// A pair counts when it misses delta by no more than this share of it.
constexpr double relative_tolerance = 0.1;

void require_delta(double delta, DeltaUnit unit) {
  const bool whole = unit != DeltaUnit::frames || delta == std::floor(delta);
  if (!std::isfinite(delta) || delta <= 0 || !whole) {
    throw UsageError(fmt::format("relative pose error: found delta {}, expected a {} above 0",
                                 delta, unit == DeltaUnit::frames ? "whole number" : "number"));
  }
}

/// What delta is counted in, at each pose: never decreasing.
std::vector<double> progress(const Trajectory& sorted, DeltaUnit unit) {
  std::vector<double> values(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    switch (unit) {
      case DeltaUnit::frames:
        values[i] = static_cast<double>(i);
        break;
      case DeltaUnit::seconds:
        values[i] = sorted[i].time_s;
        break;
      case DeltaUnit::meters:
        if (i == 0) break;
        values[i] = values[i - 1] + (sorted[i].T_world_camera.translation() -
                                     sorted[i - 1].T_world_camera.translation())
                                        .norm();
        break;
    }
  }
  return values;
}

/// The first index from `begin` on whose value is nearest; `begin` < size.
std::size_t nearest(const std::vector<double>& sorted, std::size_t begin, double value) {
  const auto from = sorted.begin() + static_cast<std::ptrdiff_t>(begin);
  auto best = std::lower_bound(from, sorted.end(), value);
  if (best == sorted.end() || (best != from && value - best[-1] <= *best - value)) --best;
  best = std::lower_bound(from, best, *best);
  return static_cast<std::size_t>(best - sorted.begin());
}

/// Adds the error of the motion from one pose to another.
void add_error(const Pose& estimate_from, const Pose& estimate_to, const Pose& truth_from,
               const Pose& truth_to, RpeResult* result) {
  const Pose error =
      (truth_from.inverse() * truth_to).inverse() * (estimate_from.inverse() * estimate_to);
  result->translations_m.push_back(error.translation().norm());
  result->rotations_deg.push_back(Eigen::AngleAxisd(error.linear()).angle() * 180 /
                                  std::numbers::pi);
}

RpeResult with_statistics(RpeResult result) {
  const auto finite = [](double v) { return std::isfinite(v); };
  if (!std::all_of(result.translations_m.begin(), result.translations_m.end(), finite)) {
    throw InputError("relative pose error: the positions are too large to be compared");
  }
  result.translation_m = summarize(result.translations_m);
  result.rotation_deg = summarize(result.rotations_deg);
  return result;
}

double median_interval_s(const Trajectory& sorted) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    intervals.push_back(sorted[i].time_s - sorted[i - 1].time_s);
  }
  return summarize(intervals).median;
}

}  // namespace

RpeResult relative_pose_error(const Trajectory& estimate, const Trajectory& ground_truth,
                              double delta, DeltaUnit unit) {
  require_delta(delta, unit);
  if (estimate.size() != ground_truth.size()) {
    throw std::invalid_argument("trajectories that are paired by index differ in length");
  }
  const std::vector<double> at = progress(estimate, unit);
  RpeResult result;
  for (std::size_t i = 0; i + 1 < estimate.size(); ++i) {
    const std::size_t j = nearest(at, i + 1, at[i] + delta);
    const double miss = std::abs(at[j] - at[i] - delta);
    if (miss > (unit == DeltaUnit::frames ? 0.0 : relative_tolerance * delta)) continue;
    add_error(estimate[i].T_world_camera, estimate[j].T_world_camera,
              ground_truth[i].T_world_camera, ground_truth[j].T_world_camera, &result);
  }
  return with_statistics(std::move(result));
}

RpeResult tum_relative_pose_error(const Trajectory& estimate, const Trajectory& ground_truth,
                                  double delta, DeltaUnit unit) {
  require_delta(delta, unit);
  const Trajectory e = sorted_by_time(estimate);
  const Trajectory g = sorted_by_time(ground_truth);
  const std::vector<double> at = progress(e, unit);
  const double limit_s = 2 * median_interval_s(g);
  RpeResult result;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const std::size_t j = nearest(at, 0, at[i] + delta);
    if (j + 1 == e.size()) continue;
    const auto truth_i = nearest_pose(g, e[i].time_s, limit_s);
    const auto truth_j = nearest_pose(g, e[j].time_s, limit_s);
    if (!truth_i || !truth_j) continue;
    add_error(e[j].T_world_camera, e[i].T_world_camera, g[*truth_j].T_world_camera,
              g[*truth_i].T_world_camera, &result);
  }
  return with_statistics(std::move(result));
}

}  // namespace slambench
