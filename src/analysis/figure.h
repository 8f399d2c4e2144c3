// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/stored_run.h"

namespace slambench {

/// What a figure is about: tables have a part for each.
enum class FigureGroup { speed, stages, kernels, energy, memory, accuracy, frames };

/// A difference that means nothing although every run of a program shows it: another rounding of
/// the same computation leads to it. Either of the two is enough.
struct Tolerance {
  double relative = 0;
  double absolute = 0;  ///< in the figure's unit
  bool holds(double base, double other) const {
    const double difference = std::abs(other - base);
    const double larger = std::max(std::abs(base), std::abs(other));
    return difference <= relative * larger || difference <= absolute;
  }
};

/// A number of a run that has a name of its own: comparisons, limits and tables speak of it by it.
struct NamedFigure {
  std::string name;  ///< "kernel_raycast_s"
  std::string unit;  ///< "s", "frames/s", "B", "m", ...; "" for a count
  FigureGroup group = FigureGroup::speed;
  std::string place;  ///< in record.json
  bool more_is_better = false;
  std::string sentence;
  Tolerance tolerance = {};  ///< of comparisons
};

/// All of them, in the order of tables.
const std::vector<NamedFigure>& figure_table();

/// Nullptr when no figure has that name.
const NamedFigure* find_figure(std::string_view name);

std::string_view name(FigureGroup group);

/// The number at a place of record.json, of each repeat of the run in order; empty when the run
/// does not have it.
std::vector<double> values_of(const std::string& place, const StoredRun& run);

/// Their median; nothing when the run does not have it.
std::optional<double> value_of(const std::string& place, const StoredRun& run);

/// Why a number is not there: the reason of the place, of what it lies in or of its own part, else
/// that the record does not hold it.
std::string reason_absent(const std::string& place, const StoredRun& run);

}  // namespace slambench
