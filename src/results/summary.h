// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>
#include <string_view>

#include "results/record.h"

namespace slambench {

/// The run for a person at a terminal of 80 columns: what ran, kernels and stages with their times,
/// accuracy, what became of the frames. `folder` is where the files are; empty: nowhere. Colours
/// are ANSI sequences.
std::string summary_text(const Record& record, std::string_view folder, bool colors);

}  // namespace slambench
