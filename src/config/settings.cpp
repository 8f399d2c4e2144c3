// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "config/settings.h"

#include <fmt/format.h>

#include "config/nearest.h"
#include "core/error.h"

namespace slambench {

std::string canonical_text(const Parameter& parameter, std::string_view text) {
  return std::visit(
      [&](auto* value) {
        const auto before = *value;
        try {
          set_from_text(parameter, text);
          std::string canonical = to_text(parameter);
          *value = before;
          return canonical;
        } catch (...) {
          *value = before;
          throw;
        }
      },
      parameter.value);
}

Settings::Settings(std::vector<ParameterList> lists) : lists_(std::move(lists)) {
  std::size_t count = 0;
  for (const ParameterList& list : lists_) count += list.parameters.size();
  setters_.resize(count);
}

std::pair<const Parameter*, std::size_t> Settings::locate(std::string_view name) const {
  std::size_t place = 0;
  std::vector<std::string_view> known;
  for (const ParameterList& list : lists_) {
    for (const Parameter& parameter : list.parameters) {
      if (parameter.name == name) return {&parameter, place};
      known.push_back(parameter.name);
      ++place;
    }
  }
  throw UsageError(fmt::format("unknown parameter '{}'{}", name, suggestion(name, known)));
}

void Settings::set(std::string_view name, std::string_view text, Origin origin,
                   std::string set_by) {
  const auto [parameter, place] = locate(name);
  if (origin < setters_[place].origin) return;
  set_from_text(*parameter, text);
  setters_[place] = {origin, std::move(set_by)};
}

void Settings::apply(const Preset& preset) {
  for (const auto& [name, value] : preset.assignments) {
    set(name, value, Origin::preset, fmt::format("preset {}", preset.name));
  }
}

void Settings::apply(const ConfigFile& file) {
  for (const ConfigAssignment& assignment : file.assignments) {
    set(assignment.name, assignment.value, Origin::file, fmt::format("file {}", file.path));
  }
}

void Settings::suggest(const std::vector<std::pair<std::string, std::string>>& assignments) {
  for (const auto& [name, value] : assignments) set(name, value, Origin::reader, "sequence");
}

const std::string& Settings::set_by(std::string_view name) const {
  return setters_[locate(name).second].name;
}

std::vector<UsedParameter> Settings::used() const {
  std::vector<UsedParameter> all;
  for (const ParameterList& list : lists_) {
    for (const Parameter& parameter : list.parameters) {
      all.push_back({std::string(list.group), std::string(parameter.name),
                     std::string(parameter.unit), to_text(parameter), setters_[all.size()].name});
    }
  }
  return all;
}

}  // namespace slambench
