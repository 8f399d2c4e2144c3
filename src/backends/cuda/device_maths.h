// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>

#include "core/image.h"
#include "kernels/float3.h"

/// Small things that kernels need on the device and, in tests, on the host.
namespace slambench::cuda {

SLAMBENCH_HD inline int least(int a, int b) { return a < b ? a : b; }
SLAMBENCH_HD inline int greatest(int a, int b) { return a < b ? b : a; }

/// The number of parts of that size that cover a count.
SLAMBENCH_HD inline int parts_of(int count, int size) { return (count + size - 1) / size; }
SLAMBENCH_HD inline Size tiles_of(Size image, int edge) {
  return {parts_of(image.width, edge), parts_of(image.height, edge)};
}

SLAMBENCH_HD inline int pixel_index(Size size, int x, int y) { return y * size.width + x; }

/// Adds to a counter that other threads of the grid add to; returns what it was.
SLAMBENCH_HD inline int atomic_add(int* counter, int value) {
#if defined(__CUDA_ARCH__)
  return atomicAdd(counter, value);
#else
  const int old = *counter;
  *counter += value;
  return old;
#endif
}

/// Lowers a value that is not negative, and that other threads of the grid lower: their bits are
/// in the order of their values.
SLAMBENCH_HD inline void atomic_lower(float* least_value, float value) {
#if defined(__CUDA_ARCH__)
  atomicMin(reinterpret_cast<int*>(least_value), __float_as_int(value));
#else
  if (value < *least_value) *least_value = value;
#endif
}

}  // namespace slambench::cuda
