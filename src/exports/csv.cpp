// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <array>
#include <optional>
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

/// A text or a number, as a field; empty when there is none.
std::string field(const std::optional<std::string>& value) { return csv_field(value.value_or("")); }
std::string field_at(const StoredRun& run, std::string_view place) {
  return field(run.value_text(std::string(place)));
}

}  // namespace

std::string wide_csv(const std::vector<ExportRun>& runs, const ParameterRoles&) {
  std::set<std::string> parameters;  // that any run has
  for (const ExportRun& each : runs) parameters.merge(each.run.parameters());
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
      text += fmt::format(",{}", field(run.parameter(parameter)));
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
