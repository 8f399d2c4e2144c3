// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/sampling_thread.h"

#include <pthread.h>
#include <signal.h>

#include <chrono>

namespace slambench {

SamplingThread::SamplingThread(Sampler& sampler) : sampler_(sampler) {
  // Signals are for the thread that waits for them.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  const auto restore = [&] { pthread_sigmask(SIG_SETMASK, &before, nullptr); };
  try {
    thread_ = std::thread([this] { run(); });
  } catch (...) {
    restore();
    throw;
  }
  restore();
}

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
