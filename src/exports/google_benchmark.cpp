// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// The form of https://github.com/google/benchmark/blob/main/docs/tools.md: its tools need name,
// real_time, cpu_time, time_unit, run_type and repetition_index of each entry.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/figure.h"
#include "core/error.h"
#include "core/shell_text.h"
#include "exports/exports.h"

namespace slambench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* no_cpu_time =
    "not measured by slambench: a copy of real_time, because compare.py wants one";

/// Repeated runs under the name that their entries begin with.
struct Configuration {
  std::string name;
  std::vector<const ExportRun*> runs;
};

/// A command for a shell that exports a run with its repeats: with those that were given of its
/// parent folder, when they are all alike; otherwise alone.
std::string command_for(const ExportRun& each, const std::vector<ExportRun>& runs,
                        const ParameterRoles& roles) {
  const auto folder = [](const ExportRun& run) {
    return std::filesystem::path(run.run.path).parent_path();
  };
  std::vector<std::string> together;
  bool alike = true;
  for (const ExportRun& other : runs) {
    if (folder(other).parent_path() != folder(each).parent_path()) continue;
    together.push_back(folder(other).string());
    alike = alike && differences(each.run, other.run, roles).empty();
  }
  std::vector<std::string> words = {"slambench", "export"};
  if (!alike) together = {folder(each).string()};
  words.insert(words.end(), together.begin(), together.end());
  std::string file = each.name;  // no two runs have the same
  std::replace(file.begin(), file.end(), '/', '-');
  for (const char* word : {"--format", "google-benchmark", "-o"}) words.emplace_back(word);
  words.push_back(file + ".json");
  return shell_text(words);
}

/// "living-room/2", with the backend where runs of several are there: two files of one backend each
/// have the same names then, and can be compared.
std::string prefix(const StoredRun& run, bool with_backend) {
  const std::string sequence = run.text("sequence.name");
  return with_backend ? fmt::format("{}/{}", sequence, run.text("provenance.backend")) : sequence;
}

std::vector<Configuration> configurations(const std::vector<ExportRun>& runs,
                                          const ParameterRoles& roles) {
  std::set<std::string> backends;
  for (const ExportRun& each : runs) backends.insert(each.run.text("provenance.backend"));
  std::vector<Configuration> all;
  for (const ExportRun& each : runs) {
    require_counts(each.run);
    const std::string name = prefix(each.run, backends.size() > 1);
    auto it = std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.name == name; });
    if (it == all.end()) it = all.insert(all.end(), {name, {}});
    it->runs.push_back(&each);
    const ExportRun& first = *it->runs.front();
    const auto differ = differences(first.run, each.run, roles);
    if (differ.empty()) continue;
    throw InputError(fmt::format(
        "{} and {} would have the same names in one file and are no repeats of one another: they "
        "differ in {}; export them to files of their own: {} && {}",
        first.run.path, each.run.path, list_text(differ), command_for(first, runs, roles),
        command_for(each, runs, roles)));
  }
  return all;
}

/// "kernel/raycast" of kernel_raycast_s.
std::string entry_name(const NamedFigure& figure) {
  std::string name = figure.name.substr(0, figure.name.size() - 2);
  for (const std::string_view head : {"stage_", "kernel_"}) {
    if (name.starts_with(head)) name[head.size() - 1] = '/';
  }
  return name;
}

/// A run's figures that are no times, as counters of an entry of its `repeat`. Those that are not
/// known of every repeat are left out.
void add_counters(const StoredRun& run, std::size_t repeat, Json* entry) {
  for (const NamedFigure& figure : figure_table()) {
    if (figure.unit == "s") continue;
    const std::vector<double> values = values_of(figure.place, run);
    if (values.size() != run.run_count()) continue;
    (*entry)[figure.name == "fps" ? "items_per_second" : figure.name] = values[repeat];
  }
}

Json entry_of(const std::string& name, const StoredRun& run, double seconds) {
  const auto number = [&](const char* place) {
    return static_cast<long>(value_of(place, run).value_or(0));
  };
  Json entry = {{"name", name}, {"run_name", name}, {"run_type", "iteration"}};
  if (const long threads = number("provenance.threads"); threads > 0) entry["threads"] = threads;
  entry["iterations"] = number("time.measured_frames");
  entry["real_time"] = seconds * 1e3;
  entry["cpu_time"] = seconds * 1e3;
  entry["time_unit"] = "ms";
  entry["label"] =
      fmt::format("{} on {}", run.text("provenance.backend"), run.text("provenance.device"));
  return entry;
}

/// One entry a repetition; none where no run has the figure.
void add_entries(const Configuration& of, const NamedFigure& figure, std::size_t family,
                 Json* benchmarks) {
  std::vector<Json> entries;
  for (const ExportRun* each : of.runs) {
    const StoredRun& run = each->run;
    const std::vector<double> values = values_of(figure.place, run);
    for (std::size_t i = 0; i < values.size(); ++i) {
      Json entry = entry_of(fmt::format("{}/{}", of.name, entry_name(figure)), run, values[i]);
      if (figure.name == "computation_s" && values.size() == run.run_count()) {
        add_counters(run, i, &entry);
      }
      entries.push_back(std::move(entry));
    }
  }
  for (std::size_t i = 0; i < entries.size(); ++i) {
    entries[i]["family_index"] = family;
    entries[i]["per_family_instance_index"] = 0;
    entries[i]["repetitions"] = entries.size();
    entries[i]["repetition_index"] = i;
    benchmarks->push_back(std::move(entries[i]));
  }
}

/// Of the first run; the host's name is not in a record.
Json context(const StoredRun& run) {
  Json json = {{"date", run.text("provenance.started_at")},
               {"executable", "slambench"},
               {"caches", Json::array()},
               {"cpu_time", no_cpu_time}};
  const auto put = [&](const char* key, const char* place, double factor) {
    if (const auto value = value_of(place, run)) json[key] = std::lround(*value * factor);
  };
  put("num_cpus", "provenance.cores", 1);
  put("mhz_per_cpu", "conditions.cpu_frequency_hz.mean", 1e-6);
  if (const std::string governor = run.text("conditions.governor"); !governor.empty()) {
    json["cpu_scaling_enabled"] = governor != "performance";
  }
  if (const auto load = value_of("provenance.load_average_start", run)) json["load_avg"] = {*load};
  json["library_build_type"] = run.text("provenance.build_type") == "Debug" ? "debug" : "release";
  for (const char* name : {"version", "commit", "compiler", "cpu", "os", "device"}) {
    json[fmt::format("slambench_{}", name)] = run.text(fmt::format("provenance.{}", name));
  }
  return json;
}

}  // namespace

std::string google_benchmark_json(const std::vector<ExportRun>& runs, const ParameterRoles& roles) {
  Json benchmarks = Json::array();
  std::size_t family = 0;
  for (const Configuration& configuration : configurations(runs, roles)) {
    for (const NamedFigure& figure : figure_table()) {
      if (figure.unit == "s") add_entries(configuration, figure, family++, &benchmarks);
    }
  }
  if (benchmarks.empty()) {
    throw InputError(fmt::format("{}: has no times: {}", runs.front().run.path,
                                 reason_absent("time.computation_s", runs.front().run)));
  }
  const Json json = {{"context", context(runs.front().run)}, {"benchmarks", benchmarks}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace slambench
