// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "parameter_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

#include "config/presets.h"
#include "datasets/source.h"

namespace slambench {
namespace {

struct Placeholder {
  const char* operator()(const bool*) const { return ""; }
  const char* operator()(const int*) const { return "N"; }
  const char* operator()(const double*) const { return "X"; }
  const char* operator()(const std::optional<double>*) const { return "X"; }
  const char* operator()(const std::string*) const { return "TEXT"; }
  const char* operator()(const std::array<int, 3>*) const { return "N[,N,N]"; }
  const char* operator()(const std::array<double, 3>*) const { return "X[,Y,Z]"; }
  const char* operator()(const std::vector<int>*) const { return "N,N,..."; }
  const char* operator()(const std::optional<std::array<double, 4>>*) const { return "A,B,C,D"; }
};

std::string placeholder(const Parameter& parameter) {
  if (!parameter.parts.empty()) return std::string(parameter.parts);
  return std::visit(Placeholder{}, parameter.value);
}

bool is_switch(const Parameter& parameter) {
  return std::holds_alternative<bool*>(parameter.value);
}

std::string option_names(const Parameter& parameter) {
  return parameter.flag == 0 ? fmt::format("--{}", parameter.name)
                             : fmt::format("-{},--{}", parameter.flag, parameter.name);
}

}  // namespace

std::string range_words(const Parameter& parameter) {
  if (is_switch(parameter)) return "";
  if (std::holds_alternative<std::string*>(parameter.value)) {
    return fmt::format("{}", fmt::join(parameter.choices, ", "));
  }
  return fmt::format("{} to {}", parameter.min, parameter.max);
}

std::string default_exception(const Parameter& parameter) {
  if (std::ranges::find(suggested_parameters, parameter.name) != std::end(suggested_parameters)) {
    return "unless the sequence has its own";
  }
  std::vector<std::string_view> presets;
  for (const Preset& preset : preset_table()) {
    const bool sets = std::ranges::any_of(preset.assignments,
                                          [&](const auto& a) { return a.first == parameter.name; });
    if (sets) presets.push_back(preset.name);
  }
  return presets.empty() ? "" : fmt::format("unless preset {} sets it", fmt::join(presets, " or "));
}

namespace {

/// What the preset that holds unless told otherwise makes of the parameter; nothing when it leaves
/// it alone.
std::optional<std::string> by_default_preset(const Parameter& parameter) {
  for (const auto& [name, value] : find_preset(default_preset).assignments) {
    if (name == parameter.name) return value;
  }
  return std::nullopt;
}

std::string default_words(const Parameter& parameter) {
  if (const auto value = by_default_preset(parameter)) {
    return fmt::format("default {}, by preset {}", *value, default_preset);
  }
  const std::string value = to_text(parameter);
  if (value.empty() || is_switch(parameter)) return "";
  const bool suggested =
      std::ranges::find(suggested_parameters, parameter.name) != std::end(suggested_parameters);
  return fmt::format("default {}{}", value,
                     suggested ? " " + default_exception(parameter) : std::string());
}

/// The sentence with the facts of the parameter.
std::string with_facts(std::string_view sentence, const Parameter& parameter) {
  std::string facts(parameter.unit);
  const auto add = [&facts](const std::string& fact) {
    if (!facts.empty() && !fact.empty()) facts += ", ";
    facts += fact;
  };
  add(range_words(parameter));
  add(default_words(parameter));
  return facts.empty() ? std::string(sentence) : fmt::format("{} ({})", sentence, facts);
}

/// What the names of the family's members in the list have in place of its word in capitals:
/// "KERNEL: mm2meters, raycast".
std::string members_of(const ParameterFamily& family, const ParameterList& list) {
  constexpr std::string_view capitals = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";
  const std::size_t begin = family.name.find_first_of(capitals);
  const std::size_t end = family.name.find_last_of(capitals) + 1;
  std::vector<std::string_view> words;
  for (const Parameter& parameter : list.parameters) {
    if (parameter.family != &family) continue;
    const std::size_t length = parameter.name.size() - family.name.size() + end - begin;
    words.push_back(parameter.name.substr(begin, length));
  }
  return fmt::format("{}: {}", family.name.substr(begin, end - begin), fmt::join(words, ", "));
}

}  // namespace

std::string help_sentence(const Parameter& parameter) {
  return with_facts(parameter.sentence, parameter);
}

void ParameterOptions::add(CLI::App& command, const std::vector<ParameterList>& lists) {
  for (const ParameterList& list : lists) {
    std::set<const ParameterFamily*> families;
    std::set<std::string> members;
    for (const Parameter& parameter : list.parameters) {
      CLI::Option* option = is_switch(parameter) ? command.add_flag(option_names(parameter))
                                                 : command.add_option(option_names(parameter));
      if (!is_switch(parameter)) option->expected(1);
      option->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
      option->type_name(placeholder(parameter));
      option->description(help_sentence(parameter));
      option->group(fmt::format("Parameters, table [{}] of a configuration file", list.group));
      options_.emplace_back(parameter.name, option);
      if (const ParameterFamily* family = parameter.family) {
        if (!families.insert(family).second) {
          option->description("");
          continue;
        }
        const std::string own = members_of(*family, list);
        option->option_text(fmt::format("--{} {}", family->name, placeholder(parameter)));
        option->description(with_facts(family->sentence, parameter) +
                            (members.insert(own).second ? ". " + own : ""));
      }
    }
  }
}

void ParameterOptions::apply(Settings& settings) const {
  for (const auto& [name, value] : given()) {
    settings.set(name, value, Origin::command_line, "command line");
  }
}

std::vector<ConfigAssignment> ParameterOptions::given() const {
  std::vector<ConfigAssignment> assignments;
  for (const auto& [name, option] : options_) {
    if (option->count() > 0) assignments.push_back({name, option->results().back()});
  }
  return assignments;
}

}  // namespace slambench
