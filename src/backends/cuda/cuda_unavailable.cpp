// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/cuda/cuda_backend.h"
#include "core/error.h"

/// In the place of cuda_backend.cu where there is no CUDA compiler.
namespace slambench {

std::string cuda_obstacle() {
  return "this build has no CUDA: install the CUDA toolkit (nvcc) and build again";
}

std::vector<std::string> cuda_devices() { return {}; }

std::unique_ptr<Backend> make_cuda_backend(int) { throw UnavailableError(cuda_obstacle()); }

}  // namespace slambench
