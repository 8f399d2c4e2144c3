// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "exports/exports.h"
#include "results/result_folder.h"
#include "results/sample_record.h"
#include "support/temporary_folder.h"

namespace slambench::testing {

/// Result folders of these records, r0, r1, ..., as they are read for an export.
inline std::vector<ExportRun> exported(const TemporaryFolder& folder,
                                       const std::vector<Record>& records) {
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < records.size(); ++i) {
    paths.push_back(folder.path(fmt::format("r{}", i)));
    write_results(paths.back(), true, records[i]);
  }
  return read_export_runs(paths);
}

/// Of a single run.
inline Record single_record() {
  Record record = sample_record();
  record.repetition = {};
  return record;
}

}  // namespace slambench::testing
