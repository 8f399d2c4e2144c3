// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "analysis/samples.h"

#include <fmt/format.h>

#include "core/error.h"
#include "io/files.h"
#include "io/text.h"

namespace slambench {

std::vector<StoredSeries> parse_samples(std::string_view csv, const std::string& path) {
  constexpr std::string_view header = "meter,unit,time_s,value";
  if (const auto first = take_line(&csv); first != header) {
    throw InputError(path, "line 1", quote(first), std::string(header));
  }
  std::vector<StoredSeries> all;
  for (int number = 2; !csv.empty(); ++number) {
    const std::string_view line = take_line(&csv);
    const std::vector<std::string> fields = csv_fields(line);
    const auto time_s = fields.size() == 4 ? parse_finite(fields[2]) : std::nullopt;
    const auto value = fields.size() == 4 ? parse_finite(fields[3]) : std::nullopt;
    if (!time_s || !value) {
      throw InputError(path, fmt::format("line {}", number), quote(line),
                       "a meter, its unit, and two numbers");
    }
    if (all.empty() || all.back().meter != fields[0] || all.back().unit != fields[1]) {
      all.push_back({fields[0], fields[1], {}, {}});
    }
    all.back().times_s.push_back(*time_s);
    all.back().values.push_back(*value);
  }
  return all;
}

std::vector<StoredSeries> read_samples(const std::string& path) {
  return parse_samples(read_file(path), path);
}

}  // namespace slambench
