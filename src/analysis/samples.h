// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace slambench {

/// What one sensor said over time, of a samples.csv (docs/record.md).
struct StoredSeries {
  std::string meter, unit;      ///< "package-0", "W"
  std::vector<double> times_s;  ///< since the first frame began
  std::vector<double> values;
};

/// In the order of the file. Throws InputError naming file, line, what was found and expected.
std::vector<StoredSeries> read_samples(const std::string& path);

/// The same for a text that is already in memory; `path` is for messages.
std::vector<StoredSeries> parse_samples(std::string_view csv, const std::string& path);

}  // namespace slambench
