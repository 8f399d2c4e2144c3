// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "interrupt.h"

#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "terminal.h"

namespace slambench {
namespace {

constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP};

// A signal handler can reach nothing but statics.
std::atomic<bool> flag = false, tells = false;
static_assert(std::atomic<bool>::is_always_lock_free);

/// What the caller told the process to ignore (nohup, a shell's background job) stays ignored.
void set_handlers(void (*handler)(int)) {
  for (const int signal : signals) {
    if (std::signal(signal, handler) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

extern "C" void raise_flag(int) {
  const int error = errno;
  flag.store(true);
  set_handlers(SIG_DFL);
  if (tells.load()) {
    constexpr char text[] =
        "\r\033[Kslambench: ending with what there is once the step in progress is done; interrupt "
        "again to end at once, without results\n";
    [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, text, sizeof text - 1);
  }
  errno = error;
}

}  // namespace

InterruptFlag::InterruptFlag() {
  flag.store(false);
  tells.store(error_is_terminal());
  set_handlers(raise_flag);
}

InterruptFlag::~InterruptFlag() { set_handlers(SIG_DFL); }

const std::atomic<bool>& InterruptFlag::raised() const { return flag; }

}  // namespace slambench
