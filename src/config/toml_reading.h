// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

#include "config/config_file.h"
#include "core/parameter.h"

namespace slambench {

/// Where in which file something stands, for messages.
struct TomlPlace {
  const std::string& path;
  const toml::node& node;

  /// Throws InputError "FILE:LINE: message".
  [[noreturn]] void reject(const std::string& message) const;
};

/// Throws InputError naming file and line for what is not TOML, and for text with a NUL.
toml::table parse_toml(std::string_view text, const std::string& path);

/// The value nearly as a user wrote it, for messages.
std::string written(const toml::node& node);

/// Text, or InputError.
std::string read_word(std::string_view key, const TomlPlace& place);

/// A value for the parameter, or InputError that says what was found and what expected.
ConfigAssignment read_assignment(const Parameter& parameter, const TomlPlace& place);

/// The values of a table named after a list of parameters, or InputError.
void read_group(const toml::table& table, const ParameterList& list, const std::string& path,
                std::vector<ConfigAssignment>* assignments);

}  // namespace slambench
