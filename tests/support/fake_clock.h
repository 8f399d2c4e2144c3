// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <algorithm>

#include "meters/clock.h"

namespace slambench::testing {

/// Stands still unless told otherwise; sleeping moves it.
class FakeClock final : public Clock {
 public:
  explicit FakeClock(double start_s = 1000) : now_s_(start_s) {}
  double now_s() const override { return now_s_; }
  void sleep_until(double time_s) const override {
    slept_s_ += std::max(0.0, time_s - now_s_);
    now_s_ = std::max(now_s_, time_s);
  }
  void advance(double seconds) { now_s_ += seconds; }
  double slept_s() const { return slept_s_; }

 private:
  mutable double now_s_;
  mutable double slept_s_ = 0;
};

}  // namespace slambench::testing
