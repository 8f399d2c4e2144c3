// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdlib>
#include <cstring>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "backends/cuda/device_backend.h"

namespace slambench::testing {

/// In which order threads of a block, blocks and elements take their turns. No result may depend
/// on it: threads that disturb each other between two barriers give other results in one of them.
enum class Order { forwards, backwards };

/// f(i) for i in [0, count).
template <class F>
void in_order(Order order, int count, const F& f) {
  for (int i = 0; i < count; ++i) f(order == Order::forwards ? i : count - 1 - i);
}

/// A block of threads, one after the other.
class HostBlock {
 public:
  HostBlock(Order order, int index, int count, int threads)
      : order_(order), index_(index), count_(count), threads_(threads) {}

  int index() const { return index_; }
  int count() const { return count_; }
  template <class F>
  void each(const F& f) const {
    in_order(order_, threads_, f);
  }
  template <class F>
  bool any(const F& f) const {
    bool found = false;
    in_order(order_, threads_, [&](int thread) { found = f(thread) || found; });
    return found;
  }
  template <class Wanted, class Store>
  void append(int* counter, const Wanted& wanted, const Store& store) const {
    in_order(order_, threads_, [&](int thread) {
      if (wanted(thread)) store(thread, (*counter)++);
    });
  }

 private:
  Order order_;
  int index_, count_, threads_;
};

/// The blocks of a grid, one after the other, each with its shared memory.
template <class F>
class HostGrid {
 public:
  using Shared = typename F::Shared;

  HostGrid(Order order, int count, std::vector<Shared>* shared)
      : order_(order), count_(count), shared_(shared) {}

  int count() const { return count_; }
  template <class Body>
  void each_block(const Body& body) const {
    in_order(order_, count_, [&](int i) {
      body(HostBlock(order_, i, count_, F::threads), (*shared_)[static_cast<std::size_t>(i)]);
    });
  }
  void sync() const {}
  Shared& shared() const { return shared_->front(); }

 private:
  Order order_;
  int count_;
  std::vector<Shared>* shared_;
};

/// Runs the CUDA backend's kernels on the host.
class HostLaunch {
 public:
  explicit HostLaunch(Order order, int processors = 5) : order_(order), processors_(processors) {}

  std::string device() const { return "host"; }
  std::string driver() const { return "none"; }
  int processors() const { return processors_; }

  /// Filled with garbage, as memory of a device is.
  void* allocate(std::size_t bytes) {
    ++allocations;
    constexpr std::size_t most = std::size_t{1} << 30;
    void* data = bytes > most ? nullptr : std::malloc(bytes);
    if (data == nullptr) throw UnavailableError("no memory");
    std::memset(data, 0xa5, bytes);
    live.insert(data);
    allocated_ += bytes;
    return data;
  }
  void release(void* data, std::size_t bytes) noexcept {
    live.erase(data);
    std::free(data);
    allocated_ -= bytes;
  }
  std::size_t allocated_bytes() const { return allocated_; }
  void upload(void* device, const void* host, std::size_t bytes) {
    std::memcpy(device, host, bytes);
  }
  void download(void* host, const void* device, std::size_t bytes) {
    fetch(host, device, bytes);
    finish();
  }
  /// Nobody may look before the wait: until then there is garbage.
  void fetch(void* host, const void* device, std::size_t bytes) {
    if (arriving_at_ != nullptr) finish();
    const auto* data = static_cast<const unsigned char*>(device);
    arriving_.assign(data, data + bytes);
    arriving_at_ = host;
    std::memset(host, 0xa5, bytes);
  }
  void finish() {
    ++waits;
    if (arriving_at_ != nullptr) std::memcpy(arriving_at_, arriving_.data(), arriving_.size());
    arriving_at_ = nullptr;
  }
  void begin(Kernel) { ++open; }
  void end(Kernel kernel) {
    --open;
    pending_.push_back(kernel);
  }
  void begin(Transfer, std::size_t bytes) {
    ++open;
    copied_ = bytes;
  }
  void end(Transfer direction) {
    --open;
    pending_copies_.emplace_back(direction, copied_);
  }
  void report(Observer* observer) {
    for (const Kernel kernel : std::exchange(pending_, {})) {
      if (observer != nullptr) observer->kernel_measured(kernel, 1.0);
    }
    for (const auto& [direction, bytes] : std::exchange(pending_copies_, {})) {
      if (observer != nullptr) observer->transfer_measured(direction, bytes, 1.0);
    }
  }

  template <class F>
  void pixels(Size size, const F& f) {
    in_order(order_, size.height,
             [&](int y) { in_order(order_, size.width, [&](int x) { f(x, y); }); });
  }
  template <class F>
  void elements(int count, const F& f) {
    constexpr int beyond = 3;  // as a last block that is not full has threads left
    in_order(order_, count + beyond, f);
  }
  template <class F>
  void voxels(Int3 n, const F& f) {
    in_order(order_, n.z, [&](int z) {
      in_order(order_, n.y, [&](int y) { in_order(order_, n.x, [&](int x) { f(x, y, z); }); });
    });
  }
  template <class F>
  void blocks(int count, const F& f) {
    in_order(order_, count, [&](int i) {
      const auto shared = garbage<typename F::Shared>();
      f(HostBlock(order_, i, count, F::threads), *shared);
    });
  }
  template <class F>
  void grid(const F& f) {
    std::vector<typename F::Shared> shared(static_cast<std::size_t>(processors_),
                                           *garbage<typename F::Shared>());
    f(HostGrid<F>(order_, processors_, &shared));
    for (const auto& block : shared) {
      constexpr std::size_t size = sizeof block.outcome;
      blocks_agree &= std::memcmp(&block.outcome, &shared.front().outcome, size) == 0;
    }
  }

  int allocations = 0, open = 0, waits = 0;
  bool blocks_agree = true;  ///< all blocks of all grids ended with the same outcome
  std::set<void*> live;

 private:
  /// Shared memory before anybody has written to it.
  template <class T>
  static std::unique_ptr<T> garbage() {
    auto shared = std::make_unique<T>();
    std::memset(static_cast<void*>(shared.get()), 0xa5, sizeof(T));
    return shared;
  }

  Order order_;
  int processors_;
  std::size_t allocated_ = 0;
  std::vector<Kernel> pending_;
  std::vector<std::pair<Transfer, std::size_t>> pending_copies_;
  std::size_t copied_ = 0;
  std::vector<unsigned char> arriving_;
  void* arriving_at_ = nullptr;
};

using HostCudaBackend = cuda::DeviceBackend<HostLaunch>;

inline std::unique_ptr<HostCudaBackend> host_cuda_backend(Order order) {
  return std::make_unique<HostCudaBackend>(std::make_shared<HostLaunch>(order));
}

}  // namespace slambench::testing
