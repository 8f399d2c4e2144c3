// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

namespace slambench {

/// Logical processors that this process may use; 1 at least.
int usable_processors();

}  // namespace slambench
