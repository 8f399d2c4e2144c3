// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/serial/serial_backend.h"

#include <algorithm>

namespace slambench {
namespace {

/// Calls f(pixel index, x, y) for every pixel, row by row.
template <class F>
void for_each_pixel(Size size, F f) {
  std::size_t i = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) f(i++, x, y);
  }
}

/// Every voxel of every brick.
void integrate_bricks(BrickVolume& volume, Float3 voxel_m, const float* depth_m, Size size,
                      const IntegrateParameters& parameters) {
  std::int16_t tsdf[BrickVolume::voxels], weights[BrickVolume::voxels];
  for (std::size_t brick = 0; brick < volume.count(); ++brick) {
    volume.load(brick, tsdf, weights);
    bool changed = false;
    for (int i = 0; i < BrickVolume::voxels; ++i) {
      const Int3 at = volume.voxel_at(brick, i);
      const Float3 center =
          parameters.T_camera_volume.apply(voxel_center(at.x, at.y, at.z, voxel_m));
      Voxel voxel{tsdf[i], weights[i]};
      changed |= integrate_voxel(&voxel, center, depth_m, size, parameters);
      tsdf[i] = voxel.tsdf;
      weights[i] = voxel.weight;
    }
    if (!changed) continue;
    volume.reserve(1);
    volume.store(brick, tsdf, weights);
  }
  volume.refresh();
}

}  // namespace

bool SerialBackend::supports(Kernel kernel, MapKind map) const {
  return kernel != Kernel::acquire && kernel != Kernel::align &&
         (map == MapKind::grid || map == MapKind::bricks);
}

void SerialBackend::do_generate_gaussian(DeviceImage<float>& weights, float sigma_px) {
  const int radius = weights.size.width / 2;
  for (int i = -radius; i <= radius; ++i)
    pixels(weights)[i + radius] = gaussian_weight(i, sigma_px);
}

void SerialBackend::do_init_volume(Volume& volume) {
  if (volume.map == MapKind::bricks) return bricks(volume).clear();
  std::fill_n(voxels(volume), voxel_count(volume.resolution), Voxel{});
}

void SerialBackend::do_mm2meters(DeviceImage<float>& depth_m,
                                 const DeviceImage<std::uint16_t>& depth, float units_per_m) {
  const int ratio = depth.size.width / depth_m.size.width;
  const std::uint16_t* in = pixels(depth);
  float* out = pixels(depth_m);
  for_each_pixel(depth_m.size, [&](std::size_t i, int x, int y) {
    out[i] = meters_from_units(in[y * ratio * depth.size.width + x * ratio], units_per_m);
  });
}

void SerialBackend::do_bilateral_filter(DeviceImage<float>& filtered_m,
                                        const DeviceImage<float>& depth_m,
                                        const DeviceImage<float>& gaussian, float range_sigma_m) {
  const int radius = gaussian.size.width / 2;
  const float inverse_two_sigma2 = 1.0f / (2.0f * range_sigma_m * range_sigma_m);
  const float* in = pixels(depth_m);
  float* out = pixels(filtered_m);
  for_each_pixel(depth_m.size, [&](std::size_t i, int x, int y) {
    out[i] = bilateral(in, depth_m.size, x, y, pixels(gaussian), radius, inverse_two_sigma2);
  });
}

void SerialBackend::do_half_sample(DeviceImage<float>& half_m, const DeviceImage<float>& depth_m,
                                   float range_m) {
  const float* in = pixels(depth_m);
  float* out = pixels(half_m);
  for_each_pixel(half_m.size, [&](std::size_t i, int x, int y) {
    out[i] = half_sampled(in, depth_m.size, x, y, range_m);
  });
}

void SerialBackend::do_depth2vertex(DeviceImage<Float3>& vertices,
                                    const DeviceImage<float>& depth_m, Intrinsics camera) {
  const float* in = pixels(depth_m);
  Float3* out = pixels(vertices);
  for_each_pixel(depth_m.size, [&](std::size_t i, int x, int y) {
    out[i] = vertex_from_depth(in[i], camera, x, y);
  });
}

void SerialBackend::do_vertex2normal(DeviceImage<Float3>& normals,
                                     const DeviceImage<Float3>& vertices) {
  const Float3* in = pixels(vertices);
  Float3* out = pixels(normals);
  for_each_pixel(vertices.size, [&](std::size_t i, int x, int y) {
    out[i] = normal_from_vertices(in, vertices.size, x, y);
  });
}

void SerialBackend::do_track(DeviceImage<TrackData>& rows, const DeviceImage<Float3>& vertices,
                             const DeviceImage<Float3>& normals,
                             const DeviceImage<Float3>& model_vertices,
                             const DeviceImage<Float3>& model_normals,
                             const TrackParameters& parameters) {
  const Float3 *vertex = pixels(vertices), *normal = pixels(normals);
  TrackData* out = pixels(rows);
  for (std::size_t i = 0; i < rows.size.count(); ++i) {
    out[i] = track_point(vertex[i], normal[i], pixels(model_vertices), pixels(model_normals),
                         model_vertices.size, parameters);
  }
}

Reduction SerialBackend::do_reduce(const DeviceImage<TrackData>& rows) {
  Reduction sum;
  for (std::size_t i = 0; i < rows.size.count(); ++i) accumulate(pixels(rows)[i], &sum);
  return sum;
}

void SerialBackend::do_integrate(Volume& volume, const DeviceImage<float>& depth_m,
                                 const IntegrateParameters& parameters) {
  const Int3 n = volume.resolution;
  const Float3 voxel_m = voxel_size(n, volume.size_m);
  if (volume.map == MapKind::bricks) {
    return integrate_bricks(bricks(volume), voxel_m, pixels(depth_m), depth_m.size, parameters);
  }
  Voxel* voxel = voxels(volume);
  for (int z = 0; z < n.z; ++z) {
    for (int y = 0; y < n.y; ++y) {
      for (int x = 0; x < n.x; ++x, ++voxel) {
        const Float3 center = parameters.T_camera_volume.apply(voxel_center(x, y, z, voxel_m));
        integrate_voxel(voxel, center, pixels(depth_m), depth_m.size, parameters);
      }
    }
  }
}

void SerialBackend::do_raycast(DeviceImage<Float3>& vertices, DeviceImage<Float3>& normals,
                               const Volume& volume, const RaycastParameters& parameters) {
  with_map(volume, [&](const auto& map) {
    for_each_pixel(vertices.size, [&](std::size_t i, int x, int y) {
      raycast_pixel(map, x, y, parameters, &pixels(vertices)[i], &pixels(normals)[i]);
    });
  });
}

void SerialBackend::do_render_depth(DeviceImage<Rgba8>& image, const DeviceImage<float>& depth_m,
                                    float near_m, float far_m) {
  for (std::size_t i = 0; i < image.size.count(); ++i) {
    pixels(image)[i] = depth_color(pixels(depth_m)[i], near_m, far_m);
  }
}

void SerialBackend::do_render_track(DeviceImage<Rgba8>& image, const DeviceImage<TrackData>& rows) {
  for (std::size_t i = 0; i < image.size.count(); ++i) {
    pixels(image)[i] = track_color(pixels(rows)[i].outcome);
  }
}

void SerialBackend::do_render_volume(DeviceImage<Rgba8>& image, const Volume& volume,
                                     const RaycastParameters& view,
                                     const ShadeParameters& shading) {
  with_map(volume, [&](const auto& map) {
    for_each_pixel(image.size, [&](std::size_t i, int x, int y) {
      Float3 vertex, normal;
      raycast_pixel(map, x, y, view, &vertex, &normal);
      pixels(image)[i] = shade(vertex, normal, shading);
    });
  });
}

}  // namespace slambench
