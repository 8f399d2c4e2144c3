// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <algorithm>

#if defined(SLAMBENCH_STD_THREADS)
#include <atomic>
#include <thread>
#include <vector>
#endif

namespace slambench {

/// Parallel loops over chunks of [0, count). Chunks are cut the same way whatever the number of
/// threads, so that work whose result is kept per chunk does not depend on it.
class Parallel {
 public:
  /// 0: one thread per core that this process may use. Throws UnavailableError when the system does
  /// not grant them.
  explicit Parallel(int threads);

  int threads() const { return threads_; }

  /// Calls f(begin, end) for every chunk of at most `grain` in any order; f must not throw.
  template <class F>
  void for_chunks(int count, int grain, const F& f) const {
    const int chunks = (count + grain - 1) / grain;
    const auto run = [&](int chunk) { f(chunk * grain, std::min(count, chunk * grain + grain)); };
    if (threads_ == 1 || chunks <= 1) {
      for (int chunk = 0; chunk < chunks; ++chunk) run(chunk);
      return;
    }
#if defined(SLAMBENCH_STD_THREADS)
    std::atomic<int> next = 0;
    const auto work = [&] {
      for (int chunk = next++; chunk < chunks; chunk = next++) run(chunk);
    };
    std::vector<std::thread> others;
    for (int i = 1; i < std::min(threads_, chunks); ++i) others.emplace_back(work);
    work();
    for (std::thread& other : others) other.join();
#else
#pragma omp parallel for num_threads(threads_) schedule(dynamic, 1)
    for (int chunk = 0; chunk < chunks; ++chunk) run(chunk);
#endif
  }

 private:
  int threads_;
};

}  // namespace slambench
