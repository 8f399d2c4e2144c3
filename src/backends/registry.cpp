// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/registry.h"

#include <fmt/format.h>

#include "backends/openmp/openmp_backend.h"
#include "backends/serial/serial_backend.h"
#include "core/error.h"

namespace slambench {
namespace {

constexpr BackendEntry table[] = {
    {"serial", "plain sequential C++: the reference", [] { return Availability{}; },
     [] { return std::vector<std::string>{SerialBackend().device()}; },
     [](const BackendOptions&) -> std::unique_ptr<Backend> {
       return std::make_unique<SerialBackend>();
     }},
    {"openmp", "threads and SIMD on the host", [] { return Availability{}; },
     [] { return std::vector<std::string>{OpenmpBackend(1).device()}; },
     [](const BackendOptions& options) -> std::unique_ptr<Backend> {
       return std::make_unique<OpenmpBackend>(options.threads);
     }},
};

std::string lower(std::string_view text) {
  std::string letters(text);
  for (char& c : letters) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return letters;
}

/// A device is named by its index or a part of its name, whatever the case of letters.
void check_device(const BackendEntry& entry, const std::string& wanted) {
  if (wanted.empty()) return;
  std::string known;
  int index = 0;
  for (const std::string& device : entry.devices()) {
    if (wanted == std::to_string(index) || lower(device).find(lower(wanted)) != std::string::npos) {
      return;
    }
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
