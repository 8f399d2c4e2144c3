// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "exports/exports.h"

#include <algorithm>
#include <array>

#include "analysis/result_folders.h"

namespace slambench {
namespace {

constexpr std::array<ExportFormat, 4> table{{
    {"csv", "a row a run, a column a figure and a parameter", wide_csv},
    {"csv-long", "a row a figure of a run, with the unit, or the reason why it is not there",
     long_csv},
    {"google-benchmark", "JSON as Google Benchmark writes it, for its compare.py",
     google_benchmark_json},
    {"trace", "frames, stages and kernels over time, for ui.perfetto.dev or chrome://tracing",
     trace_json},
}};

}  // namespace

std::vector<ExportRun> read_export_runs(const std::vector<std::string>& folders) {
  const std::vector<std::string> names = short_names(folders);
  std::vector<ExportRun> runs;
  for (std::size_t i = 0; i < folders.size(); ++i) {
    runs.push_back({names[i], read_stored_run(folders[i])});
  }
  return runs;
}

std::span<const ExportFormat> export_table() { return table; }

const ExportFormat* find_export_format(std::string_view name) {
  const auto it = std::find_if(table.begin(), table.end(),
                               [&](const ExportFormat& format) { return format.name == name; });
  return it == table.end() ? nullptr : &*it;
}

}  // namespace slambench
