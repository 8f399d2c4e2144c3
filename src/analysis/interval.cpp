// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "analysis/interval.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

namespace slambench {
namespace {

struct Sample {
  double mean = 0, variance = 0;
  double count = 0;
  double variance_of_mean() const { return variance / count; }
};

/// Variance 0 for a single value.
Sample sample_of(std::span<const double> values) {
  Sample s;
  s.count = static_cast<double>(values.size());
  s.mean = std::accumulate(values.begin(), values.end(), 0.0) / s.count;
  if (values.size() < 2) return s;
  for (const double v : values) s.variance += (v - s.mean) * (v - s.mean);
  s.variance /= s.count - 1;
  return s;
}

std::vector<double> logarithms(std::span<const double> values) {
  std::vector<double> logs;
  logs.reserve(values.size());
  for (const double v : values) logs.push_back(std::log(v));
  return logs;
}

RatioInterval around(double log_ratio, double half_width) {
  return {std::exp(log_ratio), std::exp(log_ratio - half_width), std::exp(log_ratio + half_width)};
}

/// The probability that |t| of the Student distribution stays below sqrt(degrees) * tan(angle):
/// its density becomes a power of the cosine, which Simpson's rule integrates.
double student_within(double angle, double degrees) {
  constexpr int steps = 400;
  const double h = angle / steps;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const int weight = i == 0 || i == steps ? 1 : (i % 2 == 1 ? 4 : 2);
    sum += weight * std::pow(std::cos(i * h), degrees - 1);
  }
  const double log_factor = std::lgamma((degrees + 1) / 2) - std::lgamma(degrees / 2);
  return 2 * std::exp(log_factor) / std::sqrt(std::numbers::pi) * sum * h / 3;
}

/// The sum of `length` values from `begin` on, the first following the last.
double block_sum(std::span<const double> values, std::size_t begin, std::size_t length) {
  double sum = 0;
  for (std::size_t i = 0; i < length; ++i) sum += values[(begin + i) % values.size()];
  return sum;
}

}  // namespace

double student_t(double alpha, double degrees) {
  double low = 0, high = std::numbers::pi / 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (student_within(middle, degrees) < 1 - alpha ? low : high) = middle;
  }
  return std::sqrt(degrees) * std::tan((low + high) / 2);
}

RatioInterval ratio_of_runs(std::span<const double> base, std::span<const double> other,
                            double alpha) {
  Sample b = sample_of(logarithms(base)), o = sample_of(logarithms(other));
  if (base.size() < 2) b.variance = o.variance;
  if (other.size() < 2) o.variance = b.variance;
  const double variance = b.variance_of_mean() + o.variance_of_mean();
  double degrees = std::max(b.count, o.count) - 1;
  if (base.size() > 1 && other.size() > 1 && variance > 0) {
    degrees = variance * variance /
              (b.variance_of_mean() * b.variance_of_mean() / (b.count - 1) +
               o.variance_of_mean() * o.variance_of_mean() / (o.count - 1));
  }
  return around(o.mean - b.mean, student_t(alpha, degrees) * std::sqrt(variance));
}

RatioInterval ratio_of_pairs(std::span<const double> base, std::span<const double> other,
                             double alpha) {
  std::vector<double> differences = logarithms(other);
  const std::vector<double> base_logs = logarithms(base);
  for (std::size_t i = 0; i < differences.size(); ++i) differences[i] -= base_logs[i];
  const Sample s = sample_of(differences);
  return around(s.mean, student_t(alpha, s.count - 1) * std::sqrt(s.variance_of_mean()));
}

std::size_t block_length(std::size_t frames) {
  // Longer than the period of any rate at which frames differ (integration, rendering), and long
  // enough to hold a disturbance of some frames.
  constexpr std::size_t least = 10;
  const auto root = static_cast<std::size_t>(std::sqrt(static_cast<double>(frames)));
  return std::min(frames, std::max(least, root));
}

RatioInterval ratio_of_frames(std::span<const double> base, std::span<const double> other,
                              double alpha, std::uint64_t seed) {
  constexpr int resamples = 1000;
  constexpr double many_degrees = 1e4;  // as good as a normal distribution
  const bool same_frames = base.size() == other.size();
  std::mt19937_64 random(seed);
  const auto draw = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
  const auto blocks = [](std::size_t count) {
    return (count + block_length(count) - 1) / block_length(count);
  };
  std::vector<double> logs;
  for (int i = 0; i < resamples; ++i) {
    double base_sum = 0, other_sum = 0;
    for (std::size_t k = 0; k < blocks(base.size()); ++k) {
      const std::size_t begin = draw(base.size());
      base_sum += block_sum(base, begin, block_length(base.size()));
      if (same_frames) other_sum += block_sum(other, begin, block_length(other.size()));
    }
    for (std::size_t k = 0; !same_frames && k < blocks(other.size()); ++k) {
      other_sum += block_sum(other, draw(other.size()), block_length(other.size()));
    }
    if (base_sum > 0 && other_sum > 0) logs.push_back(std::log(other_sum / base_sum));
  }
  const double base_mean = sample_of(base).mean, other_mean = sample_of(other).mean;
  return around(std::log(other_mean / base_mean),
                student_t(alpha, many_degrees) * std::sqrt(sample_of(logs).variance));
}

}  // namespace slambench
