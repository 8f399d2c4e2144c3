// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/frame_columns.h"
#include "core/trajectory.h"

namespace slambench {

/// A picture of a result folder: images/frame_000120_depth.png.
struct Picture {
  int frame = 0;
  std::string kind;  ///< "depth"
  std::string path;
};

/// A result folder as it was read (docs/record.md).
// Moving nlohmann's JSON does not throw. NOLINTNEXTLINE(bugprone-exception-escape)
struct ReportRun {
  std::string folder;  ///< as the user named it
  std::string name;    ///< what the report calls it
  nlohmann::ordered_json record;
  FrameColumns frames;
  Trajectory estimate, truth;     ///< truth: empty without one
  std::vector<Picture> pictures;  ///< by frame, then kind
};

/// Throws InputError naming the file, and what was found and expected in it: a folder without one
/// of its files, a record of another format or schema version, one that does not fit its frames.
ReportRun read_report_run(const std::string& folder);

/// Gives each run the short name of its folder.
void name_runs(std::vector<ReportRun>* runs);

}  // namespace slambench
