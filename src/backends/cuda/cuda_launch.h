// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cooperative_groups.h>
#include <cuda_runtime.h>

#include "backends/cuda/align_kernel.h"
#include "backends/cuda/cuda_device.h"
#include "core/error.h"

/// The launches of device_backend.h on a CUDA device. All device code that is CUDA's own lies here;
/// what kernels compute lies in headers that know nothing of it.
namespace slambench::cuda {

// The members of the next two compile for the host too, as kernels do, but are never called there.
#if defined(__CUDA_ARCH__)
#define SLAMBENCH_ON_DEVICE(...) __VA_ARGS__
#else
#define SLAMBENCH_ON_DEVICE(...)
#endif

/// The threads of the block that the calling thread belongs to.
struct DeviceBlock {
  SLAMBENCH_HD int index() const {
    int i = 0;
    SLAMBENCH_ON_DEVICE(i = static_cast<int>(blockIdx.x));
    return i;
  }
  SLAMBENCH_HD int count() const {
    int n = 0;
    SLAMBENCH_ON_DEVICE(n = static_cast<int>(gridDim.x));
    return n;
  }
  SLAMBENCH_HD static int thread() {
    int i = 0;
    SLAMBENCH_ON_DEVICE(i = static_cast<int>(threadIdx.x));
    return i;
  }
  template <class F>
  SLAMBENCH_HD void each(const F& f) const {
    f(thread());
    SLAMBENCH_ON_DEVICE(__syncthreads());
  }
  template <class F>
  SLAMBENCH_HD bool any(const F& f) const {
    bool found = f(thread());
    SLAMBENCH_ON_DEVICE(found = __syncthreads_or(found ? 1 : 0) != 0);
    return found;
  }
  /// A warp at a time: its ballot says who stores where, and one thread takes the places of all.
  template <class Wanted, class Store>
  SLAMBENCH_HD void append(int* counter, const Wanted& wanted, const Store& store) const {
    const bool mine = wanted(thread());
    int place = 0;
#if defined(__CUDA_ARCH__)
    constexpr unsigned all = 0xffffffffu;
    const unsigned ballot = __ballot_sync(all, mine);
    const unsigned lane = threadIdx.x % 32;
    if (lane == 0 && ballot != 0) place = atomicAdd(counter, __popc(ballot));
    place = __shfl_sync(all, place, 0) + __popc(ballot & ((1u << lane) - 1));
#else
    (void)counter;
#endif
    if (mine) store(thread(), place);
  }
};

/// All blocks of a cooperative kernel; `Shared` is the calling thread's block's.
template <class Shared>
class DeviceGrid {
 public:
  SLAMBENCH_HD explicit DeviceGrid(Shared& shared) : shared_(shared) {}

  SLAMBENCH_HD int count() const { return DeviceBlock().count(); }
  template <class F>
  SLAMBENCH_HD void each_block(const F& f) const {
    f(DeviceBlock(), shared_);
  }
  SLAMBENCH_HD void sync() const { SLAMBENCH_ON_DEVICE(cooperative_groups::this_grid().sync()); }
  SLAMBENCH_HD Shared& shared() const { return shared_; }

 private:
  Shared& shared_;
};

template <class F>
__global__ void run_pixels(const __grid_constant__ F f, Size size) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y);
  if (x < size.width && y < size.height) f(x, y);
}

template <class F>
__global__ void run_elements(const __grid_constant__ F f, int count) {
  const int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  if (i < count) f(i);
}

template <class F>
__global__ void run_voxels(const __grid_constant__ F f, Int3 n) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y);
  if (x < n.x && y < n.y) f(x, y, static_cast<int>(blockIdx.z));
}

template <class F>
__global__ void __launch_bounds__(F::threads) run_blocks(const __grid_constant__ F f) {
  using Shared = typename F::Shared;
  __shared__ alignas(alignof(Shared)) unsigned char memory[sizeof(Shared)];
  f(DeviceBlock(), *reinterpret_cast<Shared*>(memory));
}

/// The threads of its one block a multiprocessor may have all registers.
template <class F>
__global__ void __launch_bounds__(F::threads, 1) run_grid(const __grid_constant__ F f) {
  using Shared = typename F::Shared;
  __shared__ alignas(alignof(Shared)) unsigned char memory[sizeof(Shared)];
  f(DeviceGrid<Shared>(*reinterpret_cast<Shared*>(memory)));
}

class CudaLaunch : public CudaDevice {
 public:
  /// Throws UnavailableError when this build has no code for the device, or when the blocks of the
  /// alignment, one a multiprocessor, cannot run there at the same time.
  explicit CudaLaunch(int device) : CudaDevice(device) {
    int blocks = 0;
    SLAMBENCH_CUDA(
        cudaOccupancyMaxActiveBlocksPerMultiprocessor(&blocks, run_grid<Align>, Align::threads, 0));
    if (blocks < 1)
      throw UnavailableError("CUDA: a block of the alignment does not fit the device");
  }

  template <class F>
  void pixels(Size size, const F& f) {
    constexpr bool square = requires { F::square; };
    const dim3 threads = square ? dim3(8, 16) : dim3(32, 8);
    const dim3 blocks(parts(size.width, threads.x), parts(size.height, threads.y));
    run_pixels<<<blocks, threads, 0, stream()>>>(f, size);
    SLAMBENCH_CUDA(cudaGetLastError());
  }
  template <class F>
  void elements(int count, const F& f) {
    constexpr int threads = 256;
    run_elements<<<parts(count, threads), threads, 0, stream()>>>(f, count);
    SLAMBENCH_CUDA(cudaGetLastError());
  }
  template <class F>
  void voxels(Int3 n, const F& f) {
    const dim3 threads(32, 8);
    const dim3 blocks(parts(n.x, threads.x), parts(n.y, threads.y), static_cast<unsigned>(n.z));
    run_voxels<<<blocks, threads, 0, stream()>>>(f, n);
    SLAMBENCH_CUDA(cudaGetLastError());
  }
  template <class F>
  void blocks(int count, const F& f) {
    run_blocks<<<static_cast<unsigned>(count), F::threads, 0, stream()>>>(f);
    SLAMBENCH_CUDA(cudaGetLastError());
  }
  /// One block a multiprocessor: the more there are, the more sums each has to read.
  template <class F>
  void grid(const F& f) {
    void* arguments[] = {const_cast<F*>(&f)};
    SLAMBENCH_CUDA(cudaLaunchCooperativeKernel(reinterpret_cast<const void*>(run_grid<F>),
                                               dim3(static_cast<unsigned>(processors())),
                                               dim3(F::threads), arguments, 0, stream()));
  }

 private:
  static unsigned parts(int count, unsigned size) {
    return static_cast<unsigned>(parts_of(count, static_cast<int>(size)));
  }
};

}  // namespace slambench::cuda
