// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string_view>

namespace slambench {

/// The text of kernels/NAME.cl, embedded when the program was built; empty when there is none.
std::string_view kernel_source(std::string_view name);

}  // namespace slambench
