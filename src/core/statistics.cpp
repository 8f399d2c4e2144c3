// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "core/statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace slambench {
namespace {

/// The q-quantile of a sorted, non-empty sample.
double quantile(const std::vector<double>& sorted, double q) {
  const double position = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

Statistics summarize(std::span<const double> values) {
  Statistics s;
  s.count = values.size();
  if (values.empty()) return s;

  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const auto n = static_cast<double>(sorted.size());
  double sum = 0, sum_of_squares = 0;
  for (const double v : sorted) {
    sum += v;
    sum_of_squares += v * v;
  }
  s.mean = sum / n;
  double squared_deviations = 0;
  for (const double v : sorted) squared_deviations += (v - s.mean) * (v - s.mean);
  s.std = std::sqrt(squared_deviations / n);
  s.rmse = std::sqrt(sum_of_squares / n);
  s.median = quantile(sorted, 0.5);
  s.p95 = quantile(sorted, 0.95);
  s.p99 = quantile(sorted, 0.99);
  s.min = sorted.front();
  s.max = sorted.back();
  return s;
}

}  // namespace slambench
