// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cmath>

#include "backends/cuda/brick_map.h"
#include "backends/cuda/found_pose.h"

/// integrate: the flat volume voxel by voxel; of the bricks only those that a measurement changes.
namespace slambench::cuda {

/// One row of voxels of the flat volume: threads of a block take neighbouring ones.
struct IntegrateGrid {
  static constexpr bool of_tracked_frames = true;

  Voxel* voxels;
  Int3 resolution;
  Float3 voxel_m;
  const float* depth_m;
  Size size;
  IntegrateParameters parameters;

  SLAMBENCH_HD void operator()(int x, int y, int z) const {
    const auto row = static_cast<std::size_t>(z) * static_cast<std::size_t>(resolution.y) +
                     static_cast<std::size_t>(y);
    const Float3 center = parameters.T_camera_volume.apply(voxel_center(x, y, z, voxel_m));
    integrate_voxel(
        voxels + row * static_cast<std::size_t>(resolution.x) + static_cast<std::size_t>(x), center,
        depth_m, size, parameters);
  }
  SLAMBENCH_HD void move_to(const FoundPose& found) {
    parameters.T_camera_volume = found.T_camera_volume;
  }
};

/// Fills the flat volume with fresh voxels.
struct ClearGrid {
  Voxel* voxels;
  Int3 resolution;
  SLAMBENCH_HD void operator()(int x, int y, int z) const {
    const auto row = static_cast<std::size_t>(z) * static_cast<std::size_t>(resolution.y) +
                     static_cast<std::size_t>(y);
    voxels[row * static_cast<std::size_t>(resolution.x) + static_cast<std::size_t>(x)] = Voxel{};
  }
};

/// Least and greatest depth of square tiles, in levels of halving resolution; 0 stands for what is
/// no depth, so that a tile with a hole has the least depth 0.
struct DepthRange {
  float least, greatest;
};

struct DepthPyramid {
  static constexpr int levels = 5;
  static constexpr int finest_tile = 4;  ///< pixels
  static constexpr int most_tiles = 3;   ///< along an axis, that are looked at of one level

  Size size;  ///< of the image
  DepthRange* tiles = nullptr;

  SLAMBENCH_HD static int edge(int level) { return finest_tile << level; }
  /// Where a level's tiles start; of level `levels`: how many there are.
  SLAMBENCH_HD static int first(Size image, int level) {
    int count = 0;
    for (int i = 0; i < level; ++i) {
      const Size t = tiles_of(image, edge(i));
      count += t.width * t.height;
    }
    return count;
  }

  SLAMBENCH_HD static DepthRange joined(DepthRange a, DepthRange b) {
    return {fminf(a.least, b.least), fmaxf(a.greatest, b.greatest)};
  }
  /// Of nothing: joined with another, it is the other.
  SLAMBENCH_HD static DepthRange nothing() { return {HUGE_VALF, 0.0f}; }

  /// Over pixels [x0, x1] x [y0, y1], which lie in the image, and some more around.
  SLAMBENCH_HD DepthRange range(int x0, int y0, int x1, int y1) const {
    int level = 0;
    while (level + 1 < levels && (x1 / edge(level) - x0 / edge(level) >= most_tiles ||
                                  y1 / edge(level) - y0 / edge(level) >= most_tiles)) {
      ++level;
    }
    const int tile = edge(level), width = parts_of(size.width, tile);
    const DepthRange* first_tile = tiles + first(size, level);
    DepthRange all = nothing();
    for (int y = y0 / tile; y <= y1 / tile; ++y) {
      for (int x = x0 / tile; x <= x1 / tile; ++x) {
        all = joined(all, first_tile[y * width + x]);
      }
    }
    return all;
  }
};

/// Fills the pyramid: a block for each tile of the coarsest level, a thread for each of the finest
/// tiles in it. Empties the list of bricks as well.
struct BuildDepthPyramid {
  static constexpr int side = 1 << (DepthPyramid::levels - 1);  ///< finest tiles along a coarsest
  static constexpr int threads = side * side;
  struct Shared {
    DepthRange tile[DepthPyramid::levels][threads];
  };

  DepthPyramid pyramid;
  const float* depth_m;
  BrickCounters* counters;

  SLAMBENCH_HD DepthRange finest(int tx, int ty) const {
    constexpr int edge = DepthPyramid::finest_tile;
    const int x1 = least(pyramid.size.width, (tx + 1) * edge);
    const int y1 = least(pyramid.size.height, (ty + 1) * edge);
    DepthRange range = DepthPyramid::nothing();
    for (int y = ty * edge; y < y1; ++y) {
      for (int x = tx * edge; x < x1; ++x) {
        const float depth = depth_m[pixel_index(pyramid.size, x, y)];
        const float valid = depth > 0.0f ? depth : 0.0f;
        range = DepthPyramid::joined(range, {valid, valid});
      }
    }
    return range;
  }

  template <class Block>
  SLAMBENCH_HD void operator()(const Block& block, Shared& shared) const {
    const int across = parts_of(pyramid.size.width, DepthPyramid::edge(DepthPyramid::levels - 1));
    const int block_x = block.index() % across, block_y = block.index() / across;
    for (int level = 0; level < DepthPyramid::levels; ++level) {
      const int edge = side >> level;  // tiles of this level along the block
      const Size tiles = tiles_of(pyramid.size, DepthPyramid::edge(level));
      block.each([&](int thread) {
        if (level == 0 && block.index() == 0 && thread == 0) counters->varied = 0;
        if (thread >= edge * edge) return;
        const int x = thread % edge, y = thread / edge;
        const int tx = block_x * edge + x, ty = block_y * edge + y;
        DepthRange range = DepthPyramid::nothing();
        if (level == 0) {
          range = finest(tx, ty);
        } else {
          const DepthRange* below = shared.tile[level - 1] + 2 * y * 2 * edge + 2 * x;
          range = DepthPyramid::joined(DepthPyramid::joined(below[0], below[1]),
                                       DepthPyramid::joined(below[2 * edge], below[2 * edge + 1]));
        }
        shared.tile[level][thread] = range;
        if (tx >= tiles.width || ty >= tiles.height) return;
        pyramid.tiles[DepthPyramid::first(pyramid.size, level) + ty * tiles.width + tx] = range;
      });
    }
  }
};

/// One call of integrate on bricks.
struct BrickMeasurement {
  BrickMap map;
  Float3 voxel_m;
  const float* depth_m;
  Size size;
  IntegrateParameters parameters;
  float tolerance_m;  ///< how far rounding may move a voxel
};

/// What a measurement does to a brick.
enum class BrickChange {
  none,    ///< no voxel is measured
  free,    ///< every voxel is measured as free space, a truncated distance of 1
  varied,  ///< look at every voxel
};

/// From where the voxels at the brick's corners are: between them the projection is convex.
/// Tolerances make up for the rounding of single voxels.
SLAMBENCH_HD inline BrickChange change_of(const BrickMeasurement& in, const DepthPyramid& depth,
                                          int brick) {
  const IntegrateParameters& p = in.parameters;
  Float3 corners[8];
  float near_m = HUGE_VALF, far_m = -HUGE_VALF;
  for (int i = 0; i < 8; ++i) {
    constexpr int last = brick_edge - 1;
    const int voxel = (i & 1) * last + ((i >> 1) & 1) * last * brick_edge +
                      (i >> 2) * last * brick_edge * brick_edge;
    const Int3 v = in.map.voxel(brick, voxel);
    corners[i] = p.T_camera_volume.apply(voxel_center(v.x, v.y, v.z, in.voxel_m));
    near_m = fminf(near_m, corners[i].z);
    far_m = fmaxf(far_m, corners[i].z);
  }
  if (far_m < p.min_depth_m - in.tolerance_m) return BrickChange::none;
  if (near_m < p.min_depth_m + in.tolerance_m) return BrickChange::varied;

  float u0 = HUGE_VALF, u1 = -HUGE_VALF, v0 = HUGE_VALF, v1 = -HUGE_VALF;
  for (const Float3& c : corners) {
    const float u = p.camera.fx * c.x / c.z + p.camera.cx + 0.5f;
    const float v = p.camera.fy * c.y / c.z + p.camera.cy + 0.5f;
    u0 = fminf(u0, u), u1 = fmaxf(u1, u);
    v0 = fminf(v0, v), v1 = fmaxf(v1, v);
  }
  const float focal = fmaxf(fabsf(p.camera.fx), fabsf(p.camera.fy));
  const float tolerance_px = 1e-3f + focal * in.tolerance_m / near_m;
  u0 -= tolerance_px, v0 -= tolerance_px, u1 += tolerance_px, v1 += tolerance_px;
  const auto last_x = static_cast<float>(in.size.width - 1);
  const auto last_y = static_cast<float>(in.size.height - 1);
  if (!(u1 >= 0 && v1 >= 0 && u0 <= last_x && v0 <= last_y)) return BrickChange::none;
  const bool whole = u0 >= 0 && v0 >= 0 && u1 <= last_x && v1 <= last_y;
  const DepthRange range =
      depth.range(static_cast<int>(fmaxf(0.0f, u0)), static_cast<int>(fmaxf(0.0f, v0)),
                  static_cast<int>(fminf(last_x, u1)), static_cast<int>(fminf(last_y, v1)));
  // A distance along the ray is at least the one along the axis, which these compare.
  if (range.greatest - near_m < -p.mu_m - in.tolerance_m) return BrickChange::none;
  if (whole && range.least - far_m > p.mu_m + in.tolerance_m) return BrickChange::free;
  return BrickChange::varied;
}

/// Counts a measurement of the bricks that are and stay free, and lists those to look at.
struct ClassifyBricks {
  static constexpr bool of_tracked_frames = true;
  static constexpr int threads = 128;
  struct Shared {};

  BrickMeasurement in;
  DepthPyramid depth;

  /// Whether the brick is to be looked at.
  SLAMBENCH_HD bool varied(int brick) const {
    if (brick >= in.map.count()) return false;
    const BrickChange change = change_of(in, depth, brick);
    if (change != BrickChange::free) return change == BrickChange::varied;
    std::int32_t& weights = in.map.weight_planes[brick];
    if (in.map.distance_planes[brick] != 0 || weights >= 0) return true;
    const auto weight = static_cast<float>(-1 - weights);
    weights = -1 - static_cast<int>(fminf(weight + 1.0f, in.parameters.max_weight));
    return false;
  }

  template <class Block>
  SLAMBENCH_HD void operator()(const Block& block, Shared&) const {
    const int first = block.index() * threads;
    block.append(
        &in.map.counters->varied, [&](int thread) { return varied(first + thread); },
        [&](int thread, int place) { in.map.varied[place] = first + thread; });
  }
  SLAMBENCH_HD void move_to(const FoundPose& found) {
    in.parameters.T_camera_volume = found.T_camera_volume;
  }
};

/// Updates the listed bricks, whole ones by one block.
struct IntegrateBricks {
  static constexpr bool of_tracked_frames = true;
  static constexpr int threads = brick_voxels;
  using Shared = BrickInHand;

  BrickMeasurement in;

  template <class Block>
  SLAMBENCH_HD void operator()(const Block& block, Shared& hand) const {
    const int count = in.map.counters->varied;
    for (int place = block.index(); place < count; place += block.count()) {
      const int brick = in.map.varied[place];
      look_up(block, in.map, brick, hand);
      const bool changed = block.any([&](int i) {
        const Voxel old = stored_voxel(in.map, hand, i);
        const Int3 v = in.map.voxel(brick, i);
        const Float3 center =
            in.parameters.T_camera_volume.apply(voxel_center(v.x, v.y, v.z, in.voxel_m));
        Voxel voxel = old;
        integrate_voxel(&voxel, center, in.depth_m, in.size, in.parameters);
        hand.tsdf[i] = voxel.tsdf;
        hand.weight[i] = voxel.weight;
        return voxel.tsdf != old.tsdf || voxel.weight != old.weight;
      });
      if (changed) store(block, in.map, brick, hand);
    }
  }
  SLAMBENCH_HD void move_to(const FoundPose& found) {
    in.parameters.T_camera_volume = found.T_camera_volume;
  }
};

}  // namespace slambench::cuda
