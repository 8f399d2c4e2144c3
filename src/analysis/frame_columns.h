// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace slambench {

/// The columns of a frames.csv, by name: a number a frame, NaN where a field is empty.
using FrameColumns = std::map<std::string, std::vector<double>, std::less<>>;

/// Throws InputError naming file, line, what was found and what was expected.
FrameColumns read_frame_columns(const std::string& path);

/// The same for a text that is already in memory; `path` is for messages.
FrameColumns parse_frame_columns(std::string_view csv, const std::string& path);

}  // namespace slambench
