// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/frame_columns.h"
#include "analysis/run_group.h"
#include "analysis/samples.h"
#include "core/trajectory.h"

namespace slambench {

/// A picture of a result folder: images/frame_000120_depth.png.
struct Picture {
  int frame = 0;
  std::string kind;  ///< "depth"
  std::string path;
};

/// A result folder as it was read (docs/record.md), or the middle one of several that repeat each
/// other (report_entries.h).
// Moving nlohmann's JSON does not throw. NOLINTNEXTLINE(bugprone-exception-escape)
struct ReportRun {
  std::string folder;             ///< as the user named it
  std::string name;               ///< what the report calls it
  std::string sequence, variant;  ///< the row and the column of tables that it stands in
  nlohmann::ordered_json record;
  StoredRun stored;  ///< the same record, by places
  FrameColumns frames;
  std::vector<StoredSeries> samples;
  Trajectory estimate, truth;     ///< truth: empty without one
  std::vector<Picture> pictures;  ///< by frame, then kind
};

/// Throws InputError naming the file, and what was found and expected in it: a folder without one
/// of its files, a record of another format or schema version, one that does not fit its frames.
ReportRun read_report_run(const std::string& folder);

}  // namespace slambench
