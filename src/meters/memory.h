// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "meters/measurements.h"
#include "meters/system_files.h"

namespace slambench {

/// The resident set of this process.
class MemoryMeter {
 public:
  /// Forgets what was before: the largest counts from here.
  void begin();
  /// Fills the resident sets; what cannot be read is explained in `absent`.
  void end(MemoryMeasurement* memory, std::map<std::string, std::string>* absent);

 private:
  std::string no_peak_;  ///< why there is no largest
};

/// The value of a line "KEY:   123 kB" of /proc/self/status, in bytes. Throws MeterError when there
/// is none.
std::size_t status_bytes(std::string_view status, std::string_view key);

}  // namespace slambench
