// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cmath>

/// Marks what compiles for the host and for a CUDA device alike.
#if defined(__CUDACC__)
#define SLAMBENCH_HD __host__ __device__
#else
#define SLAMBENCH_HD
#endif

namespace slambench {

/// Three floats without padding: the element of vertex and normal maps on every backend.
/// Sums run from left to right: the order is part of the contract, so that SIMD and device code
/// can reproduce it. (Eigen, used everywhere above the kernels, fixes neither.)
struct Float3 {
  float x = 0, y = 0, z = 0;
  friend bool operator==(const Float3&, const Float3&) = default;
};

struct Int3 {
  int x = 0, y = 0, z = 0;
  friend bool operator==(const Int3&, const Int3&) = default;
};

SLAMBENCH_HD inline Float3 operator+(Float3 a, Float3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
SLAMBENCH_HD inline Float3 operator-(Float3 a, Float3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
SLAMBENCH_HD inline Float3 operator*(Float3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }

SLAMBENCH_HD inline float dot(Float3 a, Float3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
SLAMBENCH_HD inline Float3 cross(Float3 a, Float3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
SLAMBENCH_HD inline float length(Float3 a) { return sqrtf(dot(a, a)); }
/// Undefined (NaN) for the zero vector.
SLAMBENCH_HD inline Float3 normalized(Float3 a) { return a * (1.0f / length(a)); }

/// A rigid transform in single precision: rows of the rotation, and the translation.
struct Rigid3f {
  Float3 row0{1, 0, 0}, row1{0, 1, 0}, row2{0, 0, 1};
  Float3 translation;

  SLAMBENCH_HD Float3 rotate(Float3 v) const { return {dot(row0, v), dot(row1, v), dot(row2, v)}; }
  SLAMBENCH_HD Float3 apply(Float3 p) const { return rotate(p) + translation; }
};

}  // namespace slambench
