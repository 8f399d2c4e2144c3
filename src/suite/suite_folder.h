// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/stored_run.h"
#include "results/record.h"
#include "suite/suite_plan.h"

/// What a suite keeps on disk: FOLDER/suite.json, and the results of its runs in
/// FOLDER/CONFIGURATION/REPETITION. A run counts once its folder is there with a record that is
/// complete and valid; nothing else says what is done. What lies in hidden folders never counts.
namespace slambench {

/// Held while a suite works in a folder, and by its runs, until the last of them is gone.
class SuiteLock {
 public:
  SuiteLock() = default;
  ~SuiteLock();
  SuiteLock(const SuiteLock&) = delete;
  SuiteLock& operator=(const SuiteLock&) = delete;

  /// Whether nobody else holds it. Makes the folder when it is not there; throws Error naming it
  /// when that fails.
  bool take(const std::string& folder);

 private:
  int file_ = -1;
};

/// Where the results of a run belong; of one that warms up, where they are removed again.
std::string run_folder(const std::string& folder, const Configuration& configuration,
                       const PlannedRun& run);

/// Gives each configuration the folder that it has in an earlier suite.json (and the path of its
/// sequence, where that is not known here), and new ones none that is in use. Nothing happens to a
/// folder that is not there or empty. Throws UsageError for one that holds anything but a suite,
/// InputError for a suite.json that cannot be read.
void keep_folders(const std::string& folder, std::vector<Configuration>* configurations);

/// What made results: this program on this machine.
struct SuiteBuild {
  Provenance provenance;
  std::string executable;  ///< hash of its file: tells apart what a commit does not
};

/// Replaces suite.json. Throws Error.
void write_suite(const std::string& folder, const std::string& title,
                 const std::vector<Configuration>& configurations, const SuiteBuild& build);

/// Results that lie where they do not belong, or do not count.
struct Misfit {
  std::string path, reason;
};

/// What a finished run took by its record: start-up and frames.
struct RunCost {
  double seconds = 0;
  int frames = 0;
};

RunCost cost_of(const StoredRun& run);

struct SuiteResults {
  std::map<PlannedRun, RunCost> done;
  std::vector<Misfit> half;     ///< interrupted or not valid: to be run again
  std::vector<Misfit> foreign;  ///< of no configuration, of another one or of another build
};

/// Looks through the folder; nothing is changed.
SuiteResults find_results(const std::string& folder,
                          const std::vector<Configuration>& configurations, const SuiteBuild& build,
                          const std::vector<ParameterList>& lists);

/// Removes what killed runs and suites left behind in the folder, whose lock is held.
void remove_suite_leftovers(const std::string& folder);

/// Moves results to FOLDER/.PLACE, where they count no more. Returns where they are now. Throws
/// Error.
std::string put_away(const std::string& folder, const std::string& place, const std::string& path);

/// Removes what a run left at `path` without coming to its end, and moves results that are complete
/// but do not count to FOLDER/.failed, as they say why. Returns where these are now, else "".
/// Nothing that is no folder is touched.
std::string discard_results(const std::string& folder, const std::string& path);

}  // namespace slambench
