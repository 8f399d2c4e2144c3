// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/run_group.h"
#include "analysis/stored_run.h"

namespace slambench {

/// A run to be handed on.
struct ExportRun {
  std::string name;  ///< short, and different from that of every other run
  StoredRun run;
};

/// The runs of these result folders. Throws InputError naming what cannot be read.
std::vector<ExportRun> read_export_runs(const std::vector<std::string>& folders);

/// A form in which another program takes results; docs/exports.md describes each.
struct ExportFormat {
  std::string_view name;      ///< as on the command line
  std::string_view sentence;  ///< for people
  /// The text of the file. Throws InputError for runs that the format has no room for.
  std::string (*text)(const std::vector<ExportRun>& runs, const ParameterRoles& roles);
};

std::span<const ExportFormat> export_table();

/// Nullptr when there is none of that name.
const ExportFormat* find_export_format(std::string_view name);

// One file a format.

/// What Google Benchmark writes with --benchmark_format=json, for its compare.py and others. Runs
/// that do not differ are repetitions.
std::string google_benchmark_json(const std::vector<ExportRun>& runs, const ParameterRoles& roles);

/// Trace events for Perfetto and Chrome: frames, in them stages, in them kernels; what the sensors
/// said as counters. Reads frames.csv and samples.csv.
std::string trace_json(const std::vector<ExportRun>& runs, const ParameterRoles& roles);

/// A row a run, a column a figure, then a column a parameter. Of repeated runs the medians.
std::string wide_csv(const std::vector<ExportRun>& runs, const ParameterRoles& roles);

/// A row a figure and repeat, those that were not measured with the reason.
std::string long_csv(const std::vector<ExportRun>& runs, const ParameterRoles& roles);

}  // namespace slambench
