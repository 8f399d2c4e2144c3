// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <pthread.h>
#include <signal.h>

#include <thread>
#include <utility>

namespace slambench {

/// Starts a thread that gets no signals: they are for the thread that waits for them.
template <class F>
std::thread quiet_thread(F run) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  const auto restore = [&] { pthread_sigmask(SIG_SETMASK, &before, nullptr); };
  try {
    std::thread thread(std::move(run));
    restore();
    return thread;
  } catch (...) {
    restore();
    throw;
  }
}

}  // namespace slambench
