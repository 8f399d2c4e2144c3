// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/cuda/cuda_backend.h"

#include "backends/cuda/cuda_launch.h"
#include "backends/cuda/device_backend.h"

namespace slambench {

std::unique_ptr<Backend> make_cuda_backend(int device) {
  return std::make_unique<cuda::DeviceBackend<cuda::CudaLaunch>>(
      std::make_shared<cuda::CudaLaunch>(device));
}

}  // namespace slambench
