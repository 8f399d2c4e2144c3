// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include "meters/meter.h"

namespace slambench {

/// A sensor that is a number in one file, times the file's unit.
class FileMeter final : public Meter {
 public:
  FileMeter(MeterInfo info, SystemFiles files, std::string file, double unit)
      : Meter(std::move(info)), files_(std::move(files)), file_(std::move(file)), unit_(unit) {}
  double read() override { return files_.number(file_) * unit_; }

 private:
  const SystemFiles files_;
  const std::string file_;
  const double unit_;
};

/// Adds the meter when it can be read now, and else the reason.
inline void add_readable(std::unique_ptr<Meter> meter, FoundMeters* found) {
  try {
    meter->read();
    found->meters.push_back(std::move(meter));
  } catch (const MeterError& error) {
    found->refused.emplace_back(meter->info().name, error.what());
  }
}

/// Says why there is nothing to read, when there is nothing.
inline void explain_nothing(FoundMeters* found, std::string without_any) {
  if (!found->meters.empty()) return;
  found->unavailable =
      found->refused.empty() ? std::move(without_any) : found->refused.front().second;
}

}  // namespace slambench
