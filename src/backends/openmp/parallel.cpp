// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/openmp/parallel.h"

#include <sched.h>

#include <thread>

namespace slambench {
namespace {

int usable_cores() {
  cpu_set_t cores;
  if (sched_getaffinity(0, sizeof(cores), &cores) == 0) return std::max(1, CPU_COUNT(&cores));
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace

Parallel::Parallel(int threads) : threads_(threads > 0 ? threads : usable_cores()) {}

}  // namespace slambench
