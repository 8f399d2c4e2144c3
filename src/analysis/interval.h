// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>
#include <span>

namespace slambench {

/// A ratio and how far chance may have moved it.
struct RatioInterval {
  double ratio = 1, low = 1, high = 1;
  bool contains_one() const { return low <= 1 && 1 <= high; }
};

/// The t that a Student-distributed number of `degrees` (>= 1, not necessarily whole) exceeds in
/// magnitude with probability `alpha` in (0, 1).
double student_t(double alpha, double degrees);

// All intervals are of the ratio of geometric means, other to base; positive values only. They hold
// with the probability 1 - alpha when the logarithms of the values are normally distributed.

/// Of repeated runs: Welch's interval of the difference of mean logarithms. Where one side has a
/// single run, it is taken to scatter as the other does. Needs two runs on one side.
RatioInterval ratio_of_runs(std::span<const double> base, std::span<const double> other,
                            double alpha);

/// Of runs in pairs, the i-th of `base` with the i-th of `other`: Student's interval of the mean
/// logarithm of their ratios, so that what changed slowly for both does not count. Needs two pairs.
RatioInterval ratio_of_pairs(std::span<const double> base, std::span<const double> other,
                             double alpha);

/// Of the means over the frames of two single runs, by the circular block bootstrap: blocks of
/// consecutive frames are drawn, the same ones from both runs where these have equally many frames,
/// because neighbouring frames are alike; the scatter of the logarithm of the ratio among the
/// resamples gives the interval. It knows nothing of how much another run would differ.
RatioInterval ratio_of_frames(std::span<const double> base, std::span<const double> other,
                              double alpha, std::uint64_t seed = 1);

/// Frames in a block for so many frames.
std::size_t block_length(std::size_t frames);

}  // namespace slambench
