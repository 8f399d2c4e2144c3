// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cmath>

#include "backends/cuda/brick_map.h"
#include "backends/cuda/found_pose.h"

/// raycast and render_volume. Through bricks, rays pass over what is known to be free: they add up
/// the same depths as slambench::find_surface and find the same surface.
namespace slambench::cuda {

/// Per tile of a view, a depth before which every sample of the volume is +1: the least depth of
/// the bricks with distances of their own, projected into the image.
struct StartDepths {
  static constexpr int tile = 8;  ///< pixels

  Size size;  ///< of the image
  float* depths = nullptr;

  SLAMBENCH_HD Size tiles() const { return tiles_of(size, tile); }
  /// Of all tiles, behind theirs: 0 when something has no bounded image.
  SLAMBENCH_HD int everywhere() const { return tiles().width * tiles().height; }
  SLAMBENCH_HD float at(int x, int y) const {
    return fminf(depths[y / tile * tiles().width + x / tile], depths[everywhere()]);
  }
};

struct ClearStartDepths {
  StartDepths start;
  SLAMBENCH_HD void operator()(int i) const {
    if (i <= start.everywhere()) start.depths[i] = HUGE_VALF;
  }
};

/// A point of the camera frame before its division by depth, in pixels times depth.
struct Projected {
  float u, v, z;
};

/// The point of the volume as the camera sees it: K and the inverse of the pose.
SLAMBENCH_HD inline Projected projected(const RaycastParameters& view, Float3 point) {
  const Rigid3f& t = view.T_volume_camera;
  const Float3 d = point - t.translation;
  const float x = t.row0.x * d.x + t.row1.x * d.y + t.row2.x * d.z;
  const float y = t.row0.y * d.x + t.row1.y * d.y + t.row2.y * d.z;
  const float z = t.row0.z * d.x + t.row1.z * d.y + t.row2.z * d.z;
  return {view.camera.fx * x + view.camera.cx * z, view.camera.fy * y + view.camera.cy * z, z};
}

/// The tile that a pixel coordinate lies in, clamped to the image's.
SLAMBENCH_HD inline int tile_at(float pixel, int tiles) {
  const float last = static_cast<float>(tiles * StartDepths::tile);
  return least(tiles - 1, static_cast<int>(fmaxf(0.0f, fminf(last, pixel))) / StartDepths::tile);
}

/// Lowers the start depths of the tiles that see brick i, if it has distances of its own.
struct MarkStartDepths {
  static constexpr bool of_tracked_frames = false;

  BrickMap map;
  RaycastParameters view;
  StartDepths start;

  /// The box of points whose samples read the brick: a voxel beside it and a little for rounding.
  SLAMBENCH_HD Float3 corner(Int3 brick, Float3 voxel_m, int which) const {
    constexpr float margin = 1.01f;
    const auto low = [&](int b) { return static_cast<float>(b * brick_edge) - margin + 0.5f; };
    const auto high = [&](int b, int n) {
      return static_cast<float>(least(n, b * brick_edge + brick_edge)) + margin - 0.5f;
    };
    return {
        ((which & 1) != 0 ? high(brick.x, map.resolution.x) : low(brick.x)) * voxel_m.x,
        ((which & 2) != 0 ? high(brick.y, map.resolution.y) : low(brick.y)) * voxel_m.y,
        ((which & 4) != 0 ? high(brick.z, map.resolution.z) : low(brick.z)) * voxel_m.z,
    };
  }

  SLAMBENCH_HD void operator()(int i) const {
    if (i >= map.count() || map.distance_planes[i] == 0) return;
    constexpr float in_front_m = 1e-3f;
    const Int3 brick = map.position(i);
    const Float3 voxel_m = voxel_size(map.resolution, map.size_m);
    const auto last_x = static_cast<float>(start.size.width);
    const auto last_y = static_cast<float>(start.size.height);
    float near_m = HUGE_VALF, far_m = -HUGE_VALF;
    float u0 = HUGE_VALF, u1 = -HUGE_VALF, v0 = HUGE_VALF, v1 = -HUGE_VALF;
    bool left = true, right = true, above = true, below = true;
    for (int which = 0; which < 8; ++which) {
      const Projected c = projected(view, corner(brick, voxel_m, which));
      near_m = fminf(near_m, c.z), far_m = fmaxf(far_m, c.z);
      left = left && c.u + c.z < 0;
      above = above && c.v + c.z < 0;
      right = right && c.u > last_x * c.z;
      below = below && c.v > last_y * c.z;
      u0 = fminf(u0, c.u / c.z), u1 = fmaxf(u1, c.u / c.z);
      v0 = fminf(v0, c.v / c.z), v1 = fmaxf(v1, c.v / c.z);
    }
    if (far_m < view.near_m || left || right || above || below) return;
    if (near_m < in_front_m) {  // its image is not bounded
      atomic_lower(start.depths + start.everywhere(), 0.0f);
      return;
    }
    // Half a pixel would do; one makes up for rounding.
    const Size tiles = start.tiles();
    const int tx0 = tile_at(u0 - 1, tiles.width), tx1 = tile_at(u1 + 1, tiles.width);
    const int ty1 = tile_at(v1 + 1, tiles.height);
    for (int ty = tile_at(v0 - 1, tiles.height); ty <= ty1; ++ty) {
      for (int tx = tx0; tx <= tx1; ++tx) {
        atomic_lower(start.depths + ty * tiles.width + tx, near_m);
      }
    }
  }
  SLAMBENCH_HD void move_to(const FoundPose& found) {
    view.T_volume_camera = found.T_volume_camera;
  }
};

/// slambench::find_surface, given a depth before which every sample is +1.
SLAMBENCH_HD inline bool find_surface(const BrickMap& map, Float3 origin, Float3 direction,
                                      const RaycastParameters& p, float start_m, Float3* hit) {
  const RaySegment segment = clip_ray(origin, direction, map.size_m, p.near_m, p.far_m);
  if (!(segment.near_t < segment.far_t)) return false;

  // The interpolation of equal values may round: it must not matter for the steps.
  const bool may_skip = p.slow_below < 0.999f;
  float t = segment.near_t, step = p.large_step_m;
  float previous = 1.0f, previous_t = t;
  bool first = true, skipped = false;
  while (may_skip && t < segment.far_t && t + step < start_m) {
    previous_t = t;
    t += step;
    first = false;
    skipped = true;
  }
  for (; t < segment.far_t; t += step) {
    const Float3 point = origin + direction * t;
    // In the band there is nothing to skip.
    if (may_skip && previous >= 0.99f && !map.occupied(cell_of(map, point))) {
      previous = 1.0f;
      previous_t = t;
      first = false;
      skipped = true;
      continue;
    }
    const float value = interpolate(map, point);
    if (first && !(value > 0.0f)) return false;  // the ray starts behind a surface
    if (value < 0.0f) {
      // Nor for the crossing: the sample before is taken after all.
      if (skipped) previous = interpolate(map, origin + direction * previous_t);
      *hit = origin + direction * (t + step * value / (previous - value));
      return true;
    }
    if (value < p.slow_below) step = p.small_step_m;
    previous = value;
    first = false;
    skipped = false;
  }
  return false;
}

/// slambench::raycast_pixel on the flat volume.
struct GridRays {
  GridView map;
  SLAMBENCH_HD void cast(int x, int y, const RaycastParameters& p, Float3* vertex,
                         Float3* normal) const {
    raycast_pixel(map, x, y, p, vertex, normal);
  }
};

/// The same on bricks.
struct BrickRays {
  BrickMap map;
  StartDepths start;
  SLAMBENCH_HD void cast(int x, int y, const RaycastParameters& p, Float3* vertex,
                         Float3* normal) const {
    *vertex = {};
    *normal = {invalid_normal, 0.0f, 0.0f};
    const Float3 direction = p.T_volume_camera.rotate(pixel_ray(p.camera, x, y));
    Float3 hit;
    if (!cuda::find_surface(map, p.T_volume_camera.translation, direction, p, start.at(x, y),
                            &hit)) {
      return;
    }
    *vertex = hit;
    const Float3 slope = gradient(map, hit);
    if (length(slope) > 0.0f) *normal = normalized(slope);
  }
};

template <class Rays>
struct Raycast {
  static constexpr bool of_tracked_frames = false;
  /// Rays of a warp should stay together.
  static constexpr bool square = true;

  Rays rays;
  RaycastParameters parameters;
  Float3* vertices;
  Float3* normals;
  Size size;
  SLAMBENCH_HD void operator()(int x, int y) const {
    const int i = pixel_index(size, x, y);
    rays.cast(x, y, parameters, &vertices[i], &normals[i]);
  }
  SLAMBENCH_HD void move_to(const FoundPose& found) {
    parameters.T_volume_camera = found.T_volume_camera;
  }
};

template <class Rays>
struct RenderVolume {
  static constexpr bool square = true;

  Rays rays;
  RaycastParameters view;
  ShadeParameters shading;
  Rgba8* image;
  Size size;
  SLAMBENCH_HD void operator()(int x, int y) const {
    Float3 vertex, normal;
    rays.cast(x, y, view, &vertex, &normal);
    image[pixel_index(size, x, y)] = shade(vertex, normal, shading);
  }
};

}  // namespace slambench::cuda
