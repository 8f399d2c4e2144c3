// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/parameter.h"

namespace slambench {

struct ConfigAssignment {
  std::string name, value;  ///< of a parameter, the value as on the command line
};

/// What a TOML file says: parameters in tables named after their groups, and before them, outside
/// of any table, `sequence` and `preset`.
struct ConfigFile {
  std::string path;
  std::optional<std::string> sequence, preset;
  std::vector<ConfigAssignment> assignments;  ///< in the order of the file
};

/// Reads and checks a file against the lists, whose values stay as they are. Throws InputError
/// naming file, line and key: what is not TOML, an unknown table or key (and the nearest known
/// one), a value of the wrong type or outside its range.
ConfigFile read_config_file(const std::string& path, const std::vector<ParameterList>& lists);

/// The same for text that is already in memory; `path` is for messages.
ConfigFile parse_config(std::string_view text, const std::string& path,
                        const std::vector<ParameterList>& lists);

}  // namespace slambench
