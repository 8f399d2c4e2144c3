// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/figure.h"
#include "analysis/interval.h"
#include "analysis/limit.h"
#include "analysis/run_group.h"

namespace slambench {

enum class Verdict {
  same,           ///< equal, of a figure that does not scatter
  tolerated,      ///< differ, by less than the figure's tolerance
  no_difference,  ///< the interval holds 1, or there is none
  too_few_runs,   ///< it does, and is so wide that it tells nothing
  unclear,        ///< the single runs differ, and nobody knows how much two runs do
  lower,
  higher,
};

/// One figure of two groups of runs.
struct FigureComparison {
  const NamedFigure* figure = nullptr;
  double base = 0, other = 0;             ///< geometric means over the runs, of positive values
  std::optional<double> ratio;            ///< other / base; none when one of them is 0
  std::optional<RatioInterval> interval;  ///< none for a figure that does not scatter
  Verdict verdict = Verdict::no_difference;
};

/// Runs on each side that are compared in pairs when they took turns: fewer pairs leave too little
/// to estimate their scatter from.
inline constexpr std::size_t least_pairs = 6;

/// Where the intervals come from.
enum class Evidence {
  frames,  ///< a single run on each side: its frames
  runs,    ///< repeated runs
  pairs,   ///< repeated runs that took turns
};

/// Which runs stand on one side of a comparison.
struct ComparedSide {
  std::string name;  ///< what the user called them
  std::size_t runs = 1;
  std::string sequence, backend, commit;
  bool in_one_go = false;  ///< frames are: stages are the device's times of their kernels
};

struct Comparison {
  ComparedSide base, other;
  std::vector<RunDifference> differences;
  Evidence evidence = Evidence::frames;
  std::size_t frames = 0, block = 0;  ///< with Evidence::frames
  std::size_t intervals = 0;          ///< which hold all together with `confidence`
  double confidence = 0.95;
  std::vector<FigureComparison> figures;  ///< in the order of figure_table()
};

/// What shall be compared.
struct ComparisonOptions {
  double confidence = 0.95;
  std::vector<std::string> figures = {};  ///< names; empty: all
  std::optional<double> tolerance = {};   ///< relative, of accuracy, instead of each figure's own
  ParameterRoles roles = {};              ///< to say in what the runs differ
};

/// Every figure that both have. The intervals are as wide as it takes to hold all together: the
/// more figures are looked at, the likelier one of them differs by chance.
Comparison compare(const RunGroup& base, const RunGroup& other, const ComparisonOptions& options);

/// "no difference shown", "slower", "less", ... of this figure.
std::string verdict_text(const FigureComparison& comparison);

/// One line a limit that the other runs violate. A limit of a ratio is violated when the whole
/// interval is. Throws UnavailableError as violations() of a run does.
std::vector<std::string> violations(const std::vector<Limit>& limits, const RunGroup& other,
                                    const Comparison& comparison);

// All comparisons with one base as a document; docs/compare.md describes the formats.
std::string comparison_text(const std::vector<Comparison>& comparisons);
std::string comparison_markdown(const std::vector<Comparison>& comparisons);
std::string comparison_csv(const std::vector<Comparison>& comparisons);
std::string comparison_json(const std::vector<Comparison>& comparisons);

}  // namespace slambench
