// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "report/report_run.h"

namespace slambench {

/// Camera positions as (right, forward, up) of the start camera, m, whatever the sequence's axes.
struct ReportPaths {
  std::vector<Eigen::Vector3d> estimate;
  std::vector<Eigen::Vector3d> truth;  ///< laid over the estimate, as far as that goes in time
  std::string truth_note;              ///< how it was laid over it, or why there is none
};

ReportPaths report_paths(const ReportRun& run);

}  // namespace slambench
