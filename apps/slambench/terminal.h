// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string_view>

namespace slambench {

/// Makes the standard streams safe to use: a closed one does not become the next file that is
/// opened, and a reader that goes away is an error of the next write instead of a signal.
void prepare_standard_streams();

/// Writes to standard output. Throws Error(failed) with the system's reason when it does not
/// arrive (closed, full disk, a reader that went away).
void print(std::string_view text);

/// Writes to standard error, whatever becomes of it.
void print_error(std::string_view text);

/// Whether standard error is a terminal whose line can be redrawn.
bool error_is_terminal();

/// Whether standard output is a terminal, whose lines end at its width.
bool output_is_terminal();

/// Whether standard output is a terminal that takes colours and the user has nothing against them
/// (https://no-color.org).
bool output_takes_colors();

/// Columns of the terminal at standard error; 80 when unknown.
int terminal_width();

}  // namespace slambench
