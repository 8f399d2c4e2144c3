// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/registry.h"

#include <fmt/format.h>

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

/// The index of the wanted device: named by its index or a part of its name, whatever the case of
/// letters; a number is an index. Not named, it is the first. Throws UsageError when there is none.
int device_index(const BackendEntry& entry, const std::string& wanted) {
  if (wanted.empty()) return 0;
  const bool is_index = wanted.find_first_not_of("0123456789") == std::string::npos;
  std::string known;
  int index = 0;
  for (const std::string& device : entry.devices()) {
    const bool is_part = lower(device).find(lower(wanted)) != std::string::npos;
    if (is_index ? wanted == std::to_string(index) : is_part) return index;
    known += fmt::format("{}{}: {}", known.empty() ? "" : ", ", index++, device);
  }
  throw UsageError(fmt::format("--device: found '{}', expected one of backend {}'s devices ({})",
                               wanted, entry.name, known));
}

/// Available when nothing stands in the way.
Availability unless(const std::string& obstacle) { return {obstacle.empty(), obstacle}; }

constexpr BackendEntry table[] = {
    {"serial", "plain sequential C++: the reference", [] { return Availability{}; },
     [] { return std::vector<std::string>{SerialBackend().device()}; },
     [](const BackendOptions&, int) -> std::unique_ptr<Backend> {
       return std::make_unique<SerialBackend>();
     }},
    {"opencl", "any device with a driver for OpenCL 1.2", [] { return unless(opencl_obstacle()); },
     opencl_devices,
     [](const BackendOptions& options, int device) {
       return make_opencl_backend(device, options.opencl);
     }},
    {"openmp", "threads and SIMD on the host", [] { return Availability{}; },
     [] { return std::vector<std::string>{OpenmpBackend(1).device()}; },
     [](const BackendOptions& options, int) -> std::unique_ptr<Backend> {
       return std::make_unique<OpenmpBackend>(options.threads);
     }},
    {"cuda", "NVIDIA GPUs of compute capability 7.5 and later",
     [] { return unless(cuda_obstacle()); }, cuda_devices,
     [](const BackendOptions&, int device) { return make_cuda_backend(device); }},
};

}  // namespace

std::span<const BackendEntry> backend_table() { return table; }

std::unique_ptr<Backend> create_backend(std::string_view name, const BackendOptions& options) {
  options.check();
  std::string known;
  for (const BackendEntry& entry : table) {
    if (entry.name == name) {
      const Availability availability = entry.availability();
      if (!availability.available) {
        throw UnavailableError(
            fmt::format("backend {}: unavailable: {}", name, availability.reason));
      }
      return entry.create(options, device_index(entry, options.device));
    }
    known += known.empty() ? "" : ", ";
    known += entry.name;
  }
  throw UsageError(fmt::format("--backend: found '{}', expected one of {}", name, known));
}

}  // namespace slambench
