// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace slambench {

/// Calls body(i) once for each i in [0, count), in any order, from `threads` threads at once, or as
/// many as the system grants. The first exception ends the loop early and is thrown to the caller.
template <class Body>
void parallel_for(int count, int threads, const Body& body) {
  std::atomic<int> next = 0;
  std::exception_ptr failure;
  std::mutex failing;
  const auto work = [&] {
    try {
      for (int i = next++; i < count; i = next++) body(i);
    } catch (...) {
      next = count;
      const std::scoped_lock lock(failing);
      if (!failure) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> helpers;
    try {
      for (int i = 1; i < std::min(threads, count); ++i) helpers.emplace_back(work);
    } catch (const std::system_error&) {
      // No more of them: those that there are do all the work.
    }
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace slambench
