// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "suite/suite_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <set>

#include "config/nearest.h"
#include "config/presets.h"
#include "config/toml_reading.h"
#include "core/error.h"
#include "io/files.h"

namespace slambench {
namespace {

using Lists = std::vector<ParameterList>;

/// Where results go and what is printed: of each run, the suite decides.
constexpr std::array<std::string_view, 7> parameters_of_suites = {
    "out", "force", "log-file", "dump-volume", "quiet", "json", "no-gui"};

void refuse_parameter_of_suites(std::string_view name, const TomlPlace& place) {
  if (std::ranges::find(parameters_of_suites, name) == parameters_of_suites.end()) return;
  place.reject(fmt::format("{}: cannot be set in a suite, which decides it for each run", name));
}

std::string read_preset(const TomlPlace& place) {
  std::string name = read_word("preset", place);
  try {
    find_preset(name);
  } catch (const UsageError& error) {
    place.reject(std::string(error.what()).substr(2));  // without the dashes of the option
  }
  return name;
}

bool read_switch(std::string_view key, const TomlPlace& place) {
  const auto* value = place.node.as_boolean();
  if (value == nullptr) {
    place.reject(fmt::format("{}: found {}, expected true or false", key, written(place.node)));
  }
  return value->get();
}

const toml::table& read_table(std::string_view key, const TomlPlace& place) {
  const auto* table = place.node.as_table();
  if (table == nullptr) {
    place.reject(fmt::format("{}: found {}, expected a table", key, written(place.node)));
  }
  return *table;
}

const toml::array& read_list(std::string_view key, const TomlPlace& place) {
  const auto* list = place.node.as_array();
  if (list == nullptr || list->empty()) {
    place.reject(fmt::format("{}: found {}, expected a list with one value at least", key,
                             list == nullptr ? written(place.node) : "an empty one"));
  }
  return *list;
}

/// What to do with a key of its own meaning; all others are tables of parameters.
struct Key {
  std::string_view name;
  std::function<void(const TomlPlace&)> read;
};

/// Reads a table that has keys of its own and, beside them, settings like a configuration file.
void read_settings(const toml::table& table, const std::string& path, const Lists& lists,
                   const std::vector<Key>& keys, SuiteSettings* settings) {
  std::vector<std::string_view> known = {"preset"};
  for (const Key& key : keys) known.push_back(key.name);
  for (const ParameterList& list : lists) known.push_back(list.group);
  for (const auto& [word, node] : table) {
    const std::string_view name(word);
    const TomlPlace place{path, node};
    const auto key = std::ranges::find(keys, name, &Key::name);
    const auto list = std::ranges::find(lists, name, &ParameterList::group);
    if (name == "preset") {
      settings->preset = read_preset(place);
    } else if (key != keys.end()) {
      key->read(place);
    } else if (list == lists.end()) {
      place.reject(fmt::format("unknown {} '{}'{}", node.is_table() ? "table" : "key", name,
                               suggestion(name, known)));
    } else {
      const toml::table& values = read_table(name, place);
      for (const auto& [parameter, value] : values) {
        refuse_parameter_of_suites(parameter.str(), {path, value});
      }
      read_group(values, *list, path, &settings->assignments);
    }
  }
}

SuiteAxis read_axis(std::string_view name, const TomlPlace& place, const Lists& lists) {
  const Parameter* parameter = find(lists, name);
  if (parameter == nullptr && name != "preset") {
    std::vector<std::string_view> known = {"preset"};
    for (const ParameterList& list : lists) {
      for (const Parameter& p : list.parameters) known.push_back(p.name);
    }
    place.reject(
        fmt::format("unknown parameter '{}' in [matrix]{}", name, suggestion(name, known)));
  }
  refuse_parameter_of_suites(name, place);
  if (name == "repeat" || name == "warmup") {
    place.reject(fmt::format("{}: cannot be varied; set it under [run]", name));
  }
  SuiteAxis axis{std::string(name), {}};
  for (const toml::node& value : read_list(name, place)) {
    const TomlPlace at{place.path, value};
    std::string text =
        parameter == nullptr ? read_preset(at) : read_assignment(*parameter, at).value;
    if (std::ranges::find(axis.values, text) != axis.values.end()) {
      at.reject(fmt::format("{}: {} is there twice", name, written(value)));
    }
    axis.values.push_back(std::move(text));
  }
  return axis;
}

/// In the order of the file, which the table does not keep.
std::vector<SuiteAxis> read_matrix(const TomlPlace& place, const Lists& lists) {
  std::vector<std::pair<toml::source_position, SuiteAxis>> found;
  for (const auto& [key, node] : read_table("matrix", place)) {
    const TomlPlace at{place.path, node};
    found.emplace_back(key.source().begin, read_axis(key.str(), at, lists));
  }
  std::ranges::stable_sort(found, [](const auto& a, const auto& b) {
    return std::pair(a.first.line, a.first.column) < std::pair(b.first.line, b.first.column);
  });
  std::vector<SuiteAxis> axes;
  for (auto& [position, axis] : found) axes.push_back(std::move(axis));
  return axes;
}

/// A short name for a path: all of it where it is short and plain, else its last part.
std::string name_of(const std::string& path) {
  const bool plain = path.find_first_of("$~") == std::string::npos && !path.starts_with('/') &&
                     !path.starts_with("..");
  std::filesystem::path rest = std::filesystem::path(path).lexically_normal();
  if (!rest.has_filename()) rest = rest.parent_path();
  return plain ? rest.string() : rest.filename().string();
}

SuiteSequence read_sequence(const TomlPlace& place, const Lists& lists) {
  SuiteSequence sequence;
  sequence.line = static_cast<int>(place.node.source().begin.line);
  if (place.node.is_string()) {
    sequence.path = read_word("sequence", place);
  } else if (place.node.is_table()) {
    const std::vector<Key> keys = {
        {"path", [&](const TomlPlace& at) { sequence.path = read_word("path", at); }},
        {"name", [&](const TomlPlace& at) { sequence.name = read_word("name", at); }},
        {"optional", [&](const TomlPlace& at) { sequence.optional = read_switch("optional", at); }},
    };
    read_settings(*place.node.as_table(), place.path, lists, keys, &sequence.settings);
  } else {
    place.reject(fmt::format("sequence: found {}, expected a path or a table with one",
                             written(place.node)));
  }
  if (sequence.path.empty()) place.reject("sequence: found no path, expected path = \"...\"");
  if (sequence.name.empty()) sequence.name = name_of(sequence.path);
  return sequence;
}

std::vector<SuiteSequence> read_sequences(const TomlPlace& place, const Lists& lists) {
  if (!place.node.is_array()) return {read_sequence(place, lists)};
  std::vector<SuiteSequence> sequences;
  for (const toml::node& node : read_list("sequence", place)) {
    const TomlPlace at{place.path, node};
    sequences.push_back(read_sequence(at, lists));
    const auto same = std::ranges::find(sequences, sequences.back().name, &SuiteSequence::name);
    if (same + 1 != sequences.end()) {
      at.reject(fmt::format("sequence: two are called '{}'; give one another name = \"...\"",
                            same->name));
    }
  }
  return sequences;
}

SuiteGroup read_suite_group(const TomlPlace& place, const Lists& lists) {
  SuiteGroup group;
  const std::vector<Key> keys = {
      {"name", [&](const TomlPlace& at) { group.name = read_word("name", at); }},
      {"matrix", [&](const TomlPlace& at) { group.axes = read_matrix(at, lists); }},
      {"sequences",
       [&](const TomlPlace& at) {
         for (const toml::node& node : read_list("sequences", at)) {
           group.sequences.push_back(read_word("sequences", {at.path, node}));
         }
       }},
  };
  read_settings(read_table("group", place), place.path, lists, keys, &group.settings);
  if (group.name.empty()) place.reject("group: found no name, expected name = \"...\"");
  return group;
}

std::vector<SuiteGroup> read_groups(const TomlPlace& place, const Lists& lists) {
  std::vector<SuiteGroup> groups;
  for (const toml::node& node : read_list("group", place)) {
    const TomlPlace at{place.path, node};
    groups.push_back(read_suite_group(at, lists));
    if (std::ranges::count(groups, groups.back().name, &SuiteGroup::name) > 1) {
      at.reject(fmt::format("group: two are called '{}'", groups.back().name));
    }
  }
  return groups;
}

/// Groups may come before the sequences that they name.
void require_known_sequences(const SuiteFile& file) {
  std::vector<std::string_view> known;
  for (const SuiteSequence& sequence : file.sequences) known.push_back(sequence.name);
  for (const SuiteGroup& group : file.groups) {
    for (const std::string& name : group.sequences) {
      if (std::ranges::find(known, name) != known.end()) continue;
      throw InputError(fmt::format("{}: group '{}': sequences: found '{}', expected some of {}{}",
                                   file.path, group.name, name, fmt::join(known, ", "),
                                   suggestion(name, known)));
    }
  }
}

}  // namespace

SuiteFile parse_suite(std::string_view text, const std::string& path, const Lists& lists) {
  SuiteFile file;
  file.path = path;
  const std::vector<Key> keys = {
      {"title", [&](const TomlPlace& at) { file.title = read_word("title", at); }},
      {"matrix", [&](const TomlPlace& at) { file.axes = read_matrix(at, lists); }},
      {"sequence", [&](const TomlPlace& at) { file.sequences = read_sequences(at, lists); }},
      {"group", [&](const TomlPlace& at) { file.groups = read_groups(at, lists); }},
  };
  read_settings(parse_toml(text, path), path, lists, keys, &file.settings);
  if (file.sequences.empty()) {
    throw InputError(path, "sequence", "none", "one at least: [[sequence]] with path = \"...\"");
  }
  if (file.groups.empty()) file.groups.emplace_back();
  require_known_sequences(file);
  return file;
}

SuiteFile read_suite_file(const std::string& path, const Lists& lists) {
  return parse_suite(read_file(path), path, lists);
}

}  // namespace slambench
