// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <functional>
#include <string>

#include "results/record.h"
#include "runner/runner.h"

namespace slambench {

/// Which of the runs of one command.
struct RunNumber {
  int number = 1;  ///< of the warm-up runs, or of the measured ones
  int of = 1;
  bool warmup = false;
  bool last = true;  ///< no other follows
};

/// "warm-up run 1 of 2", "run 3 of 5".
std::string to_text(const RunNumber& run);

/// Does the warm-up runs and then the measured ones, and gives the record of the measured run whose
/// mean computation time is the median, with the figures of all of them in `repetition`. The record
/// is invalid when one of the runs is. A run that was interrupted is the last; it is in the figures
/// only when there is no other.
Record repeat_runs(const RunParameters& parameters,
                   const std::function<Record(const RunNumber&)>& one_run);

}  // namespace slambench
