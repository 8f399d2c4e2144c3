// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "report/paths.h"

#include <Eigen/LU>
#include <algorithm>

#include "core/error.h"
#include "metrics/trajectory_metrics.h"

namespace slambench {
namespace {

using Json = nlohmann::ordered_json;

/// From the sequence's own axes to those of the chart.
Eigen::Matrix3d chart_from_own(const Json& record) {
  Eigen::Matrix3d own_from_camera = Eigen::Matrix3d::Identity();
  const Json rows = record.at("sequence").value("own_from_camera", Json());
  for (std::size_t y = 0; y < 3; ++y) {
    for (std::size_t x = 0; x < 3; ++x) {
      const bool there = rows.is_array() && rows.size() == 3 && rows[y].is_array() &&
                         rows[y].size() == 3 && rows[y][x].is_number();
      if (!there) throw InputError("record.json: sequence.own_from_camera: expected a 3x3 matrix");
      own_from_camera(static_cast<int>(y), static_cast<int>(x)) = rows[y][x].get<double>();
    }
  }
  Eigen::Matrix3d chart_from_camera;  // camera: x right, y down, z forward
  chart_from_camera << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return chart_from_camera * own_from_camera.inverse();
}

/// The limit within which the record paired poses, or the usual one.
double pairing_limit_s(const Json& record) {
  const Json judged = record.at("accuracy").value("over_processed", Json());
  const Json limit = judged.is_object() ? judged.value("limit_s", Json()) : Json();
  return limit.is_number() ? limit.get<double>() : default_limit_s(Association::evo);
}

/// Fitted by SE(3) or, where the positions do not determine that, by the first pose.
Similarity truth_from_estimate(const ReportRun& run, double limit_s, std::string* note) {
  const PosePairs pairs = associate(run.estimate, run.truth, Association::evo, limit_s);
  const PairedTrajectories paired = select(run.estimate, run.truth, pairs);
  try {
    Similarity fit = align(paired.estimate, paired.ground_truth, Alignment::se3);
    *note = "true path laid over the estimate by SE(3)";
    return fit;
  } catch (const InputError&) {
    Similarity fit = align(paired.estimate, paired.ground_truth, Alignment::first_pose);
    *note = "true path laid over the estimate at the first pose";
    return fit;
  }
}

}  // namespace

ReportPaths report_paths(const ReportRun& run) {
  const Eigen::Matrix3d chart = chart_from_own(run.record);
  ReportPaths paths;
  for (const StampedPose& pose : run.estimate) {
    paths.estimate.emplace_back(chart * pose.T_world_camera.translation());
  }
  if (run.truth.empty() || run.estimate.empty()) {
    paths.truth_note = "the result folder has no ground truth";
    return paths;
  }
  const double limit_s = pairing_limit_s(run.record);
  try {
    const Similarity fit = truth_from_estimate(run, limit_s, &paths.truth_note);
    const auto by_time = [](const StampedPose& a, const StampedPose& b) {
      return a.time_s < b.time_s;
    };
    const auto [first, last] =
        std::minmax_element(run.estimate.begin(), run.estimate.end(), by_time);
    for (const StampedPose& pose : sorted_by_time(run.truth)) {
      if (pose.time_s < first->time_s - limit_s || pose.time_s > last->time_s + limit_s) continue;
      paths.truth.emplace_back(chart * (fit.rigid.inverse() * pose.T_world_camera.translation()));
    }
  } catch (const InputError& error) {
    paths.truth_note = error.what();
  }
  return paths;
}

}  // namespace slambench
