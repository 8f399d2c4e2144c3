// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/opencl/opencl.h"
#include "core/error.h"

namespace slambench {

std::string opencl_obstacle() {
  return "this build has no OpenCL; install ocl-icd-opencl-dev and opencl-clhpp-headers and "
         "configure again";
}

std::vector<std::string> opencl_devices() { return {}; }

std::unique_ptr<Backend> make_opencl_backend(int, const OpenclParameters&) {
  throw UnavailableError("backend opencl: " + opencl_obstacle());
}

}  // namespace slambench
