// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "meters/clock.h"
#include "meters/measurements.h"
#include "meters/system_files.h"

namespace slambench {

/// Watches what else the machine does, from the system's own accounts.
class ConditionsMeter {
 public:
  ConditionsMeter(SystemFiles files, const Clock& clock)
      : files_(std::move(files)), clock_(clock) {}
  void begin() { begin_ = now(); }
  /// Fills what others kept busy, governor and throttling.
  void end(Conditions* conditions) const;

 private:
  struct Accounts {
    double time_s = 0;
    std::optional<double> busy_s;                    ///< of all processors together
    double own_s = 0;                                ///< of this process
    std::map<std::string, std::uint64_t> throttled;  ///< by file, of each processor
  };
  Accounts now() const;

  const SystemFiles files_;
  const Clock& clock_;
  Accounts begin_;
};

/// Seconds that processors were busy, from the text of /proc/stat; none when it does not tell.
std::optional<double> busy_seconds(const std::string& stat, double ticks_per_s);

/// What may have disturbed the times, with what to do about it.
std::vector<std::string> noise_in(const Conditions& conditions,
                                  const std::vector<MeterSample>& frequency_hz);

/// The same of how much repeated runs differ; empty when they do not.
std::string noise_of_runs(double median, double run_spread);

}  // namespace slambench
