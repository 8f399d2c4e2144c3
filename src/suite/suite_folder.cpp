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
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/result_folders.h"
#include "analysis/stored_run.h"
#include "core/error.h"
#include "io/files.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* suite_format = "slambench-suite";
constexpr int suite_version = 1;
constexpr const char* warmup_folder = ".warm-up";

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

Json as_json(const Configuration& configuration) {
  Json parameters = Json::object();
  for (const auto& [name, value] : configuration.assignments) parameters[name] = value;
  return {{"folder", configuration.folder},   {"sequence", configuration.sequence_name},
          {"variant", configuration.variant}, {"path", configuration.sequence},
          {"preset", configuration.preset},   {"parameters", parameters}};
}

/// What identifies the configurations of an earlier suite, and their folders.
std::vector<Configuration> read_suite(const std::string& file) {
  std::vector<Configuration> configurations;
  const Json json = Json::parse(read_file(file), nullptr, false);
  if (!json.is_object() || json.value("format", Json()) != suite_format ||
      json.value("version", Json()) != suite_version) {
    throw InputError(fmt::format("{}: is not what this version of slambench suite writes", file));
  }
  try {
    for (const Json& from : json.at("configurations")) {
      Configuration to;
      from.at("folder").get_to(to.folder);
      from.at("path").get_to(to.sequence);
      from.at("preset").get_to(to.preset);
      for (const auto& [name, value] : from.at("parameters").items()) {
        to.assignments.push_back({name, value.get<std::string>()});
      }
      configurations.push_back(std::move(to));
    }
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: {}", file, error.what()));
  }
  std::set<std::string> folders;
  for (const Configuration& c : configurations) {
    if (is_folder_name(c.folder) && folders.insert(c.folder).second) continue;
    throw InputError(
        fmt::format("{}: folder: found '{}', expected a name that no other "
                    "configuration has and no path",
                    file, c.folder));
  }
  return configurations;
}

/// What the record has at the place, a number as text; "" when nothing.
std::string value_at(const StoredRun& run, const std::string& place) {
  const auto number = run.numbers.find(place);
  return number == run.numbers.end() ? run.text(place) : fmt::format("{}", number->second);
}

/// Why the run does not belong to the configuration and this build; "" when it does.
std::string mismatch(const StoredRun& run, const Configuration& configuration,
                     const Provenance& build, const std::vector<ParameterList>& lists) {
  std::vector<std::pair<std::string, std::string>> expected = {
      {"provenance.version", build.version},
      {"provenance.commit", build.commit},
      {"provenance.compiler", build.compiler},
      {"provenance.flags", build.flags},
      {"provenance.build_type", build.build_type},
      {"provenance.cpu", build.cpu},
      {"provenance.cores", fmt::format("{}", build.cores)},
      {"provenance.os", build.os}};
  if (!configuration.preset.empty()) {
    expected.emplace_back("parameters.run.preset.value", configuration.preset);
  }
  for (const ParameterList& list : lists) {
    for (const Parameter& parameter : list.parameters) {
      const auto value = configuration.value(parameter.name);
      if (!value) continue;
      expected.emplace_back(fmt::format("parameters.{}.{}.value", list.group, parameter.name),
                            *value);
    }
  }
  for (const auto& [place, value] : expected) {
    const std::string found = value_at(run, place);
    if (found == value) continue;
    constexpr std::string_view of_build = "provenance.";
    return place.starts_with(of_build)
               ? fmt::format("was made by another build or machine: {} is '{}', here '{}'",
                             place.substr(of_build.size()), found, value)
               : fmt::format("is of other settings: {} is '{}', expected '{}'", place, found,
                             value);
  }
  return "";
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

RunCost cost_of(const StoredRun& run) {
  const auto number = [&](const char* place) {
    const auto it = run.numbers.find(place);
    return it == run.numbers.end() ? 0.0 : it->second;
  };
  return {number("time.wall_s") + number("time.start_up.seconds"),
          static_cast<int>(number("frames.processed"))};
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
  const fs::path file = fs::path(folder) / suite_name;
  if (!fs::exists(file, error)) {
    if (std::ranges::all_of(entries(folder), is_leftover)) return;
    throw UsageError(fmt::format("{}: holds files but no suite ({}); choose another folder", folder,
                                 suite_name));
  }
  const std::vector<Configuration> earlier = read_suite(file);
  std::vector<Configuration*> fresh;
  for (Configuration& configuration : *configurations) {
    const auto same = std::ranges::find_if(earlier, [&](const Configuration& other) {
      return configuration.computes_the_same_as(other);
    });
    if (same == earlier.end()) {
      fresh.push_back(&configuration);
    } else {
      configuration.folder = same->folder;
    }
  }
  const auto taken = [&](const Configuration* self, const std::string& name) {
    return std::ranges::find(earlier, name, &Configuration::folder) != earlier.end() ||
           std::ranges::any_of(*configurations, [&](const Configuration& other) {
             return &other != self && other.folder == name;
           });
  };
  for (Configuration* configuration : fresh) {
    const std::string name = configuration->folder;
    for (int i = 2; taken(configuration, configuration->folder); ++i) {
      configuration->folder = fmt::format("{}-{}", name, i);
    }
  }
}

void write_suite(const std::string& folder, const std::string& title,
                 const std::vector<Configuration>& configurations) {
  Json json = {{"format", suite_format}, {"version", suite_version}, {"title", title}};
  json["configurations"] = Json::array();
  for (const Configuration& c : configurations) json["configurations"].push_back(as_json(c));
  write_file(fs::path(folder) / suite_name,
             json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

SuiteResults find_results(const std::string& folder,
                          const std::vector<Configuration>& configurations, const Provenance& build,
                          const std::vector<ParameterList>& lists) {
  SuiteResults results;
  std::error_code error;
  if (!fs::is_directory(folder, error)) return results;
  for (const std::string& path : result_folders_in(folder)) {
    const auto run = run_at(fs::path(path).lexically_relative(folder), configurations);
    if (!run) {
      results.foreign.push_back({path, "is of no configuration of the suite"});
      continue;
    }
    try {
      const StoredRun stored = read_stored_run(path);
      const std::string other = mismatch(stored, configurations[run->configuration], build, lists);
      if (!other.empty()) {
        results.foreign.push_back({path, other});
      } else if (!stored.complete()) {
        results.half.push_back({path, "was interrupted"});
      } else if (!stored.valid()) {
        results.half.push_back({path, "is not valid"});
      } else {
        results.done[*run] = cost_of(stored);
      }
    } catch (const InputError& unreadable) {
      results.half.push_back({path, unreadable.what()});
    }
  }
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

}  // namespace slambench
