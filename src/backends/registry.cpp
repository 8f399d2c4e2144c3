// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/registry.h"

#include <fmt/format.h>

#include <optional>

#include "backends/cuda/cuda_backend.h"
#include "backends/opencl/opencl.h"
#include "backends/openmp/openmp_backend.h"
#include "backends/serial/serial_backend.h"
#include "core/error.h"

namespace slambench {
namespace {

std::string lower(std::string_view text) {
  std::string letters(text);
  for (char& c : letters) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return letters;
}

/// A device is named by its index or a part of its name, whatever the case of letters; a number is
/// an index. Not named, it is the first. None: there is no such device.
std::optional<int> device_index(const std::vector<std::string>& devices,
                                const std::string& wanted) {
  if (wanted.empty()) return 0;
  const bool is_index = wanted.find_first_not_of("0123456789") == std::string::npos;
  int index = 0;
  for (const std::string& device : devices) {
    const bool is_part = lower(device).find(lower(wanted)) != std::string::npos;
    if (is_index ? wanted == std::to_string(index) : is_part) return index;
    ++index;
  }
  return std::nullopt;
}

constexpr BackendEntry table[] = {
    {"serial", "plain sequential C++: the reference", [] { return Availability{}; },
     [] { return std::vector<std::string>{SerialBackend().device()}; },
     [](const BackendOptions&) -> std::unique_ptr<Backend> {
       return std::make_unique<SerialBackend>();
     }},
    {"opencl", "any device with a driver for OpenCL 1.2",
     [] {
       const std::string obstacle = opencl_obstacle();
       return Availability{obstacle.empty(), obstacle};
     },
     opencl_devices,
     [](const BackendOptions& options) {
       return make_opencl_backend(device_index(opencl_devices(), options.device).value_or(0),
                                  options.opencl);
     }},
    {"openmp", "threads and SIMD on the host", [] { return Availability{}; },
     [] { return std::vector<std::string>{OpenmpBackend(1).device()}; },
     [](const BackendOptions& options) -> std::unique_ptr<Backend> {
       return std::make_unique<OpenmpBackend>(options.threads);
     }},
    {"cuda", "NVIDIA GPUs of compute capability 7.5 and later",
     [] {
       const std::string obstacle = cuda_obstacle();
       return Availability{obstacle.empty(), obstacle};
     },
     cuda_devices,
     [](const BackendOptions& options) {
       return make_cuda_backend(device_index(cuda_devices(), options.device).value_or(0));
     }},
};

void check_device(const BackendEntry& entry, const std::string& wanted) {
  if (wanted.empty()) return;
  const std::vector<std::string> devices = entry.devices();
  if (device_index(devices, wanted)) return;
  std::string known;
  int index = 0;
  for (const std::string& device : devices) {
    known += fmt::format("{}{}: {}", known.empty() ? "" : ", ", index++, device);
  }
  throw UsageError(fmt::format("--device: found '{}', expected one of backend {}'s devices ({})",
                               wanted, entry.name, known));
}

}  // namespace

std::span<const BackendEntry> backend_table() { return table; }

std::unique_ptr<Backend> create_backend(std::string_view name, const BackendOptions& options) {
  std::string known;
  for (const BackendEntry& entry : table) {
    if (entry.name == name) {
      const Availability availability = entry.availability();
      if (!availability.available) {
        throw UnavailableError(
            fmt::format("backend {}: unavailable: {}", name, availability.reason));
      }
      check_device(entry, options.device);
      return entry.create(options);
    }
    known += known.empty() ? "" : ", ";
    known += entry.name;
  }
  throw UsageError(fmt::format("--backend: found '{}', expected one of {}", name, known));
}

}  // namespace slambench
