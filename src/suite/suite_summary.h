// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "suite/suite_folder.h"

namespace slambench {

/// What the runs of a suite cost so far, to say what the others will.
class RunTimes {
 public:
  void add(const Configuration& configuration, const RunCost& cost);
  /// From runs of the configuration, else from those of its variant on other sequences, else from
  /// all; nothing before the first.
  std::optional<double> expected_s(const Configuration& configuration, int frames) const;

 private:
  struct Sum {
    double seconds = 0;
    long frames = 0;
  };
  std::map<std::string, Sum> by_folder_, by_variant_;
  Sum all_;
};

/// "45 s", "12 min", "3 h 20 min".
std::string duration_text(double seconds);

/// The figures of one configuration: medians over its runs.
struct ConfigurationResult {
  std::string sequence_name, variant;
  std::size_t runs = 0;
  std::optional<double> fps, computation_s, ate_rmse_m, frame_energy_j;
  std::string problem;  ///< why its runs are not repeats of one another; empty when they are
};

/// Reads the results of a configuration that has `runs` of them.
ConfigurationResult result_of(const std::string& folder, const Configuration& configuration,
                              std::size_t runs, const std::vector<ParameterList>& lists);

/// A row a configuration under the name of its sequence, 80 columns.
std::string suite_table(const std::vector<ConfigurationResult>& results, bool colors);

}  // namespace slambench
