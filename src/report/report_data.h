// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/report_run.h"

namespace slambench {

/// What the user chose of a report.
struct ReportOptions {
  std::string title = "SLAMBench report";
  int detailed_runs = 8;                 ///< shown frame by frame as well: see detailed_runs()
  std::vector<int> picture_frames = {};  ///< whose pictures are shown; empty: a few of each run
};

/// All that the page shows, as the one JSON value that its script reads: the records as they are,
/// and of the detailed runs the columns along the sequence, the paths and the pictures. Long
/// sequences are thinned and pictures limited, so that the file stays small; `limits` says how.
nlohmann::ordered_json report_data(const std::vector<ReportRun>& runs,
                                   const ReportOptions& options);

/// The runs that are shown frame by frame: the first ones; where there are several sequences, of
/// the one that has the most runs. In order.
std::vector<std::size_t> detailed_runs(const std::vector<ReportRun>& runs,
                                       const ReportOptions& options);

/// Indices of the points that no other is as good as in both coordinates and better in one; in
/// order of x. Less is better.
struct TradeOff {
  std::size_t index = 0;
  double x = 0, y = 0;
};
std::vector<std::size_t> pareto_front(std::vector<TradeOff> points);

}  // namespace slambench
