// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/hwmon.h"

#include <fmt/format.h>

#include "meters/file_meter.h"
#include "meters/ina231.h"
#include "meters/meter.h"

namespace slambench {
namespace {

constexpr double micro = 1e-6;

/// Numbers N of the chip's files HEADn TAIL: 1 of "power1_input" for "power" and "_input".
std::vector<std::string> channels(const SystemFiles& files, const HwmonChip& chip,
                                  std::string_view head, std::string_view tail) {
  std::vector<std::string> found;
  for (const std::string& name : files.names(chip.folder)) {
    if (!name.starts_with(head) || !name.ends_with(tail)) continue;
    const auto number = name.substr(head.size(), name.size() - head.size() - tail.size());
    if (number.find_first_not_of("0123456789") == std::string::npos) found.push_back(number);
  }
  return found;
}

/// "amdgpu", "amdgpu PPT": what the rail is called is all that is known of it.
std::string rail_name(const SystemFiles& files, const HwmonChip& chip, const std::string& channel) {
  std::string name = chip.name.empty() ? chip.folder.substr(chip.folder.rfind('/') + 1) : chip.name;
  if (!chip.device.empty() && chip.name.starts_with("ina")) name += " " + chip.device;
  const std::string label = files.text_or_empty(fmt::format("{}/{}_label", chip.folder, channel));
  return label.empty() ? name : fmt::format("{} {}", name, label);
}

void add_channels(const SystemFiles& files, const HwmonChip& chip, Quantity quantity,
                  std::string_view head, std::string_view tail, FoundMeters* found) {
  for (const std::string& number : channels(files, chip, head, tail)) {
    const std::string channel = fmt::format("{}{}", head, number);
    const std::string file = fmt::format("{}/{}{}", chip.folder, channel, tail);
    // Some chips have an average over a time of their own besides, or instead.
    if (tail == "_average" && files.exists(fmt::format("{}/{}_input", chip.folder, channel))) {
      continue;
    }
    add_readable(std::make_unique<FileMeter>(
                     MeterInfo{.name = rail_name(files, chip, channel),
                               .sensor = fmt::format("hwmon {} {}{}", chip.name, channel, tail),
                               .quantity = quantity,
                               .resolution = micro,
                               .within = "",
                               .in_total = false},
                     files, file, micro),
                 found);
  }
}

}  // namespace

std::vector<HwmonChip> hwmon_chips(const SystemFiles& files) {
  std::vector<HwmonChip> chips;
  for (const std::string& entry : files.names(hwmon_folder)) {
    HwmonChip chip;
    chip.folder = fmt::format("{}/{}", hwmon_folder, entry);
    chip.name = files.text_or_empty(chip.folder + "/name");
    chip.device = files.link_target_name(chip.folder + "/device");
    chips.push_back(std::move(chip));
  }
  return chips;
}

FoundMeters find_hwmon(const MeterContext& context) {
  const SystemFiles& files = context.files;
  FoundMeters found;
  for (const HwmonChip& chip : hwmon_chips(files)) {
    if (chip.name == "ina3221" || is_odroid_ina231(chip)) continue;  // have meters of their own
    add_channels(files, chip, Quantity::power_w, "power", "_input", &found);
    add_channels(files, chip, Quantity::power_w, "power", "_average", &found);
    add_channels(files, chip, Quantity::energy_j, "energy", "_input", &found);
  }
  explain_nothing(&found, fmt::format("{}: no other chip that measures power or energy",
                                      files.path(hwmon_folder)));
  return found;
}

}  // namespace slambench
