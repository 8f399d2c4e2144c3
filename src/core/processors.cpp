// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "core/processors.h"

#include <sched.h>

#include <algorithm>
#include <thread>

namespace slambench {

int usable_processors() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0) return std::max(1, CPU_COUNT(&set));
  // More processors than the set can name.
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace slambench
