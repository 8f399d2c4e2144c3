// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>

#include "meters/hwmon.h"

namespace slambench {

/// The supply line of an ODROID-XU3 that its INA231 at this place on the bus ("4-0045") measures;
/// empty for another place.
std::string odroid_rail(const std::string& device);

/// Whether the chip is one of an ODROID-XU3's INA231, under the kernel's own driver.
bool is_odroid_ina231(const HwmonChip& chip);

}  // namespace slambench
