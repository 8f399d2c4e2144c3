// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/sampler.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

namespace slambench {
namespace {

constexpr double slow_interval_s = 1;

bool is_slow(Quantity quantity) {
  return quantity == Quantity::frequency_hz || quantity == Quantity::temperature_c;
}

}  // namespace

/// Follows one meter.
class Sampler::Reader {
 public:
  /// Means of power over less time than `shortest_s` would show how the sensor updates, not power.
  Reader(std::unique_ptr<Meter> meter, double shortest_s)
      : meter_(std::move(meter)), shortest_s_(shortest_s) {}

  const Meter& meter() const { return *meter_; }
  const Channel& channel() const { return channel_; }

  void begin() {
    channel_ = {};
    channel_.info = meter_->info();
    update_.reset();
    meter_->restart();
  }

  /// `time_s` since begin(). After a failure nothing is read any more: what is missing cannot be
  /// made up for.
  void read(double time_s) {
    if (!channel_.failure.empty()) return;
    try {
      add(time_s, meter_->read());
    } catch (const std::exception& error) {
      channel_.failure = error.what();
    }
  }

  void end() {
    if (!channel_.failure.empty()) return;
    if (meter_->info().quantity == Quantity::energy_j && channel_.updates == 0) {
      channel_.failure = "the counter did not move during the run, which may be too short for it";
    }
  }

 private:
  void add(double time_s, double value) {
    const bool first = channel_.readings == 0;
    if (!first && meter_->info().quantity == Quantity::energy_j && value < last_.value) {
      throw MeterError(
          fmt::format("{}: energy fell from {} to {} J, expected a counter that does "
                      "not: it may have begun anew",
                      meter_->info().sensor, last_.value, value));
    }
    const bool changed = !first && value != last_.value;
    if (changed) ++channel_.updates;
    switch (meter_->info().quantity) {
      case Quantity::energy_j:
        if (first) first_j_ = value;
        channel_.joules = value - first_j_;
        if (changed) add_update(time_s, value);
        break;
      case Quantity::power_w:
        if (!first) channel_.joules += (last_.value + value) / 2 * (time_s - last_.time_s);
        channel_.peak_w = std::max(channel_.peak_w.value_or(value), value);
        [[fallthrough]];
      case Quantity::frequency_hz:
      case Quantity::temperature_c:
        channel_.samples.push_back({time_s, value});
    }
    ++channel_.readings;
    last_ = {time_s, value};
  }

  /// A counter tells the mean power between two of its updates. How long before begin() the first
  /// began is not known.
  void add_update(double time_s, double value) {
    if (update_) {
      const double seconds = time_s - update_->time_s;
      if (seconds < shortest_s_) return;
      const double power_w = (value - update_->value) / seconds;
      channel_.peak_w = std::max(channel_.peak_w.value_or(power_w), power_w);
      channel_.samples.push_back({time_s, power_w});
    }
    update_ = {time_s, value};
  }

  const std::unique_ptr<Meter> meter_;
  const double shortest_s_;
  Channel channel_;
  MeterSample last_;
  double first_j_ = 0;
  std::optional<MeterSample> update_;
};

Sampler::Sampler(std::vector<std::unique_ptr<Meter>> meters, const Clock& clock, double interval_s)
    : clock_(clock), interval_s_(interval_s) {
  for (auto& meter : meters) {
    readers_.push_back(std::make_unique<Reader>(std::move(meter), interval_s / 2));
  }
}

Sampler::~Sampler() = default;

void Sampler::begin() {
  for (const auto& reader : readers_) reader->begin();
  samples_ = 0;
  begin_s_ = slow_s_ = clock_.now_s();
  read(begin_s_, true);
}

void Sampler::sample() {
  const double now_s = clock_.now_s();
  const bool all = now_s - slow_s_ >= slow_interval_s;
  if (all) slow_s_ = now_s;
  read(now_s, all);
}

void Sampler::end() {
  read(clock_.now_s(), true);
  for (const auto& reader : readers_) reader->end();
}

/// Readings of one round have one time, so that all rails have the same duration.
void Sampler::read(double now_s, bool all) {
  for (const auto& reader : readers_) {
    if (!all && is_slow(reader->meter().info().quantity)) continue;
    reader->read(now_s - begin_s_);
  }
  last_s_ = now_s;
  ++samples_;
}

std::vector<Channel> Sampler::channels() const {
  std::vector<Channel> all;
  for (const auto& reader : readers_) all.push_back(reader->channel());
  return all;
}

}  // namespace slambench
