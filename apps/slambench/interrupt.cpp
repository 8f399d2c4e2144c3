// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "interrupt.h"

#include <csignal>

namespace slambench {
namespace {

// A signal handler can reach nothing but statics.
std::atomic<bool> flag = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void set_handlers(void (*handler)(int)) {
  std::signal(SIGINT, handler);
  std::signal(SIGTERM, handler);
}

extern "C" void raise_flag(int) {
  flag.store(true);
  set_handlers(SIG_DFL);
}

}  // namespace

InterruptFlag::InterruptFlag() {
  flag.store(false);
  set_handlers(raise_flag);
}

InterruptFlag::~InterruptFlag() { set_handlers(SIG_DFL); }

const std::atomic<bool>& InterruptFlag::raised() const { return flag; }

}  // namespace slambench
