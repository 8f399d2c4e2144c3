// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <linux/capability.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

#include "meters/meter.h"

namespace slambench::testing {

/// While it lives, file permissions hold for this thread even when the user is root.
class WithoutRootsPowers {
 public:
  WithoutRootsPowers() {
    ::syscall(SYS_capget, &header_, before_.data());
    auto without = before_;
    without[0].effective &= ~((1U << CAP_DAC_OVERRIDE) | (1U << CAP_DAC_READ_SEARCH));
    ::syscall(SYS_capset, &header_, without.data());
  }
  ~WithoutRootsPowers() { ::syscall(SYS_capset, &header_, before_.data()); }
  WithoutRootsPowers(const WithoutRootsPowers&) = delete;
  WithoutRootsPowers& operator=(const WithoutRootsPowers&) = delete;

 private:
  __user_cap_header_struct header_{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, 2> before_{};
};

/// Counters that tests set, by (type, config, processor).
class FakePerfEvents final : public PerfEvents {
 public:
  using Key = std::tuple<std::uint32_t, std::uint64_t, int>;
  std::unique_ptr<PerfCount> open(const PerfEvent& event) const override {
    ++opened;
    if (!refusal.empty()) throw MeterError(refusal);
    const Key key{event.type, event.config, event.cpu};
    if (!values.contains(key)) throw MeterError("no such counter");
    return std::make_unique<Count>(values.at(key));
  }

  std::string refusal;
  mutable int opened = 0;  ///< how often one was asked for
  mutable std::map<Key, std::uint64_t> values;

 private:
  class Count final : public PerfCount {
   public:
    explicit Count(std::uint64_t& value) : value_(value) {}
    std::uint64_t read() override { return value_; }

   private:
    std::uint64_t& value_;
  };
};

/// Reads what a function says; NaN: the sensor does not answer.
class FakeMeter final : public Meter {
 public:
  FakeMeter(MeterInfo info, std::function<double()> value)
      : Meter(std::move(info)), value_(std::move(value)) {}
  double read() override {
    const double value = value_();
    if (value != value) throw MeterError("it went away");
    return value;
  }

 private:
  const std::function<double()> value_;
};

}  // namespace slambench::testing
