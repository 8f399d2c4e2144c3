// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/host/brick_volume.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <limits>

#include "backends/host/memory.h"
#include "core/error.h"
#include "kernels/volume_maths.h"

namespace slambench {
namespace {

constexpr std::size_t huge_page = std::size_t{2} << 20;
/// Memory is asked for in portions, so that the system is not asked at every frame.
constexpr std::size_t portion_bytes = std::size_t{16} << 20;
/// Bytes past the last brick or plane that a 32-bit read of its last value touches.
constexpr std::size_t slack = 4;
/// Bytes of tables for a brick: its planes, its owner's, its level and those of its eight parts.
constexpr std::size_t brick_bytes = 3 * sizeof(std::int32_t) + 1 + 2 * 8;

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
  require_memory(count * brick_bytes);
  distance_planes_.resize(count);
  weight_planes_.resize(count);
  levels_.resize(count);
  part_levels_.resize(8 * count);
  sample_levels_.resize(8 * count + slack);
  stale_.resize(static_cast<std::size_t>(bricks_.y) * static_cast<std::size_t>(bricks_.z));
  owners_.resize(count + 1);
  clear();
}

void BrickVolume::clear() {
  std::fill(distance_planes_.begin(), distance_planes_.end(), 0);
  std::fill(weight_planes_.begin(), weight_planes_.end(), -1 - Voxel{}.weight);
  std::fill(levels_.begin(), levels_.end(), std::uint8_t{free_level});
  std::fill(part_levels_.begin(), part_levels_.end(), std::uint8_t{free_level});
  std::fill(sample_levels_.begin(), sample_levels_.end(), std::uint8_t{free_level});
  std::fill(stale_.begin(), stale_.end(), std::uint8_t{0});
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
    levels_[brick] = store_levels(brick, tsdf);
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

std::uint8_t BrickVolume::store_levels(std::size_t brick, const std::int16_t* tsdf) {
  const Int3 first = voxel_at(brick, 0), count = parts();
  bool changed = false;
  std::uint8_t lowest = free_level;
  for (int pz = 0; pz < 2; ++pz) {
    for (int py = 0; py < 2; ++py) {
      const std::int16_t* values = tsdf + (pz * edge + py) * part_edge * edge;
      std::int16_t least[edge];  // of the columns along x
      std::copy_n(values, edge, least);
      for (int row = 1; row < part_edge * part_edge; ++row) {
        const std::int16_t* next = values + (row / part_edge * edge + row % part_edge) * edge;
        for (int x = 0; x < edge; ++x) least[x] = std::min(least[x], next[x]);
      }
      const int y = first.y / part_edge + py, z = first.z / part_edge + pz;
      std::uint8_t* levels = part_levels_.data() + voxel_index(count, first.x / part_edge, y, z);
      for (int px = 0; px < 2; ++px) {
        const std::int16_t* half = least + px * part_edge;
        const auto level =
            static_cast<std::uint8_t>(level_of(*std::min_element(half, half + part_edge)));
        changed |= levels[px] != level;
        levels[px] = level;
        lowest = std::min(lowest, level);
      }
    }
  }
  if (changed) {  // others may store bricks of this row at the same time
    const std::atomic_ref<std::uint8_t> stale(stale_[brick / static_cast<std::size_t>(bricks_.x)]);
    stale.store(1, std::memory_order_relaxed);
  }
  return lowest;
}

void BrickVolume::refresh_sample_levels() {
  const Int3 count = parts();
  const auto width = static_cast<std::size_t>(count.x);
  const auto stale = [&](int by, int bz) {
    return by < bricks_.y && bz < bricks_.z &&
           stale_[static_cast<std::size_t>(bz) * static_cast<std::size_t>(bricks_.y) +
                  static_cast<std::size_t>(by)] != 0;
  };
  const auto row = [&](int y, int z) {
    const int last_y = std::min(y, count.y - 1), last_z = std::min(z, count.z - 1);
    return part_levels_.data() + voxel_index(count, 0, last_y, last_z);
  };
  std::vector<std::uint8_t> four_rows(width + 1, std::uint8_t{free_level});
  std::uint8_t* lowest = four_rows.data();
  for (int z = 0; z < count.z; ++z) {
    for (int y = 0; y < count.y; ++y) {
      const int by = y / 2, bz = z / 2;
      if (!stale(by, bz) && !stale(by + 1, bz) && !stale(by, bz + 1) && !stale(by + 1, bz + 1)) {
        continue;
      }
      const std::uint8_t *a = row(y, z), *b = row(y + 1, z), *c = row(y, z + 1),
                         *d = row(y + 1, z + 1);
      for (std::size_t x = 0; x < width; ++x) {
        lowest[x] = std::min(std::min(a[x], b[x]), std::min(c[x], d[x]));
      }
      std::uint8_t* sample = sample_levels_.data() + voxel_index(count, 0, y, z);
      for (std::size_t x = 0; x < width; ++x) sample[x] = std::min(lowest[x], lowest[x + 1]);
    }
  }
  std::fill(stale_.begin(), stale_.end(), std::uint8_t{0});
}

std::size_t BrickVolume::bytes() const {
  return distances_.used_bytes() + weights_.used_bytes() + count() * brick_bytes;
}

}  // namespace slambench
