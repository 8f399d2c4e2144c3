// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "backends/backend.h"
#include "backends/opencl/opencl_parameters.h"
#include "core/parameter.h"

namespace slambench {

/// Whether something can be used here, and if not, why and what would help.
struct Availability {
  bool available = true;
  std::string reason;
};

/// What a user chose about the backend.
struct BackendOptions {
  std::string backend = "serial";  ///< a name in the table
  std::string device;              ///< index or a part of the name; empty: the first
  int threads = 0;                 ///< of a host backend; 0: all
  OpenclParameters opencl;         ///< has a list of its own

  ParameterList describe();
  /// Throws UsageError for what no device can change: whichever backend is chosen, its own or not.
  void check() const;
};

/// One line of the table of backends.
struct BackendEntry {
  std::string_view name;
  std::string_view sentence;
  Availability (*availability)();
  std::vector<std::string> (*devices)();
  std::unique_ptr<Backend> (*create)(const BackendOptions&, int device);  ///< an index
};

/// Every backend this project has, slowest first, whether built in or not: what is not says so.
/// `opencl` stands before `openmp`, which is quicker on the same processor and always there: nobody
/// who did not ask for OpenCL has its drivers loaded, with their threads and signal handlers.
std::span<const BackendEntry> backend_table();

/// Throws UsageError for an unknown name (and lists the known) and for options that fail
/// BackendOptions::check; UnavailableError with the reason for one that cannot be used here.
std::unique_ptr<Backend> create_backend(std::string_view name, const BackendOptions& options);

}  // namespace slambench
