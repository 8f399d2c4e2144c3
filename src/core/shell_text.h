// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>
#include <vector>

namespace slambench {

/// The words as one would type them in a shell.
std::string shell_text(const std::vector<std::string>& words);

}  // namespace slambench
