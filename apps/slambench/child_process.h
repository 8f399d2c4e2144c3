// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace slambench {

/// How a child ended, and what it wrote.
struct ChildOutcome {
  int status = 0;  ///< its exit status; 128 + the signal's number when one ended it
  std::string out, err;
};

/// Runs this same program with the arguments (after the program's name, which is `name`) in a
/// process of its own, with nothing to read, and waits for its end. `tick` is called several times
/// a second; the first time it returns false, the child is asked to end (SIGTERM), which it does
/// after the frame in progress. Should this process be killed, the child is too. Throws Error when
/// no process can be started.
ChildOutcome run_child(const std::string& name, const std::vector<std::string>& arguments,
                       const std::function<bool()>& tick);

}  // namespace slambench
