// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include "backends/cuda/cuda_backend.h"
#include "backends/cuda/cuda_device.h"

namespace slambench {

std::string cuda_obstacle() {
  int driver = 0, runtime = 0, count = 0;
  if (cudaDriverGetVersion(&driver) != cudaSuccess || driver == 0) {
    return "no CUDA driver on this machine";
  }
  const cudaError_t status = cudaGetDeviceCount(&count);
  cudaGetLastError();
  if (status == cudaErrorInsufficientDriver && cudaRuntimeGetVersion(&runtime) == cudaSuccess) {
    return fmt::format("the driver is for CUDA {}.{}, expected {}.{} at least", driver / 1000,
                       driver % 1000 / 10, runtime / 1000, runtime % 1000 / 10);
  }
  if (status == cudaErrorNoDevice || (status == cudaSuccess && count == 0)) {
    return "no CUDA device on this machine";
  }
  if (status != cudaSuccess) {
    return fmt::format("no CUDA device can be used: {}", cudaGetErrorString(status));
  }
  return "";
}

std::vector<std::string> cuda_devices() {
  int count = 0;
  SLAMBENCH_CUDA(cudaGetDeviceCount(&count));
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(count));
  for (int device = 0; device < count; ++device) names.push_back(cuda::device_name(device));
  return names;
}

}  // namespace slambench
