// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <CL/opencl.hpp>
#include <cstddef>
#include <map>
#include <string>

#include "backends/opencl/device.h"
#include "backends/opencl/opencl_parameters.h"

namespace slambench {

/// A kernel ready to be launched, and its layout.
struct DeviceKernel {
  cl::Kernel kernel;
  KernelLayout layout;

  /// Packets of lanes that cover so many elements.
  std::size_t packets(int count) const {
    return static_cast<std::size_t>((count + layout.lanes - 1) / layout.lanes);
  }
  /// Groups that cover so many packets.
  std::size_t groups(std::size_t packets) const {
    const auto each =
        static_cast<std::size_t>(layout.group) * static_cast<std::size_t>(layout.packets);
    return (packets + each - 1) / each;
  }
};

/// Builds kernels when they are first asked for. What the compiler made is kept in the user's
/// cache, under the device, the driver, the options and the text it was made of.
class Programs {
 public:
  Programs(cl::Context context, OpenclDevice device, OpenclParameters parameters);

  /// The kernel of kernels/NAME.cl with these macros ("-DNAME=VALUE ..."). Throws Error with the
  /// compiler's log, UnavailableError when the kernel does not fit on the device.
  DeviceKernel& get(const std::string& name, const std::string& macros = "");

 private:
  DeviceKernel build(const std::string& name, const std::string& macros) const;
  void require_fits(const std::string& name, const DeviceKernel& kernel) const;

  cl::Context context_;
  OpenclDevice device_;
  OpenclParameters parameters_;
  std::map<std::string, DeviceKernel> kernels_;
};

}  // namespace slambench
