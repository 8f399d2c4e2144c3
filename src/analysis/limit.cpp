// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "analysis/limit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "analysis/figure.h"
#include "core/error.h"
#include "core/trimmed.h"
#include "io/text.h"

namespace slambench {
namespace {

using Relation = Limit::Relation;

/// Longer ones first: "<=" begins with "<".
constexpr std::array<std::pair<std::string_view, Relation>, 6> relations = {
    {{"<=", Relation::at_most},
     {">=", Relation::at_least},
     {"==", Relation::equal},
     {"!=", Relation::unequal},
     {"<", Relation::less},
     {">", Relation::more}}};

[[noreturn]] void reject(std::string_view text, const std::string& message) {
  throw UsageError(fmt::format("limit '{}': {}", text, message));
}

/// Takes "ratio(" and ")" away.
bool take_ratio(std::string_view* figure) {
  if (!figure->starts_with("ratio(") || !figure->ends_with(")")) return false;
  *figure = trimmed(figure->substr(6, figure->size() - 7));
  return true;
}

}  // namespace

bool Limit::violated_by(double value) const {
  switch (relation) {
    case Relation::less:
      return value < bound;
    case Relation::at_most:
      return value <= bound;
    case Relation::more:
      return value > bound;
    case Relation::at_least:
      return value >= bound;
    case Relation::equal:
      return value == bound;
    case Relation::unequal:
      return value != bound;
  }
  return false;
}

std::string known_figures() {
  std::string text;
  for (const NamedFigure& figure : figure_table()) {
    text += fmt::format("{}{}", text.empty() ? "" : ", ", figure.name);
  }
  return text;
}

Limit parse_limit(std::string_view text, bool ratios) {
  const std::size_t at = text.find_first_of("<>=!");
  const std::string_view rest = at == std::string_view::npos ? "" : text.substr(at);
  const auto* relation = std::find_if(relations.begin(), relations.end(), [&](const auto& known) {
    return rest.starts_with(known.first);
  });
  if (relation == relations.end()) {
    reject(text, "expected FIGURE, one of < <= > >= == !=, and a number, as in 'fps<30'");
  }
  Limit limit;
  limit.text = std::string(trimmed(text));
  limit.relation = relation->second;
  const std::string_view number = trimmed(rest.substr(relation->first.size()));
  const auto bound = parse_finite(number);
  if (!bound) {
    reject(text,
           fmt::format("found {} after {}, expected a number", quote(number), relation->first));
  }
  limit.bound = *bound;
  std::string_view figure = trimmed(text.substr(0, at));
  limit.of_ratio = take_ratio(&figure);
  if (limit.of_ratio && !ratios) reject(text, "ratios are known to slambench compare only");
  limit.figure = std::string(figure);
  const NamedFigure* known = find_figure(figure);
  if (known == nullptr && figure.find('.') == std::string_view::npos) {
    reject(text, fmt::format("unknown figure {}; known are {}, and any number by its place in "
                             "record.json (time.stages.track.seconds.p99)",
                             quote(figure), known_figures()));
  }
  limit.place = known != nullptr ? known->place : limit.figure;
  return limit;
}

std::vector<std::string> violations(const std::vector<Limit>& limits, const StoredRun& run) {
  std::vector<std::string> lines;
  const Limit* unknown = nullptr;
  for (const Limit& limit : limits) {
    if (limit.of_ratio) continue;
    const auto value = value_of(limit.place, run);
    if (!value) {
      unknown = &limit;
    } else if (limit.violated_by(*value)) {
      lines.push_back(
          fmt::format("{} is {:.6g}, not wanted: {}", limit.figure, *value, limit.text));
    }
  }
  if (lines.empty() && unknown != nullptr) {
    throw UnavailableError(fmt::format("limit '{}': {} was not measured: {}", unknown->text,
                                       unknown->figure, reason_absent(unknown->place, run)));
  }
  return lines;
}

}  // namespace slambench
