// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <CL/opencl.hpp>
#include <string>
#include <vector>

namespace slambench {

/// A device of OpenCL 1.2 or later that has a compiler.
// The bindings do not promise that a move throws nothing. NOLINTNEXTLINE(bugprone-exception-escape)
struct OpenclDevice {
  cl::Device device;
  std::string name, platform, driver;
  std::size_t memory_bytes = 0, largest_buffer_bytes = 0, local_bytes = 0;
  bool is_processor = false;     ///< the host's own: its memory is ours, its lanes are SIMD
  bool divides_exactly = false;  ///< division and square root round correctly when asked to
  std::string text() const;      ///< for people: name, platform, memory, driver
};

/// GPUs, then other accelerators, then processors; none when there is no platform.
std::vector<OpenclDevice> find_opencl_devices();

}  // namespace slambench
