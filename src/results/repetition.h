// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/record.h"

namespace slambench {

/// A figure of one run.
struct Figure {
  std::string unit;
  double value = 0;
  std::optional<double> frame_spread;  ///< standard deviation over the frames of the run
};

/// The figures of a run that runs are compared by, under their places in record.json
/// ("time.stages.track.seconds_per_frame", "energy.total.joules"). What was not measured, or is not
/// a finite number, is not there.
std::map<std::string, Figure> run_figures(const Record& record);

/// The same runs' figures put together: `runs` has those of each run, in order. The interval is
/// that of bootstrap_median(). Figures that a run lacks are named in Repetition::lacking.
Repetition repetition_of(const std::vector<std::map<std::string, Figure>>& runs);

/// Which of the runs has the median value of the figure (the lower of two); 0 when none has it.
std::size_t median_run(const std::vector<std::map<std::string, Figure>>& runs,
                       const std::string& place);

/// An interval that holds the median of what the values were drawn from, with the confidence: the
/// percentiles of the medians of `resamples` samples drawn from the values with replacement (Efron
/// & Tibshirani 1993, ch. 13). The same values give the same interval. Of few values it is their
/// range at most, which holds the median less often: 1 - 2^(1 - n) of the time, 94 % for 5.
struct Interval {
  double low = 0, high = 0;
};
Interval bootstrap_median(std::span<const double> values, double confidence = 0.95,
                          int resamples = 10000, std::uint64_t seed = 1);

}  // namespace slambench
