// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "meters/perf_events.h"
#include "meters/system_files.h"

namespace slambench {

enum class Quantity { energy_j, power_w, frequency_hz, temperature_c };

struct MeterInfo {
  std::string name;    ///< of what is measured: "package-0", "A15"
  std::string sensor;  ///< where it is read: "powercap intel-rapl:0"
  Quantity quantity = Quantity::power_w;
  double resolution = 0;  ///< smallest step of the reading, in the unit of the quantity
  std::string within;     ///< the meter whose energy holds this one's; empty: none is known
  bool in_total = false;  ///< is part of the energy of the whole, and in no other such part
};

/// Measures one quantity at one place.
class Meter {
 public:
  explicit Meter(MeterInfo info) : info_(std::move(info)) {}
  virtual ~Meter() = default;
  Meter(const Meter&) = delete;
  Meter& operator=(const Meter&) = delete;

  const MeterInfo& info() const { return info_; }
  void rename(std::string name) { info_.name = std::move(name); }

  /// The reading now, in the unit of the quantity. Energy counts from any point and never falls.
  /// Throws MeterError when the sensor does not answer, or not with a number.
  virtual double read() = 0;

  /// The next reading begins a measurement: it need not follow closely upon the last one.
  virtual void restart() {}

 private:
  MeterInfo info_;
};

/// Where meters look for sensors; tests put their own in its place.
struct MeterContext {
  SystemFiles files;
  const PerfEvents* perf = nullptr;
  std::string nvml_library;
};

/// A meter that was found and cannot be read, with the reason.
using RefusedMeter = std::pair<MeterInfo, std::string>;

/// What a kind of meter found.
struct FoundMeters {
  std::vector<std::unique_ptr<Meter>> meters;
  std::vector<RefusedMeter> refused;
  std::string unavailable;  ///< why there is nothing to read; empty: there is
};

/// A line of the table of meters.
struct MeterEntry {
  std::string_view name;
  std::string_view sentence;
  /// `state`: of the machine. `beside`: not read by a Meter but by who needs it (memory, counters):
  /// such an entry finds no meters, and is available all the same.
  enum class Kind { energy, state, beside } kind;
  /// What there is here.
  FoundMeters (*find)(const MeterContext& context);
};

/// All kinds of meters. Energy comes first, and of several ways to the same sensor the best.
std::span<const MeterEntry> meter_table();

/// All that is to be sampled: the meters of the whole table, each of a name of its own, and of what
/// two kinds would read alike (powercap and performance events) the first only. `refused` and
/// `unavailable` are about energy.
FoundMeters find_meters(const MeterContext& context);

// The kinds.
FoundMeters find_powercap(const MeterContext& context);
FoundMeters find_perf_power(const MeterContext& context);
FoundMeters find_ina231(const MeterContext& context);
FoundMeters find_ina3221(const MeterContext& context);
FoundMeters find_hwmon(const MeterContext& context);
FoundMeters find_nvml(const MeterContext& context);
FoundMeters find_frequency(const MeterContext& context);
FoundMeters find_temperature(const MeterContext& context);
FoundMeters find_memory(const MeterContext& context);
FoundMeters find_counters(const MeterContext& context);

}  // namespace slambench
