// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "analysis/run_group.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <set>

#include "analysis/result_folders.h"
#include "core/error.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;
using Kind = RunDifference::Kind;

constexpr const char* nothing = "nothing";

/// It only names values that are all there.
constexpr std::string_view preset = "run.preset";

constexpr std::array<std::string_view, 11> build_places = {
    "provenance.version",    "provenance.commit", "provenance.compiler", "provenance.flags",
    "provenance.build_type", "provenance.cpu",    "provenance.cores",    "provenance.os",
    "provenance.device",     "provenance.driver", "time.read_ahead"};

constexpr std::array<std::string_view, 9> input_places = {
    "sequence.input_hash",        "sequence.name",      "sequence.input_size.width",
    "sequence.input_size.height", "sequence.camera.fx", "sequence.camera.fy",
    "sequence.camera.cx",         "sequence.camera.cy", "sequence.units_per_m"};

/// A folder of result folders stands for these, in order of their names.
std::vector<std::string> expanded(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error) || is_result_folder(path)) return {path};
  std::vector<std::string> found = result_folders_in(path);
  if (found.empty()) {
    throw InputError(
        fmt::format("{}: found a folder without a record.json, expected a result "
                    "folder or a folder of result folders",
                    path));
  }
  return found;
}

/// The parts between commas, unless the whole is a path.
std::vector<std::string> parts(const std::string& argument) {
  std::error_code error;
  if (fs::exists(argument, error)) return {argument};
  std::vector<std::string> list;
  for (std::size_t begin = 0; begin <= argument.size();) {
    const std::size_t end = std::min(argument.find(',', begin), argument.size());
    list.push_back(argument.substr(begin, end - begin));
    begin = end + 1;
  }
  return list;
}

std::string short_text(const std::string& text) {
  constexpr std::size_t most = 40;
  return text.size() <= most ? text : text.substr(0, most - 3) + "...";
}

}  // namespace

ParameterRoles roles_of(const std::vector<ParameterList>& lists) {
  ParameterRoles roles = {{std::string(preset), ParameterRole::implementation}};
  for (const ParameterList& list : lists) {
    for (const Parameter& p : list.parameters) {
      roles[fmt::format("{}.{}", list.group, p.name)] = p.role;
    }
  }
  return roles;
}

std::string list_text(const std::vector<RunDifference>& list) {
  std::string text;
  for (const RunDifference& d : list) {
    text += fmt::format("{}{} ({} against {})", text.empty() ? "" : ", ", d.key, short_text(d.base),
                        short_text(d.other));
  }
  return text;
}

bool in_real_time(const StoredRun& run) {
  const std::string fps = run.parameter("run.fps").value_or("");
  return run.parameter("run.real-time") == "true" || !(fps.empty() || fps == "0");
}

std::vector<RunDifference> differences(const StoredRun& base, const StoredRun& other,
                                       const ParameterRoles& roles) {
  std::vector<RunDifference> found;
  using Value = std::optional<std::string>;
  const auto add = [&](Kind kind, std::string_view key, const Value& b, const Value& o) {
    if (b == o) return;
    found.push_back({kind, std::string(key), b.value_or(nothing), o.value_or(nothing)});
  };
  const auto add_place = [&](Kind kind, std::string_view key, std::string_view place) {
    const std::string at(place);
    add(kind, key, base.value_text(at), other.value_text(at));
  };
  // In real time the hash tells which frames were in time, not what the sequence holds. Without,
  // equal hashes are equal sequences, whatever they are called.
  const bool real_time = in_real_time(base) || in_real_time(other);
  const bool same_input =
      !real_time && base.text("sequence.input_hash") == other.text("sequence.input_hash");
  for (const std::string_view place : input_places) {
    if (place == "sequence.input_hash" && real_time) continue;
    if (place == "sequence.name" && same_input) continue;
    add_place(Kind::task, place, place);
  }
  std::set<std::string> parameters = base.parameters();
  parameters.merge(other.parameters());
  for (const std::string& full : parameters) {
    const auto role = roles.find(full);
    const bool known = role != roles.end();
    if (known && role->second == ParameterRole::bookkeeping) continue;
    const bool how = known && role->second == ParameterRole::implementation;
    add(how ? Kind::implementation : Kind::task, full.substr(full.find('.') + 1),
        base.parameter(full), other.parameter(full));
  }
  for (const std::string_view place : build_places) {
    add_place(Kind::build, place.substr(place.find('.') + 1), place);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.kind < b.kind; });
  return found;
}

void require_same_task(const RunGroup& base, const RunGroup& other,
                       const std::vector<std::string>& allowed, const ParameterRoles& roles) {
  std::vector<RunDifference> refused = differences(base.runs.front(), other.runs.front(), roles);
  std::erase_if(refused, [&](const RunDifference& d) {
    return d.kind != Kind::task ||
           std::find(allowed.begin(), allowed.end(), d.key) != allowed.end();
  });
  if (refused.empty()) return;
  throw InputError(
      fmt::format("{} and {} did not compute the same: {}; --allow KEY lets one of "
                  "these differ, --allow-different all",
                  base.name, other.name, list_text(refused)));
}

RunGroup read_run_group(const std::string& argument, const ParameterRoles& roles) {
  RunGroup group;
  group.name = argument;
  for (const std::string& part : parts(argument)) {
    for (const std::string& path : expanded(part)) {
      group.runs.push_back(read_stored_run(path));
      require_counts(group.runs.back());
    }
  }
  std::stable_sort(group.runs.begin(), group.runs.end(),
                   [](const StoredRun& a, const StoredRun& b) {
                     return a.text("provenance.started_at") < b.text("provenance.started_at");
                   });
  for (const StoredRun& run : group.runs) {
    const auto list = differences(group.runs.front(), run, roles);
    if (list.empty()) continue;
    throw InputError(
        fmt::format("{}: its runs are not repeats of one another: {} and {} differ "
                    "in {}",
                    argument, group.runs.front().path, run.path, list_text(list)));
  }
  return group;
}

}  // namespace slambench
