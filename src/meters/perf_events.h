// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>
#include <memory>

#include "meters/system_files.h"

namespace slambench {

/// An event of the kernel's performance counters (perf_event_open(2)).
struct PerfEvent {
  std::uint32_t type = 0;
  std::uint64_t config = 0;
  /// Everything on that processor; -1: the calling thread, in user space, and the threads that it
  /// and they start from now on.
  int cpu = -1;
};

/// A running count; stops when it goes.
class PerfCount {
 public:
  virtual ~PerfCount() = default;
  /// Since it was opened; where counters were shared, scaled to the whole time. Throws MeterError.
  virtual std::uint64_t read() = 0;
};

/// The system's performance events; tests put their own in their place.
class PerfEvents {
 public:
  virtual ~PerfEvents() = default;
  /// Throws MeterError when the processor has no such event or the system does not permit it.
  virtual std::unique_ptr<PerfCount> open(const PerfEvent& event) const = 0;
};

const PerfEvents& system_perf_events();

}  // namespace slambench
