// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "io/png.h"
#include "report/report_entries.h"
#include "report/report_page.h"
#include "results/result_folder.h"
#include "results/sample_record.h"
#include "support/temporary_folder.h"

namespace slambench::testing {

/// Text that would run in a browser that took it for markup.
inline const std::string hostile =
    "</script><script>document.title='taken'</script><img src=x "
    "onerror=\"document.title='taken'\">";

/// A record of which every figure is there.
inline Record full_record() {
  Record record = sample_record();
  record.repetition = sample_repetition();
  record.measurements = sample_measurements();
  return record;
}

/// A record of a run that was not repeated.
inline Record single_run() {
  Record record = sample_record();
  record.repetition = {};
  return record;
}

/// Writes a result folder with a picture; returns its path.
inline std::string write_run(const TemporaryFolder& folder, const std::string& name,
                             const Record& record) {
  const std::string path = folder.path(name);
  ResultFolder results(path, false);
  Image<Rgba8> picture(Size{8, 6});
  results.write_image(1, "depth", picture);
  results.write_image(4, "depth", picture);
  results.commit(record);
  return path;
}

inline std::vector<ReportRun> read_runs(const std::vector<std::string>& paths) {
  std::vector<ReportRun> runs;
  for (const auto& path : paths) runs.push_back(read_report_run(path));
  return report_entries(std::move(runs), {}, false).runs;
}

}  // namespace slambench::testing
