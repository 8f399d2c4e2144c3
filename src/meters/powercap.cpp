// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// Linux's power capping zones: counters of energy in the processor (RAPL), Intel's and AMD's.
// https://docs.kernel.org/power/powercap/powercap.html
#include <fmt/format.h>

#include <optional>
#include <set>

#include "meters/file_meter.h"

namespace slambench {
namespace {

constexpr const char* folder = "/sys/class/powercap";

/// A zone wraps around to zero after its largest value.
class PowercapMeter final : public Meter {
 public:
  PowercapMeter(MeterInfo info, const SystemFiles& files, const std::string& zone)
      : Meter(std::move(info)),
        files_(files),
        counter_(zone + "/energy_uj"),
        range_uj_(files.count(zone + "/max_energy_range_uj")) {}

  double read() override {
    const std::uint64_t now_uj = files_.count(counter_);
    if (now_uj > range_uj_) {
      throw MeterError(fmt::format("{}: found {}, expected at most max_energy_range_uj = {}",
                                   files_.path(counter_), now_uj, range_uj_));
    }
    if (last_uj_) {
      const std::uint64_t step =
          now_uj >= *last_uj_ ? now_uj - *last_uj_ : range_uj_ - *last_uj_ + now_uj;
      if (step > range_uj_ / 2) {
        throw MeterError(fmt::format(
            "{}: moved by {} of {} uJ between two readings, expected less than half: it may have "
            "wrapped around more than once",
            files_.path(counter_), step, range_uj_));
      }
      total_uj_ += step;
    }
    last_uj_ = now_uj;
    return static_cast<double>(total_uj_) * 1e-6;
  }

  void restart() override { last_uj_.reset(); }

 private:
  const SystemFiles files_;
  const std::string counter_;
  const std::uint64_t range_uj_;
  std::optional<std::uint64_t> last_uj_;
  std::uint64_t total_uj_ = 0;
};

/// "intel-rapl:0:1" lies in "intel-rapl:0", which lies in the control type "intel-rapl".
std::string parent_of(const std::string& zone) { return zone.substr(0, zone.rfind(':')); }
std::string control_type(const std::string& zone) { return zone.substr(0, zone.find(':')); }

/// "package-0", and "package-0/core" for a zone in it.
std::string zone_name(const SystemFiles& files, const std::string& zone) {
  const std::string own = files.text_or_empty(fmt::format("{}/{}/name", folder, zone));
  const std::string parent = parent_of(zone);
  if (parent == control_type(zone)) return own.empty() ? zone : own;
  return fmt::format("{}/{}", zone_name(files, parent), own.empty() ? zone : own);
}

}  // namespace

FoundMeters find_powercap(const MeterContext& context) {
  const SystemFiles& files = context.files;
  FoundMeters found;
  std::set<std::string> names;
  // "intel-rapl:..." comes before "intel-rapl-mmio:...", which repeats packages through memory.
  for (const bool repeating : {false, true}) {
    for (const std::string& zone : files.names(folder)) {
      const bool is_zone = zone.find(':') != std::string::npos;
      if (!is_zone || (zone.find("-mmio") != std::string::npos) != repeating) continue;
      MeterInfo info{.name = zone_name(files, zone),
                     .sensor = fmt::format("powercap {}", zone),
                     .quantity = Quantity::energy_j,
                     .resolution = 1e-6,
                     .within = "",
                     .in_total = false};
      if (!names.insert(info.name).second) continue;
      const std::string parent = parent_of(zone);
      if (parent != control_type(zone)) {
        info.within = zone_name(files, parent);
      } else {
        // The platform's counter holds packages and more, but is not to be trusted everywhere.
        info.in_total = info.name != "psys";
      }
      const auto make = [&] {
        return std::make_unique<PowercapMeter>(info, files, fmt::format("{}/{}", folder, zone));
      };
      add_readable(info, make, &found);
    }
  }
  explain_nothing(&found, fmt::format("{}: no zone that counts energy", files.path(folder)));
  return found;
}

}  // namespace slambench
