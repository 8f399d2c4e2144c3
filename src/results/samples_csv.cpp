// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include "io/text.h"
#include "results/writers.h"

namespace slambench {
std::string samples_csv(const Record& record) {
  if (!record.measurements.sampling) return {};
  std::string csv = "meter,unit,time_s,value\r\n";
  for (const SampleSeries& series : record.measurements.sampling->series) {
    const std::string head = fmt::format("{},{}", csv_field(series.name), csv_field(series.unit));
    for (const MeterSample& sample : series.samples) {
      csv += fmt::format("{},{},{}\r\n", head, sample.time_s, sample.value);
    }
  }
  return csv;
}

}  // namespace slambench
