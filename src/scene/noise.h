// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>

#include "core/image.h"

namespace slambench {

/// Adds the errors of a structured-light sensor to exact depth: the model that ICL-NUIM uses
/// (Handa, Whelan, McDonald, Davison, ICRA 2014, section III; after Barron & Malik, CVPR 2013).
///   - shift: each pixel takes the depth at a place N(0, 1/2 px) beside it, in both directions;
///   - disparity: in units of 1/8 px it is 35130 / (depth in cm); it gets N(0, 1/6) and is rounded:
///     z = 35130 / round(35130 / round(100 z) + N(0, 1/6) + 0.5) / 100;
///   - dropouts: no measurement (0) where the ray grazes the surface, for certain where `incidence`
///     (the cosine between ray and normal) is below 0.1 (84 degrees), never above 0.2 (78 degrees).
/// Pixels without depth stay without. The same seed and frame give the same bytes on every machine
/// and in any order of frames. Sizes of both images agree; `noisy_m` gets the same.
void add_kinect_noise(const Image<float>& depth_m, const Image<float>& incidence,
                      std::uint64_t seed, int frame, Image<float>& noisy_m);

/// Reproducible numbers: the counter-based SplitMix64 (Steele, Lea, Flood 2014), which like its
/// transforms below needs integers and exact floating-point operations only.
class NoiseGenerator {
 public:
  explicit NoiseGenerator(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits();
  /// Uniform in [0, 1), a multiple of 2^-24.
  float uniform();
  /// Mean 0 and deviation 1: the sum of twelve uniform numbers (Irwin-Hall), so within 6.
  float normal();

 private:
  std::uint64_t state_;
};

}  // namespace slambench
