// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/host/brick_volume.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <limits>

#include "backends/host/memory.h"
#include "core/error.h"

namespace slambench {
namespace {

constexpr std::size_t huge_page = std::size_t{2} << 20;
/// Memory is asked for in portions, so that the system is not asked at every frame.
constexpr std::size_t portion_planes = (std::size_t{16} << 20) / PlanePool::plane_bytes;
/// Bytes past the last brick or plane that a 32-bit read of its last value touches.
constexpr std::size_t slack = 4;

std::size_t brick_count(Int3 bricks) {
  return static_cast<std::size_t>(bricks.x) * static_cast<std::size_t>(bricks.y) *
         static_cast<std::size_t>(bricks.z);
}

Int3 bricks_of(Int3 resolution) {
  const auto bricks = [](int n) { return (n + BrickVolume::edge - 1) / BrickVolume::edge; };
  return {bricks(resolution.x), bricks(resolution.y), bricks(resolution.z)};
}

}  // namespace

PlanePool::PlanePool(std::size_t capacity)
    : capacity_(std::min<std::size_t>(capacity, std::numeric_limits<std::int32_t>::max())),
      mapped_bytes_((capacity_ * plane_bytes + slack + huge_page - 1) / huge_page * huge_page) {
  void* data = mmap(nullptr, mapped_bytes_, PROT_READ | PROT_WRITE,
                    MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (data == MAP_FAILED) {
    throw UnavailableError(
        fmt::format("memory: the system refuses {} MiB of address space", mapped_bytes_ >> 20));
  }
  ask_for_huge_pages(data, mapped_bytes_);
  data_ = static_cast<std::int16_t*>(data);
}

PlanePool::~PlanePool() { munmap(data_, mapped_bytes_); }

void PlanePool::reserve(std::size_t planes) {
  const std::size_t wanted = used_ + planes;
  if (wanted <= granted_) return;
  if (wanted > capacity_) {
    throw UnavailableError(
        fmt::format("bricks: found {} planes needed, expected at most {}", wanted, capacity_));
  }
  const std::size_t grant = std::min(capacity_, std::max(wanted, granted_ + portion_planes));
  require_memory((grant - granted_) * plane_bytes);
  granted_ = grant;
}

// Each brick can own a plane of each kind; plane 0 of the distances is the one of free space.
BrickVolume::BrickVolume(Int3 resolution)
    : bricks_(bricks_of(resolution)),
      distances_(brick_count(bricks_) + 1),
      weights_(brick_count(bricks_)) {
  const std::size_t count = brick_count(bricks_);
  require_memory(count * (3 * sizeof(std::int32_t) + 1));
  distance_planes_.resize(count);
  weight_planes_.resize(count);
  occupancy_.resize(count + slack);
  owners_.resize(count + 1);
  clear();
}

void BrickVolume::clear() {
  std::fill(distance_planes_.begin(), distance_planes_.end(), 0);
  std::fill(weight_planes_.begin(), weight_planes_.end(), -1 - Voxel{}.weight);
  std::fill(occupancy_.begin(), occupancy_.end(), std::uint8_t{0});
  distances_.clear();
  weights_.clear();
  distances_.reserve(1);
  std::fill_n(distances_.plane(distances_.take()), voxels, free_space);
  seen_planes_ = distances_.used();
}

void BrickVolume::load(std::size_t brick, std::int16_t* tsdf, std::int16_t* weights) const {
  std::copy_n(distances_.plane(distance_planes_[brick]), voxels, tsdf);
  if (uniform(brick)) {
    std::fill_n(weights, voxels, uniform_weight(brick));
  } else {
    std::copy_n(own_weights(brick), voxels, weights);
  }
}

void BrickVolume::store(std::size_t brick, const std::int16_t* tsdf, const std::int16_t* weights) {
  const auto differs = [](const std::int16_t* values, std::int16_t from) {
    int different = 0;
    for (int i = 0; i < voxels; ++i) different |= values[i] ^ from;
    return different != 0;
  };
  if (distance_planes_[brick] == 0 && differs(tsdf, free_space)) {
    const int plane = distances_.take();
    owners_[static_cast<std::size_t>(plane)] = static_cast<std::int32_t>(brick);
    distance_planes_[brick] = plane;
  }
  if (distance_planes_[brick] != 0) std::copy_n(tsdf, voxels, own_tsdf(brick));

  if (uniform(brick)) {
    if (!differs(weights, weights[0])) {
      set_uniform_weight(brick, weights[0]);
      return;
    }
    weight_planes_[brick] = weights_.take();
  }
  std::copy_n(weights, voxels, own_weights(brick));
}

void BrickVolume::reserve(std::size_t bricks) {
  const std::size_t most_distances = count() + 1 - distances_.used();
  const std::size_t most_weights = count() - weights_.used();
  distances_.reserve(std::min(bricks, most_distances));
  weights_.reserve(std::min(bricks, most_weights));
}

void BrickVolume::refresh_occupancy() {
  for (; seen_planes_ < distances_.used(); ++seen_planes_) {
    const int brick = owners_[seen_planes_];
    const int bx = brick % bricks_.x, by = brick / bricks_.x % bricks_.y;
    const int bz = brick / bricks_.x / bricks_.y;
    for (int z = std::max(0, bz - 1); z <= bz; ++z) {
      for (int y = std::max(0, by - 1); y <= by; ++y) {
        for (int x = std::max(0, bx - 1); x <= bx; ++x) occupancy_[index(x, y, z)] = 1;
      }
    }
  }
}

std::size_t BrickVolume::bytes() const {
  return (distances_.used() + weights_.used()) * PlanePool::plane_bytes +
         count() * (3 * sizeof(std::int32_t) + 1);
}

}  // namespace slambench
