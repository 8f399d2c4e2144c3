// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>

#include "meters/clock.h"

namespace slambench {

/// What this machine's cores reach at best, measured: the ceilings of the roofline model (Williams
/// et al. 2009) that kernels are held against.
struct MachineCeiling {
  int threads = 0;
  /// Read and written bytes of copying arrays far larger than the caches (STREAM's Copy, which
  /// counts both directions).
  double copy_bytes_per_s = 0;
  /// Single precision, from registers; a fused multiply-add counts two.
  double fma_flops_per_s = 0;
  std::string instruction_set;  ///< that the second figure was reached with
};

/// Measures for about a second on as many threads, 0: all cores that this process may use; the best
/// of many rounds, as what disturbs only ever slows down. Takes 512 MiB of memory while it runs;
/// throws UnavailableError when there is less.
MachineCeiling measure_machine(const Clock& clock, int threads);

}  // namespace slambench
