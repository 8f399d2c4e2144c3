// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <array>
#include <set>
#include <string>
#include <utility>

#include "analysis/figure.h"
#include "exports/exports.h"
#include "io/text.h"

namespace slambench {
namespace {

constexpr std::string_view line_end = "\r\n";  // RFC 4180

/// What tells a run from others, beside its figures and parameters: column, place in record.json.
constexpr std::array<std::pair<std::string_view, std::string_view>, 15> facts{{
    {"sequence", "sequence.name"},
    {"backend", "provenance.backend"},
    {"device", "provenance.device"},
    {"instruction_set", "provenance.instruction_set"},
    {"threads", "provenance.threads"},
    {"map", "memory.map"},
    {"cpu", "provenance.cpu"},
    {"version", "provenance.version"},
    {"commit", "provenance.commit"},
    {"compiler", "provenance.compiler"},
    {"started_at", "provenance.started_at"},
    {"input_hash", "sequence.input_hash"},
    {"complete", "complete"},
    {"valid", "valid"},
    {"measured_frames", "time.measured_frames"},
}};

/// "mu" of "parameters.kinectfusion.mu.value"; empty for any other place.
std::string parameter_at(std::string_view place) {
  constexpr std::string_view head = "parameters.", tail = ".value";
  if (!place.starts_with(head) || !place.ends_with(tail)) return "";
  place = place.substr(head.size(), place.size() - head.size() - tail.size());
  return std::string(place);
}

/// "kinectfusion.mu" of every parameter that any run has.
std::set<std::string> parameters_of(const std::vector<ExportRun>& runs) {
  std::set<std::string> names;
  for (const ExportRun& each : runs) {
    for (const auto& [place, value] : each.run.texts) {
      if (std::string name = parameter_at(place); !name.empty()) names.insert(std::move(name));
    }
  }
  return names;
}

/// A text or a number, as a field; empty when there is none.
std::string field_at(const StoredRun& run, std::string_view place) {
  const std::string key(place);
  if (const auto it = run.texts.find(key); it != run.texts.end()) return csv_field(it->second);
  const auto it = run.numbers.find(key);
  return it == run.numbers.end() ? "" : fmt::format("{}", it->second);
}

}  // namespace

std::string wide_csv(const std::vector<ExportRun>& runs, const ParameterRoles&) {
  const std::set<std::string> parameters = parameters_of(runs);
  std::string text = "run,repeats";
  for (const auto& [column, place] : facts) text += fmt::format(",{}", column);
  for (const NamedFigure& figure : figure_table()) text += fmt::format(",{}", figure.name);
  for (const std::string& name : parameters) text += fmt::format(",{}", csv_field(name));
  text += line_end;
  for (const auto& [name, run] : runs) {
    text += fmt::format("{},{}", csv_field(name), run.run_count());
    for (const auto& [column, place] : facts) text += fmt::format(",{}", field_at(run, place));
    for (const NamedFigure& figure : figure_table()) {
      const auto value = value_of(figure.place, run);
      text += value ? fmt::format(",{}", *value) : ",";
    }
    for (const std::string& parameter : parameters) {
      text += fmt::format(",{}", field_at(run, fmt::format("parameters.{}.value", parameter)));
    }
    text += line_end;
  }
  return text;
}

std::string long_csv(const std::vector<ExportRun>& runs, const ParameterRoles&) {
  std::string text = "run,sequence,backend,figure,unit,repeat,value,absent\r\n";
  for (const auto& [name, run] : runs) {
    for (const NamedFigure& figure : figure_table()) {
      const std::string head =
          fmt::format("{},{},{},{},{}", csv_field(name), field_at(run, "sequence.name"),
                      field_at(run, "provenance.backend"), figure.name, csv_field(figure.unit));
      const std::vector<double> values = values_of(figure.place, run);
      for (std::size_t i = 0; i < values.size(); ++i) {
        text += fmt::format("{},{},{},{}", head, i + 1, values[i], line_end);
      }
      if (values.empty()) {
        text +=
            fmt::format("{},,,{}{}", head, csv_field(reason_absent(figure.place, run)), line_end);
      }
    }
  }
  return text;
}

}  // namespace slambench
