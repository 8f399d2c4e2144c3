// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "core/image.h"
#include "kernels/float3.h"

namespace slambench {

/// The kernels of the paper (Table I), the two of start-up, and the coarser entries that a backend
/// may offer instead of several single ones. The enumerator is the kernel's one name: method,
/// file, CSV column and command-line word are spelled the same.
enum class Kernel {
  acquire,
  mm2meters,
  bilateral_filter,
  half_sample,
  depth2vertex,
  vertex2normal,
  track,
  reduce,
  solve,
  align,  ///< track, reduce and solve fused: the ICP loop in one entry
  integrate,
  raycast,
  render_depth,
  render_track,
  render_volume,
  init_volume,
  generate_gaussian,
};
inline constexpr std::size_t kernel_count = 17;

/// The building blocks of the pipeline that times are reported for (the published log's columns).
enum class Stage { acquire, preprocess, track, integrate, raycast, render, init };
inline constexpr std::size_t stage_count = 7;

/// Sizes that the cost of one call depends on.
struct ProblemSize {
  Size input;      ///< of the sensor's depth image
  Size image;      ///< that the kernel works on (its level of the pyramid)
  Int3 volume;     ///< voxels
  int radius = 2;  ///< of the bilateral filter
};

/// What one call must at least do on the flat grid: bytes moved to or from memory when every
/// array is touched once, and floating-point operations (a fused multiply-add counts two,
/// division, square root and exponential count one).
struct Cost {
  double bytes = 0;
  double flops = 0;
};

/// One row of the table that timing, command line, tests, benchmarks and docs read.
struct KernelInfo {
  Kernel kernel;
  std::string_view name;
  std::string_view paper_name;  ///< the paper's spelling; empty for what the paper does not have
  Stage stage;
  std::string_view pattern;  ///< parallel pattern, in the paper's terms
  std::string_view in, out;  ///< shapes, in the paper's terms
  Cost (*cost)(const ProblemSize&);
  std::string_view sentence;
};

/// In pipeline order; row i describes the kernel with value i.
std::span<const KernelInfo, kernel_count> kernel_table();
const KernelInfo& info(Kernel kernel);
std::string_view name(Kernel kernel);
std::string_view name(Stage stage);
std::optional<Kernel> kernel_from_name(std::string_view name);

}  // namespace slambench
