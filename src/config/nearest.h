// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace slambench {

/// The known word that takes the fewest edits (Levenshtein distance) to reach from `word`; empty
/// when none is near enough to have been meant.
std::string_view nearest(std::string_view word, const std::vector<std::string_view>& known);

/// "; did you mean 'WORD'?", or "" when nothing is near: the end of an error message.
std::string suggestion(std::string_view word, const std::vector<std::string_view>& known,
                       std::string_view prefix = "");

}  // namespace slambench
