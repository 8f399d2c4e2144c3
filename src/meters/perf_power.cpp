// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// The events power/energy-*/ of Linux's performance counters: the same counters as powercap's, for
// the whole machine. https://docs.kernel.org/admin-guide/perf/index.html
#include <fmt/format.h>

#include <charconv>

#include "io/text.h"
#include "meters/file_meter.h"

namespace slambench {
namespace {

constexpr const char* folder = "/sys/bus/event_source/devices/power";

/// Events by the names that powercap has for the same counters.
struct Domain {
  std::string_view event, name;
};
constexpr Domain domains[] = {{"energy-pkg", ""},
                              {"energy-cores", "core"},
                              {"energy-gpu", "uncore"},
                              {"energy-ram", "dram"},
                              {"energy-psys", "psys"}};

class PerfPowerMeter final : public Meter {
 public:
  PerfPowerMeter(MeterInfo info, std::unique_ptr<PerfCount> count)
      : Meter(std::move(info)), count_(std::move(count)) {}
  double read() override { return static_cast<double>(count_->read()) * info().resolution; }

 private:
  const std::unique_ptr<PerfCount> count_;
};

/// "0,18" or "0-1,4" as numbers. Throws MeterError for anything else.
std::vector<int> processors(const SystemFiles& files, const std::string& file) {
  const std::string text = files.text(file);
  const auto fail = [&]() -> int {
    throw MeterError(
        fmt::format("{}: found {}, expected a list of processors", files.path(file), quote(text)));
  };
  std::vector<int> list;
  const char* at = text.data();
  const char* const end = at + text.size();
  const auto number = [&] {
    int value = 0;
    const auto result = std::from_chars(at, end, value);
    if (result.ec != std::errc{} || value < 0) fail();
    at = result.ptr;
    return value;
  };
  while (at != end) {
    const int first = number();
    int last = first;
    if (at != end && *at == '-') ++at, last = number();
    constexpr int most = 4096;
    if (last < first || last - first > most || (at != end && *at++ != ',')) fail();
    for (int cpu = first; cpu <= last; ++cpu) list.push_back(cpu);
  }
  return list;
}

/// "event=0x02".
std::uint64_t event_config(const SystemFiles& files, const std::string& file) {
  const std::string text = files.text(file);
  constexpr std::string_view head = "event=0x";
  std::uint64_t config = 0;
  const char* const end = text.data() + text.size();
  if (text.starts_with(head)) {
    const auto result = std::from_chars(text.data() + head.size(), end, config, 16);
    if (result.ec == std::errc{} && result.ptr == end) return config;
  }
  throw MeterError(
      fmt::format("{}: found {}, expected event=0x...", files.path(file), quote(text)));
}

/// The package that a processor lies in; the index of the processor's line where that is not told.
int package_of(const SystemFiles& files, int cpu, int index) {
  const std::string text = files.text_or_empty(
      fmt::format("/sys/devices/system/cpu/cpu{}/topology/physical_package_id", cpu));
  int package = index;
  std::from_chars(text.data(), text.data() + text.size(), package);
  return package;
}

std::unique_ptr<Meter> open_event(const MeterContext& context, MeterInfo info,
                                  const std::string& event, int cpu) {
  const SystemFiles& files = context.files;
  const std::string unit = files.text(event + ".unit");
  if (unit != "Joules") {
    throw MeterError(
        fmt::format("{}.unit: found {}, expected Joules", files.path(event), quote(unit)));
  }
  info.resolution = files.number(event + ".scale");
  const auto type = static_cast<std::uint32_t>(files.count(fmt::format("{}/type", folder)));
  auto count = context.perf->open({type, event_config(files, event), cpu});
  return std::make_unique<PerfPowerMeter>(std::move(info), std::move(count));
}

}  // namespace

FoundMeters find_perf_power(const MeterContext& context) {
  const SystemFiles& files = context.files;
  FoundMeters found;
  if (!files.exists(folder)) {
    found.unavailable = fmt::format("{}: No such file or directory", files.path(folder));
    return found;
  }
  try {
    int index = 0;
    for (const int cpu : processors(files, fmt::format("{}/cpumask", folder))) {
      const std::string package = fmt::format("package-{}", package_of(files, cpu, index++));
      for (const Domain& domain : domains) {
        const std::string event = fmt::format("{}/events/{}", folder, domain.event);
        if (!files.exists(event)) continue;
        MeterInfo info{.name = package,
                       .sensor = fmt::format("perf power/{}/ of processor {}", domain.event, cpu),
                       .quantity = Quantity::energy_j,
                       .resolution = 0,
                       .within = "",
                       .in_total = domain.name.empty()};
        if (domain.name == "psys") {
          info.name = domain.name;
        } else if (!domain.name.empty()) {
          info.name = fmt::format("{}/{}", package, domain.name);
          info.within = package;
        }
        add_readable(
            info, [&] { return open_event(context, info, event, cpu); }, &found);
      }
    }
  } catch (const MeterError& error) {
    found.unavailable = error.what();
    return found;
  }
  explain_nothing(&found, fmt::format("{}/events: no event of energy", files.path(folder)));
  return found;
}

}  // namespace slambench
