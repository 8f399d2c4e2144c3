// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "suite/suite_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "analysis/suite_index.h"
#include "config/settings.h"
#include "core/error.h"

namespace slambench {
namespace {

using Lists = std::vector<ParameterList>;

constexpr std::size_t most_combinations = 10'000;

/// Room is left for numbers that tell folders apart.
constexpr std::size_t longest_words = 120, longest_name = 160;

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == '.';
}

std::string folder_name(const std::string& words) {
  std::string name = words.substr(0, longest_words);
  for (char& c : name) c = is_plain(c) ? c : '-';
  if (name.starts_with('.')) name.front() = '-';  // hidden folders hold no results
  return name;
}

/// The suite's axes with those of the group in their places.
std::vector<SuiteAxis> axes_of(const SuiteFile& file, const SuiteGroup& group) {
  std::vector<SuiteAxis> axes = file.axes;
  for (const SuiteAxis& axis : group.axes) {
    const auto same = std::ranges::find(axes, axis.name, &SuiteAxis::name);
    same == axes.end() ? axes.push_back(axis) : void(*same = axis);
  }
  return axes;
}

std::string canonical(const std::string& name, const std::string& value, const Lists& lists) {
  return name == "preset" ? value : canonical_text(*find(lists, name), value);
}

/// The value that the settings give the axis; "" when none.
std::string selection(const SuiteAxis& axis, const SuiteSettings& settings, const Lists& lists) {
  if (axis.name == "preset") return settings.preset;
  const auto it = std::ranges::find(settings.assignments, axis.name, &ConfigAssignment::name);
  return it == settings.assignments.end() ? "" : canonical(axis.name, it->value, lists);
}

/// Words speak for themselves, numbers do not.
std::string value_label(const SuiteAxis& axis, const std::string& value, const Lists& lists) {
  const Parameter* parameter = find(lists, axis.name);
  const bool word = parameter == nullptr || !parameter->choices.empty();
  return word ? value : fmt::format("{}={}", axis.name, value);
}

/// Settings in which the last call wins.
class Layers {
 public:
  explicit Layers(const Lists& lists) : lists_(lists) {}

  void add(const SuiteSettings& settings) {
    if (!settings.preset.empty()) preset_ = settings.preset;
    for (const ConfigAssignment& a : settings.assignments) add(a.name, a.value);
  }
  void add(const std::string& name, const std::string& value) {
    if (name == "preset") {
      preset_ = value;
    } else {
      values_[name] = canonical(name, value, lists_);
    }
  }

  void write_to(Configuration* configuration) const {
    configuration->preset = preset_;
    for (const ParameterList& list : lists_) {
      for (const Parameter& parameter : list.parameters) {
        const auto it = values_.find(std::string(parameter.name));
        if (it == values_.end()) continue;
        if (parameter.name == "repeat") {
          configuration->repeat = std::stoi(it->second);
        } else if (parameter.name == "warmup") {
          configuration->warmup = std::stoi(it->second);
        } else {
          configuration->assignments.push_back({it->first, it->second});
        }
      }
    }
  }

 private:
  const Lists& lists_;
  std::string preset_;
  std::map<std::string, std::string> values_;
};

/// The place of one combination on each axis; false after the last one.
bool advance(std::vector<std::size_t>* place, const std::vector<SuiteAxis>& axes) {
  for (std::size_t i = axes.size(); i-- > 0;) {
    if (++(*place)[i] < axes[i].values.size()) return true;
    (*place)[i] = 0;
  }
  return false;
}

void require_few(const SuiteFile& file, const std::vector<SuiteAxis>& axes, std::size_t before) {
  std::size_t count = 1;
  for (const SuiteAxis& axis : axes) {
    count *= axis.values.size();
    if (before + count <= most_combinations) continue;
    throw InputError(fmt::format("{}: matrix: found {} combinations or more, expected at most {}",
                                 file.path, before + count, most_combinations));
  }
}

void add_combinations(const SuiteFile& file, const SuiteSequence& sequence, const SuiteGroup& group,
                      const SuiteSettings& overrides, const Lists& lists,
                      std::set<std::string>* folders, std::vector<Configuration>* all) {
  const std::vector<SuiteAxis> axes = axes_of(file, group);
  require_few(file, axes, all->size());
  std::vector<std::size_t> place(axes.size(), 0);
  do {
    Layers layers(lists);
    layers.add(file.settings);
    layers.add(sequence.settings);
    layers.add(group.settings);
    layers.add(overrides);
    Configuration configuration;
    std::string variant = group.name;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const std::string& value = axes[i].values[place[i]];
      layers.add(axes[i].name, value);
      const std::string chosen = selection(axes[i], overrides, lists);
      if (!chosen.empty() && chosen != canonical(axes[i].name, value, lists)) {
        configuration.selected = false;
      }
      if (axes[i].values.size() < 2) continue;
      variant +=
          fmt::format("{}{}", variant.empty() ? "" : " ", value_label(axes[i], value, lists));
    }
    configuration.sequence_name = sequence.name;
    configuration.variant = variant.empty() ? "all settings" : variant;
    configuration.sequence = sequence.path;
    configuration.available = sequence.available;
    layers.write_to(&configuration);
    const std::string words = variant.empty() ? sequence.name : sequence.name + " " + variant;
    configuration.folder = unused_folder_name(folder_name(words), folders);
    all->push_back(std::move(configuration));
  } while (advance(&place, axes));
}

void require_different(const SuiteFile& file, const std::vector<Configuration>& all) {
  std::map<std::vector<std::string>, std::string> folders;  // by all that is computed
  for (const Configuration& configuration : all) {
    auto all_of_it = run_arguments(configuration);
    if (configuration.sequence.empty()) all_of_it.push_back(configuration.sequence_name);
    const auto [other, is_new] = folders.emplace(std::move(all_of_it), configuration.folder);
    if (is_new) continue;
    throw InputError(
        fmt::format("{}: {} and {} are the same runs: found equal settings, expected groups and "
                    "sequences that differ",
                    file.path, other->second, configuration.folder));
  }
}

/// "${A}/b" with the value of A; the name that is not set in `missing`.
std::string with_environment(
    const std::string& path,
    const std::function<std::optional<std::string>(const std::string&)>& environment,
    std::string* missing) {
  std::string text;
  for (std::size_t at = 0;;) {
    const std::size_t begin = path.find("${", at);
    const std::size_t end = begin == std::string::npos ? begin : path.find('}', begin);
    text += path.substr(at, end == std::string::npos ? end : begin - at);
    if (end == std::string::npos) return text;
    const std::string name = path.substr(begin + 2, end - begin - 2);
    const auto value = environment(name);
    if (value && !value->empty()) text += *value;
    if (!value || value->empty()) *missing = name;
    at = end + 1;
  }
}

}  // namespace

bool is_folder_name(const std::string& name) {
  return !name.empty() && name.size() <= longest_name && !name.starts_with('.') &&
         name != suite_index_name && std::ranges::all_of(name, is_plain);
}

std::string unused_folder_name(const std::string& name, std::set<std::string>* used) {
  std::string candidate = name;
  for (int i = 2; !is_folder_name(candidate) || !used->insert(candidate).second; ++i) {
    candidate = fmt::format("{}-{}", name, i);
  }
  return candidate;
}

std::optional<std::string> Configuration::value(std::string_view parameter) const {
  const auto it = std::ranges::find(assignments, parameter, &ConfigAssignment::name);
  return it == assignments.end() ? std::nullopt : std::optional(it->value);
}

bool Configuration::computes_the_same_as(const Configuration& other) const {
  const bool known = !sequence.empty() && !other.sequence.empty();
  return (known ? sequence == other.sequence : sequence_name == other.sequence_name) &&
         preset == other.preset &&
         std::ranges::equal(assignments, other.assignments, [](const auto& a, const auto& b) {
           return a.name == b.name && a.value == b.value;
         });
}

std::vector<std::string> resolve_sequences(
    SuiteFile* file,
    const std::function<std::optional<std::string>(const std::string&)>& environment,
    const std::function<bool(const std::string& path)>& is_there) {
  std::vector<std::string> left_out;
  for (SuiteSequence& sequence : file->sequences) {
    std::string missing;
    const std::string written = sequence.path;
    sequence.path = with_environment(written, environment, &missing);
    if (!missing.empty() && !sequence.optional) {
      throw InputError(fmt::format("{}:{}: path: found '{}', expected the environment to have {}",
                                   file->path, sequence.line, written, missing));
    }
    if (!sequence.optional || (missing.empty() && is_there(sequence.path))) continue;
    sequence.available = false;
    left_out.push_back(
        fmt::format("sequence {}: {}", sequence.name,
                    missing.empty() ? sequence.path + " is not there" : missing + " is not set"));
    if (!missing.empty()) sequence.path.clear();
  }
  return left_out;
}

std::vector<Configuration> configurations(const SuiteFile& file, const SuiteSettings& overrides,
                                          const Lists& lists) {
  std::vector<Configuration> all;
  std::set<std::string> folders;
  for (const SuiteSequence& sequence : file.sequences) {
    for (const SuiteGroup& group : file.groups) {
      const bool wanted =
          group.sequences.empty() ||
          std::ranges::find(group.sequences, sequence.name) != group.sequences.end();
      if (wanted) add_combinations(file, sequence, group, overrides, lists, &folders, &all);
    }
  }
  require_different(file, all);
  return all;
}

std::vector<std::string> lists_without_selection(const SuiteFile& file,
                                                 const SuiteSettings& overrides,
                                                 const Lists& lists) {
  std::vector<std::string> sentences;
  for (const SuiteGroup& group : file.groups) {
    for (const SuiteAxis& axis : axes_of(file, group)) {
      const std::string chosen = selection(axis, overrides, lists);
      const bool lacks = std::ranges::none_of(axis.values, [&](const std::string& value) {
        return canonical(axis.name, value, lists) == chosen;
      });
      if (chosen.empty() || !lacks) continue;
      sentences.push_back(fmt::format("{}: {}: found {}, expected one of {}",
                                      group.name.empty() ? "matrix" : "group " + group.name,
                                      axis.name, chosen, fmt::join(axis.values, ", ")));
    }
  }
  return sentences;
}

std::vector<std::string> run_arguments(const Configuration& configuration) {
  const bool looks_like_option = configuration.sequence.starts_with('-');
  std::vector<std::string> words = {
      "run", fmt::format("{}{}", looks_like_option ? "--input-file=" : "", configuration.sequence)};
  if (!configuration.preset.empty()) words.push_back("--preset=" + configuration.preset);
  for (const ConfigAssignment& assignment : configuration.assignments) {
    if (assignment.value.empty()) {  // after a '=' the command line takes nothing for no value
      words.insert(words.end(), {"--" + assignment.name, ""});
    } else {
      words.push_back(fmt::format("--{}={}", assignment.name, assignment.value));
    }
  }
  return words;
}

std::optional<std::pair<Configuration, Configuration>> comparable_pair(
    const std::vector<Configuration>& configurations, const Lists& lists) {
  const auto same_task = [&](const Configuration& a, const Configuration& b) {
    if (a.sequence_name != b.sequence_name || a.preset != b.preset) return false;
    return std::ranges::all_of(lists, [&](const ParameterList& list) {
      return std::ranges::all_of(list.parameters, [&](const Parameter& p) {
        return p.role != ParameterRole::task || a.value(p.name) == b.value(p.name);
      });
    });
  };
  for (auto base = configurations.begin(); base != configurations.end(); ++base) {
    for (auto other = configurations.end(); --other != base;) {
      if (same_task(*base, *other)) return std::pair(*base, *other);
    }
  }
  return std::nullopt;
}

std::vector<std::string> input_of(const Configuration& configuration, const Lists& lists) {
  std::vector<std::string> words = {configuration.sequence, configuration.preset};
  for (const ParameterList& list : lists) {
    if (list.group != "source" && list.group != "run") continue;
    for (const auto& [name, value] : configuration.assignments) {
      if (find({list}, name) != nullptr) words.insert(words.end(), {name, value});
    }
  }
  return words;
}

std::vector<PlannedRun> runs_in_turns(const std::vector<Configuration>& configurations,
                                      const std::function<bool(const PlannedRun&)>& is_done) {
  int most_runs = 0, most_warmups = 0;
  for (const Configuration& c : configurations) {
    most_runs = std::max(most_runs, c.repeat);
    most_warmups = std::max(most_warmups, c.warmup);
  }
  std::vector<PlannedRun> runs;
  std::set<std::size_t> unfinished;
  for (int repetition = 1; repetition <= most_runs; ++repetition) {
    for (std::size_t i = 0; i < configurations.size(); ++i) {
      const PlannedRun run{i, repetition};
      if (!configurations[i].runs_today()) continue;
      if (repetition > configurations[i].repeat || is_done(run)) continue;
      runs.push_back(run);
      unfinished.insert(i);
    }
  }
  std::vector<PlannedRun> warmups;
  for (int turn = 0; turn < most_warmups; ++turn) {
    for (const std::size_t i : unfinished) {
      if (turn < configurations[i].warmup) warmups.push_back({i, 0});
    }
  }
  runs.insert(runs.begin(), warmups.begin(), warmups.end());
  return runs;
}

}  // namespace slambench
