// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

#include "meters/ina231.h"

#include <fmt/format.h>

#include "meters/file_meter.h"

namespace slambench {
namespace {

// The four INA231 of Hardkernel's ODROID-XU3, the board of the SLAMBench paper: power of the two
// clusters of processors, the GPU and the memory.

constexpr const char* driver_folder = "/sys/bus/i2c/drivers/INA231";

struct Rail {
  std::string_view address, name;
};
constexpr Rail rails[] = {{"-0045", "A7"}, {"-0040", "A15"}, {"-0044", "GPU"}, {"-0041", "DRAM"}};

MeterInfo info_of(const std::string& device, const char* driver) {
  return {.name = odroid_rail(device),
          .sensor = fmt::format("INA231 {} ({})", device, driver),
          .quantity = Quantity::power_w,
          .resolution = 1e-6,
          .within = "",
          .in_total = true};
}

/// The driver of the vendor's kernel: watts as text, and a switch.
void find_old(const SystemFiles& files, FoundMeters* found) {
  for (const std::string& device : files.names(driver_folder)) {
    if (odroid_rail(device).empty()) continue;
    const std::string folder = fmt::format("{}/{}", driver_folder, device);
    const std::string enable = files.text_or_empty(folder + "/enable");
    if (enable == "0") {
      const std::string file = files.path(folder + "/enable");
      found->refused.emplace_back(info_of(device, "vendor's driver"),
                                  fmt::format("switched off: echo 1 | sudo tee {}", file));
      continue;
    }
    add_readable(std::make_unique<FileMeter>(info_of(device, "vendor's driver"), files,
                                             folder + "/sensor_W", 1.0),
                 found);
  }
}

/// The kernel's own driver ina2xx: microwatts.
void find_mainline(const SystemFiles& files, FoundMeters* found) {
  for (const HwmonChip& chip : hwmon_chips(files)) {
    if (!is_odroid_ina231(chip)) continue;
    add_readable(std::make_unique<FileMeter>(info_of(chip.device, "hwmon"), files,
                                             chip.folder + "/power1_input", 1e-6),
                 found);
  }
}

}  // namespace

std::string odroid_rail(const std::string& device) {
  for (const Rail& rail : rails) {
    if (device.ends_with(rail.address)) return std::string(rail.name);
  }
  return {};
}

bool is_odroid_ina231(const HwmonChip& chip) {
  return (chip.name == "ina231" || chip.name == "ina2xx") && !odroid_rail(chip.device).empty();
}

FoundMeters find_ina231(const MeterContext& context) {
  FoundMeters found;
  find_old(context.files, &found);
  if (found.meters.empty()) find_mainline(context.files, &found);
  explain_nothing(&found, "no INA231 at an address of an ODROID-XU3");
  return found;
}

}  // namespace slambench
