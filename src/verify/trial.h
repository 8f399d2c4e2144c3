// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cmath>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "backends/backend.h"
#include "verify/agreement.h"
#include "verify/random.h"
#include "verify/recording.h"
#include "verify/same.h"
#include "verify/tolerances.h"
#include "verify/workbench.h"

namespace slambench {

/// A check in progress: one kernel of one candidate on one map. Cases are added one by one; what
/// the candidate computes is held against the reference, against the check's tolerance, and
/// against what the candidate computes when asked again with another number of threads.
class Trial {
 public:
  Trial(const Tolerance& tolerance, Candidate& candidate, MapKind map,
        const AgreementOptions& options);

  const Tolerance& tolerance() const { return tolerance_; }
  MapKind map() const { return map_; }
  const std::vector<Recording>& recordings() const { return options_.recordings; }
  bool candidate_supports(Kernel kernel) const { return candidate_.first->supports(kernel, map_); }
  /// The check's own stream of numbers, from its start.
  Random random() const { return Random(options_.seed, tolerance_.check); }

  /// `run(Workbench&)` puts inputs and outputs on the workbench, runs the kernel, and returns
  /// what came out, as values that same() can compare; `compare(expected, found)` calls
  /// at_most(). An exception of the candidate is a disagreement.
  template <class Run, class Compare>
  void add(const std::string& input, const Run& run, const Compare& compare) {
    if (options_.fail_fast && result_.verdict == Verdict::disagrees) return;
    input_ = input;
    ++result_.cases;
    Workbench bench(*reference_, MapKind::grid);
    const auto expected = run(bench);
    try {
      Workbench first(*candidate_.first, map_);
      const auto found = run(first);
      report(first.violations());
      compare(expected, found);
      Workbench again(*candidate_.second, map_);
      const bool repeats = same(found, run(again));
      report(again.violations());
      at_most("differs when repeated", repeats ? 0 : 1);
    } catch (const std::exception& error) {
      at_most("exception", 1, error.what());
    }
  }

  /// Records a measured quantity of the current case; `where` tells the place and the values.
  void at_most(std::string_view quantity, double found, const std::string& where = "");

  Agreement take();

 private:
  void report(const std::vector<Violation>& violations);

  const Tolerance& tolerance_;
  Candidate& candidate_;
  const MapKind map_;
  const AgreementOptions& options_;
  std::unique_ptr<Backend> reference_;
  std::string input_;
  Agreement result_;
};

}  // namespace slambench
