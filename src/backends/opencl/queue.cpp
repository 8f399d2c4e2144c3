// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/opencl/queue.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "core/error.h"

namespace slambench {
namespace {

/// From the start of one command to the end of another, or the same; both are done.
double seconds_between(const cl::Event& first, const cl::Event& last) {
  const auto begin = first.getProfilingInfo<CL_PROFILING_COMMAND_START>();
  const auto end = last.getProfilingInfo<CL_PROFILING_COMMAND_END>();
  return static_cast<double>(end - begin) * 1e-9;
}

}  // namespace

void throw_opencl_error(const std::string& device, const cl::Error& error) {
  const std::string call = fmt::format("{} (error {})", error.what(), error.err());
  switch (error.err()) {
    case CL_MEM_OBJECT_ALLOCATION_FAILURE:
    case CL_OUT_OF_RESOURCES:
    case CL_OUT_OF_HOST_MEMORY:
    case CL_INVALID_BUFFER_SIZE:
      throw UnavailableError(
          fmt::format("opencl: {} has no memory or resources left: {}", device, call));
    case CL_DEVICE_NOT_AVAILABLE:
      throw UnavailableError(fmt::format(
          "opencl: {} is not available, another program may hold it: {}", device, call));
    default:
      throw Error(ExitStatus::failed, fmt::format("opencl: {} failed: {}", device, call));
  }
}

Queue::Queue(const OpenclDevice& device)
    : device_(device), allocated_bytes_(std::make_shared<std::size_t>(0)) {
  with_opencl_errors(device_.name, [&] {
    context_ = cl::Context(device_.device);
    queue_ = cl::CommandQueue(context_, device_.device, CL_QUEUE_PROFILING_ENABLE);
  });
}

Queue::~Queue() {
  try {
    queue_.finish();
  } catch (const cl::Error&) {  // nobody is left to tell
  }
}

void Queue::require_memory(std::size_t bytes) const {
  if (bytes > device_.largest_buffer_bytes) {
    throw UnavailableError(
        fmt::format("opencl: found a buffer of {} MiB, expected at most {} on {}", bytes >> 20,
                    device_.largest_buffer_bytes >> 20, device_.name));
  }
  // A driver may only find out when it uses the memory, and then not tell.
  const std::size_t left = device_.memory_bytes - std::min(device_.memory_bytes, allocated_bytes());
  if (bytes > left) {
    throw UnavailableError(
        fmt::format("opencl: found a buffer of {} MiB, expected at most the {} left of {} on {}",
                    bytes >> 20, left >> 20, device_.memory_bytes >> 20, device_.name));
  }
}

DeviceMemory Queue::allocate(std::size_t bytes) {
  bytes = std::max<std::size_t>(bytes, 4);
  require_memory(bytes);
  // On a processor the memory is the host's, and is asked for now rather than when it is used.
  const cl_mem_flags where = device_.is_processor ? CL_MEM_ALLOC_HOST_PTR : 0;
  return with_opencl_errors(device_.name, [&] {
    cl::Buffer buffer(context_, CL_MEM_READ_WRITE | where, bytes);
    queue_.enqueueFillBuffer(buffer, std::uint8_t{0}, 0, bytes);
    *allocated_bytes_ += bytes;
    const auto give_back = [in_use = allocated_bytes_, bytes](void*) { *in_use -= bytes; };
    return DeviceMemory(buffer, std::shared_ptr<void>(nullptr, give_back));
  });
}

void Queue::write(const cl::Buffer& destination, const void* source, std::size_t bytes) {
  transfer(Transfer::to_device, bytes, [&](cl::Event* event) {
    queue_.enqueueWriteBuffer(destination, CL_TRUE, 0, bytes, source, nullptr, event);
  });
}

void Queue::read(void* destination, const cl::Buffer& source, std::size_t bytes) {
  transfer(Transfer::to_host, bytes, [&](cl::Event* event) {
    queue_.enqueueReadBuffer(source, CL_TRUE, 0, bytes, destination, nullptr, event);
  });
}

void Queue::copy(const cl::Buffer& destination, const cl::Buffer& source, std::size_t bytes) {
  run([&](cl::Event* event) {
    queue_.enqueueCopyBuffer(source, destination, 0, 0, bytes, nullptr, event);
  });
}

void Queue::begin(Kernel kernel) {
  in_call_ = true;
  if (measures_) calls_.push_back({kernel, {}, {}});
}

void Queue::finish(Observer* observer) {
  in_call_ = false;
  with_opencl_errors(device_.name, [&] {
    queue_.finish();
    if (observer == nullptr) return;
    for (const Call& call : calls_) {
      if (call.first() == nullptr) continue;
      observer->kernel_measured(call.kernel, seconds_between(call.first, call.last));
    }
    for (const Copy& copy : copies_) {
      observer->transfer_measured(copy.direction, copy.bytes,
                                  seconds_between(copy.event, copy.event));
    }
  });
  calls_.clear();
  copies_.clear();
}

}  // namespace slambench
