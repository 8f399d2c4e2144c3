// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "backends/backend.h"

namespace slambench {

/// Why the CUDA backend cannot be used here; empty when it can.
std::string cuda_obstacle();

/// What each device that it can run on is called, in the order of their indices. None when there
/// is an obstacle.
std::vector<std::string> cuda_devices();

/// On the device of that index. Throws UnavailableError when the device cannot run this build's
/// code, or has no memory left.
std::unique_ptr<Backend> make_cuda_backend(int device);

}  // namespace slambench
