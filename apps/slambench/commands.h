// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "core/error.h"

namespace slambench {

/// What a subcommand does once its arguments are parsed. Errors are thrown (core/error.h).
using Action = std::function<ExitStatus()>;

/// Each declares its arguments on `command` and returns what to do with them.
/// `command_line` is the whole of it, for the record; `program` is how this one was called.
Action add_run(CLI::App& command, const std::string& command_line);
Action add_compare(CLI::App& command);
Action add_evaluate(CLI::App& command);
Action add_export(CLI::App& command);
Action add_generate(CLI::App& command);
Action add_info(CLI::App& command);
Action add_list(CLI::App& command);
Action add_report(CLI::App& command);
Action add_suite(CLI::App& command, const std::string& program);
Action add_verify(CLI::App& command);

}  // namespace slambench
