// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/comparison.h"
#include "io/text.h"

namespace slambench {
namespace {

using Json = nlohmann::ordered_json;
using Kind = RunDifference::Kind;

constexpr std::size_t width = 80;

std::string_view kind_name(Kind kind) {
  switch (kind) {
    case Kind::task:
      return "task";
    case Kind::implementation:
      return "implementation";
    case Kind::build:
      return "build and machine";
  }
  return "";
}

std::string_view evidence_name(Evidence evidence) {
  switch (evidence) {
    case Evidence::frames:
      return "frames";
    case Evidence::runs:
      return "runs";
    case Evidence::pairs:
      return "pairs";
  }
  return "";
}

/// Words broken into lines of at most `width` columns, those after the first indented.
std::string paragraph(std::string_view first, std::size_t indent, std::string_view text) {
  std::string page, line = fmt::format("{:<{}}", first, indent);
  bool empty = true;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    if (!empty && line.size() + 1 + word.size() > width) {
      page += line + "\n";
      line.assign(indent, ' ');
      empty = true;
    }
    if (!empty) line += ' ';
    line += word;
    empty = false;
  }
  return page + line + "\n";
}

/// In what unit people read a figure, and how many of it make one of the figure's own.
struct Display {
  std::string unit;
  double factor = 1;
};

Display display(const NamedFigure& figure) {
  if (figure.unit == "s") return {"ms", 1e3};
  if (figure.unit == "m") return {"mm", 1e3};
  if (figure.unit == "B") return {"MiB", 1.0 / (1 << 20)};
  return {figure.unit, 1};
}

/// Four digits that count, and `more`, in nine columns.
std::string number(double value, int more) {
  if (value != 0 && (value >= 1e7 || value < 1e-4)) return fmt::format("{:.2e}", value);
  const int decimals = more + (value >= 1000 ? 0 : (value >= 100 ? 1 : (value >= 10 ? 2 : 3)));
  const bool whole = value == static_cast<double>(static_cast<long>(value));
  return whole && value >= 1000 ? fmt::format("{:.0f}", value)
                                : fmt::format("{:.{}f}", value, decimals);
}

/// With as many digits as it takes to tell the two sides apart where the difference is no chance.
struct ValueTexts {
  std::string base, other;
};
ValueTexts value_texts(const FigureComparison& c) {
  const NamedFigure& figure = *c.figure;
  const auto text = [&](double value, int more) {
    if (figure.unit.empty()) return fmt::format("{:.0f}", value);
    return number(value * display(figure).factor, more);
  };
  constexpr int most = 3;
  ValueTexts texts;
  for (int more = 0; more <= most; ++more) {
    texts = {text(c.base, more), text(c.other, more)};
    if (c.interval || texts.base != texts.other || c.base == c.other) break;
  }
  return texts;
}

/// A ratio, or an end of its interval.
std::string factor_text(double factor) {
  if (factor >= 1e4 || factor < 1e-3) return fmt::format("{:.1e}", factor);
  return fmt::format("{:.{}f}", factor, factor >= 100 ? 0 : (factor >= 10 ? 1 : 3));
}

std::string ratio_text(const FigureComparison& c) { return c.ratio ? factor_text(*c.ratio) : ""; }

std::string interval_text(const FigureComparison& c) {
  if (!c.interval || c.verdict == Verdict::too_few_runs) return "";
  return fmt::format("{} to {}", factor_text(c.interval->low), factor_text(c.interval->high));
}

/// A figure's name without what its part of the table says of all.
std::string short_name(const NamedFigure& figure) {
  std::string_view name = figure.name;
  for (const std::string_view head : {"stage_", "kernel_"}) {
    if (name.starts_with(head)) name.remove_prefix(head.size());
  }
  for (const std::string_view tail : {"_s", "_m", "_bytes", "_deg", "_j", "_w"}) {
    if (name.ends_with(tail)) {
      name.remove_suffix(tail.size());
      break;
    }
  }
  const std::string unit = display(figure).unit;
  const bool said = figure.group == FigureGroup::stages || figure.group == FigureGroup::kernels ||
                    unit.empty() || unit == "frames/s";
  return said ? std::string(name) : fmt::format("{}, {}", name, unit);
}

std::string group_title(FigureGroup group) {
  const bool times = group == FigureGroup::stages || group == FigureGroup::kernels;
  return fmt::format("{}{}", name(group), times ? ", ms a frame" : "");
}

std::string differences_of(const Comparison& c, Kind kind) {
  std::string text;
  for (const RunDifference& d : c.differences) {
    if (d.kind != kind) continue;
    text += fmt::format("{}{} {} against {}", text.empty() ? "" : "; ", d.key, d.base, d.other);
  }
  return text;
}

std::string runs_text(std::size_t runs) {
  return runs == 1 ? "1 run" : fmt::format("{} runs", runs);
}

std::string side_text(const ComparedSide& side) {
  return fmt::format("{} ({}): {} on {}, commit {}", side.name, runs_text(side.runs), side.sequence,
                     side.backend, side.commit.substr(0, 12));
}

/// Why runs were not taken in pairs.
std::string unpaired(std::size_t base, std::size_t other) {
  if (std::min(base, other) < least_pairs) {
    return fmt::format("are too few to be taken in pairs ({} on each side that took turns)",
                       least_pairs);
  }
  return base == other ? "did not take turns"
                       : "are not as many on each side, so that none are pairs";
}

/// How the intervals came about and what they do not tell.
std::vector<std::string> notes(const Comparison& c) {
  std::vector<std::string> list;
  if (std::any_of(c.figures.begin(), c.figures.end(),
                  [](const FigureComparison& f) { return f.verdict == Verdict::tolerated; })) {
    list.emplace_back(
        "Within tolerance: a difference in accuracy as another rounding of the same computation "
        "makes it; --tolerance sets another.");
  }
  if (c.base.in_one_go != c.other.in_one_go &&
      std::any_of(c.figures.begin(), c.figures.end(), [](const FigureComparison& f) {
        return f.figure->group == FigureGroup::stages;
      })) {
    list.push_back(fmt::format(
        "Stages of {} are the device's times of their kernels, those of {} wall times: "
        "computation and total are wall times on both sides.",
        (c.base.in_one_go ? c.base : c.other).name, (c.base.in_one_go ? c.other : c.base).name));
  }
  if (c.intervals == 0) {
    list.emplace_back(
        "No interval can be given: a single run on each side without the times of "
        "its frames, or no figure that varies.");
    return list;
  }
  const std::string together =
      c.intervals == 1
          ? fmt::format("The interval holds with {:g} % confidence.", 100 * c.confidence)
          : fmt::format(
                "All {} intervals hold together with {:g} % confidence (Bonferroni): each is "
                "wider than it would be alone. --figure looks at fewer.",
                c.intervals, 100 * c.confidence);
  switch (c.evidence) {
    case Evidence::frames:
      list.push_back(fmt::format(
          "Intervals: circular block bootstrap over the {} measured frames, in blocks of {} "
          "because neighbouring frames are alike. One run a side says nothing of how much two "
          "runs of the same program differ, so no difference is called shown: repeat the runs, "
          "taking turns.",
          c.frames, c.block));
      break;
    case Evidence::runs:
      list.push_back(fmt::format(
          "Intervals: Welch's, of the logarithms of {} and {} runs. The runs {}: what changed "
          "on the machine meanwhile looks like a difference.",
          c.base.runs, c.other.runs, unpaired(c.base.runs, c.other.runs)));
      break;
    case Evidence::pairs:
      list.push_back(fmt::format(
          "Intervals: Student's, of the logarithms of the ratios of {} pairs of runs that took "
          "turns, so that what changed slowly on the machine does not count.",
          c.base.runs));
      break;
  }
  list.push_back(together);
  return list;
}

std::string row(std::string_view label, std::string_view base, std::string_view other,
                std::string_view ratio, std::string_view interval, std::string_view verdict) {
  std::string line = fmt::format("{:<20} {:>8} {:>8} {:>6} {:>14} {}", label, base, other, ratio,
                                 interval, verdict);
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string text_of(const Comparison& c) {
  constexpr std::size_t indent = 9;
  std::string text = paragraph("base", indent, side_text(c.base));
  text += paragraph("other", indent, side_text(c.other));
  for (const Kind kind : {Kind::task, Kind::implementation, Kind::build}) {
    const std::string list = differences_of(c, kind);
    if (list.empty()) continue;
    text += paragraph("differ", indent, fmt::format("in {}: {}", kind_name(kind), list));
  }
  const NamedFigure* before = nullptr;
  for (const FigureComparison& f : c.figures) {
    if (before == nullptr || before->group != f.figure->group) {
      text += '\n';
      text += row(group_title(f.figure->group), "base", "other", "ratio",
                  fmt::format("{:g} % interval", 100 * c.confidence), "");
    }
    before = f.figure;
    const ValueTexts values = value_texts(f);
    text += row(fmt::format(" {}", short_name(*f.figure)), values.base, values.other, ratio_text(f),
                interval_text(f), verdict_text(f));
  }
  text += "\n";
  for (const std::string& note : notes(c)) text += paragraph("", 0, note);
  return text;
}

/// A bar would end the cell.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char ch : text) {
    if (ch == '|') escaped += '\\';
    escaped += ch;
  }
  return escaped;
}

std::string markdown_of(const Comparison& c) {
  std::string text =
      fmt::format("### {}, against {}\n\n", cell(side_text(c.other)), cell(side_text(c.base)));
  for (const Kind kind : {Kind::task, Kind::implementation, Kind::build}) {
    const std::string list = differences_of(c, kind);
    if (!list.empty()) text += fmt::format("They differ in {}: {}.\n\n", kind_name(kind), list);
  }
  text += fmt::format(
      "| figure | base | other | ratio | {:g} % interval | |\n"
      "|---|---:|---:|---:|---|---|\n",
      100 * c.confidence);
  for (const FigureComparison& f : c.figures) {
    const std::string unit = display(*f.figure).unit;
    const ValueTexts values = value_texts(f);
    text += fmt::format("| `{}`{} | {} | {} | {} | {} | {} |\n", f.figure->name,
                        unit.empty() ? "" : fmt::format(", {}", unit), values.base, values.other,
                        ratio_text(f), interval_text(f), verdict_text(f));
  }
  text += "\n";
  for (const std::string& note : notes(c)) text += note + "\n";
  return text;
}

Json json_of(const FigureComparison& f) {
  Json json = {
      {"figure", f.figure->name}, {"unit", f.figure->unit}, {"base", f.base}, {"other", f.other}};
  if (f.ratio) json["ratio"] = *f.ratio;
  if (f.interval) {
    json["low"] = f.interval->low;
    json["high"] = f.interval->high;
  }
  json["verdict"] = verdict_text(f);
  return json;
}

Json json_of(const ComparedSide& side) {
  return {{"runs_of", side.name},
          {"runs", side.runs},
          {"sequence", side.sequence},
          {"backend", side.backend},
          {"commit", side.commit}};
}

Json json_of(const Comparison& c) {
  Json json = {{"base", json_of(c.base)},
               {"other", json_of(c.other)},
               {"intervals_from", evidence_name(c.evidence)},
               {"intervals", c.intervals},
               {"confidence", c.confidence}};
  json["notes"] = notes(c);
  json["differences"] = Json::array();
  for (const RunDifference& d : c.differences) {
    json["differences"].push_back(
        {{"in", kind_name(d.kind)}, {"key", d.key}, {"base", d.base}, {"other", d.other}});
  }
  json["figures"] = Json::array();
  for (const FigureComparison& f : c.figures) json["figures"].push_back(json_of(f));
  return json;
}

}  // namespace

std::string comparison_text(const std::vector<Comparison>& comparisons) {
  std::string text;
  for (const Comparison& c : comparisons) {
    if (!text.empty()) text += fmt::format("\n{:-<{}}\n", "", width);
    text += text_of(c);
  }
  return text;
}

std::string comparison_markdown(const std::vector<Comparison>& comparisons) {
  std::string text;
  for (const Comparison& c : comparisons) {
    if (!text.empty()) text += '\n';
    text += markdown_of(c);
  }
  return text;
}

std::string comparison_csv(const std::vector<Comparison>& comparisons) {
  std::string text =
      "base,other,base_runs,other_runs,figure,unit,base_value,other_value,ratio,low,high,"
      "intervals_from,verdict\r\n";
  const auto optional = [](bool has, double value) { return has ? fmt::format("{}", value) : ""; };
  for (const Comparison& c : comparisons) {
    for (const FigureComparison& f : c.figures) {
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", csv_field(c.base.name),
                          csv_field(c.other.name), c.base.runs, c.other.runs, f.figure->name,
                          f.figure->unit, f.base, f.other,
                          optional(f.ratio.has_value(), f.ratio.value_or(0)),
                          optional(f.interval.has_value(), f.interval ? f.interval->low : 0),
                          optional(f.interval.has_value(), f.interval ? f.interval->high : 0),
                          f.interval ? evidence_name(c.evidence) : "", verdict_text(f));
    }
  }
  return text;
}

std::string comparison_json(const std::vector<Comparison>& comparisons) {
  Json json = {{"format", "slambench-comparison"}, {"schema_version", 1}};
  json["comparisons"] = Json::array();
  for (const Comparison& c : comparisons) json["comparisons"].push_back(json_of(c));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace slambench
