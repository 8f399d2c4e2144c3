// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/clock.h"

#include <chrono>
#include <ctime>
#include <thread>

namespace slambench {
namespace {

class SteadyClock final : public Clock {
 public:
  double now_s() const override {
    return std::chrono::duration<double>(Base::now().time_since_epoch()).count();
  }
  void sleep_until(double time_s) const override {
    // Rounded up, so that now_s() has reached the time on return.
    const auto time = std::chrono::ceil<Base::duration>(std::chrono::duration<double>(time_s));
    std::this_thread::sleep_until(Base::time_point(time));
    while (now_s() < time_s) std::this_thread::yield();
  }

 private:
  using Base = std::chrono::steady_clock;
};

}  // namespace

const Clock& steady_clock() {
  static const SteadyClock clock;
  return clock;
}

double thread_cpu_s() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

}  // namespace slambench
