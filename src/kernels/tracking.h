// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cmath>

#include "kernels/types.h"

/// Whether an alignment is believed, on the host or where the next kernels wait for it.
namespace slambench {

struct TrackingLimits {
  double residual_m = 0;       ///< largest root mean square error
  double inlier_fraction = 0;  ///< least part of the level's pixels that are paired
};

/// Root mean square of the point-to-plane errors; 0 without any.
SLAMBENCH_HD inline double residual_m(const Reduction& last) {
  if (last.inliers <= 0) return 0;
  return sqrt(last.squared_error / static_cast<double>(last.inliers));
}

/// Of an iteration over a level of so many pixels.
SLAMBENCH_HD inline double inlier_fraction(const Reduction& last, std::int64_t pixels) {
  return static_cast<double>(last.inliers) / static_cast<double>(pixels);
}

/// Of an alignment whose pose is `finite` or not, and whose last iteration was over a level of so
/// many pixels: whether enough of them agree with the model, and well enough.
SLAMBENCH_HD inline bool is_believed(bool finite, const Reduction& last, std::int64_t pixels,
                                     const TrackingLimits& limits) {
  return finite && last.inliers > 0 && residual_m(last) <= limits.residual_m &&
         inlier_fraction(last, pixels) >= limits.inlier_fraction;
}

}  // namespace slambench
