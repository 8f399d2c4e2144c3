// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>

#include "results/record.h"

namespace slambench {

// The texts of a result folder's files; docs/record.md describes them. Numbers are written
// independently of the locale and, but for the SLAMBench 1 log, so that they read back exactly.

/// The record but for its frames, as docs/record.schema.json demands. What is not a finite number
/// is left out, with the reason under "absent".
std::string record_json(const Record& record);

/// A row a frame, RFC 4180 (lines end in CR LF); a field is empty where there is no value.
std::string frames_csv(const Record& record);

/// The published log: 14 columns, tab separated, a row a processed frame. As published, X Y Z is
/// the position before the row's frame was tracked, relative to the start, in y-down camera axes.
std::string slambench1_log(const Record& record);

/// What the sensors said over time: a row a reading; empty when there is none.
std::string samples_csv(const Record& record);

/// What lies in the folder, for a person who finds it.
std::string readme_text(const Record& record, bool with_images);

}  // namespace slambench
