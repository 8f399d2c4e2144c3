// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

namespace slambench {

/// The text wrapped to lines of at most `width` columns, each after the first indented.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent);

/// The help of a command at 80 columns: usage, what it does, arguments, and options by group, but
/// for those without a description.
std::string help_text(const CLI::App& command);

}  // namespace slambench
