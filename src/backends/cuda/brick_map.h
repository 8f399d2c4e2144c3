// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include "backends/cuda/device_maths.h"
#include "kernels/volume_maths.h"

/// A volume in bricks of 8^3 voxels (x fastest) under a direct table, in the device's memory. A
/// brick whose distances have all only ever been +1 has no distances of its own but shares plane 0;
/// one whose weights are all equal keeps that one number instead of a plane. Nothing is lost: 32766
/// is a fixed point of the update with a truncated distance of 1, whatever the weight. Where the
/// resolution is no multiple of 8, the last bricks have voxels beyond it, which nobody reads.
namespace slambench::cuda {

inline constexpr int brick_edge = 8;
inline constexpr int brick_voxels = brick_edge * brick_edge * brick_edge;
inline constexpr std::int16_t free_space = 32766;
static_assert(free_space == Voxel{}.tsdf && Voxel{}.weight == 0);

/// Numbers that blocks of one kernel share.
struct BrickCounters {
  int distance_planes;  ///< in use, the one of free space included
  int weight_planes;    ///< in use
  int varied;           ///< bricks in the list of those to look at
};

/// Pointers into the device's memory: what kernels are given, and a map for the per-voxel maths.
struct BrickMap {
  Int3 resolution;
  Float3 size_m;
  Int3 bricks;                              ///< along the axes
  std::int32_t* distance_planes = nullptr;  ///< per brick
  std::int32_t* weight_planes = nullptr;    ///< per brick; negative: -1 - the uniform weight
  std::int16_t* distances = nullptr;        ///< planes, one for each brick and that of free space
  std::int16_t* weights = nullptr;          ///< planes, one for each brick
  /// Per brick, not 0 when a sample whose lower corner lies in it can be other than +1: when it or
  /// a neighbour above it along any axes has distances of its own.
  std::uint8_t* occupancy = nullptr;
  std::int32_t* varied = nullptr;  ///< bricks to look at
  BrickCounters* counters = nullptr;

  SLAMBENCH_HD int count() const { return bricks.x * bricks.y * bricks.z; }
  SLAMBENCH_HD int index(int bx, int by, int bz) const {
    return (bz * bricks.y + by) * bricks.x + bx;
  }
  SLAMBENCH_HD Int3 position(int brick) const {
    return {brick % bricks.x, brick / bricks.x % bricks.y, brick / bricks.x / bricks.y};
  }
  /// The volume's index of a brick's voxel; may lie beyond the resolution.
  SLAMBENCH_HD Int3 voxel(int brick, int i) const {
    const Int3 b = position(brick);
    return {b.x * brick_edge + i % brick_edge, b.y * brick_edge + i / brick_edge % brick_edge,
            b.z * brick_edge + i / brick_edge / brick_edge};
  }
  SLAMBENCH_HD static std::int16_t* plane(std::int16_t* planes, int i) {
    return planes + static_cast<std::size_t>(i) * brick_voxels;
  }

  SLAMBENCH_HD float tsdf(int x, int y, int z) const {
    const int own = distance_planes[index(x / brick_edge, y / brick_edge, z / brick_edge)];
    return static_cast<float>(
        plane(distances,
              own)[(z % brick_edge * brick_edge + y % brick_edge) * brick_edge + x % brick_edge]);
  }
  /// Of the brick that the lower corner of the cell lies in.
  SLAMBENCH_HD bool occupied(const Cell& cell) const {
    return occupancy[index(clamp_index(cell.base.x, resolution.x) / brick_edge,
                           clamp_index(cell.base.y, resolution.y) / brick_edge,
                           clamp_index(cell.base.z, resolution.z) / brick_edge)] != 0;
  }
};

/// A brick in the hands of a block of brick_voxels threads.
struct BrickInHand {
  std::int16_t tsdf[brick_voxels], weight[brick_voxels];
  int distance_plane, weight_plane;
};

/// Says where the brick's voxels are stored now.
template <class Block>
SLAMBENCH_HD inline void look_up(const Block& block, const BrickMap& map, int brick,
                                 BrickInHand& hand) {
  block.each([&](int i) {
    if (i != 0) return;
    hand.distance_plane = map.distance_planes[brick];
    hand.weight_plane = map.weight_planes[brick];
  });
}

SLAMBENCH_HD inline Voxel stored_voxel(const BrickMap& map, const BrickInHand& hand, int i) {
  const int weight_plane = hand.weight_plane;
  return {BrickMap::plane(map.distances, hand.distance_plane)[i],
          weight_plane < 0 ? static_cast<std::int16_t>(-1 - weight_plane)
                           : BrickMap::plane(map.weights, weight_plane)[i]};
}

/// Marks the brick and its neighbours below as occupied. Several blocks may write the same byte,
/// and all write the same value.
SLAMBENCH_HD inline void mark_occupied(const BrickMap& map, int brick) {
  const Int3 b = map.position(brick);
  for (int z = greatest(0, b.z - 1); z <= b.z; ++z) {
    for (int y = greatest(0, b.y - 1); y <= b.y; ++y) {
      for (int x = greatest(0, b.x - 1); x <= b.x; ++x) map.occupancy[map.index(x, y, z)] = 1;
    }
  }
}

/// Stores the brick after look_up(); takes planes from the pool where it needs them. Which plane
/// a brick gets depends on who comes first; no result does.
template <class Block>
SLAMBENCH_HD inline void store(const Block& block, const BrickMap& map, int brick,
                               BrickInHand& hand) {
  const bool has_surface = block.any([&](int i) { return hand.tsdf[i] != free_space; });
  const bool weights_differ = block.any([&](int i) { return hand.weight[i] != hand.weight[0]; });
  block.each([&](int i) {
    if (i != 0) return;
    if (hand.distance_plane == 0 && has_surface) {
      hand.distance_plane = atomic_add(&map.counters->distance_planes, 1);
      map.distance_planes[brick] = hand.distance_plane;
      mark_occupied(map, brick);
    }
    if (hand.weight_plane < 0) {
      hand.weight_plane =
          weights_differ ? atomic_add(&map.counters->weight_planes, 1) : -1 - hand.weight[0];
      map.weight_planes[brick] = hand.weight_plane;
    }
  });
  block.each([&](int i) {
    if (hand.distance_plane != 0) {
      BrickMap::plane(map.distances, hand.distance_plane)[i] = hand.tsdf[i];
    }
    if (hand.weight_plane >= 0) BrickMap::plane(map.weights, hand.weight_plane)[i] = hand.weight[i];
  });
}

/// Forgets all measurements.
struct ClearBricks {
  BrickMap map;
  SLAMBENCH_HD void operator()(int i) const {
    if (i == 0) *map.counters = {1, 0, 0};
    if (i < brick_voxels) map.distances[i] = free_space;
    if (i >= map.count()) return;
    map.distance_planes[i] = 0;
    map.weight_planes[i] = -1;
    map.occupancy[i] = 0;
  }
};

/// Fills a cleared map from a flat volume; beyond its resolution the last voxels are repeated.
struct WriteBricks {
  static constexpr int threads = brick_voxels;
  using Shared = BrickInHand;

  BrickMap map;
  const Voxel* voxels;

  template <class Block>
  SLAMBENCH_HD void operator()(const Block& block, Shared& hand) const {
    const Int3 n = map.resolution;
    for (int brick = block.index(); brick < map.count(); brick += block.count()) {
      look_up(block, map, brick, hand);
      block.each([&](int i) {
        const Int3 v = map.voxel(brick, i);
        const auto x = static_cast<std::size_t>(clamp_index(v.x, n.x));
        const auto y = static_cast<std::size_t>(clamp_index(v.y, n.y));
        const auto z = static_cast<std::size_t>(clamp_index(v.z, n.z));
        const Voxel voxel =
            voxels[(z * static_cast<std::size_t>(n.y) + y) * static_cast<std::size_t>(n.x) + x];
        hand.tsdf[i] = voxel.tsdf;
        hand.weight[i] = voxel.weight;
      });
      store(block, map, brick, hand);
    }
  }
};

/// Fills a flat volume from the bricks.
struct ReadBricks {
  static constexpr int threads = brick_voxels;
  using Shared = BrickInHand;

  BrickMap map;
  Voxel* voxels;

  template <class Block>
  SLAMBENCH_HD void operator()(const Block& block, Shared& hand) const {
    const Int3 n = map.resolution;
    for (int brick = block.index(); brick < map.count(); brick += block.count()) {
      look_up(block, map, brick, hand);
      block.each([&](int i) {
        const Int3 v = map.voxel(brick, i);
        if (v.x >= n.x || v.y >= n.y || v.z >= n.z) return;
        const auto row = static_cast<std::size_t>(v.z) * static_cast<std::size_t>(n.y) +
                         static_cast<std::size_t>(v.y);
        voxels[row * static_cast<std::size_t>(n.x) + static_cast<std::size_t>(v.x)] =
            stored_voxel(map, hand, i);
      });
    }
  }
};

}  // namespace slambench::cuda
