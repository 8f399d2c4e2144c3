// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "suite/suite_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <set>

#include "analysis/figure.h"
#include "analysis/result_folders.h"
#include "analysis/run_group.h"
#include "analysis/stored_run.h"
#include "analysis/suite_index.h"
#include "core/error.h"
#include "io/files.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;

constexpr const char* warmup_folder = ".warm-up";
constexpr const char* input_hash = "sequence.input_hash";

[[noreturn]] void fail(const fs::path& path, const std::error_code& error) {
  throw Error(ExitStatus::failed, fmt::format("{}: {}", path.string(), error.message()));
}

std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    found.push_back(it->path());
  }
  return found;
}

/// What only a process that was killed leaves; hidden, as no configuration's folder is.
bool is_leftover(const fs::path& path) {
  const std::string name = path.filename();
  return name.starts_with('.') && (name.ends_with(".slambench-partial") || name == warmup_folder ||
                                   (name.starts_with(".slambench-") && name.ends_with(".tmp")));
}

/// A suite.json: the program that wrote it, what identifies configurations, and their folders.
struct EarlierSuite {
  std::string executable;
  std::vector<Configuration> configurations;
};

EarlierSuite read_suite(const std::string& file) {
  SuiteIndex index = read_suite_index(file);
  EarlierSuite suite{index.executable, {}};
  std::set<std::string> folders;
  for (SuiteIndex::Configuration& from : index.configurations) {
    if (!is_folder_name(from.folder) || !folders.insert(from.folder).second) {
      throw InputError(
          fmt::format("{}: folder: found '{}', expected a name that no other "
                      "configuration has and no path",
                      file, from.folder));
    }
    Configuration to;
    to.folder = std::move(from.folder);
    to.sequence_name = std::move(from.sequence);
    to.sequence = std::move(from.path);
    to.preset = std::move(from.preset);
    for (auto& [name, value] : from.parameters) to.assignments.push_back({name, value});
    suite.configurations.push_back(std::move(to));
  }
  return suite;
}

/// How the settings of one configuration differ from those of another.
std::vector<std::string> setting_differences(const Configuration& found,
                                             const Configuration& expected) {
  std::vector<std::string> sentences;
  const auto compare = [&](std::string_view name, const std::string& value,
                           const std::string& other) {
    if (value == other) return;
    sentences.push_back(fmt::format("{} {}, expected {}", name, value.empty() ? "not set" : value,
                                    other.empty() ? "none" : other));
  };
  compare("sequence", found.sequence, expected.sequence);
  compare("preset", found.preset, expected.preset);
  std::set<std::string> names;
  for (const auto& [name, value] : found.assignments) names.insert(name);
  for (const auto& [name, value] : expected.assignments) names.insert(name);
  for (const std::string& name : names) {
    compare(name, found.value(name).value_or(""), expected.value(name).value_or(""));
  }
  return sentences;
}

/// Why results in a folder of that name are of no configuration: what the earlier suite that made
/// them had in place of the one that is most alike.
std::string stranger_text(const std::string& name, const EarlierSuite& earlier,
                          const std::vector<Configuration>& configurations) {
  const auto it = std::ranges::find(earlier.configurations, name, &Configuration::folder);
  if (it == earlier.configurations.end()) return "is of no configuration of the suite";
  std::vector<std::string> least;
  for (const Configuration& configuration : configurations) {
    auto differences = setting_differences(*it, configuration);
    if (differences.empty()) return "is of no run of the suite";
    if (least.empty() || differences.size() < least.size()) least = std::move(differences);
  }
  return fmt::format("is of other settings: {}", fmt::join(least, "; "));
}

/// Why the run was not made by this build on this machine; "" when it was.
std::string other_build(const StoredRun& run, const SuiteBuild& build,
                        const std::string& executable) {
  const Provenance& here = build.provenance;
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"version", here.version},
      {"commit", here.commit},
      {"compiler", here.compiler},
      {"flags", here.flags},
      {"build_type", here.build_type},
      {"cpu", here.cpu},
      {"cores", fmt::format("{}", here.cores)},
      {"os", here.os}};
  for (const auto& [name, value] : expected) {
    const std::string found = run.value_text("provenance." + name).value_or("");
    if (found == value) continue;
    return fmt::format("was made by another build or machine: {} is '{}', here '{}'", name, found,
                       value);
  }
  const bool says_all = here.commit != "unknown" && !here.commit.ends_with("-dirty");
  if (says_all || executable == build.executable) return "";
  return fmt::format(
      "was made by another build of commit {}: the hash of the program was '{}', "
      "is '{}' here",
      here.commit, executable, build.executable);
}

/// Why the run is not of the configuration; "" when it is.
std::string other_settings(const StoredRun& run, const Configuration& configuration,
                           const std::vector<ParameterList>& lists) {
  const auto difference = [&](std::string_view group, std::string_view name,
                              const std::string& value) {
    const std::string found = run.parameter(fmt::format("{}.{}", group, name)).value_or("");
    return found == value ? ""
                          : fmt::format("is of other settings: {} {}, expected {}", name,
                                        found.empty() ? "not set" : found, value);
  };
  std::string text;
  if (!configuration.preset.empty()) text = difference("run", "preset", configuration.preset);
  for (const ParameterList& list : lists) {
    for (const Parameter& parameter : list.parameters) {
      const auto value = configuration.value(parameter.name);
      if (text.empty() && value) text = difference(list.group, parameter.name, *value);
    }
  }
  return text;
}

/// What a run that counts was run over.
struct RunInput {
  PlannedRun run;
  std::string path;
  fs::file_time_type written;  ///< its record: finer than the start that this tells of
  std::string hash;            ///< of the frames; "" in real time, where each run has others
};

/// Takes out what was run before the sequence became another one.
void refuse_other_inputs(const std::vector<RunInput>& runs, SuiteResults* results) {
  const RunInput& newest = *std::ranges::max_element(runs, {}, &RunInput::written);
  for (const RunInput& each : runs) {
    if (each.hash == newest.hash) continue;
    results->done.erase(each.run);
    results->foreign.push_back({each.path, fmt::format("has another input than {}", newest.path)});
  }
}

/// The run whose place in the suite's folder this is, CONFIGURATION/REPETITION; nothing when none.
std::optional<PlannedRun> run_at(const fs::path& path,
                                 const std::vector<Configuration>& configurations) {
  const std::string number = path.filename();
  const auto it =
      std::ranges::find(configurations, path.parent_path().string(), &Configuration::folder);
  int repetition = 0;
  const auto [end, error] =
      std::from_chars(number.data(), number.data() + number.size(), repetition);
  if (it == configurations.end() || error != std::errc{} || repetition < 1 ||
      number != std::to_string(repetition) || end != number.data() + number.size()) {
    return std::nullopt;
  }
  return PlannedRun{static_cast<std::size_t>(it - configurations.begin()), repetition};
}

}  // namespace

SuiteLock::~SuiteLock() {
  if (file_ >= 0) ::close(file_);
}

bool SuiteLock::take(const std::string& folder) {
  if (file_ < 0) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) fail(folder, error);
    // Not closed in the runs: one that outlives its suite for a moment still writes.
    file_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY);  // NOLINT(android-cloexec-open)
    if (file_ < 0) fail(folder, {errno, std::generic_category()});
  }
  while (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EINTR) continue;
    return errno != EWOULDBLOCK;  // a file system that locks no folders grants it
  }
  return true;
}

std::string run_folder(const std::string& folder, const Configuration& configuration,
                       const PlannedRun& run) {
  if (run.repetition == 0) return fs::path(folder) / warmup_folder;
  return fs::path(folder) / configuration.folder / std::to_string(run.repetition);
}

void keep_folders(const std::string& folder, std::vector<Configuration>* configurations) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder, error)) {
    throw UsageError(folder + ": is a file, expected a folder");
  }
  const fs::path file = fs::path(folder) / suite_index_name;
  if (!fs::exists(file, error)) {
    if (std::ranges::all_of(entries(folder), is_leftover)) return;
    throw UsageError(fmt::format("{}: holds files but no suite ({}); choose another folder", folder,
                                 suite_index_name));
  }
  const std::vector<Configuration> earlier = read_suite(file).configurations;
  std::vector<Configuration*> fresh;
  for (Configuration& configuration : *configurations) {
    const auto same = std::ranges::find_if(earlier, [&](const Configuration& other) {
      return configuration.computes_the_same_as(other);
    });
    if (same == earlier.end()) {
      fresh.push_back(&configuration);
    } else {
      configuration.folder = same->folder;
      if (configuration.sequence.empty()) configuration.sequence = same->sequence;
    }
  }
  std::set<std::string> used;
  for (const Configuration& c : earlier) used.insert(c.folder);
  for (Configuration* configuration : fresh) {
    configuration->folder = unused_folder_name(configuration->folder, &used);
  }
}

void write_suite(const std::string& folder, const std::string& title,
                 const std::vector<Configuration>& configurations, const SuiteBuild& build) {
  SuiteIndex index{title, build.executable, {}};
  for (const Configuration& c : configurations) {
    index.configurations.push_back(
        {c.folder, c.sequence_name, c.variant, c.sequence, c.preset, {}});
    for (const auto& [name, value] : c.assignments) {
      index.configurations.back().parameters.emplace_back(name, value);
    }
  }
  write_file(fs::path(folder) / suite_index_name, suite_index_json(index));
}

RunCost cost_of(const StoredRun& run) {
  const auto number = [&](const char* place) { return value_of(place, run).value_or(0); };
  return {number("time.wall_s") + number("time.start_up.seconds"),
          static_cast<int>(number("frames.processed"))};
}

SuiteResults find_results(const std::string& folder,
                          const std::vector<Configuration>& configurations, const SuiteBuild& build,
                          const std::vector<ParameterList>& lists) {
  SuiteResults results;
  std::error_code error;
  const fs::path file = fs::path(folder) / suite_index_name;
  if (!fs::exists(file, error)) return results;
  const EarlierSuite earlier = read_suite(file);
  std::map<std::vector<std::string>, std::vector<RunInput>> inputs;  // of runs that count
  for (const std::string& path : result_folders_in(folder)) {
    const fs::path place = fs::path(path).lexically_relative(folder);
    const auto run = run_at(place, configurations);
    if (!run) {
      results.foreign.push_back(
          {path, stranger_text(place.parent_path(), earlier, configurations)});
      continue;
    }
    try {
      const StoredRun stored = read_stored_run(path);
      std::string other = other_build(stored, build, earlier.executable);
      if (other.empty()) {
        other = other_settings(stored, configurations[run->configuration], lists);
      }
      if (!other.empty()) {
        results.foreign.push_back({path, other});
      } else if (!stored.complete()) {
        results.half.push_back({path, "was interrupted"});
      } else if (!stored.valid()) {
        results.half.push_back({path, "is not valid"});
      } else {
        results.done[*run] = cost_of(stored);
        inputs[input_of(configurations[run->configuration], lists)].push_back(
            {*run, path, fs::last_write_time(stored.path, error),
             in_real_time(stored) ? "" : stored.text(input_hash)});
      }
    } catch (const InputError& unreadable) {
      results.half.push_back({path, unreadable.what()});
    }
  }
  for (const auto& [input, runs] : inputs) refuse_other_inputs(runs, &results);
  return results;
}

void remove_suite_leftovers(const std::string& folder) {
  std::error_code ignored;
  for (const fs::path& entry : entries(folder)) {
    if (is_leftover(entry)) {
      fs::remove_all(entry, ignored);
    } else if (fs::is_directory(entry, ignored)) {
      for (const fs::path& inside : entries(entry)) {
        if (is_leftover(inside)) fs::remove_all(inside, ignored);
      }
      ::rmdir(entry.c_str());  // when it is empty now
    }
  }
}

std::string put_away(const std::string& folder, const std::string& place, const std::string& path) {
  const fs::path from(path);
  const fs::path into = fs::path(folder) / ("." + place);
  const std::string name = from.lexically_relative(folder).generic_string();
  std::string plain = name;
  std::ranges::replace(plain, '/', '-');
  std::error_code error;
  fs::create_directories(into, error);
  if (error) fail(into, error);
  fs::path to = into / plain;
  for (int i = 2; fs::exists(to, error); ++i) to = into / fmt::format("{}-{}", plain, i);
  fs::rename(from, to, error);
  if (error) fail(from, error);
  ::rmdir(from.parent_path().c_str());  // when it is empty now
  return to;
}

std::string discard_results(const std::string& folder, const std::string& path) {
  std::error_code error;
  if (fs::symlink_status(path, error).type() != fs::file_type::directory) return "";  // not ours
  bool complete = false;
  try {
    complete = read_stored_run(path).complete();
  } catch (const InputError&) {  // it is half
  }
  if (complete) return put_away(folder, "failed", path);
  fs::remove_all(path, error);
  return "";
}

}  // namespace slambench
