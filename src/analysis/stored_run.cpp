// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "analysis/stored_run.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "io/files.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* record_name = "record.json";

/// What stands before and after a parameter's name in the place of its value.
constexpr std::string_view parameter_head = "parameters.", parameter_tail = ".value";

/// Members of members under their names joined by dots. Lists have no place of their own.
void flatten(const Json& json, const std::string& place, StoredRun* run) {
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      flatten(value, place.empty() ? key : fmt::format("{}.{}", place, key), run);
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

}  // namespace

std::string StoredRun::text(const std::string& place) const {
  const auto it = texts.find(place);
  return it == texts.end() ? "" : it->second;
}

std::optional<std::string> StoredRun::value_text(const std::string& place) const {
  if (const auto it = texts.find(place); it != texts.end()) return it->second;
  const auto it = numbers.find(place);
  return it == numbers.end() ? std::nullopt : std::optional(fmt::format("{}", it->second));
}

std::set<std::string> StoredRun::parameters() const {
  std::set<std::string> names;
  for (const auto& [place, value] : texts) {
    if (!place.starts_with(parameter_head) || !place.ends_with(parameter_tail)) continue;
    names.insert(place.substr(parameter_head.size(),
                              place.size() - parameter_head.size() - parameter_tail.size()));
  }
  return names;
}

std::optional<std::string> StoredRun::parameter(const std::string& group_and_name) const {
  return value_text(fmt::format("{}{}{}", parameter_head, group_and_name, parameter_tail));
}

void require_counts(const StoredRun& run) {
  if (run.complete() && run.valid()) return;
  throw InputError(fmt::format("{}: the run {}, expected one that counts", run.path,
                               run.complete() ? "is not valid" : "was interrupted"));
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

}  // namespace slambench
