// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "analysis/stored_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/error.h"
#include "io/files.h"
#include "io/text.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* record_name = "record.json";

/// Members of members under their names joined by dots. Lists have no place of their own.
void flatten(const Json& json, const std::string& place, StoredRun* run) {
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      flatten(value, place.empty() ? key : place + "." + key, run);
    }
  } else if (json.is_number()) {
    run->numbers[place] = json.get<double>();
  } else if (json.is_string()) {
    run->texts[place] = json.get<std::string>();
  } else if (json.is_boolean()) {
    run->texts[place] = json.get<bool>() ? "true" : "false";
  }
}

void read_repeats(const Json& figures, StoredRun* run) {
  for (const auto& [place, figure] : figures.items()) {
    const auto values = figure.is_object() ? figure.find("values") : figure.end();
    if (values == figure.end() || !values->is_array() || values->size() < 2) continue;
    std::vector<double>& list = run->repeats[place];
    for (const Json& value : *values) list.push_back(value.is_number() ? value.get<double>() : 0);
  }
}

/// The next field of a row, which is shortened by it. No field of a frames.csv is quoted.
std::string_view take_field(std::string_view* row) {
  const std::size_t end = row->find(',');
  const std::string_view field = row->substr(0, end);
  *row = end == std::string_view::npos ? std::string_view() : row->substr(end + 1);
  return field;
}

std::string_view take_line(std::string_view* text) {
  const std::size_t end = text->find('\n');
  std::string_view line = text->substr(0, end);
  *text = end == std::string_view::npos ? std::string_view() : text->substr(end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::size_t field_count(std::string_view row) {
  return 1 + static_cast<std::size_t>(std::count(row.begin(), row.end(), ','));
}

}  // namespace

std::string StoredRun::text(const std::string& place) const {
  const auto it = texts.find(place);
  return it == texts.end() ? "" : it->second;
}

StoredRun parse_stored_run(std::string_view text, const std::string& path) {
  Json json = Json::parse(text, nullptr, false);
  const auto format = json.is_object() ? json.find("format") : json.end();
  if (format == json.end() || *format != "slambench-record") {
    throw InputError(
        fmt::format("{}: is not the record of a run: expected what slambench run "
                    "writes as record.json",
                    path));
  }
  StoredRun run;
  run.path = path;
  // Its keys are places and hold dots themselves.
  if (const auto absent = json.find("absent"); absent != json.end() && absent->is_object()) {
    for (const auto& [place, reason] : absent->items()) {
      if (reason.is_string()) run.absent[place] = reason.get<std::string>();
    }
  }
  json.erase("absent");
  // So do those of the repeated figures.
  if (const auto it = json.find("repetition"); it != json.end() && it->is_object()) {
    if (const auto figures = it->find("figures"); figures != it->end() && figures->is_object()) {
      read_repeats(*figures, &run);
    }
    json.erase(it);
  }
  flatten(json, "", &run);
  return run;
}

StoredRun read_stored_run(const std::string& path) {
  std::error_code error;
  const fs::path file =
      fs::is_directory(path, error) ? fs::path(path) / record_name : fs::path(path);
  return parse_stored_run(read_file(file), file);
}

FrameColumns parse_frame_columns(std::string_view csv, const std::string& path) {
  std::string_view header = take_line(&csv);
  const std::size_t width = field_count(header);
  std::vector<std::vector<double>*> order;
  FrameColumns columns;
  for (std::size_t i = 0; i < width; ++i) {
    order.push_back(&columns[std::string(take_field(&header))]);
  }
  for (int number = 2; !csv.empty(); ++number) {
    std::string_view row = take_line(&csv);
    const auto reject = [&](const std::string& found, const std::string& expected) {
      throw InputError(path, fmt::format("line {}", number), found, expected);
    };
    if (field_count(row) != width) {
      reject(fmt::format("{} fields", field_count(row)), fmt::format("{}", width));
    }
    for (std::vector<double>* column : order) {
      const std::string_view field = take_field(&row);
      const auto value = field.empty() ? std::optional<double>(std::nan("")) : parse_finite(field);
      if (!value) reject(quote(field), "a number");
      column->push_back(*value);
    }
  }
  return columns;
}

FrameColumns read_frame_columns(const StoredRun& run) {
  const std::string file = fs::path(run.path).parent_path() / "frames.csv";
  return parse_frame_columns(read_file(file), file);
}

}  // namespace slambench
