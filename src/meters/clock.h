// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

namespace slambench {

/// A monotonic clock; tests put their own in its place.
class Clock {
 public:
  virtual ~Clock() = default;
  /// Seconds since an arbitrary point.
  virtual double now_s() const = 0;
  /// Returns not before that time.
  virtual void sleep_until(double time_s) const = 0;
};

/// CLOCK_MONOTONIC.
const Clock& steady_clock();

/// Processor time that the calling thread has taken.
double thread_cpu_s();

}  // namespace slambench
