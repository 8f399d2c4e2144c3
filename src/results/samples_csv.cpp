// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include "results/writers.h"

namespace slambench {
namespace {

/// RFC 4180: a name may hold anything.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
  return cell + "\"";
}

}  // namespace

std::string samples_csv(const Record& record) {
  if (!record.measurements.sampling) return {};
  std::string csv = "meter,unit,time_s,value\r\n";
  for (const SampleSeries& series : record.measurements.sampling->series) {
    const std::string head = fmt::format("{},{}", quoted(series.name), quoted(series.unit));
    for (const MeterSample& sample : series.samples) {
      csv += fmt::format("{},{},{}\r\n", head, sample.time_s, sample.value);
    }
  }
  return csv;
}

}  // namespace slambench
