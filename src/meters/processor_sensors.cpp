// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// Frequency and temperature, which tell whether a run was disturbed.
#include <fmt/format.h>

#include <algorithm>

#include "meters/file_meter.h"
#include "meters/hwmon.h"

namespace slambench {
namespace {

constexpr const char* thermal_folder = "/sys/class/thermal";
/// Reading a frequency may wake the processor up: of many, so many are asked.
constexpr std::size_t most_processors = 16;
constexpr std::size_t most_temperatures = 8;

/// The mean over some of the processors.
class FrequencyMeter final : public Meter {
 public:
  FrequencyMeter(MeterInfo info, SystemFiles files, std::vector<std::string> khz_files)
      : Meter(std::move(info)), files_(std::move(files)), khz_files_(std::move(khz_files)) {}
  double read() override {
    double sum_khz = 0;
    for (const std::string& file : khz_files_) sum_khz += files_.number(file);
    return sum_khz * 1e3 / static_cast<double>(khz_files_.size());
  }

 private:
  const SystemFiles files_;
  const std::vector<std::string> khz_files_;
};

/// Chips in a processor that measure its own temperature.
bool measures_processor(const std::string& chip) {
  static constexpr std::string_view known[] = {"coretemp", "k10temp", "zenpower"};
  return std::find(std::begin(known), std::end(known), chip) != std::end(known);
}

MeterInfo temperature_info(std::string name, std::string sensor) {
  return {.name = std::move(name),
          .sensor = std::move(sensor),
          .quantity = Quantity::temperature_c,
          .resolution = 1e-3,
          .within = "",
          .in_total = false};
}

}  // namespace

FoundMeters find_frequency(const MeterContext& context) {
  const SystemFiles& files = context.files;
  std::vector<std::string> all;
  for (const std::string& cpu : processor_folders(files)) {
    std::string file = cpu + "/cpufreq/scaling_cur_freq";
    if (files.exists(file)) all.push_back(std::move(file));
  }
  FoundMeters found;
  if (!all.empty()) {
    std::vector<std::string> some;
    const std::size_t step = (all.size() + most_processors - 1) / most_processors;
    for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
    add_readable(std::make_unique<FrequencyMeter>(
                     MeterInfo{.name = "cpu frequency",
                               .sensor = fmt::format("cpufreq of {} processors", some.size()),
                               .quantity = Quantity::frequency_hz,
                               .resolution = 1e3,
                               .within = "",
                               .in_total = false},
                     files, some),
                 &found);
  }
  explain_nothing(&found, fmt::format("{}: no cpufreq", files.path(processors_folder)));
  return found;
}

FoundMeters find_temperature(const MeterContext& context) {
  const SystemFiles& files = context.files;
  FoundMeters found;
  const auto add = [&](std::string name, std::string sensor, const std::string& file) {
    if (found.meters.size() >= most_temperatures || !files.exists(file)) return;
    add_readable(std::make_unique<FileMeter>(temperature_info(std::move(name), std::move(sensor)),
                                             files, file, 1e-3),
                 &found);
  };
  for (const HwmonChip& chip : hwmon_chips(files)) {
    if (!measures_processor(chip.name)) continue;
    const std::string label = files.text_or_empty(chip.folder + "/temp1_label");
    add(label.empty() ? chip.name : label, fmt::format("hwmon {} temp1_input", chip.name),
        chip.folder + "/temp1_input");
  }
  for (const std::string& zone : files.names(thermal_folder)) {
    if (!zone.starts_with("thermal_zone")) continue;
    const std::string folder = fmt::format("{}/{}", thermal_folder, zone);
    const std::string type = files.text_or_empty(folder + "/type");
    add(type.empty() ? zone : type, fmt::format("thermal {}", zone), folder + "/temp");
  }
  explain_nothing(&found, fmt::format("{} and {}: no temperature of a processor",
                                      files.path(hwmon_folder), files.path(thermal_folder)));
  return found;
}

}  // namespace slambench
