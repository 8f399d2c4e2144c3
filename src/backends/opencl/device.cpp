// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/opencl/device.h"

#include <fmt/format.h>

#include <algorithm>

#include "backends/opencl/opencl.h"

namespace slambench {
namespace {

/// Lower ones come first.
int rank(const cl::Device& device) {
  const cl_device_type type = device.getInfo<CL_DEVICE_TYPE>();
  if ((type & CL_DEVICE_TYPE_GPU) != 0) return 0;
  return (type & CL_DEVICE_TYPE_CPU) != 0 ? 2 : 1;
}

/// "OpenCL 1.2 ..." and later.
bool is_usable(const cl::Device& device) {
  const std::string version = device.getInfo<CL_DEVICE_VERSION>();
  return device.getInfo<CL_DEVICE_AVAILABLE>() != 0 &&
         device.getInfo<CL_DEVICE_COMPILER_AVAILABLE>() != 0 &&
         device.getInfo<CL_DEVICE_ENDIAN_LITTLE>() != 0 && version >= "OpenCL 1.2";
}

OpenclDevice describe(const cl::Device& device, const std::string& platform) {
  OpenclDevice d;
  d.device = device;
  d.name = device.getInfo<CL_DEVICE_NAME>();
  d.platform = platform;
  d.driver = device.getInfo<CL_DRIVER_VERSION>();
  d.memory_bytes = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  d.largest_buffer_bytes = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  d.local_bytes = device.getInfo<CL_DEVICE_LOCAL_MEM_SIZE>();
  d.is_processor = rank(device) == 2;
  d.divides_exactly =
      (device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
  return d;
}

constexpr const char* how_to_get_one =
    "install the driver of a device, or pocl-opencl-icd for the processor";

}  // namespace

std::string OpenclDevice::text() const {
  return fmt::format("{} ({}, {:.1f} GiB, driver {})", name, platform,
                     static_cast<double>(memory_bytes) / (1 << 30), driver);
}

std::vector<OpenclDevice> find_opencl_devices() {
  std::vector<OpenclDevice> found;
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  } catch (const cl::Error&) {  // the loader's way of saying that there is none
  }
  for (const cl::Platform& platform : platforms) {
    try {
      std::vector<cl::Device> devices;
      platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
      for (const cl::Device& device : devices) {
        if (is_usable(device)) {
          found.push_back(describe(device, platform.getInfo<CL_PLATFORM_NAME>()));
        }
      }
    } catch (const cl::Error&) {  // a platform without a device that works
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const OpenclDevice& a, const OpenclDevice& b) {
    return rank(a.device) < rank(b.device);
  });
  return found;
}

std::string opencl_obstacle() {
  return find_opencl_devices().empty()
             ? std::string("no OpenCL platform with a device; ") + how_to_get_one
             : "";
}

std::vector<std::string> opencl_devices() {
  std::vector<std::string> texts;
  for (const OpenclDevice& device : find_opencl_devices()) texts.push_back(device.text());
  return texts;
}

}  // namespace slambench
