// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

namespace slambench {

/// Lets OpenMP's threads wait asleep after some ten microseconds, unless the user's environment
/// says otherwise. By default libgomp's threads spin for milliseconds, which on a shared machine
/// costs many times what it gains. It reads its environment before main, so this sets the
/// variables and starts the program anew, once; where that is refused, the run goes on as it is.
void let_threads_sleep(char** argv);

}  // namespace slambench
