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

/// Adds the meter that `make` makes when it can be made and read now, and else the reason.
template <class Make>
void add_readable(const MeterInfo& info, const Make& make, FoundMeters* found) {
  try {
    std::unique_ptr<Meter> meter = make();
    meter->read();
    found->meters.push_back(std::move(meter));
  } catch (const MeterError& error) {
    found->refused.emplace_back(info, error.what());
  }
}

inline void add_readable(std::unique_ptr<Meter> meter, FoundMeters* found) {
  const MeterInfo info = meter->info();
  add_readable(
      info, [&] { return std::move(meter); }, found);
}

/// Says why there is nothing to read, when there is nothing.
inline void explain_nothing(FoundMeters* found, std::string without_any) {
  if (!found->meters.empty()) return;
  found->unavailable =
      found->refused.empty() ? std::move(without_any) : found->refused.front().second;
}

}  // namespace slambench
