// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/registry.h"

namespace slambench {

ParameterList BackendOptions::describe() {
  std::vector<std::string_view> names;
  for (const BackendEntry& entry : backend_table()) names.push_back(entry.name);
  return with_role(
      ParameterRole::implementation,
      {
          "backend",
          {
              {"backend", 0, "", &backend, 0, 0,
               "which implementation of the kernels runs; the preset fast takes the quickest",
               names},
              {"device", 0, "", &device, 0, 0,
               "index or part of the name of the device it runs on"},
              {"threads", 0, "", &threads, 0, 4096, "threads of a host backend; 0: one per core"},
          },
      });
}

void BackendOptions::check() const { opencl.check(); }

}  // namespace slambench
