// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "core/image.h"
#include "kernels/types.h"

namespace slambench {

std::string describe(float value);
std::string describe(const Float3& value);
std::string describe(Rgba8 value);
std::string describe(const TrackData& value);
std::string describe(Voxel value);

/// How far two images are apart, pixel by pixel.
struct Spread {
  double worst = 0;        ///< largest distance; infinite when only the found value is not finite
  std::size_t beyond = 0;  ///< pixels further apart than the limit
  std::size_t total = 0;
  std::string where;  ///< the place and the values of the worst

  double share_beyond() const {
    return total > 0 ? static_cast<double>(beyond) / static_cast<double>(total) : 0;
  }
};

/// `distance(expected, found)` of all pixels. A distance that is not a number counts as infinite.
template <class T, class Distance>
Spread spread(const Image<T>& expected, const Image<T>& found, double limit,
              const Distance& distance);

/// |found - expected| / |expected|. Expected values that are not finite have no distance; a zero
/// must be found as zero.
double relative_distance(float expected, float found);
/// Euclidean, of two vectors; none when the expected one is not finite.
double vector_distance(const Float3& expected, const Float3& found);
/// Largest difference of a channel.
double level_distance(Rgba8 expected, Rgba8 found);

bool is_finite(const Float3& v);

// Implementation of the template.

std::string place(Size size, std::size_t index);

template <class T, class Distance>
Spread spread(const Image<T>& expected, const Image<T>& found, double limit,
              const Distance& distance) {
  Spread result;
  result.total = expected.count();
  std::size_t worst = 0;
  for (std::size_t i = 0; i < expected.count(); ++i) {
    double d = distance(expected.data()[i], found.data()[i]);
    if (d != d) d = std::numeric_limits<double>::infinity();
    if (d > limit) ++result.beyond;
    if (d > result.worst) {
      result.worst = d;
      worst = i;
    }
  }
  if (result.worst > 0) {
    result.where = place(expected.size(), worst) + ": found " + describe(found.data()[worst]) +
                   ", expected " + describe(expected.data()[worst]);
  }
  return result;
}

}  // namespace slambench
