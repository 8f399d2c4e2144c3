// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "scene/noise.h"

#include <algorithm>
#include <cmath>

namespace slambench {
namespace {

constexpr float shift_sigma_px = 0.5f;
constexpr float disparity_cm = 35130.0f;  ///< baseline x focal length, cm x 1/8 px
constexpr float disparity_sigma = 1.0f / 6.0f;
constexpr float grazing_always = 0.1f, grazing_never = 0.2f;

/// To the nearest integer, halves upwards; for values of the size of depths and disparities.
float rounded(float value) { return std::floor(value + 0.5f); }

int shifted(int at, float by, int size) {
  return std::clamp(at + static_cast<int>(rounded(by)), 0, size - 1);
}

bool drops_out(float incidence, float chance) {
  return incidence < grazing_always + (grazing_never - grazing_always) * chance;
}

/// The depth that the quantised, disturbed disparity stands for; 0 when it has none.
float through_disparity(float depth_m, float normal) {
  const float depth_cm = rounded(100.0f * depth_m);
  if (!(depth_cm > 0.0f)) return 0.0f;
  const float disparity = rounded(disparity_cm / depth_cm + disparity_sigma * normal + 0.5f);
  return disparity > 0.0f ? disparity_cm / disparity / 100.0f : 0.0f;
}

}  // namespace

std::uint64_t NoiseGenerator::bits() {
  state_ += 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

float NoiseGenerator::uniform() { return static_cast<float>(bits() >> 40) * (1.0f / 16777216.0f); }

float NoiseGenerator::normal() {
  // Twelve numbers of 16 bits from three words; the sums of the four in a word are taken side by
  // side. Their mean is 12 x 32767.5, their deviation one step of 65536.
  constexpr std::uint64_t lanes = 0x0000ffff0000ffffULL;
  std::uint64_t pairs = 0;
  for (int i = 0; i < 3; ++i) {
    const std::uint64_t word = bits();
    pairs += (word & lanes) + ((word >> 16) & lanes);
  }
  const auto sum = static_cast<std::int32_t>((pairs & 0xffffffffULL) + (pairs >> 32));
  return static_cast<float>(2 * sum - 12 * 65535) * (0.5f / 65536.0f);
}

void add_kinect_noise(const Image<float>& depth_m, const Image<float>& incidence,
                      std::uint64_t seed, int frame, Image<float>& noisy_m) {
  noisy_m.resize(depth_m.size());
  const std::uint64_t stream =
      NoiseGenerator(NoiseGenerator(seed).bits() + static_cast<std::uint64_t>(frame)).bits();
  NoiseGenerator generator(stream);
  for (int y = 0; y < depth_m.height(); ++y) {
    for (int x = 0; x < depth_m.width(); ++x) {
      // Every pixel draws as many numbers, whatever it sees.
      const float shift_x = generator.normal(), shift_y = generator.normal();
      const float disturbance = generator.normal(), chance = generator.uniform();
      const int from_x = shifted(x, shift_sigma_px * shift_x, depth_m.width());
      const int from_y = shifted(y, shift_sigma_px * shift_y, depth_m.height());
      const bool lost = drops_out(incidence(from_x, from_y), chance);
      noisy_m(x, y) = lost ? 0.0f : through_disparity(depth_m(from_x, from_y), disturbance);
    }
  }
}

}  // namespace slambench
