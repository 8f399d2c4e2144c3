// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <atomic>

namespace slambench {

/// While one lives, the first SIGINT, SIGTERM or SIGHUP only raises a flag, says so on a terminal,
/// and makes the second end the process at once. A signal that is ignored when one is made stays
/// ignored. At most one lives at a time.
class InterruptFlag {
 public:
  InterruptFlag();
  ~InterruptFlag();
  InterruptFlag(const InterruptFlag&) = delete;
  InterruptFlag& operator=(const InterruptFlag&) = delete;

  const std::atomic<bool>& raised() const;
};

}  // namespace slambench
