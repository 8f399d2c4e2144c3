// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/sampling_thread.h"

#include <chrono>

#include "core/quiet_thread.h"

namespace slambench {

SamplingThread::SamplingThread(Sampler& sampler)
    : sampler_(sampler), thread_(quiet_thread([this] { run(); })) {}

SamplingThread::~SamplingThread() { stop(); }

double SamplingThread::stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
  return cpu_s_;
}

void SamplingThread::run() {
  const std::chrono::duration<double> interval(sampler_.interval_s());
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, interval, [this] { return stop_; })) {
    lock.unlock();
    sampler_.sample();
    lock.lock();
  }
  cpu_s_ = thread_cpu_s();
}

}  // namespace slambench
