// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "interrupt.h"
#include "suite/suite_folder.h"
#include "suite/suite_plan.h"
#include "suite/suite_summary.h"
#include "suite_progress.h"

namespace slambench {

/// One suite at work in its folder: each run is this program in a process of its own.
class SuiteRunner {
 public:
  /// `frames`: that each configuration runs over. `results`: those of earlier runs. `program` and
  /// `configurations` must outlive it.
  SuiteRunner(const std::string& program, std::string folder,
              const std::vector<Configuration>& configurations, std::vector<PlannedRun> runs,
              std::vector<int> frames, SuiteResults results);

  const std::vector<PlannedRun>& runs() const { return runs_; }
  /// Those that are done: earlier ones and, after run_all, its own.
  const std::map<PlannedRun, RunCost>& done() const { return results_.done; }
  /// A sentence for each run that failed.
  const std::vector<std::string>& failures() const { return failures_; }

  /// Where the results of a run belong.
  std::string folder_of(const PlannedRun& run) const { return run_folder(folder_, of(run), run); }
  /// What stands after "slambench".
  std::vector<std::string> arguments_of(const PlannedRun& run) const;
  /// Until all runs have had their turn or the interrupt is raised.
  void run_all(const InterruptFlag& interrupt, SuiteProgress* progress);

 private:
  const Configuration& of(const PlannedRun& run) const;
  std::optional<double> expected_s(std::size_t from) const;
  void run_one(std::size_t i, const InterruptFlag& interrupt, SuiteProgress* progress);

  const std::string& program_;
  const std::string folder_;
  const std::vector<Configuration>& configurations_;
  const std::vector<PlannedRun> runs_;
  const std::vector<int> frames_;
  SuiteResults results_;
  RunTimes times_;
  std::vector<std::string> failures_;
};

}  // namespace slambench
