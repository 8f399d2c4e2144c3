// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include "kernels/pixel.h"
#include "kernels/types.h"

/// The per-voxel and per-ray maths, shared by host and device code. Functions that read the volume
/// take any map with
///     Int3 resolution; Float3 size_m;
///     float tsdf(int x, int y, int z) const;   // stored units, x 32766; indices in range
namespace slambench {

/// Edge lengths of a voxel, m.
SLAMBENCH_HD inline Float3 voxel_size(Int3 resolution, Float3 size_m) {
  return {size_m.x / static_cast<float>(resolution.x), size_m.y / static_cast<float>(resolution.y),
          size_m.z / static_cast<float>(resolution.z)};
}

/// The flat volume has x fastest, then y, then z.
SLAMBENCH_HD inline std::size_t voxel_index(Int3 resolution, int x, int y, int z) {
  const auto row = static_cast<std::size_t>(z) * static_cast<std::size_t>(resolution.y) +
                   static_cast<std::size_t>(y);
  return row * static_cast<std::size_t>(resolution.x) + static_cast<std::size_t>(x);
}
SLAMBENCH_HD inline std::size_t voxel_count(Int3 resolution) {
  return voxel_index(resolution, 0, 0, resolution.z);
}

/// The centre of voxel (x, y, z) in the volume's frame, whose origin is its corner.
SLAMBENCH_HD inline Float3 voxel_center(int x, int y, int z, Float3 voxel_m) {
  return {(static_cast<float>(x) + 0.5f) * voxel_m.x, (static_cast<float>(y) + 0.5f) * voxel_m.y,
          (static_cast<float>(z) + 0.5f) * voxel_m.z};
}

/// One measurement of a voxel: the running average of the truncated signed distance (Curless &
/// Levoy 1996; Newcombe et al. 2011, eq. 11 to 13). `center` is the voxel's centre in the camera
/// frame, `depth_m` the unfiltered depth image. True when the voxel was changed.
SLAMBENCH_HD inline bool integrate_voxel(Voxel* voxel, Float3 center, const float* depth_m,
                                         Size size, const IntegrateParameters& p) {
  int x = 0, y = 0;
  if (!project(center, p.camera, size, p.min_depth_m, &x, &y)) return false;
  const float depth = depth_m[y * size.width + x];
  if (!(depth > 0.0f)) return false;

  const float slope_x = center.x / center.z, slope_y = center.y / center.z;
  const float distance = (depth - center.z) * sqrtf(1.0f + slope_x * slope_x + slope_y * slope_y);
  if (!(distance > -p.mu_m)) return false;

  const float sdf = fminf(1.0f, distance / p.mu_m);
  const float weight = voxel->weight;
  const float old = static_cast<float>(voxel->tsdf) * (1.0f / tsdf_scale);
  const float mean = (weight * old + sdf) / (weight + 1.0f);
  voxel->tsdf = static_cast<std::int16_t>(fmaxf(-1.0f, fminf(1.0f, mean)) * tsdf_scale);
  voxel->weight = static_cast<std::int16_t>(fminf(weight + 1.0f, p.max_weight));
  return true;
}

/// The eight voxels around a point and the weights between them.
struct Cell {
  Int3 base;        ///< may be -1 or resolution - 1 at the border: clamp
  Float3 fraction;  ///< in [0, 1)
};

template <class Map>
SLAMBENCH_HD inline Cell cell_of(const Map& map, Float3 p) {
  const float x = p.x * static_cast<float>(map.resolution.x) / map.size_m.x - 0.5f;
  const float y = p.y * static_cast<float>(map.resolution.y) / map.size_m.y - 0.5f;
  const float z = p.z * static_cast<float>(map.resolution.z) / map.size_m.z - 0.5f;
  const float fx = floorf(x), fy = floorf(y), fz = floorf(z);
  return {{static_cast<int>(fx), static_cast<int>(fy), static_cast<int>(fz)},
          {x - fx, y - fy, z - fz}};
}

SLAMBENCH_HD inline float lerp_f(float a, float b, float t) { return a * (1.0f - t) + b * t; }

/// Trilinear truncated signed distance in [-1, 1] at a point of the volume (m); outside, the
/// border's voxels continue.
template <class Map>
SLAMBENCH_HD inline float interpolate(const Map& map, Float3 p) {
  const Cell cell = cell_of(map, p);
  const int x0 = clamp_index(cell.base.x, map.resolution.x);
  const int x1 = clamp_index(cell.base.x + 1, map.resolution.x);
  const int y0 = clamp_index(cell.base.y, map.resolution.y);
  const int y1 = clamp_index(cell.base.y + 1, map.resolution.y);
  const int z0 = clamp_index(cell.base.z, map.resolution.z);
  const int z1 = clamp_index(cell.base.z + 1, map.resolution.z);
  const Float3 f = cell.fraction;
  const float front = lerp_f(lerp_f(map.tsdf(x0, y0, z0), map.tsdf(x1, y0, z0), f.x),
                             lerp_f(map.tsdf(x0, y1, z0), map.tsdf(x1, y1, z0), f.x), f.y);
  const float back = lerp_f(lerp_f(map.tsdf(x0, y0, z1), map.tsdf(x1, y0, z1), f.x),
                            lerp_f(map.tsdf(x0, y1, z1), map.tsdf(x1, y1, z1), f.x), f.y);
  return lerp_f(front, back, f.z) * (1.0f / tsdf_scale);
}

/// The gradient of the truncated signed distance at a point: central differences at the eight
/// voxels around it, trilinearly weighted; per metre, in units of the truncation band.
template <class Map>
SLAMBENCH_HD inline Float3 gradient(const Map& map, Float3 p) {
  const Cell cell = cell_of(map, p);
  const Int3 n = map.resolution;
  Float3 sum;
  for (int corner = 0; corner < 8; ++corner) {
    const int dx = corner & 1, dy = (corner >> 1) & 1, dz = corner >> 2;
    const float weight = (dx != 0 ? cell.fraction.x : 1.0f - cell.fraction.x) *
                         (dy != 0 ? cell.fraction.y : 1.0f - cell.fraction.y) *
                         (dz != 0 ? cell.fraction.z : 1.0f - cell.fraction.z);
    const int rx = cell.base.x + dx, ry = cell.base.y + dy, rz = cell.base.z + dz;
    const int x = clamp_index(rx, n.x), y = clamp_index(ry, n.y), z = clamp_index(rz, n.z);
    sum.x += weight *
             (map.tsdf(clamp_index(rx + 1, n.x), y, z) - map.tsdf(clamp_index(rx - 1, n.x), y, z));
    sum.y += weight *
             (map.tsdf(x, clamp_index(ry + 1, n.y), z) - map.tsdf(x, clamp_index(ry - 1, n.y), z));
    sum.z += weight *
             (map.tsdf(x, y, clamp_index(rz + 1, n.z)) - map.tsdf(x, y, clamp_index(rz - 1, n.z)));
  }
  const Float3 voxel_m = voxel_size(n, map.size_m);
  constexpr float scale = 0.5f / tsdf_scale;
  return {sum.x * scale / voxel_m.x, sum.y * scale / voxel_m.y, sum.z * scale / voxel_m.z};
}

/// The part of a ray inside the volume's box and between the near and far planes, in units of the
/// direction's length; empty when near >= far. Directions may have zero components.
struct RaySegment {
  float near_t = 0, far_t = 0;
};

SLAMBENCH_HD inline void clip_axis(float origin, float direction, float size, RaySegment* s) {
  if (direction == 0.0f) {
    if (origin < 0.0f || origin > size) s->far_t = s->near_t;
    return;
  }
  const float a = (0.0f - origin) / direction, b = (size - origin) / direction;
  s->near_t = fmaxf(s->near_t, fminf(a, b));
  s->far_t = fminf(s->far_t, fmaxf(a, b));
}

SLAMBENCH_HD inline RaySegment clip_ray(Float3 origin, Float3 direction, Float3 size_m,
                                        float near_m, float far_m) {
  RaySegment s{near_m, far_m};
  clip_axis(origin.x, direction.x, size_m.x, &s);
  clip_axis(origin.y, direction.y, size_m.y, &s);
  clip_axis(origin.z, direction.z, size_m.z, &s);
  return s;
}

/// Marches one ray to the first crossing from free space to behind a surface; false when there
/// is none. The direction has depth 1, so that t is camera depth (m).
template <class Map>
SLAMBENCH_HD inline bool find_surface(const Map& map, Float3 origin, Float3 direction,
                                      const RaycastParameters& p, Float3* hit) {
  const RaySegment segment = clip_ray(origin, direction, map.size_m, p.near_m, p.far_m);
  if (!(segment.near_t < segment.far_t)) return false;

  float t = segment.near_t;
  float previous = interpolate(map, origin + direction * t);
  if (!(previous > 0.0f)) return false;  // the ray starts behind a surface

  float step = p.large_step_m;
  float value = previous;
  for (; t < segment.far_t; t += step) {
    value = interpolate(map, origin + direction * t);
    if (value < 0.0f) {
      *hit = origin + direction * (t + step * value / (previous - value));
      return true;
    }
    if (value < p.slow_below) step = p.small_step_m;
    previous = value;
  }
  return false;
}

/// The surface point and normal that pixel (x, y) of the camera sees, in the volume's frame; on a
/// miss, zero and x = invalid_normal.
template <class Map>
SLAMBENCH_HD inline void raycast_pixel(const Map& map, int x, int y, const RaycastParameters& p,
                                       Float3* vertex, Float3* normal) {
  *vertex = {};
  *normal = {invalid_normal, 0.0f, 0.0f};
  const Float3 direction = p.T_volume_camera.rotate(pixel_ray(p.camera, x, y));
  Float3 hit;
  if (!find_surface(map, p.T_volume_camera.translation, direction, p, &hit)) return;
  *vertex = hit;
  const Float3 slope = gradient(map, hit);
  if (length(slope) > 0.0f) *normal = normalized(slope);
}

/// Lambertian grey of a surface point lit from a position; black where there is no surface.
SLAMBENCH_HD inline Rgba8 shade(Float3 vertex, Float3 normal, const ShadeParameters& p) {
  if (normal.x == invalid_normal) return {0, 0, 0, 255};
  const float lambert = fmaxf(dot(normal, normalized(p.light_m - vertex)), 0.0f);
  const auto grey =
      static_cast<std::uint8_t>(fmaxf(0.0f, fminf(1.0f, lambert + p.ambient)) * 255.0f);
  return {grey, grey, grey, 255};
}

/// The flat volume.
struct GridView {
  const Voxel* voxels = nullptr;
  Int3 resolution;
  Float3 size_m;

  SLAMBENCH_HD float tsdf(int x, int y, int z) const {
    return static_cast<float>(voxels[voxel_index(resolution, x, y, z)].tsdf);
  }
};

}  // namespace slambench
