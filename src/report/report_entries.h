// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>
#include <vector>

#include "report/report_run.h"

namespace slambench {

/// Entries of a report.
struct ReportEntries {
  std::string title;            ///< that of the suite which all runs are of; empty without one
  std::vector<ReportRun> runs;  ///< each is a run, or stands for several that repeat each other
};

/// Where `repeats_together`, runs that differ in nothing but what was measured become one entry:
/// the run whose time of computation is the median (of two in the middle the faster), with the
/// figures of all as the `repetition` of its record (docs/record.md). Wherever an entry has a
/// `repetition`, its record's figures are the medians in it. Names the entries, their sequences and
/// variants: as the suite does that the folders are of (suite.json beside their parents), in its
/// order; else the variant is the backend, and whatever else differs between the runs of one
/// sequence.
ReportEntries report_entries(std::vector<ReportRun> runs, const ParameterRoles& roles,
                             bool repeats_together);

}  // namespace slambench
