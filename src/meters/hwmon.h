// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>
#include <vector>

#include "meters/system_files.h"

namespace slambench {

inline constexpr const char* hwmon_folder = "/sys/class/hwmon";

/// A chip of sensors (https://docs.kernel.org/hwmon/sysfs-interface.html).
struct HwmonChip {
  std::string folder;  ///< "/sys/class/hwmon/hwmon2"
  std::string name;    ///< "ina231", "coretemp"
  std::string device;  ///< "4-0040": bus and address of an I2C chip; may be empty
};

std::vector<HwmonChip> hwmon_chips(const SystemFiles& files);

}  // namespace slambench
