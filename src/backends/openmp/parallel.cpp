// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/openmp/parallel.h"

#include <fmt/format.h>

#include <latch>
#include <system_error>
#include <thread>
#include <vector>

#include "core/error.h"
#include "core/processors.h"

namespace slambench {
namespace {

/// Throws when the system does not grant so many threads at once: OpenMP's library would end the
/// process.
void require_threads(int count) {
  std::latch all(1);
  std::vector<std::jthread> others;
  try {
    for (int i = 1; i < count; ++i) others.emplace_back([&all] { all.wait(); });
  } catch (const std::system_error& error) {
    all.count_down();
    throw UnavailableError(
        fmt::format("threads: the system grants {} of {} ({}); --threads sets how many",
                    others.size() + 1, count, error.code().message()));
  }
  all.count_down();
}

}  // namespace

Parallel::Parallel(int threads) : threads_(threads > 0 ? threads : usable_processors()) {
  require_threads(threads_);
}

}  // namespace slambench
