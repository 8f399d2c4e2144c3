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
constexpr std::size_t portion_bytes = std::size_t{16} << 20;
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

PlanePool::PlanePool(std::size_t capacity, std::size_t plane_values)
    : capacity_(std::min<std::size_t>(capacity, std::numeric_limits<std::int32_t>::max())),
      plane_values_(plane_values),
      mapped_bytes_((capacity_ * plane_bytes() + slack + huge_page - 1) / huge_page * huge_page) {
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
  const std::size_t grant =
      std::min(capacity_, std::max(wanted, granted_ + portion_bytes / plane_bytes()));
  require_memory((grant - granted_) * plane_bytes());
  granted_ = grant;
}

// Each brick can own a plane of each kind; plane 0 of the distances is the one of free space.
BrickVolume::BrickVolume(Int3 resolution)
    : bricks_(bricks_of(resolution)),
      distances_(brick_count(bricks_) + 1, plane_values),
      weights_(brick_count(bricks_), voxels) {
  const std::size_t count = brick_count(bricks_);
  require_memory(count * (3 * sizeof(std::int32_t) + 2));
  distance_planes_.resize(count);
  weight_planes_.resize(count);
  levels_.resize(count);
  sample_levels_.resize(count + slack);
  owners_.resize(count + 1);
  clear();
}

void BrickVolume::clear() {
  std::fill(distance_planes_.begin(), distance_planes_.end(), 0);
  std::fill(weight_planes_.begin(), weight_planes_.end(), -1 - Voxel{}.weight);
  std::fill(levels_.begin(), levels_.end(), std::uint8_t{free_level});
  std::fill(sample_levels_.begin(), sample_levels_.end(), std::uint8_t{free_level});
  distances_.clear();
  weights_.clear();
  distances_.reserve(1);
  std::fill_n(distances_.plane(distances_.take()), plane_values, free_space);
  seen_planes_ = distances_.used();
}

void BrickVolume::load(std::size_t brick, std::int16_t* tsdf, std::int16_t* weights) const {
  const std::int16_t* row = distances_.plane(distance_planes_[brick]);
  for (int i = 0; i < voxels; i += edge, row += row_values) std::copy_n(row, edge, tsdf + i);
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
  // Another thread may look at this entry while it stores the next brick.
  const std::atomic_ref<std::int32_t> own(distance_planes_[brick]);
  int plane = distance_planes_[brick];
  if (plane == 0 && differs(tsdf, free_space)) {
    plane = distances_.take();
    owners_[static_cast<std::size_t>(plane)] = static_cast<std::int32_t>(brick);
    own.store(plane, std::memory_order_relaxed);
  }
  if (plane != 0) {
    std::int16_t* row = distances_.plane(plane);
    for (int i = 0; i < voxels; i += edge, row += row_values) std::copy_n(tsdf + i, edge, row);
    std::int16_t least = tsdf[0];
    for (int i = 1; i < voxels; ++i) least = std::min(least, tsdf[i]);
    levels_[brick] = static_cast<std::uint8_t>(level_of(least));
    if (brick % static_cast<std::size_t>(bricks_.x) != 0) {
      const std::atomic_ref<std::int32_t> before(distance_planes_[brick - 1]);
      copy_first_column(tsdf, edge, before.load(std::memory_order_relaxed));
    }
  }

  if (uniform(brick)) {
    if (!differs(weights, weights[0])) {
      set_uniform_weight(brick, weights[0]);
      return;
    }
    weight_planes_[brick] = weights_.take();
  }
  std::copy_n(weights, voxels, own_weights(brick));
}

void BrickVolume::copy_first_column(const std::int16_t* tsdf, std::size_t stride,
                                    int plane_before) {
  if (plane_before == 0) return;
  std::int16_t* end = distances_.plane(plane_before) + edge;
  for (int row = 0; row < edge * edge; ++row, end += row_values, tsdf += stride) *end = *tsdf;
}

void BrickVolume::reserve(std::size_t bricks) {
  const std::size_t most_distances = count() + 1 - distances_.used();
  const std::size_t most_weights = count() - weights_.used();
  distances_.reserve(std::min(bricks, most_distances));
  weights_.reserve(std::min(bricks, most_weights));
}

void BrickVolume::refresh() {
  const auto width = static_cast<std::size_t>(bricks_.x);
  for (std::size_t plane = 1; plane < distances_.used(); ++plane) {
    const auto brick = static_cast<std::size_t>(owners_[plane]);
    if (brick % width == 0 || is_free(brick) || distance_planes_[brick - 1] != 0) continue;
    distances_.reserve(1);
    const int before = distances_.take();
    std::fill_n(distances_.plane(before), plane_values, free_space);
    owners_[static_cast<std::size_t>(before)] = static_cast<std::int32_t>(brick - 1);
    distance_planes_[brick - 1] = before;
  }
  for (; seen_planes_ < distances_.used(); ++seen_planes_) {
    const auto brick = static_cast<std::size_t>(owners_[seen_planes_]);
    const bool last = (brick + 1) % width == 0;
    copy_first_column(distances_.plane(last ? 0 : distance_planes_[brick + 1]), row_values,
                      static_cast<int>(seen_planes_));
  }
  refresh_sample_levels();
}

void BrickVolume::refresh_sample_levels() {
  const auto width = static_cast<std::size_t>(bricks_.x);
  const std::size_t slice = width * static_cast<std::size_t>(bricks_.y), count = levels_.size();
  const auto lower = [](std::uint8_t* to, const std::uint8_t* from, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) to[i] = std::min(to[i], from[i]);
  };
  std::uint8_t* sample = sample_levels_.data();
  std::copy(levels_.begin(), levels_.end(), sample);
  for (std::size_t row = 0; row < count; row += width) {
    lower(sample + row, levels_.data() + row + 1, width - 1);
  }
  // Rising rows and slices read what is above them before that is lowered itself.
  for (std::size_t begin = 0; begin < count; begin += slice) {
    for (std::size_t row = begin; row + width < begin + slice; row += width) {
      lower(sample + row, sample + row + width, width);
    }
  }
  for (std::size_t begin = 0; begin + slice < count; begin += slice) {
    lower(sample + begin, sample + begin + slice, slice);
  }
}

std::size_t BrickVolume::bytes() const {
  return distances_.used_bytes() + weights_.used_bytes() + count() * (3 * sizeof(std::int32_t) + 2);
}

}  // namespace slambench
