// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/parameter.h"

namespace slambench {

/// How a kernel is laid out on a device: work-items of a group, elements (lanes) that a work-item
/// computes at once, and packets of so many elements that it takes one after the other.
struct KernelLayout {
  int group = 0, lanes = 0, packets = 0;
};

/// The design space of the OpenCL kernels; the same results everywhere in it.
struct OpenclParameters {
  OpenclParameters();

  /// Group, lanes, packets per work-item of each kernel; 0: what suits the device.
  std::vector<std::array<int, 3>> layouts;
  /// Further options of the compiler: for every kernel, and after them each kernel's own.
  std::string build_options;
  std::vector<std::string> kernel_build_options;

  ParameterList describe();
  /// Of kernels/NAME.cl, with the defaults of the kind of device filled in. Throws UsageError for
  /// one that this kernel cannot have.
  KernelLayout layout(std::string_view name, bool on_processor) const;
  /// Throws the same for the first of all kernels, and for build options that define what the
  /// program defines itself or that end where a name has to follow; whatever the device.
  void check() const;
  /// All that a user has for the compiler of kernels/NAME.cl. Of two that contradict each other
  /// compilers take the later: the kernel's own.
  std::string build_options_of(std::string_view name) const;

 private:
  void check_layout(std::size_t row) const;
};

}  // namespace slambench
