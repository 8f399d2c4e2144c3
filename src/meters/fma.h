// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>
#include <string>

namespace slambench {

/// Does that many rounds of independent multiply-adds in the widest registers of this processor.
/// Returns the floating-point operations done; `sink` receives a number that depends on them all.
double multiply_add(std::int64_t rounds, float* sink);

/// The instruction set that multiply_add() uses here: "AVX3", "NEON".
std::string multiply_add_instruction_set();

}  // namespace slambench
