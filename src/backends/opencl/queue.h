// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <CL/opencl.hpp>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "backends/opencl/device.h"
#include "backends/opencl/program.h"
#include "kernels/observer.h"

namespace slambench {

/// Throws what an error of OpenCL means to a user: UnavailableError when the device is busy or
/// has no memory left, else Error; both name the device and the call.
[[noreturn]] void throw_opencl_error(const std::string& device, const cl::Error& error);

template <class F>
decltype(auto) with_opencl_errors(const std::string& device, const F& f) {
  try {
    return f();
  } catch (const cl::Error& error) {
    throw_opencl_error(device, error);
  }
}

/// Memory on the device, accounted for as long as this or a copy of it is there.
class DeviceMemory : public cl::Buffer {
 public:
  DeviceMemory() = default;
  DeviceMemory(const cl::Buffer& buffer, std::shared_ptr<void> account)
      : cl::Buffer(buffer), account_(std::move(account)) {}

 private:
  std::shared_ptr<void> account_;
};

/// The device's queue of commands, in order: memory, transfers and launches. Knows which launches
/// belong to which call of a kernel, and their times once they are done.
class Queue {
 public:
  explicit Queue(const OpenclDevice& device);
  /// Waits: a driver must not be left at work while the program ends.
  ~Queue();
  Queue(const Queue&) = delete;
  Queue& operator=(const Queue&) = delete;

  const OpenclDevice& device() const { return device_; }
  const cl::Context& context() const { return context_; }

  /// Zeroed. Throws UnavailableError when the device has no such memory.
  DeviceMemory allocate(std::size_t bytes);
  std::size_t allocated_bytes() const { return *allocated_bytes_; }
  /// Waits until the source may change again. Writing and reading are told of as transfers.
  void write(const cl::Buffer& destination, const void* source, std::size_t bytes);
  /// Waits for everything before.
  void read(void* destination, const cl::Buffer& source, std::size_t bytes);
  /// Fills with copies of a value, whose size must divide the number of bytes.
  template <class T>
  void fill(const cl::Buffer& destination, T value, std::size_t offset, std::size_t bytes) {
    run([&](cl::Event* event) {
      queue_.enqueueFillBuffer(destination, value, offset, bytes, nullptr, event);
    });
  }
  void copy(const cl::Buffer& destination, const cl::Buffer& source, std::size_t bytes);

  /// Launches so many groups of the kernel's group size, as often as there are layers, with these
  /// arguments.
  template <class... Arguments>
  void launch_layers(DeviceKernel& kernel, std::size_t groups, std::size_t layers,
                     const Arguments&... arguments) {
    if (groups == 0) return;
    run([&](cl::Event* event) {
      cl_uint index = 0;
      (kernel.kernel.setArg(index++, arguments), ...);
      const auto group = static_cast<std::size_t>(kernel.layout.group);
      queue_.enqueueNDRangeKernel(kernel.kernel, cl::NullRange, cl::NDRange(groups * group, layers),
                                  cl::NDRange(group, 1), nullptr, event);
    });
  }
  template <class... Arguments>
  void launch_groups(DeviceKernel& kernel, std::size_t groups, const Arguments&... arguments) {
    launch_layers(kernel, groups, 1, arguments...);
  }
  /// Launches what covers so many packets.
  template <class... Arguments>
  void launch(DeviceKernel& kernel, std::size_t packets, const Arguments&... arguments) {
    launch_groups(kernel, kernel.groups(packets), arguments...);
  }

  /// Whether anybody wants to know the times of what follows.
  void measure(bool wanted) { measures_ = wanted; }
  /// Commands from now on, but for transfers, belong to a call of this kernel.
  void begin(Kernel kernel);
  /// Waits for all, and tells the observer (null: nobody) the time of each call, from the start of
  /// its first command to the end of its last, and of each transfer.
  void finish(Observer* observer);

 private:
  /// Throws UnavailableError when the device does not have so much more.
  void require_memory(std::size_t bytes) const;

  struct Call {
    Kernel kernel;
    cl::Event first, last;
  };
  struct Copy {
    Transfer direction;
    std::size_t bytes;
    cl::Event event;
  };

  template <class F>
  void run(const F& enqueue) {
    with_opencl_errors(device_.name, [&] {
      cl::Event event;
      const bool measures = measures_ && in_call_;
      enqueue(measures ? &event : nullptr);
      if (!measures) return;
      Call& call = calls_.back();
      if (call.first() == nullptr) call.first = event;
      call.last = event;
    });
  }

  /// Calls enqueue(event) of a transfer.
  template <class F>
  void transfer(Transfer direction, std::size_t bytes, const F& enqueue) {
    if (bytes == 0) return;
    with_opencl_errors(device_.name, [&] {
      cl::Event event;
      enqueue(measures_ ? &event : nullptr);
      if (measures_) copies_.push_back({direction, bytes, event});
    });
  }

  OpenclDevice device_;
  std::shared_ptr<std::size_t> allocated_bytes_;  ///< shared with the memory's accounts
  cl::Context context_;
  cl::CommandQueue queue_;
  std::vector<Call> calls_;
  std::vector<Copy> copies_;
  bool measures_ = false, in_call_ = false;
};

}  // namespace slambench
