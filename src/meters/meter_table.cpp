// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "meters/meter.h"

namespace slambench {
namespace {

using Kind = MeterEntry::Kind;

constexpr MeterEntry entries[] = {
    {"powercap", "energy of the processor, by Linux's power capping zones (Intel, AMD)",
     Kind::energy, find_powercap},
    {"perf-power", "energy of the processor, by performance events power/energy-*/", Kind::energy,
     find_perf_power},
    {"ina231", "power of an ODROID-XU3's processors, GPU and memory", Kind::energy, find_ina231},
    {"ina3221", "power of a Jetson's supply lines", Kind::energy, find_ina3221},
    {"hwmon", "power and energy of any other chip that Linux knows", Kind::energy, find_hwmon},
    {"nvml", "energy of NVIDIA's GPUs, by their driver's library", Kind::energy, find_nvml},
    {"frequency", "frequency of the processors", Kind::state, find_frequency},
    {"temperature", "temperature of processors and board", Kind::state, find_temperature},
    {"memory", "resident memory of the process, now and at most", Kind::beside, find_memory},
    {"counters", "cycles, instructions, cache and branch misses by stage (--counters)",
     Kind::beside, find_counters},
};

/// "amdgpu", and "amdgpu 2" for the next of that name.
void make_names_unique(std::vector<std::unique_ptr<Meter>>* meters) {
  std::set<std::string> taken;
  for (const auto& meter : *meters) {
    const std::string name = meter->info().name;
    for (int i = 2; !taken.insert(meter->info().name).second; ++i) {
      meter->rename(fmt::format("{} {}", name, i));
    }
  }
}

}  // namespace

std::span<const MeterEntry> meter_table() { return entries; }

FoundMeters find_meters(const MeterContext& context) {
  FoundMeters all;
  bool has_powercap = false, has_energy = false;
  for (const MeterEntry& entry : entries) {
    if (entry.kind == Kind::beside) continue;
    if (entry.name == "perf-power" && has_powercap) continue;  // the same counters
    FoundMeters found = entry.find(context);
    if (entry.name == "powercap") has_powercap = !found.meters.empty();
    std::move(found.meters.begin(), found.meters.end(), std::back_inserter(all.meters));
    if (entry.kind != Kind::energy) continue;
    has_energy = !all.meters.empty();
    std::move(found.refused.begin(), found.refused.end(), std::back_inserter(all.refused));
  }
  make_names_unique(&all.meters);
  // What one kind may not read another may.
  std::erase_if(all.refused, [&](const auto& refused) {
    return std::any_of(all.meters.begin(), all.meters.end(),
                       [&](const auto& meter) { return meter->info().name == refused.first.name; });
  });
  if (!has_energy) {
    all.unavailable = all.refused.empty() ? "no sensor (slambench list tells where was looked)"
                                          : all.refused.front().second;
  }
  return all;
}

}  // namespace slambench
