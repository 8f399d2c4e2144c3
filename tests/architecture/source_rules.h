// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace slambench {

/// The rules that the compiler does not hold, checked by reading the source tree under `root`
/// (src/, apps/, tests/, bench/, examples/). Each returns one line per violation, "FILE:LINE: ...".

/// A file includes only what its own target's CMake link list reaches; apps include what they
/// link. Targets are what slambench_library() and add_library(slambench_...) declare.
std::vector<std::string> include_violations(const std::filesystem::path& root);

/// Nothing in src/ prints, exits, reads the environment or looks at a clock, but for the few
/// places whose job it is.
std::vector<std::string> side_effect_violations(const std::filesystem::path& root);

/// Every source file starts with the two-line SPDX header.
std::vector<std::string> header_violations(const std::filesystem::path& root);

}  // namespace slambench
