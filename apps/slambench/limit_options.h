// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "analysis/limit.h"

namespace slambench {

/// --fail-if, any number of times; its help lists the figures. With `ratios`, those of
/// ratio(FIGURE) too.
void add_limit_option(CLI::App& command, std::vector<std::string>* limits, bool ratios);

/// Throws UsageError for the first that makes no sense.
std::vector<Limit> parse_limits(const std::vector<std::string>& texts, bool ratios);

/// Throws Error(threshold) that holds all lines, unless there are none.
void throw_if_violated(const std::vector<std::string>& lines);

}  // namespace slambench
