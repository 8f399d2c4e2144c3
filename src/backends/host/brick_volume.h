// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "backends/backend.h"

namespace slambench {

/// Planes of equally many 16-bit values, handed out one after the other and given back all
/// together. Their addresses never change: the address space for all is set aside at once, the
/// memory (in huge pages where the system has them) as it is used.
class PlanePool {
 public:
  /// Throws UnavailableError when the address space is refused.
  PlanePool(std::size_t capacity, std::size_t plane_values);
  ~PlanePool();
  PlanePool(const PlanePool&) = delete;
  PlanePool& operator=(const PlanePool&) = delete;

  /// Makes sure of memory for so many more planes, or throws UnavailableError.
  void reserve(std::size_t planes);
  /// A plane of unspecified values; there must be one in reserve. Safe from several threads.
  int take() { return static_cast<int>(used_.fetch_add(1, std::memory_order_relaxed)); }
  void clear() { used_ = 0; }

  std::int16_t* plane(int i) const { return data_ + static_cast<std::size_t>(i) * plane_values_; }
  std::size_t used() const { return used_; }
  std::size_t used_bytes() const { return used_ * plane_bytes(); }
  std::size_t plane_bytes() const { return plane_values_ * sizeof(std::int16_t); }

 private:
  std::size_t capacity_, plane_values_, mapped_bytes_;
  std::size_t granted_ = 0;  ///< planes that there was memory for when last looked
  std::atomic<std::size_t> used_ = 0;
  std::int16_t* data_ = nullptr;
};

/// A volume in bricks of 8^3 voxels (x fastest) under a direct table. A brick whose distances have
/// all only ever been +1 has no distances of its own but shares plane 0; one whose weights are all
/// equal keeps that one number instead of a plane. Nothing is lost: 32766 is a fixed point of the
/// update with a truncated distance of 1, whatever the weight. Where the resolution is no
/// multiple of 8, the last bricks have voxels beyond it, which nobody reads.
///
/// A row of distances is followed by the first value of the same row in the next brick along x, so
/// that any two neighbours along x lie side by side in one plane. A brick of +1 before one that is
/// not therefore has a plane too.
class BrickVolume final : public Storage {
 public:
  static constexpr int edge = 8;
  static constexpr int voxels = edge * edge * edge;
  static constexpr int row_values = edge + 1;  ///< of a plane of distances
  static constexpr int plane_values = row_values * edge * edge;
  static constexpr std::int16_t free_space = Voxel{}.tsdf;

  explicit BrickVolume(Int3 resolution);

  /// Forgets all measurements.
  void clear();
  Int3 bricks() const { return bricks_; }
  std::size_t count() const { return distance_planes_.size(); }
  std::size_t index(int bx, int by, int bz) const {
    return (static_cast<std::size_t>(bz) * static_cast<std::size_t>(bricks_.y) +
            static_cast<std::size_t>(by)) *
               static_cast<std::size_t>(bricks_.x) +
           static_cast<std::size_t>(bx);
  }
  /// Where in the volume a brick's voxel `i` is; at the far borders also beyond it.
  Int3 voxel_at(std::size_t brick, int i) const {
    const int b = static_cast<int>(brick);
    return {b % bricks_.x * edge + i % edge, b / bricks_.x % bricks_.y * edge + i / edge % edge,
            b / bricks_.x / bricks_.y * edge + i / edge / edge};
  }

  /// Copies a brick out.
  void load(std::size_t brick, std::int16_t* tsdf, std::int16_t* weights) const;
  /// Stores a brick; there must be a plane of each kind in reserve unless it has both. Different
  /// bricks may be stored by different threads; refresh() makes what was stored complete.
  void store(std::size_t brick, const std::int16_t* tsdf, const std::int16_t* weights);
  /// To be called after bricks were stored, before any are read by others than load().
  void refresh();
  /// Makes sure that so many bricks can be stored, or throws UnavailableError.
  void reserve(std::size_t bricks);

  /// Whether the brick's weights are one number, and which.
  bool uniform(std::size_t brick) const { return weight_planes_[brick] < 0; }
  std::int16_t uniform_weight(std::size_t brick) const {
    return static_cast<std::int16_t>(-1 - weight_planes_[brick]);
  }
  void set_uniform_weight(std::size_t brick, std::int16_t weight) {
    weight_planes_[brick] = -1 - weight;
  }
  /// Whether every distance of the brick is +1.
  bool is_free(std::size_t brick) const { return levels_[brick] == free_level; }
  /// The distance of a brick's voxel `i`.
  std::int16_t tsdf(std::size_t brick, int i) const {
    return distances_.plane(distance_planes_[brick])[i + i / edge];
  }
  /// Null when the brick keeps no plane of its own.
  std::int16_t* own_weights(std::size_t brick) const {
    return uniform(brick) ? nullptr : weights_.plane(weight_planes_[brick]);
  }

  float tsdf(int x, int y, int z) const {
    return tsdf(index(x / edge, y / edge, z / edge),
                (z % edge * edge + y % edge) * edge + x % edge);
  }

  /// For readers with many lanes: the plane of every brick, 0 for a brick of +1, and the planes.
  const std::int32_t* plane_table() const { return distance_planes_.data(); }
  const std::int16_t* planes() const { return distances_.plane(0); }
  std::size_t planes_used() const { return distances_.used(); }
  /// The brick that owns a plane other than 0.
  std::int32_t owner(std::size_t plane) const { return owners_[plane]; }

  /// Distances in 256 levels, for a byte a brick: a distance is of level l or above if and only if
  /// it is at least 256 (l - 128). The last level stands for +1 alone.
  static constexpr int free_level = 255;
  static constexpr int level_of(std::int16_t tsdf) {
    return tsdf == free_space ? free_level : std::min((tsdf >> 8) + 128, free_level - 1);
  }
  /// The lowest level of the brick's own distances.
  std::uint8_t level(std::size_t brick) const { return levels_[brick]; }
  /// Bricks are cut into 2^3 parts.
  static constexpr int part_edge = edge / 2;
  Int3 parts() const { return {2 * bricks_.x, 2 * bricks_.y, 2 * bricks_.z}; }
  /// A byte a part (x fastest): the lowest level that a sample whose lower corner lies in it can
  /// read. Three bytes follow the last.
  const std::uint8_t* sample_levels() const { return sample_levels_.data(); }

  /// Memory in use.
  std::size_t bytes() const;

 private:
  /// The lowest level of each of the brick's parts; the lowest of all.
  std::uint8_t store_levels(std::size_t brick, const std::int16_t* tsdf);
  /// The levels that samples read: the lowest of the part's own and of those above it.
  void refresh_sample_levels();
  void copy_first_column(const std::int16_t* tsdf, std::size_t stride, int plane_before);

  Int3 bricks_;
  std::vector<std::int32_t> distance_planes_;  ///< per brick
  std::vector<std::int32_t> weight_planes_;    ///< per brick; negative: -1 - the uniform weight
  PlanePool distances_, weights_;
  std::vector<std::uint8_t> levels_;                       ///< per brick
  std::vector<std::uint8_t> part_levels_, sample_levels_;  ///< per part
  std::vector<std::uint8_t> stale_;   ///< rows of bricks along x whose part levels have changed
  std::vector<std::int32_t> owners_;  ///< of the distance planes
  std::size_t seen_planes_ = 1;       ///< planes whose rows have been made complete
};

/// A BrickVolume as the per-voxel maths of kernels/ reads it.
struct BrickView {
  const BrickVolume* volume = nullptr;
  Int3 resolution;
  Float3 size_m;

  float tsdf(int x, int y, int z) const { return volume->tsdf(x, y, z); }
};

}  // namespace slambench
