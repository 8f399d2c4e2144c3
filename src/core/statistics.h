// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstddef>
#include <span>

namespace slambench {

/// Figures of a sample. Percentiles interpolate linearly between the order statistics (type 7,
/// the default of NumPy); the standard deviation is that of the population (divides by n).
struct Statistics {
  std::size_t count = 0;
  double mean = 0, median = 0, p95 = 0, p99 = 0, min = 0, max = 0, std = 0, rmse = 0;
};

/// All figures of the values; `count` is 0 for an empty sample and nothing else is meaningful then.
Statistics summarize(std::span<const double> values);

}  // namespace slambench
