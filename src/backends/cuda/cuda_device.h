// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cuda_runtime.h>

#include <string>
#include <vector>

#include "kernels/observer.h"

/// What CUDA's runtime does for the host: devices, memory, clocks, errors. Needs no CUDA compiler.
namespace slambench::cuda {

/// Model, compute capability, multiprocessors and highest clocks.
std::string device_name(int device);
/// Versions of the driver and of the runtime that is part of this program.
std::string driver_name();

/// Throws when a call of CUDA's did not succeed: UnavailableError when the device lacks memory or
/// cannot run this build, Error (failed) otherwise. The message names call, file and line.
void check(cudaError_t status, const char* call, const char* file, int line);
#define SLAMBENCH_CUDA(call) ::slambench::cuda::check((call), #call, __FILE__, __LINE__)

/// A device with a stream that everything runs in, in order: all of the Launch of device_backend.h
/// but for the launches.
class CudaDevice {
 public:
  explicit CudaDevice(int device);
  ~CudaDevice();
  CudaDevice(const CudaDevice&) = delete;
  CudaDevice& operator=(const CudaDevice&) = delete;

  std::string device() const { return device_name(index_); }
  std::string driver() const { return driver_name(); }
  int processors() const { return processors_; }

  void* allocate(std::size_t bytes);
  void release(void* data, std::size_t bytes) noexcept;
  std::size_t allocated_bytes() const { return allocated_bytes_; }
  void upload(void* device, const void* host, std::size_t bytes);
  void download(void* host, const void* device, std::size_t bytes);
  void fetch(void* host, const void* device, std::size_t bytes);
  void finish();
  void begin(Kernel kernel);
  void end(Kernel kernel);
  void begin(Transfer direction, std::size_t bytes);
  void end(Transfer direction);
  void report(Observer* observer);

 protected:
  /// Of this device, which it makes the calling thread's current one.
  cudaStream_t stream();

 private:
  /// Pinned memory of the host on its way to or from the device.
  struct Stage {
    unsigned char* memory = nullptr;
    cudaEvent_t free = nullptr;  ///< recorded behind its last use
  };
  /// A part of a stage's memory that is to go on to the host's.
  struct Arrival {
    void* host = nullptr;
    const void* memory = nullptr;
    std::size_t bytes = 0;
  };
  struct Span {
    cudaEvent_t begin, end;
  };
  struct Call {
    Kernel kernel;
    Span span;
  };
  struct Copy {
    Transfer direction;
    std::size_t bytes;
    Span span;
  };

  /// The stage that was used longer ago, once it is free. Finishes what is being fetched.
  const Stage& next_stage();
  cudaEvent_t timed_event();
  /// A span that begins here in the stream.
  Span begun_span();
  /// Its duration, once it is done; its events are free again.
  double seconds_of(const Span& span);
  void destroy() noexcept;

  int index_, processors_ = 0;
  std::size_t allocated_bytes_ = 0;
  cudaStream_t stream_ = nullptr;
  Stage stages_[2];
  int stage_ = 0;
  Arrival arrival_;  ///< of the fetch that nobody has waited for yet
  std::vector<Call> calls_;
  std::vector<Copy> copies_;
  std::vector<cudaEvent_t> idle_events_;
};

}  // namespace slambench::cuda
