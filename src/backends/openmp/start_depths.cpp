// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/openmp/start_depths.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/volume_maths.h"

namespace slambench {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
/// Bricks are cut into this many chunks, each with tiles of its own.
constexpr int parts = 8;

/// A point of the camera frame before its division by depth, in pixels times depth.
struct Projected {
  float u, v, z;
};

Projected operator+(Projected a, Projected b) { return {a.u + b.u, a.v + b.v, a.z + b.z}; }

/// The camera: K and the pose, applied to points (w = 1) and to directions (w = 0) of the volume.
struct Projection {
  Rigid3f T_volume_camera;
  Intrinsics camera;

  Projected direction(Float3 d) const {
    const Float3 &r0 = T_volume_camera.row0, &r1 = T_volume_camera.row1, &r2 = T_volume_camera.row2;
    const float x = r0.x * d.x + r1.x * d.y + r2.x * d.z;
    const float y = r0.y * d.x + r1.y * d.y + r2.y * d.z;
    const float z = r0.z * d.x + r1.z * d.y + r2.z * d.z;
    return {camera.fx * x + camera.cx * z, camera.fy * y + camera.cy * z, z};
  }
  Projected point(Float3 p) const { return direction(p - T_volume_camera.translation); }
};

/// Marks the tiles that see the box with the given corners.
class Marker {
 public:
  Marker(Size size, Size tiles, float near_m, std::vector<float>* depths)
      : size_(size), tiles_(tiles), near_m_(near_m), depths_(depths) {}

  void mark(const Projected (&corners)[8]) {
    float least = infinity, greatest = -infinity;
    bool left = true, right = true, above = true, below = true;
    const auto last_x = static_cast<float>(size_.width), last_y = static_cast<float>(size_.height);
    for (const Projected& c : corners) {
      least = std::min(least, c.z);
      greatest = std::max(greatest, c.z);
      left &= c.u + c.z < 0;
      above &= c.v + c.z < 0;
      right &= c.u > last_x * c.z;
      below &= c.v > last_y * c.z;
    }
    if (greatest < near_m_ || left || right || above || below) return;
    constexpr float in_front_m = 1e-3f;
    if (least < in_front_m) {  // its image is not bounded
      std::fill(depths_->begin(), depths_->end(), -infinity);
      return;
    }
    float u0 = infinity, u1 = -infinity, v0 = infinity, v1 = -infinity;
    for (const Projected& c : corners) {
      const float u = c.u / c.z, v = c.v / c.z;
      u0 = std::min(u0, u), u1 = std::max(u1, u);
      v0 = std::min(v0, v), v1 = std::max(v1, v);
    }
    const auto tile_of = [](float pixel, int count) {
      const float limited = std::clamp(pixel, 0.0f, static_cast<float>(count * StartDepths::tile));
      return std::min(count - 1, static_cast<int>(limited) / StartDepths::tile);
    };
    // Half a pixel would do; one makes up for rounding.
    const int tx1 = tile_of(u1 + 1, tiles_.width), ty1 = tile_of(v1 + 1, tiles_.height);
    const int tx0 = tile_of(u0 - 1, tiles_.width);
    for (int ty = tile_of(v0 - 1, tiles_.height); ty <= ty1; ++ty) {
      float* row = depths_->data() + static_cast<std::ptrdiff_t>(ty) * tiles_.width;
      for (int tx = tx0; tx <= tx1; ++tx) row[tx] = std::min(row[tx], least);
    }
  }

 private:
  Size size_, tiles_;
  float near_m_;
  std::vector<float>* depths_;
};

}  // namespace

int skip_level(const RaycastParameters& view) {
  // Rounding of the interpolation is far below this.
  constexpr double margin = 1e-4;
  const double least = (std::max(0.0, static_cast<double>(view.slow_below)) + margin) * tsdf_scale;
  return BrickVolume::level_of(0) + static_cast<int>(std::ceil(least / 256));
}

void StartDepths::build(const BrickView& map, const RaycastParameters& view, Size size,
                        const Parallel& parallel) {
  constexpr int edge = BrickVolume::edge;
  tiles_ = {(size.width + tile - 1) / tile, (size.height + tile - 1) / tile};
  const BrickVolume& volume = *map.volume;
  const Int3 bricks = volume.bricks();
  const Float3 voxel_m = voxel_size(map.resolution, map.size_m);
  const Projection projection{view.T_volume_camera, view.camera};
  // Samples that read a brick lie up to a voxel beside it, at the volume's border anywhere beyond
  // its last voxels' centres, and a little more for rounding.
  constexpr float margin = 1.01f;
  const auto low = [](int brick) { return static_cast<float>(brick * edge) - margin + 0.5f; };
  const auto high = [](int brick, int n) {
    const int end = std::min(n, brick * edge + edge);
    return static_cast<float>(end) + margin - 0.5f;
  };

  const int level = skip_level(view);
  const bool skips = level <= BrickVolume::free_level;
  const int planes = static_cast<int>(volume.planes_used());
  const int grain = std::max(1, (planes + parts - 1) / parts);
  parts_.resize(parts);
  for (std::vector<float>& part : parts_) {
    part.assign(tiles_.count(), skips ? infinity : -infinity);
  }
  parallel.for_chunks(planes, grain, [&](int begin, int end) {
    Marker marker(size, tiles_, view.near_m, &parts_[static_cast<std::size_t>(begin / grain)]);
    for (int plane = std::max(1, begin); plane < end; ++plane) {
      const int brick = volume.owner(static_cast<std::size_t>(plane));
      if (volume.level(static_cast<std::size_t>(brick)) >= level) continue;
      const int bx = brick % bricks.x, by = brick / bricks.x % bricks.y;
      const int bz = brick / bricks.x / bricks.y;
      const float x[2] = {low(bx) * voxel_m.x, high(bx, map.resolution.x) * voxel_m.x};
      const float y[2] = {low(by) * voxel_m.y, high(by, map.resolution.y) * voxel_m.y};
      const float z[2] = {low(bz) * voxel_m.z, high(bz, map.resolution.z) * voxel_m.z};
      const Projected first = projection.point({x[0], y[0], z[0]});
      const Projected along_x = projection.direction({x[1] - x[0], 0, 0});
      const Projected along_y = projection.direction({0, y[1] - y[0], 0});
      const Projected along_z = projection.direction({0, 0, z[1] - z[0]});
      const Projected a = first + along_x, b = first + along_y, c = a + along_y;
      marker.mark({first, a, b, c, first + along_z, a + along_z, b + along_z, c + along_z});
    }
  });
  depths_ = parts_[0];
  for (const std::vector<float>& part : parts_) {
    for (std::size_t i = 0; i < part.size(); ++i) depths_[i] = std::min(depths_[i], part[i]);
  }
}

}  // namespace slambench
