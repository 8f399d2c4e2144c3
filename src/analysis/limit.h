// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/stored_run.h"

namespace slambench {

/// What a user does not want to see: "ate_rmse_m>0.05", "ratio(fps)<0.9".
struct Limit {
  enum class Relation { less, at_most, more, at_least, equal, unequal };
  std::string text;    ///< as the user wrote it
  std::string figure;  ///< a name in figure_table(), or a place in record.json
  std::string place;   ///< of the figure in record.json
  bool of_ratio = false;
  Relation relation = Relation::less;
  double bound = 0;

  /// Whether the value is what the user does not want.
  bool violated_by(double value) const;
};

/// FIGURE RELATION NUMBER, or ratio(FIGURE) RELATION NUMBER where `ratios` are known; blanks are
/// free. FIGURE is a name or, with a dot in it, a place in record.json. Throws UsageError that says
/// what was expected where, and for an unknown figure lists the known ones.
Limit parse_limit(std::string_view text, bool ratios);

/// One line a violated limit: "ate_rmse_m is 0.061, not wanted: ate_rmse_m>0.05". Limits of ratios
/// are left out. Throws UnavailableError when a limit's figure was not measured and no other limit
/// is violated.
std::vector<std::string> violations(const std::vector<Limit>& limits, const StoredRun& run);

/// The names of all figures with units, for help and messages: "fps (frames/s), computation_s,
/// ...".
std::string known_figures();

}  // namespace slambench
