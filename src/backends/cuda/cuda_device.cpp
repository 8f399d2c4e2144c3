// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/cuda/cuda_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <string_view>
#include <utility>

#include "core/error.h"

namespace slambench::cuda {
namespace {

/// Of a part of an upload or download: the depth image of a frame fits in one.
constexpr std::size_t stage_bytes = std::size_t{4} << 20;

/// Whether it is the machine that falls short, not the program.
bool is_unavailable(cudaError_t status) {
  constexpr cudaError_t all[] = {
      cudaErrorMemoryAllocation,      cudaErrorInsufficientDriver, cudaErrorNoDevice,
      cudaErrorDevicesUnavailable,    cudaErrorInvalidDevice,      cudaErrorNoKernelImageForDevice,
      cudaErrorUnsupportedPtxVersion, cudaErrorInitializationError};
  return std::find(std::begin(all), std::end(all), status) != std::end(all);
}

int attribute(cudaDeviceAttr which, int device) {
  int value = 0;
  SLAMBENCH_CUDA(cudaDeviceGetAttribute(&value, which, device));
  return value;
}

/// "13.0" of 13000.
std::string version_text(int version) {
  return fmt::format("{}.{}", version / 1000, version % 1000 / 10);
}

/// As "580.65.06"; empty where the system does not tell.
std::string kernel_module_version() {
  std::ifstream file("/proc/driver/nvidia/version");
  std::string word;
  while (file >> word) {
    const bool is_version = word.find('.') != std::string::npos &&
                            word.find_first_not_of("0123456789.") == std::string::npos;
    if (is_version) return word;
  }
  return "";
}

}  // namespace

std::string device_name(int device) {
  cudaDeviceProp properties;
  SLAMBENCH_CUDA(cudaGetDeviceProperties(&properties, device));
  constexpr double mhz = 1e-3;  // of kHz
  return fmt::format(
      "{}, compute capability {}.{}, {} multiprocessors, up to {:.0f} MHz, memory "
      "up to {:.0f} MHz",
      properties.name, properties.major, properties.minor, properties.multiProcessorCount,
      attribute(cudaDevAttrClockRate, device) * mhz,
      attribute(cudaDevAttrMemoryClockRate, device) * mhz);
}

std::string driver_name() {
  int driver = 0, runtime = 0;
  SLAMBENCH_CUDA(cudaDriverGetVersion(&driver));
  SLAMBENCH_CUDA(cudaRuntimeGetVersion(&runtime));
  const std::string module = kernel_module_version();
  return fmt::format("NVIDIA {}CUDA {}, runtime {}", module.empty() ? "" : module + ", ",
                     version_text(driver), version_text(runtime));
}

void check(cudaError_t status, const char* call, const char* file, int line) {
  if (status == cudaSuccess) return;
  cudaGetLastError();  // what is told here is not to be found again by the next call
  std::string_view name(file);
  name.remove_prefix(std::min(name.size(), name.find_last_of('/') + 1));
  const std::string message =
      fmt::format("CUDA: {} ({}), from {} at {}:{}", cudaGetErrorString(status),
                  cudaGetErrorName(status), call, name, line);
  if (is_unavailable(status)) throw UnavailableError(message);
  throw Error(ExitStatus::failed, message);
}

CudaDevice::CudaDevice(int device) : index_(device) {
  SLAMBENCH_CUDA(cudaSetDevice(index_));
  if (attribute(cudaDevAttrCooperativeLaunch, index_) == 0) {
    throw UnavailableError("CUDA: the device has no cooperative kernels");
  }
  processors_ = attribute(cudaDevAttrMultiProcessorCount, index_);
  try {
    SLAMBENCH_CUDA(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking));
    for (Stage& stage : stages_) {
      SLAMBENCH_CUDA(cudaMallocHost(reinterpret_cast<void**>(&stage.memory), stage_bytes));
      SLAMBENCH_CUDA(cudaEventCreateWithFlags(&stage.free, cudaEventDisableTiming));
    }
  } catch (...) {
    destroy();
    throw;
  }
}

CudaDevice::~CudaDevice() { destroy(); }

// Nobody is left to tell about errors.
void CudaDevice::destroy() noexcept {
  cudaSetDevice(index_);
  if (stream_ != nullptr) cudaStreamSynchronize(stream_);
  const auto destroy_span = [](const Span& span) {
    cudaEventDestroy(span.begin);
    cudaEventDestroy(span.end);
  };
  for (const Call& call : calls_) destroy_span(call.span);
  for (const Copy& copy : copies_) destroy_span(copy.span);
  for (cudaEvent_t event : idle_events_) cudaEventDestroy(event);
  for (const Stage& stage : stages_) {
    if (stage.free != nullptr) cudaEventDestroy(stage.free);
    if (stage.memory != nullptr) cudaFreeHost(stage.memory);
  }
  if (stream_ != nullptr) cudaStreamDestroy(stream_);
}

cudaStream_t CudaDevice::stream() {
  SLAMBENCH_CUDA(cudaSetDevice(index_));
  return stream_;
}

void* CudaDevice::allocate(std::size_t bytes) {
  SLAMBENCH_CUDA(cudaSetDevice(index_));
  void* data = nullptr;
  const cudaError_t status = cudaMalloc(&data, std::max<std::size_t>(bytes, 1));
  if (status != cudaErrorMemoryAllocation) {
    SLAMBENCH_CUDA(status);
    allocated_bytes_ += bytes;
    return data;
  }
  cudaGetLastError();
  std::size_t available = 0, total = 0;
  SLAMBENCH_CUDA(cudaMemGetInfo(&available, &total));
  throw UnavailableError(
      fmt::format("memory of the device: found {} MiB available, expected {} MiB", available >> 20,
                  bytes >> 20));
}

void CudaDevice::release(void* data, std::size_t bytes) noexcept {
  cudaSetDevice(index_);
  cudaFree(data);
  allocated_bytes_ -= bytes;
}

const CudaDevice::Stage& CudaDevice::next_stage() {
  if (arrival_.bytes > 0) finish();
  stage_ ^= 1;
  SLAMBENCH_CUDA(cudaEventSynchronize(stages_[stage_].free));
  return stages_[stage_];
}

void CudaDevice::upload(void* device, const void* host, std::size_t bytes) {
  for (std::size_t done = 0; done < bytes; done += stage_bytes) {
    const std::size_t part = std::min(stage_bytes, bytes - done);
    const Stage& stage = next_stage();
    std::memcpy(stage.memory, static_cast<const unsigned char*>(host) + done, part);
    SLAMBENCH_CUDA(cudaMemcpyAsync(static_cast<unsigned char*>(device) + done, stage.memory, part,
                                   cudaMemcpyHostToDevice, stream()));
    SLAMBENCH_CUDA(cudaEventRecord(stage.free, stream()));
  }
}

void CudaDevice::download(void* host, const void* device, std::size_t bytes) {
  fetch(host, device, bytes);
  finish();
}

void CudaDevice::fetch(void* host, const void* device, std::size_t bytes) {
  for (std::size_t done = 0; done < bytes; done += stage_bytes) {
    const std::size_t part = std::min(stage_bytes, bytes - done);
    const Stage& stage = next_stage();
    SLAMBENCH_CUDA(cudaMemcpyAsync(stage.memory, static_cast<const unsigned char*>(device) + done,
                                   part, cudaMemcpyDeviceToHost, stream()));
    arrival_ = {static_cast<unsigned char*>(host) + done, stage.memory, part};
  }
}

void CudaDevice::finish() {
  const Arrival arrival = std::exchange(arrival_, {});
  SLAMBENCH_CUDA(cudaStreamSynchronize(stream()));
  if (arrival.bytes > 0) std::memcpy(arrival.host, arrival.memory, arrival.bytes);
}

cudaEvent_t CudaDevice::timed_event() {
  cudaEvent_t event = nullptr;
  if (idle_events_.empty()) {
    SLAMBENCH_CUDA(cudaEventCreate(&event));
  } else {
    event = idle_events_.back();
    idle_events_.pop_back();
  }
  return event;
}

CudaDevice::Span CudaDevice::begun_span() {
  const Span span{timed_event(), timed_event()};
  SLAMBENCH_CUDA(cudaEventRecord(span.begin, stream()));
  return span;
}

double CudaDevice::seconds_of(const Span& span) {
  float ms = 0;
  SLAMBENCH_CUDA(cudaEventElapsedTime(&ms, span.begin, span.end));
  idle_events_.push_back(span.begin);
  idle_events_.push_back(span.end);
  return static_cast<double>(ms) * 1e-3;
}

void CudaDevice::begin(Kernel kernel) { calls_.push_back({kernel, begun_span()}); }

void CudaDevice::end(Kernel) { SLAMBENCH_CUDA(cudaEventRecord(calls_.back().span.end, stream())); }

void CudaDevice::begin(Transfer direction, std::size_t bytes) {
  copies_.push_back({direction, bytes, begun_span()});
}

void CudaDevice::end(Transfer) {
  SLAMBENCH_CUDA(cudaEventRecord(copies_.back().span.end, stream()));
}

void CudaDevice::report(Observer* observer) {
  for (const Call& call : calls_) {
    const double seconds = seconds_of(call.span);
    if (observer != nullptr) observer->kernel_measured(call.kernel, seconds);
  }
  for (const Copy& copy : copies_) {
    const double seconds = seconds_of(copy.span);
    if (observer != nullptr) observer->transfer_measured(copy.direction, copy.bytes, seconds);
  }
  calls_.clear();
  copies_.clear();
}

}  // namespace slambench::cuda
