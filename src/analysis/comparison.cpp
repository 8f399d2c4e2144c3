// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "analysis/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "analysis/frame_columns.h"
#include "core/error.h"

namespace slambench {
namespace {

/// An interval whose ends are further apart than this factor tells nothing.
constexpr double widest = 1000;

/// One figure in all runs of a group, repeats of a run included; empty when one does not have it.
std::vector<double> values(const NamedFigure& figure, const RunGroup& group) {
  std::vector<double> list;
  for (const StoredRun& run : group.runs) {
    const std::vector<double> repeats = values_of(figure.place, run);
    if (repeats.empty()) return {};
    list.insert(list.end(), repeats.begin(), repeats.end());
  }
  return list;
}

std::size_t run_count(const RunGroup& group) {
  std::size_t count = 0;
  for (const StoredRun& run : group.runs) count += run.run_count();
  return count;
}

bool all_positive(const std::vector<double>& list) {
  return std::all_of(list.begin(), list.end(), [](double v) { return v > 0; });
}

bool constant(const std::vector<double>& list) {
  return std::adjacent_find(list.begin(), list.end(), std::not_equal_to<>()) == list.end();
}

double center(const std::vector<double>& list) {
  if (constant(list)) return list.front();
  double sum = 0;
  for (const double v : list) sum += all_positive(list) ? std::log(v) : v;
  const double mean = sum / static_cast<double>(list.size());
  return all_positive(list) ? std::exp(mean) : mean;
}

/// Whether the program promises the same value in every run.
bool repeatable(const NamedFigure& figure, const RunGroup& group) {
  const bool decided_by_input = figure.group == FigureGroup::accuracy ||
                                figure.group == FigureGroup::frames || figure.name == "map_bytes";
  return decided_by_input && !in_real_time(group.runs.front());
}

std::string begin_of(const StoredRun& run) { return run.text("provenance.started_at"); }

/// Whether the runs of both took turns: each pair had begun before the next one did.
bool took_turns(const RunGroup& base, const RunGroup& other) {
  const std::size_t count = base.runs.size();
  if (other.runs.size() != count || count < least_pairs) return false;
  if (run_count(base) != count || run_count(other) != count) return false;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const std::string end = std::max(begin_of(base.runs[i]), begin_of(other.runs[i]));
    if (end > std::min(begin_of(base.runs[i + 1]), begin_of(other.runs[i + 1]))) return false;
  }
  return true;
}

/// The times of a single run's measured frames, by the figures' names; empty without a frames.csv.
FrameColumns measured_frames(const RunGroup& group) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path file = fs::path(group.runs.front().path).parent_path() / "frames.csv";
  if (!fs::exists(file, error)) return {};
  FrameColumns columns = read_frame_columns(file);
  const std::vector<double> warmup = columns["warmup"];  // empty of a dropped frame
  for (auto& [name, column] : columns) {
    std::size_t i = 0;
    std::erase_if(column, [&](double) { return i >= warmup.size() || warmup[i++] != 0; });
    for (double& v : column) v = std::isnan(v) ? 0 : v;
  }
  return columns;
}

/// What decides about the intervals of a comparison.
struct Basis {
  Evidence evidence = Evidence::frames;
  FrameColumns base_frames, other_frames;
};

Basis basis_of(const RunGroup& base, const RunGroup& other) {
  if (run_count(base) > 1 || run_count(other) > 1) {
    return {took_turns(base, other) ? Evidence::pairs : Evidence::runs, {}, {}};
  }
  return {Evidence::frames, measured_frames(base), measured_frames(other)};
}

const std::vector<double>* column(const FrameColumns& frames, const NamedFigure& figure) {
  const auto it = frames.find(figure.name == "fps" ? "computation_s" : figure.name);
  return it == frames.end() || it->second.empty() ? nullptr : &it->second;
}

std::optional<RatioInterval> frame_interval(const NamedFigure& figure, const Basis& basis,
                                            double alpha) {
  const auto* base = column(basis.base_frames, figure);
  const auto* other = column(basis.other_frames, figure);
  if (base == nullptr || other == nullptr) return std::nullopt;
  const bool inverse = figure.name == "fps";
  return ratio_of_frames(inverse ? *other : *base, inverse ? *base : *other, alpha);
}

/// Of a figure that scatters and is positive in all runs.
std::optional<RatioInterval> interval_of(const NamedFigure& figure, const std::vector<double>& base,
                                         const std::vector<double>& other, const Basis& basis,
                                         double alpha) {
  switch (basis.evidence) {
    case Evidence::frames:
      return frame_interval(figure, basis, alpha);
    case Evidence::runs:
      return ratio_of_runs(base, other, alpha);
    case Evidence::pairs:
      return ratio_of_pairs(base, other, alpha);
  }
  return std::nullopt;
}

Verdict direction(double base, double other) {
  return other < base ? Verdict::lower : Verdict::higher;
}

Verdict verdict_of(const FigureComparison& c, bool exact, Evidence evidence, Tolerance tolerance) {
  const bool tolerated = tolerance.holds(c.base, c.other);
  if (exact && c.base == c.other) return Verdict::same;
  if (exact) return tolerated ? Verdict::tolerated : direction(c.base, c.other);
  if (c.base == c.other) return Verdict::no_difference;
  if (!c.interval) return tolerated ? Verdict::tolerated : Verdict::unclear;
  if (c.interval->contains_one()) {
    const bool tells = evidence == Evidence::frames || c.interval->high < widest * c.interval->low;
    return tells ? Verdict::no_difference : Verdict::too_few_runs;
  }
  if (tolerated) return Verdict::tolerated;
  return evidence == Evidence::frames ? Verdict::unclear : direction(c.base, c.other);
}

Tolerance tolerance_of(const NamedFigure& figure, const ComparisonOptions& options) {
  const bool chosen = options.tolerance && figure.group == FigureGroup::accuracy;
  return chosen ? Tolerance{.relative = *options.tolerance} : figure.tolerance;
}

bool wanted(const NamedFigure& figure, const ComparisonOptions& options) {
  return options.figures.empty() || std::find(options.figures.begin(), options.figures.end(),
                                              figure.name) != options.figures.end();
}

/// A figure with its values, until it is known how many have an interval.
struct Candidate {
  const NamedFigure* figure = nullptr;
  std::vector<double> base, other;
  bool exact = false;
  bool has_interval(const Basis& basis) const {
    if (exact || !all_positive(base) || !all_positive(other)) return false;
    if (basis.evidence == Evidence::frames) {
      return column(basis.base_frames, *figure) != nullptr &&
             column(basis.other_frames, *figure) != nullptr;
    }
    // Of figures that a record holds of its shown run alone, nobody knows how they scatter.
    return base.size() > 1 || other.size() > 1;
  }
};

FigureComparison compared(const Candidate& candidate, const Basis& basis, double alpha,
                          const ComparisonOptions& options) {
  FigureComparison c;
  c.figure = candidate.figure;
  c.base = center(candidate.base);
  c.other = center(candidate.other);
  if (c.base > 0 && c.other > 0) c.ratio = c.other / c.base;
  if (candidate.has_interval(basis)) {
    c.interval = interval_of(*c.figure, candidate.base, candidate.other, basis, alpha);
  }
  c.verdict = verdict_of(c, candidate.exact, basis.evidence, tolerance_of(*c.figure, options));
  return c;
}

ComparedSide side(const RunGroup& group) {
  const StoredRun& run = group.runs.front();
  return {group.name,
          run_count(group),
          run.text("sequence.name"),
          run.text("provenance.backend"),
          run.text("provenance.commit"),
          value_of(find_figure("between_stages_s")->place, run).has_value()};
}

void check_figures(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (find_figure(name) != nullptr) continue;
    throw UsageError(fmt::format("unknown figure '{}'; known are {}", name, known_figures()));
  }
}

}  // namespace

Comparison compare(const RunGroup& base, const RunGroup& other, const ComparisonOptions& options) {
  check_figures(options.figures);
  const Basis basis = basis_of(base, other);
  std::vector<Candidate> candidates;
  for (const NamedFigure& figure : figure_table()) {
    if (!wanted(figure, options)) continue;
    Candidate c{&figure, values(figure, base), values(figure, other)};
    if (c.base.empty() || c.other.empty()) continue;
    c.exact = repeatable(figure, base) && constant(c.base) && constant(c.other);
    if (c.exact || center(c.base) != 0 || center(c.other) != 0) candidates.push_back(std::move(c));
  }
  Comparison result;
  result.base = side(base);
  result.other = side(other);
  result.differences = differences(base.runs.front(), other.runs.front(), options.roles);
  result.evidence = basis.evidence;
  result.confidence = options.confidence;
  if (const auto it = basis.base_frames.find("computation_s"); it != basis.base_frames.end()) {
    result.frames = it->second.size();
    result.block = block_length(it->second.size());
  }
  result.intervals = static_cast<std::size_t>(
      std::count_if(candidates.begin(), candidates.end(),
                    [&](const Candidate& c) { return c.has_interval(basis); }));
  const double alpha =
      (1 - options.confidence) / static_cast<double>(std::max<std::size_t>(result.intervals, 1));
  for (const Candidate& c : candidates)
    result.figures.push_back(compared(c, basis, alpha, options));
  return result;
}

std::vector<std::string> violations(const std::vector<Limit>& limits, const RunGroup& other,
                                    const Comparison& comparison) {
  std::vector<std::string> lines;
  std::optional<UnavailableError> unavailable;
  for (const Limit& limit : limits) {
    const auto it =
        std::find_if(comparison.figures.begin(), comparison.figures.end(),
                     [&](const FigureComparison& c) { return c.figure->name == limit.figure; });
    if (it == comparison.figures.end() || (limit.of_ratio && !it->ratio)) {
      unavailable.emplace(fmt::format("limit '{}': {} was not measured: {}", limit.text,
                                      limit.figure,
                                      reason_absent(limit.place, other.runs.front())));
      continue;
    }
    const double value = limit.of_ratio ? *it->ratio : it->other;
    const RatioInterval sure =
        limit.of_ratio && it->interval ? *it->interval : RatioInterval{value, value, value};
    if (!limit.violated_by(sure.low) || !limit.violated_by(sure.high)) continue;
    lines.push_back(fmt::format(
        "{}: {} is {:.6g}, not wanted: {}", comparison.other.name,
        limit.of_ratio ? fmt::format("ratio({})", limit.figure) : limit.figure, value, limit.text));
  }
  if (lines.empty() && unavailable) throw UnavailableError(unavailable->what());
  return lines;
}

std::string verdict_text(const FigureComparison& comparison) {
  switch (comparison.verdict) {
    case Verdict::same:
      return "the same";
    case Verdict::tolerated:
      return "within tolerance";
    case Verdict::no_difference:
      return "no difference shown";
    case Verdict::too_few_runs:
      return "too few runs to tell";
    case Verdict::unclear:
      return "repeat to tell";
    case Verdict::lower:
    case Verdict::higher:
      break;
  }
  const NamedFigure& figure = *comparison.figure;
  const bool higher = comparison.verdict == Verdict::higher;
  switch (figure.group) {
    case FigureGroup::speed:
    case FigureGroup::stages:
    case FigureGroup::kernels:
      return higher == figure.more_is_better ? "faster" : "slower";
    case FigureGroup::accuracy:
      return higher == figure.more_is_better ? "better" : "worse";
    case FigureGroup::energy:
    case FigureGroup::memory:
      return higher ? "more" : "less";
    case FigureGroup::frames:
      return higher ? "more" : "fewer";
  }
  return "";
}

}  // namespace slambench
