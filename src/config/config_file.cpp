// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "config/config_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

#include "config/nearest.h"
#include "core/error.h"
#include "io/files.h"

namespace slambench {
namespace {

/// Where in which file something stands, for messages.
struct Place {
  const std::string& path;
  const toml::node& node;

  [[noreturn]] void reject(const std::string& message) const {
    throw InputError(fmt::format("{}:{}: {}", path, node.source().begin.line, message));
  }
};

bool is_number(const toml::node& node) { return node.is_integer() || node.is_floating_point(); }

/// The value as command-line text; nothing when it has no such form.
std::optional<std::string> value_text(const toml::node& node) {
  if (const auto* value = node.as_boolean()) return value->get() ? "true" : "false";
  if (const auto* value = node.as_integer()) return fmt::format("{}", value->get());
  if (const auto* value = node.as_floating_point()) return fmt::format("{}", value->get());
  if (const auto* value = node.as_string()) return value->get();
  const auto* array = node.as_array();
  if (array == nullptr) return std::nullopt;
  std::string text;
  for (const toml::node& element : *array) {
    if (!is_number(element)) return std::nullopt;
    if (!text.empty()) text += ',';
    text += *value_text(element);
  }
  return text;
}

/// The value nearly as a user wrote it, for messages.
std::string written(const toml::node& node) {
  const auto text = value_text(node);
  if (node.is_string()) return fmt::format("'{}'", *text);
  if (node.is_array()) return text ? fmt::format("[{}]", *text) : "an array of other things";
  if (node.is_table()) return "a table";
  return text.value_or("a date or time");
}

/// Whether the TOML type is the parameter's: text is no number, a number no text.
bool type_fits(const Parameter& parameter, const toml::node& node) {
  if (std::holds_alternative<bool*>(parameter.value)) return node.is_boolean();
  if (std::holds_alternative<std::string*>(parameter.value)) return node.is_string();
  const bool one_number = std::holds_alternative<int*>(parameter.value) ||
                          std::holds_alternative<double*>(parameter.value) ||
                          std::holds_alternative<std::optional<double>*>(parameter.value);
  return is_number(node) || (!one_number && node.is_array());
}

/// Sets the parameter, which throws when the value does not fit, and puts it back.
void try_value(const Parameter& parameter, const std::string& text) {
  std::visit(
      [&](auto* value) {
        const auto before = *value;
        try {
          set_from_text(parameter, text);
        } catch (...) {
          *value = before;
          throw;
        }
        *value = before;
      },
      parameter.value);
}

ConfigAssignment read_assignment(const Parameter& parameter, const Place& place) {
  const auto text = value_text(place.node);
  try {
    if (!type_fits(parameter, place.node) || !text) throw UsageError("");
    try_value(parameter, *text);
  } catch (const UsageError&) {
    place.reject(fmt::format("{}: found {}, expected {}", parameter.name, written(place.node),
                             expectation(parameter)));
  }
  return {std::string(parameter.name), *text};
}

void read_group(const toml::table& table, const ParameterList& list, ConfigFile* file) {
  std::vector<std::string_view> known;
  for (const Parameter& parameter : list.parameters) known.push_back(parameter.name);
  for (const auto& [key, node] : table) {
    const std::string_view name(key);
    const Place place{file->path, node};
    const auto it = std::find(known.begin(), known.end(), name);
    if (it == known.end()) {
      place.reject(
          fmt::format("unknown key '{}' in [{}]{}", name, list.group, suggestion(name, known)));
    }
    file->assignments.push_back(read_assignment(list.parameters[it - known.begin()], place));
  }
}

std::string read_word(std::string_view key, const Place& place) {
  const auto* text = place.node.as_string();
  if (text == nullptr) {
    place.reject(fmt::format("{}: found {}, expected text", key, written(place.node)));
  }
  return text->get();
}

void read_top(const toml::table& top, const std::vector<ParameterList>& lists, ConfigFile* file) {
  std::vector<std::string_view> known = {"sequence", "preset"};
  for (const ParameterList& list : lists) known.push_back(list.group);
  for (const auto& [key, node] : top) {
    const std::string_view name(key);
    const Place place{file->path, node};
    const auto list = std::find_if(lists.begin(), lists.end(),
                                   [&](const ParameterList& l) { return l.group == name; });
    if (name == "sequence") {
      file->sequence = read_word(name, place);
    } else if (name == "preset") {
      file->preset = read_word(name, place);
    } else if (list == lists.end()) {
      const char* kind = node.is_table() ? "table" : "key";
      place.reject(fmt::format("unknown {} '{}'{}", kind, name, suggestion(name, known)));
    } else if (!node.is_table()) {
      place.reject(fmt::format("{}: found {}, expected a table", name, written(node)));
    } else {
      read_group(*node.as_table(), *list, file);
    }
  }
}

}  // namespace

ConfigFile parse_config(std::string_view text, const std::string& path,
                        const std::vector<ParameterList>& lists) {
  ConfigFile file;
  file.path = path;
  try {
    read_top(toml::parse(text), lists, &file);
  } catch (const toml::parse_error& error) {
    throw InputError(
        fmt::format("{}:{}: not TOML: {}", path, error.source().begin.line, error.description()));
  }
  return file;
}

ConfigFile read_config_file(const std::string& path, const std::vector<ParameterList>& lists) {
  return parse_config(read_file(path), path, lists);
}

}  // namespace slambench
