// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "meters/sampler.h"

namespace slambench {

/// Calls Sampler::sample() at its interval from a thread of its own, for as long as it lives. The
/// sampler belongs to that thread meanwhile.
class SamplingThread {
 public:
  explicit SamplingThread(Sampler& sampler);
  ~SamplingThread();
  SamplingThread(const SamplingThread&) = delete;
  SamplingThread& operator=(const SamplingThread&) = delete;

  /// Ends it, at once. Returns the processor time that the thread took.
  double stop();

 private:
  void run();

  Sampler& sampler_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;
  double cpu_s_ = 0;
  std::thread thread_;
};

}  // namespace slambench
