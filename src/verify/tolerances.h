// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace slambench {

/// How far a measured quantity may be from the reference.
struct Limit {
  std::string_view quantity;
  double allowed = 0;
};

/// What one check allows, and why no less.
struct Tolerance {
  std::string_view check;
  std::vector<Limit> limits;
  std::string_view reason;

  /// Throws std::invalid_argument for a quantity that is not in the list.
  double allowed(std::string_view quantity) const;
};

/// One line per check, in the order of the checks.
std::span<const Tolerance> tolerance_table();

/// Limits that hold for every check: what no implementation has a reason to do.
std::span<const Limit> common_limits();

}  // namespace slambench
