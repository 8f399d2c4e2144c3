// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "verify/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace slambench {

std::string describe(float value) { return fmt::format("{}", value); }
std::string describe(const Float3& value) {
  return fmt::format("({}, {}, {})", value.x, value.y, value.z);
}
std::string describe(Rgba8 value) {
  return fmt::format("({}, {}, {}, {})", value.r, value.g, value.b, value.a);
}
std::string describe(const TrackData& value) {
  const auto outcome = static_cast<int>(value.outcome);
  if (value.outcome != TrackOutcome::ok) return fmt::format("outcome {}", outcome);
  return fmt::format("outcome {}, error {}, J ({})", outcome, value.error,
                     fmt::join(value.jacobian, ", "));
}
std::string describe(Voxel value) { return fmt::format("({}, {})", value.tsdf, value.weight); }

double relative_distance(float expected, float found) {
  if (!std::isfinite(expected) || expected == found) return 0;
  return std::abs(static_cast<double>(found) - expected) / std::abs(static_cast<double>(expected));
}

double vector_distance(const Float3& expected, const Float3& found) {
  if (!is_finite(expected)) return 0;
  const double x = static_cast<double>(found.x) - expected.x;
  const double y = static_cast<double>(found.y) - expected.y;
  const double z = static_cast<double>(found.z) - expected.z;
  return std::sqrt(x * x + y * y + z * z);
}

double level_distance(Rgba8 expected, Rgba8 found) {
  return std::max({std::abs(expected.r - found.r), std::abs(expected.g - found.g),
                   std::abs(expected.b - found.b), std::abs(expected.a - found.a)});
}

bool is_finite(const Float3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::string place(Size size, std::size_t index) {
  const auto width = static_cast<std::size_t>(size.width);
  return fmt::format("pixel ({}, {})", index % width, index / width);
}

}  // namespace slambench
