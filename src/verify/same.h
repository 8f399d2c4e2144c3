// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <tuple>
#include <vector>

#include "backends/backend.h"

/// Whether two results of the same computation are the same to the last bit; any NaN is as good
/// as another.
namespace slambench {

inline bool same(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (a != a && b != b);
}
inline bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (a != a && b != b);
}
inline bool same(int a, int b) { return a == b; }
inline bool same(bool a, bool b) { return a == b; }
inline bool same(std::int64_t a, std::int64_t b) { return a == b; }
inline bool same(std::uint16_t a, std::uint16_t b) { return a == b; }
inline bool same(Rgba8 a, Rgba8 b) { return a == b; }
inline bool same(Voxel a, Voxel b) { return a == b; }
inline bool same(const Float3& a, const Float3& b) {
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

template <class T, std::size_t N>
bool same(const T (&a)[N], const T (&b)[N]) {
  for (std::size_t i = 0; i < N; ++i) {
    if (!same(a[i], b[i])) return false;
  }
  return true;
}

/// Only the outcome counts where it is not `ok`.
inline bool same(const TrackData& a, const TrackData& b) {
  if (a.outcome != b.outcome) return false;
  return a.outcome != TrackOutcome::ok || (same(a.error, b.error) && same(a.jacobian, b.jacobian));
}
inline bool same(const Reduction& a, const Reduction& b) {
  return same(a.squared_error, b.squared_error) && same(a.jt_error, b.jt_error) &&
         same(a.jt_j, b.jt_j) && same(a.inliers, b.inliers) && same(a.too_far, b.too_far) &&
         same(a.wrong_normal, b.wrong_normal) && same(a.others, b.others);
}
inline bool same(const Twist& a, const Twist& b) { return same(a.v, b.v); }
inline bool same(const Pose& a, const Pose& b) {
  for (int i = 0; i < 16; ++i) {
    if (!same(a.matrix().data()[i], b.matrix().data()[i])) return false;
  }
  return true;
}

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!same(a[i], b[i])) return false;
  }
  return true;
}
template <class T>
bool same(const Image<T>& a, const Image<T>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.count(); ++i) {
    if (!same(a.data()[i], b.data()[i])) return false;
  }
  return true;
}

inline bool same(const AlignResult& a, const AlignResult& b) {
  return same(a.T_volume_camera, b.T_volume_camera) && same(a.last, b.last) &&
         a.last_level == b.last_level && a.iterations == b.iterations;
}

template <class... T>
bool same(const std::tuple<T...>& a, const std::tuple<T...>& b) {
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    return (same(std::get<I>(a), std::get<I>(b)) && ...);
  }
  (std::index_sequence_for<T...>{});
}

}  // namespace slambench
