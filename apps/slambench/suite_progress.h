// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <optional>
#include <string>

#include "meters/clock.h"

namespace slambench {

/// A line at standard output for each run that has ended, and on a terminal one at standard error
/// about the run in progress.
class SuiteProgress {
 public:
  SuiteProgress(std::size_t runs, const Clock& clock, bool wanted);

  /// `left_s`: what this run and those after it will take, where that is known.
  void begin(std::size_t index, std::string name, std::optional<double> left_s);
  void show();
  void end(std::optional<double> fps, std::optional<double> left_s);
  void fail(const std::string& reason);

 private:
  double elapsed_s() const;  ///< since begin()
  std::string head() const;

  const std::size_t runs_;
  const Clock& clock_;
  const bool wanted_, on_terminal_;
  std::size_t index_ = 0;
  std::string name_;
  std::optional<double> left_s_;
  double begin_s_ = 0, shown_s_ = 0;
};

}  // namespace slambench
