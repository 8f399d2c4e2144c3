// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace slambench {

/// A named corner of the space of parameters.
struct Preset {
  std::string_view name;
  std::string_view sentence;
  std::vector<std::pair<std::string, std::string>> assignments;  ///< parameter, value
};

inline constexpr std::string_view default_preset = "fast";

/// All of them, for the machine that this runs on.
std::vector<Preset> preset_table();

/// Throws UsageError that lists the known presets.
Preset find_preset(std::string_view name);

}  // namespace slambench
