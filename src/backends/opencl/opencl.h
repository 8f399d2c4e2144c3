// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "backends/backend.h"
#include "backends/opencl/opencl_parameters.h"

/// What the registry needs to know of the OpenCL backend, built in or not.
namespace slambench {

/// Why the backend cannot be used here and what would help; empty when it can.
std::string opencl_obstacle();
/// Every device that can be used: GPUs, then other accelerators, then processors. Name, platform,
/// memory and driver.
std::vector<std::string> opencl_devices();
/// On the device of this index, with parameters that have passed OpenclParameters::check. Throws
/// UnavailableError when there is none, or when it lacks something.
std::unique_ptr<Backend> make_opencl_backend(int device, const OpenclParameters& parameters);

}  // namespace slambench
