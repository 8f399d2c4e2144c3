// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "report/report_entries.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "analysis/figure.h"
#include "analysis/result_folders.h"
#include "analysis/suite_index.h"
#include "core/error.h"
#include "results/repetition.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Figures = std::map<std::string, Figure>;

constexpr const char* time_place = "time.computation_s.mean";

/// Runs that repeat each other, in the order in which they were given.
using Group = std::vector<ReportRun>;

std::vector<Group> groups_of(std::vector<ReportRun> runs, const ParameterRoles& roles,
                             bool repeats_together) {
  std::vector<Group> groups;
  for (ReportRun& run : runs) {
    const auto same = [&](const Group& group) {
      const StoredRun& first = group.front().stored;
      const auto counts = [](const StoredRun& one) { return one.valid() && one.complete(); };
      return repeats_together && counts(first) && counts(run.stored) &&
             group.front().variant == run.variant && differences(first, run.stored, roles).empty();
    };
    auto it = std::find_if(groups.begin(), groups.end(), same);
    if (it == groups.end()) it = groups.insert(groups.end(), Group());
    it->push_back(std::move(run));
  }
  return groups;
}

/// Figures that a report shows beside those with a name: how their places begin and end.
struct UnnamedFigures {
  std::string_view head, tail;
  const char* unit;
};
constexpr std::array<UnnamedFigures, 11> unnamed_figures{{
    {"energy.", ".joules", "J"},
    {"energy.", ".joules_per_frame", "J"},
    {"energy.", ".mean_w", "W"},
    {"energy.", ".peak_w", "W"},
    {"energy.", ".idle_w", "W"},
    {"energy.", ".energy_delay_js", "J s"},
    {"energy.", ".joules_above_idle", "J"},
    {"counters.stages.", "", ""},
    {"time.transfers.", ".seconds_per_frame", "s"},
    {"time.computation_s", ".p95", "s"},
    {"accuracy.slambench1_ate_m", ".max", "m"},
}};

/// The places of figures of which a report shows the median of repeated runs, with their units.
std::map<std::string, std::string> shown_places(const StoredRun& run) {
  std::map<std::string, std::string> places;
  for (const NamedFigure& figure : figure_table()) places[figure.place] = figure.unit;
  for (const auto& [place, value] : run.numbers) {
    for (const auto& [head, tail, unit] : unnamed_figures) {
      if (place.starts_with(head) && place.ends_with(tail)) places.emplace(place, unit);
    }
  }
  return places;
}

/// The figures of every run, repeats within its record included.
std::vector<Figures> figures_of(const Group& group) {
  std::vector<Figures> all;
  const auto places = shown_places(group.front().stored);
  for (const ReportRun& run : group) {
    const std::size_t repeats = run.stored.run_count(), first = all.size();
    all.resize(first + repeats);
    for (const auto& [place, unit] : places) {
      const std::vector<double> values = values_of(place, run.stored);
      for (std::size_t i = 0; i < repeats && values.size() == repeats; ++i) {
        all[first + i][place] = {unit, values[i], {}};
      }
    }
  }
  return all;
}

/// As the record of repeated runs has it.
Json repetition_json(const Group& group) {
  const Repetition repetition = repetition_of(figures_of(group));
  Json figures = Json::object();
  for (const auto& [place, figure] : repetition.figures) {
    Json& json = figures[place];
    json = {{"unit", figure.unit}, {"values", figure.values}, {"median", figure.median}};
    if (figure.low) json["low"] = *figure.low;
    if (figure.high) json["high"] = *figure.high;
    if (figure.run_spread) json["run_spread"] = *figure.run_spread;
  }
  return {{"runs", repetition.runs}, {"figures", figures}};
}

/// The number at a place ("energy.rails.A15.joules"); nullptr when there is none. Names may hold
/// dots themselves.
Json* number_at(Json* json, std::string_view place) {
  if (!json->is_object()) return nullptr;
  for (auto it = json->begin(); it != json->end(); ++it) {
    if (!place.starts_with(it.key())) continue;
    const std::string_view rest = place.substr(it.key().size());
    if (rest.empty()) return it->is_number() ? &*it : nullptr;
    if (!rest.starts_with('.')) continue;
    if (Json* found = number_at(&*it, rest.substr(1))) return found;
  }
  return nullptr;
}

/// Of repeated runs: the medians over all of them in place of the figures of one.
void put_medians(Json* record) {
  const Json repetition = record->value("repetition", Json::object());
  if (!repetition.is_object()) return;
  const Json figures = repetition.value("figures", Json::object());
  for (const auto& [place, figure] : figures.items()) {
    if (!figure.is_object() || !figure.contains("median")) continue;
    if (Json* shown = number_at(record, place)) *shown = figure.at("median");
  }
}

/// The one in the middle, which stands for all.
ReportRun middle_of(Group group) {
  if (group.size() == 1) return std::move(group.front());
  std::vector<Figures> times;
  for (const ReportRun& run : group) {
    const auto time_s = value_of(time_place, run.stored);
    times.push_back(time_s ? Figures{{time_place, {"s", *time_s, {}}}} : Figures());
  }
  ReportRun& middle = group[median_run(times, time_place)];
  middle.record["repetition"] = repetition_json(group);
  return std::move(middle);
}

ReportRun entry_of(Group group) {
  ReportRun entry = middle_of(std::move(group));
  put_medians(&entry.record);
  return entry;
}

/// The folder that a run's folder lies in.
fs::path parent_of(const ReportRun& run) {
  const fs::path whole = fs::absolute(fs::path(run.folder) / "").lexically_normal();
  return whole.parent_path().parent_path();  // the first is without the slash at the end
}

/// Where runs of several folders lie: the folder of them all when it holds no other run.
std::vector<std::string> folders_of(const std::vector<Group>& groups) {
  std::map<fs::path, std::set<std::size_t>> users;  // of a parent folder
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (const ReportRun& run : groups[i]) users[parent_of(run)].insert(i);
  }
  std::vector<std::string> folders;
  for (const Group& group : groups) {
    const fs::path of_first = parent_of(group.front());
    const bool together = std::all_of(group.begin(), group.end(), [&](const ReportRun& run) {
      return parent_of(run) == of_first;
    });
    const bool whole = group.size() > 1 && together && users.at(of_first).size() == 1;
    folders.push_back(whole ? of_first.string() : group.front().folder);
  }
  return folders;
}

/// What a suite says of a run.
struct SuiteEntry {
  const SuiteIndex* suite;
  std::size_t order;  ///< of the configuration
};

/// The suites that runs are of; each is read once.
class Suites {
 public:
  /// Nothing for a run that no suite made, or of which it does not say what it is.
  std::optional<SuiteEntry> entry_of(const ReportRun& run) {
    const fs::path configuration = parent_of(run);
    const auto& index = index_in(configuration.parent_path());
    if (!index) return std::nullopt;
    const auto& all = index->configurations;
    const auto it = std::find_if(all.begin(), all.end(), [&](const auto& c) {
      return c.folder == configuration.filename();
    });
    if (it == all.end() || it->sequence.empty() || it->variant.empty()) return std::nullopt;
    return SuiteEntry{&*index, static_cast<std::size_t>(it - all.begin())};
  }

 private:
  const std::optional<SuiteIndex>& index_in(const fs::path& folder) {
    const auto [it, is_new] = indexes_.try_emplace(folder);
    const fs::path file = folder / suite_index_name;
    std::error_code error;
    if (!is_new || !fs::is_regular_file(file, error)) return it->second;
    try {
      it->second = read_suite_index(file);
    } catch (const InputError&) {  // the runs can be told apart without it
    }
    return it->second;
  }

  std::map<fs::path, std::optional<SuiteIndex>> indexes_;
};

/// What `key` of a difference is in a run: the value of a parameter, or of the build.
std::string value_of_key(const StoredRun& run, const std::string& key) {
  for (const std::string& name : run.parameters()) {
    if (name.ends_with("." + key)) return run.parameter(name).value_or("");
  }
  return run.text(fmt::format("provenance.{}", key));
}

/// Keys of what differs between runs of one sequence, beside the backend and what follows from it.
std::vector<std::string> varied_keys(const std::vector<ReportRun>& runs,
                                     const ParameterRoles& roles) {
  const std::set<std::string> said = {"backend", "preset", "version", "driver", "device"};
  constexpr std::size_t most = 4;
  std::vector<std::string> keys;
  for (const ReportRun& run : runs) {
    const auto first = std::find_if(runs.begin(), runs.end(), [&](const ReportRun& other) {
      return other.sequence == run.sequence;
    });
    for (const RunDifference& d : differences(first->stored, run.stored, roles)) {
      const bool known = std::find(keys.begin(), keys.end(), d.key) != keys.end();
      if (known || said.contains(d.key) || d.key.starts_with("sequence.")) continue;
      if (keys.size() < most) keys.push_back(d.key);
    }
  }
  return keys;
}

void name_variants(std::vector<ReportRun>* runs, const ParameterRoles& roles) {
  const std::vector<std::string> keys = varied_keys(*runs, roles);
  for (ReportRun& run : *runs) {
    for (const std::string& key : keys) {
      const std::string value = value_of_key(run.stored, key);
      const std::size_t most = key == "commit" ? 8 : 24;
      if (!value.empty()) run.variant += fmt::format(", {} {}", key, value.substr(0, most));
    }
  }
}

/// No two runs of a sequence have the same variant afterwards, unless they have the same name.
void make_variants_unique(std::vector<ReportRun>* runs) {
  std::map<std::pair<std::string, std::string>, int> count;
  for (const ReportRun& run : *runs) ++count[{run.sequence, run.variant}];
  for (ReportRun& run : *runs) {
    const bool unique = count.at({run.sequence, run.variant}) == 1;
    if (!unique) run.variant += fmt::format(" ({})", run.name);
  }
}

/// As the suite of all runs names and orders them; false when there is none.
bool follow_suite(ReportEntries* entries) {
  Suites suites;
  std::vector<SuiteEntry> said;
  for (const ReportRun& run : entries->runs) {
    const auto entry = suites.entry_of(run);
    if (!entry) return false;
    said.push_back(*entry);
  }
  std::vector<std::pair<std::size_t, ReportRun>> ordered;
  entries->title = said.front().suite->title;
  for (std::size_t i = 0; i < said.size(); ++i) {
    const auto& [suite, order] = said[i];
    ReportRun& run = entries->runs[i];
    run.sequence = suite->configurations[order].sequence;
    run.variant = suite->configurations[order].variant;
    run.name = fmt::format("{}, {}", run.sequence, run.variant);
    if (suite->title != entries->title) entries->title.clear();
    ordered.emplace_back(order, std::move(run));
  }
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    entries->runs[i] = std::move(ordered[i].second);
  }
  return true;
}

}  // namespace

ReportEntries report_entries(std::vector<ReportRun> runs, const ParameterRoles& roles,
                             bool repeats_together) {
  std::vector<Group> groups = groups_of(std::move(runs), roles, repeats_together);
  const std::vector<std::string> names = short_names(folders_of(groups));
  ReportEntries entries;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    entries.runs.push_back(entry_of(std::move(groups[i])));
    entries.runs.back().name = names[i];
  }
  if (!entries.runs.empty() && !follow_suite(&entries)) name_variants(&entries.runs, roles);
  make_variants_unique(&entries.runs);
  return entries;
}

}  // namespace slambench
