// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "config/toml_reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "config/nearest.h"
#include "config/settings.h"
#include "core/error.h"

namespace slambench {
namespace {

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

/// Whether the TOML type is the parameter's: text is no number, a number no text.
bool type_fits(const Parameter& parameter, const toml::node& node) {
  if (std::holds_alternative<bool*>(parameter.value)) return node.is_boolean();
  if (std::holds_alternative<std::string*>(parameter.value)) return node.is_string();
  const bool one_number = std::holds_alternative<int*>(parameter.value) ||
                          std::holds_alternative<double*>(parameter.value) ||
                          std::holds_alternative<std::optional<double>*>(parameter.value);
  return is_number(node) || (!one_number && node.is_array());
}

/// A NUL would end the text early where the system or a driver reads it.
void reject_nul(const toml::node& node, const std::string& path) {
  if (const auto* text = node.as_string(); text && text->get().find('\0') != std::string::npos) {
    TomlPlace{path, node}.reject("found text with a NUL character, expected text without");
  }
  if (const auto* array = node.as_array()) {
    for (const toml::node& element : *array) reject_nul(element, path);
  }
  if (const auto* table = node.as_table()) {
    for (const auto& [key, value] : *table) reject_nul(value, path);
  }
}

}  // namespace

void TomlPlace::reject(const std::string& message) const {
  throw InputError(fmt::format("{}:{}: {}", path, node.source().begin.line, message));
}

toml::table parse_toml(std::string_view text, const std::string& path) {
  try {
    toml::table table = toml::parse(text);
    reject_nul(table, path);
    return table;
  } catch (const toml::parse_error& error) {
    throw InputError(
        fmt::format("{}:{}: not TOML: {}", path, error.source().begin.line, error.description()));
  }
}

std::string written(const toml::node& node) {
  const auto text = value_text(node);
  if (node.is_string()) return fmt::format("'{}'", *text);
  if (node.is_array()) return text ? fmt::format("[{}]", *text) : "an array of other things";
  if (node.is_table()) return "a table";
  return text.value_or("a date or time");
}

ConfigAssignment read_assignment(const Parameter& parameter, const TomlPlace& place) {
  const auto text = value_text(place.node);
  try {
    if (!type_fits(parameter, place.node) || !text) throw UsageError("");
    canonical_text(parameter, *text);
  } catch (const UsageError&) {
    place.reject(fmt::format("{}: found {}, expected {}", parameter.name, written(place.node),
                             expectation(parameter)));
  }
  return {std::string(parameter.name), *text};
}

void read_group(const toml::table& table, const ParameterList& list, const std::string& path,
                std::vector<ConfigAssignment>* assignments) {
  std::vector<std::string_view> known;
  for (const Parameter& parameter : list.parameters) known.push_back(parameter.name);
  for (const auto& [key, node] : table) {
    const std::string_view name(key);
    const TomlPlace place{path, node};
    const auto it = std::find(known.begin(), known.end(), name);
    if (it == known.end()) {
      place.reject(
          fmt::format("unknown key '{}' in [{}]{}", name, list.group, suggestion(name, known)));
    }
    assignments->push_back(read_assignment(list.parameters[it - known.begin()], place));
  }
}

std::string read_word(std::string_view key, const TomlPlace& place) {
  const auto* text = place.node.as_string();
  if (text == nullptr) {
    place.reject(fmt::format("{}: found {}, expected text", key, written(place.node)));
  }
  return text->get();
}

}  // namespace slambench
