// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>
#include <random>

#include "core/image.h"

namespace slambench::testing {

/// Numbers that are the same on every machine for the same seed (the distributions of the standard
/// library are not).
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  /// In [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * (engine_() / 4294967296.0);
  }
  bool chance(double probability) { return uniform(0, 1) < probability; }

 private:
  std::mt19937 engine_;
};

/// Depths in [low, high) with no smoothness at all, and holes (0) at random.
inline Image<float> random_depth_m(Size size, std::uint32_t seed, double hole_fraction = 0.1,
                                   double low = 0.5, double high = 4.0) {
  Random random(seed);
  Image<float> depth(size);
  for (float& pixel : depth) {
    const auto value = static_cast<float>(random.uniform(low, high));
    pixel = random.chance(hole_fraction) ? 0.0f : value;
  }
  return depth;
}

/// The same as a sensor's units: [low, high), holes 0.
inline Image<std::uint16_t> random_depth_units(Size size, std::uint32_t seed,
                                               double hole_fraction = 0.1, int low = 500,
                                               int high = 4000) {
  const Image<float> depth = random_depth_m(size, seed, hole_fraction, low, high);
  Image<std::uint16_t> units(size);
  for (std::size_t i = 0; i < units.count(); ++i) {
    units.data()[i] = static_cast<std::uint16_t>(depth.data()[i]);
  }
  return units;
}

/// Punches holes (T{}) into any image.
template <class T>
void punch_holes(Image<T>& image, std::uint32_t seed, double fraction) {
  Random random(seed);
  for (T& pixel : image) {
    if (random.chance(fraction)) pixel = T{};
  }
}

}  // namespace slambench::testing
