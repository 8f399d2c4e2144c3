// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <compare>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "suite/suite_file.h"

namespace slambench {

/// Whether a configuration's folder can have this name: letters, digits, '_', '-' and '.', not
/// hidden, not that of suite.json, and short enough for any file system.
bool is_folder_name(const std::string& name);

/// The first of NAME, NAME-2, NAME-3, ... that can be one and is not used; it is then.
std::string unused_folder_name(const std::string& name, std::set<std::string>* used);

/// One cell of the matrix: what is run, as often as it says.
struct Configuration {
  std::string folder;            ///< of its runs, in that of the suite: no other has the same
  std::string sequence_name;     ///< the row of a table
  std::string variant;           ///< the column: its group, and the values that vary
  std::string sequence, preset;  ///< a sequence whose path is not known here is ""
  std::vector<ConfigAssignment> assignments;  ///< as records show them, in the order of the lists
  int repeat = 1, warmup = 0;
  bool selected = true;   ///< by the command line
  bool available = true;  ///< here: its sequence and its backend

  /// Others are left out today; results that they have stay theirs.
  bool runs_today() const { return selected && available; }

  /// Nothing when the preset or the default decides.
  std::optional<std::string> value(std::string_view parameter) const;
  /// Where the path of a sequence is not known, its name decides.
  bool computes_the_same_as(const Configuration& other) const;
};

/// Puts the environment's values in place of ${NAME} in the paths of sequences, and marks those
/// that are optional and not there. Returns a sentence for each of these. Throws InputError for a
/// name that is not set, when the sequence is not optional.
std::vector<std::string> resolve_sequences(
    SuiteFile* file,
    const std::function<std::optional<std::string>(const std::string&)>& environment,
    const std::function<bool(const std::string& path)>& is_there);

/// All combinations: by sequence, then group, then the values of the matrix, the last axis the
/// quickest. From weak to strong: the suite's settings, the sequence's, the group's, `overrides`.
/// Of an axis that these set, they select the value. Throws InputError when two combinations are
/// the same.
std::vector<Configuration> configurations(const SuiteFile& file, const SuiteSettings& overrides,
                                          const std::vector<ParameterList>& lists);

/// A sentence for each list of a matrix that lacks the value which `overrides` select.
std::vector<std::string> lists_without_selection(const SuiteFile& file,
                                                 const SuiteSettings& overrides,
                                                 const std::vector<ParameterList>& lists);

/// What stands after "slambench", but for the folder of the results.
std::vector<std::string> run_arguments(const Configuration& configuration);

/// Two configurations whose runs `slambench compare` takes: on one sequence, with one preset and
/// the same values of all that decides what is computed. The first that has such another one, and
/// the last of these; nothing when there are no two.
std::optional<std::pair<Configuration, Configuration>> comparable_pair(
    const std::vector<Configuration>& configurations, const std::vector<ParameterList>& lists);

/// What decides over which frames it runs: equal for two configurations, these see the same.
std::vector<std::string> input_of(const Configuration& configuration,
                                  const std::vector<ParameterList>& lists);

struct PlannedRun {
  std::size_t configuration = 0;
  int repetition = 0;  ///< from 1; 0 for a run that warms up and is in no figure
  auto operator<=>(const PlannedRun&) const = default;
};

/// The runs that are not done, in turns: the first of every configuration, then the second of
/// every, and so on, so that what changes slowly in the machine meets all alike. Before them those
/// that warm up, of configurations that have runs left.
std::vector<PlannedRun> runs_in_turns(const std::vector<Configuration>& configurations,
                                      const std::function<bool(const PlannedRun&)>& is_done);

}  // namespace slambench
