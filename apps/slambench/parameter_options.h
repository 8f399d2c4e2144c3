// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "config/settings.h"
#include "core/parameter.h"

namespace slambench {

/// Parameters as options of a command, in one group of the help per list; a family has one entry.
class ParameterOptions {
 public:
  void add(CLI::App& command, const std::vector<ParameterList>& lists);
  /// Sets what was given on the command line. Throws UsageError.
  void apply(Settings& settings) const;
  /// The same as names and unchecked values, in the order of the lists.
  std::vector<ConfigAssignment> given() const;

 private:
  std::vector<std::pair<std::string, CLI::Option*>> options_;
};

/// "edges of the volume (m, 0.01 to 1000, default 2,2,2 unless the sequence has its own)"
std::string help_sentence(const Parameter& parameter);

/// Who sets the parameter in a run in which the user does not: "unless the sequence has its own",
/// "unless preset fast sets it"; empty when the default holds.
std::string default_exception(const Parameter& parameter);

/// "0.01 to 1000", "grid or bricks"; empty where anything goes.
std::string range_words(const Parameter& parameter);

}  // namespace slambench
