// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/openmp/openmp_backend.h"

#include <algorithm>

#include "backends/align.h"
#include "backends/openmp/image_kernels.h"
#include "backends/openmp/raycast_kernels.h"

namespace slambench {
namespace {

constexpr int image_rows = 8;      // of a chunk
constexpr int ray_rows = 4;        // of a chunk of rays, which take long
constexpr int volume_rows = 64;    // of a chunk of the flat volume
constexpr int bricks_at_once = 8;  // of a chunk of bricks

}  // namespace

bool OpenmpBackend::supports(Kernel kernel, MapKind map) const {
  return kernel != Kernel::acquire && (map == MapKind::grid || map == MapKind::bricks);
}

template <class F>
void OpenmpBackend::for_rows(int height, const F& f) const {
  parallel_.for_chunks(height, image_rows, [&](int begin, int end) { f(Rows{begin, end}); });
}

template <class F>
Reduction OpenmpBackend::sum_bands(Size size, const F& f) {
  const int count = (size.height + band_rows - 1) / band_rows;
  bands_.resize(static_cast<std::size_t>(count));
  parallel_.for_chunks(size.height, band_rows, [&](int begin, int end) {
    bands_[static_cast<std::size_t>(begin / band_rows)] = f(Rows{begin, end});
  });
  Reduction sum;
  for (const Reduction& band : bands_) add(band, &sum);
  return sum;
}

void OpenmpBackend::do_generate_gaussian(DeviceImage<float>& weights, float sigma_px) {
  const int radius = weights.size.width / 2;
  for (int i = -radius; i <= radius; ++i)
    pixels(weights)[i + radius] = gaussian_weight(i, sigma_px);
}

void OpenmpBackend::do_init_volume(Volume& volume) {
  if (volume.map == MapKind::bricks) return bricks(volume).clear();
  Voxel* voxel = voxels(volume);
  const Int3 n = volume.resolution;
  parallel_.for_chunks(n.z, 1, [&](int begin, int end) {
    std::fill(voxel + voxel_index(n, 0, 0, begin), voxel + voxel_index(n, 0, 0, end), Voxel{});
  });
}

void OpenmpBackend::do_mm2meters(DeviceImage<float>& depth_m,
                                 const DeviceImage<std::uint16_t>& depth, float units_per_m) {
  const int ratio = depth.size.width / depth_m.size.width;
  for_rows(depth_m.size.height, [&](Rows rows) {
    mm2meters_rows(pixels(depth_m), depth_m.size, pixels(depth), ratio, units_per_m, rows);
  });
}

void OpenmpBackend::do_bilateral_filter(DeviceImage<float>& filtered_m,
                                        const DeviceImage<float>& depth_m,
                                        const DeviceImage<float>& gaussian, float range_sigma_m) {
  const float inverse_two_sigma2 = 1.0f / (2.0f * range_sigma_m * range_sigma_m);
  for_rows(depth_m.size.height, [&](Rows rows) {
    bilateral_rows(pixels(filtered_m), pixels(depth_m), depth_m.size, pixels(gaussian),
                   gaussian.size.width / 2, inverse_two_sigma2, rows);
  });
}

void OpenmpBackend::do_half_sample(DeviceImage<float>& half_m, const DeviceImage<float>& depth_m,
                                   float range_m) {
  for_rows(half_m.size.height, [&](Rows rows) {
    half_sample_rows(pixels(half_m), half_m.size, pixels(depth_m), depth_m.size, range_m, rows);
  });
}

void OpenmpBackend::do_depth2vertex(DeviceImage<Float3>& vertices,
                                    const DeviceImage<float>& depth_m, Intrinsics camera) {
  for_rows(depth_m.size.height, [&](Rows rows) {
    depth2vertex_rows(pixels(vertices), pixels(depth_m), depth_m.size, camera, rows);
  });
}

void OpenmpBackend::do_vertex2normal(DeviceImage<Float3>& normals,
                                     const DeviceImage<Float3>& vertices) {
  for_rows(vertices.size.height, [&](Rows rows) {
    vertex2normal_rows(pixels(normals), pixels(vertices), vertices.size, rows);
  });
}

void OpenmpBackend::do_track(DeviceImage<TrackData>& rows, const DeviceImage<Float3>& vertices,
                             const DeviceImage<Float3>& normals,
                             const DeviceImage<Float3>& model_vertices,
                             const DeviceImage<Float3>& model_normals,
                             const TrackParameters& parameters) {
  const TrackInput input = {
      pixels(vertices),      pixels(normals),     vertices.size, pixels(model_vertices),
      pixels(model_normals), model_vertices.size, parameters};
  for_rows(rows.size.height, [&](Rows part) { track_rows(pixels(rows), input, part); });
}

Reduction OpenmpBackend::do_reduce(const DeviceImage<TrackData>& rows) {
  const TrackData* track = pixels(rows);
  return sum_bands(rows.size, [&](Rows band) { return reduce_band(track, rows.size, band); });
}

Twist OpenmpBackend::do_solve(const Reduction& reduction, double condition) {
  return solve_motion_quickly(reduction, condition);
}

AlignResult OpenmpBackend::do_align(const AlignInput& input, double condition) {
  TrackInput track = {nullptr,
                      nullptr,
                      {},
                      pixels(*input.model_vertices),
                      pixels(*input.model_normals),
                      input.model_vertices->size,
                      input.parameters};
  const auto match = [&](std::size_t level, const TrackParameters& at) {
    track.vertices = pixels(*input.vertices[level]);
    track.normals = pixels(*input.normals[level]);
    track.size = input.vertices[level]->size;
    track.parameters = at;
    return sum_bands(track.size, [&](Rows band) { return track_reduce_band(track, band); });
  };
  AlignResult result =
      iterate_align(input, match, [&](const Reduction& sums) { return do_solve(sums, condition); });
  if (input.keep_rows && track.vertices != nullptr) {  // `track` is still the last iteration's
    TrackData* rows = pixels(*input.rows[static_cast<std::size_t>(result.last_level)]);
    for_rows(track.size.height, [&](Rows part) { track_rows(rows, track, part); });
  }
  return result;
}

void OpenmpBackend::do_integrate(Volume& volume, const DeviceImage<float>& depth_m,
                                 const IntegrateParameters& parameters) {
  depth_.build(pixels(depth_m), depth_m.size, parallel_);
  const Float3 size_m = volume.size_m;
  const IntegrateInput input = {pixels(depth_m),
                                depth_m.size,
                                parameters,
                                volume.resolution,
                                voxel_size(volume.resolution, size_m),
                                depth_.greatest(),
                                1e-5f * std::max({size_m.x, size_m.y, size_m.z})};
  if (volume.map == MapKind::bricks) return integrate_bricks(bricks(volume), input);
  Voxel* voxel = voxels(volume);
  parallel_.for_chunks(volume.resolution.y * volume.resolution.z, volume_rows,
                       [&](int begin, int end) { integrate_rows(voxel, input, begin, end); });
}

void OpenmpBackend::integrate_bricks(BrickVolume& volume, const IntegrateInput& input) {
  const Int3 bricks = volume.bricks();
  slices_.resize(static_cast<std::size_t>(bricks.z));
  parallel_.for_chunks(bricks.z, 1, [&](int bz, int) {
    std::vector<BrickWork>& slice = slices_[static_cast<std::size_t>(bz)];
    slice.clear();
    for (int by = 0; by < bricks.y; ++by) classify_bricks(volume, input, depth_, by, bz, &slice);
  });
  work_.clear();
  for (const std::vector<BrickWork>& slice : slices_) {
    work_.insert(work_.end(), slice.begin(), slice.end());
  }
  volume.reserve(work_.size());
  parallel_.for_chunks(static_cast<int>(work_.size()), bricks_at_once, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      integrate_brick(volume, input, work_[static_cast<std::size_t>(i)]);
    }
  });
  volume.refresh();
}

void OpenmpBackend::march(RaycastOutput output, const Volume& volume,
                          const RaycastParameters& parameters) {
  if (volume.map == MapKind::bricks) {
    start_.build(brick_view(volume), parameters, output.size, parallel_);
    output.start = &start_;
  }
  with_map(volume, [&](const auto& map) {
    const bool reaches = raycast_reaches(map);
    parallel_.for_chunks(output.size.height, ray_rows, [&](int begin, int end) {
      if (reaches) return raycast_rows(output, map, parameters, {begin, end});
      for (int y = begin; y < end; ++y) {
        for (int x = 0; x < output.size.width; ++x) {
          const std::size_t i =
              static_cast<std::size_t>(y) * static_cast<std::size_t>(output.size.width) +
              static_cast<std::size_t>(x);
          if (output.only_misses && output.normals[i].x != invalid_normal) continue;
          raycast_pixel(map, x, y, parameters, &output.vertices[i], &output.normals[i]);
        }
      }
    });
  });
}

void OpenmpBackend::do_raycast(DeviceImage<Float3>& vertices, DeviceImage<Float3>& normals,
                               const Volume& volume, const RaycastParameters& parameters) {
  march({pixels(vertices), pixels(normals), vertices.size}, volume, parameters);
}

void OpenmpBackend::do_render_depth(DeviceImage<Rgba8>& image, const DeviceImage<float>& depth_m,
                                    float near_m, float far_m) {
  for_rows(image.size.height, [&](Rows rows) {
    render_depth_rows(pixels(image), pixels(depth_m), image.size, near_m, far_m, rows);
  });
}

void OpenmpBackend::do_render_track(DeviceImage<Rgba8>& image, const DeviceImage<TrackData>& rows) {
  for_rows(image.size.height,
           [&](Rows part) { render_track_rows(pixels(image), pixels(rows), image.size, part); });
}

void OpenmpBackend::do_render_volume(DeviceImage<Rgba8>& image, const Volume& volume,
                                     const RaycastParameters& view,
                                     const ShadeParameters& shading) {
  march(scratch_surface(image.size), volume, view);
  shade(image, shading, seen_vertices_.data(), seen_normals_.data());
}

void OpenmpBackend::do_render_seen(DeviceImage<Rgba8>& image, const Volume& volume,
                                   const RaycastParameters& view, const ShadeParameters& shading,
                                   const SeenSurface& seen) {
  const Float3* vertices = pixels(*seen.vertices);
  const Float3* normals = pixels(*seen.normals);
  if (seen.view.far_m == view.far_m) return shade(image, shading, vertices, normals);
  RaycastOutput surface = scratch_surface(image.size);
  for_rows(image.size.height, [&](Rows rows) {
    const auto width = static_cast<std::size_t>(image.size.width);
    const auto begin = static_cast<std::size_t>(rows.begin) * width;
    const auto end = static_cast<std::size_t>(rows.end) * width;
    std::copy(vertices + begin, vertices + end, surface.vertices + begin);
    std::copy(normals + begin, normals + end, surface.normals + begin);
  });
  surface.only_misses = true;  // a ray that met a surface meets the same one when it may go farther
  march(surface, volume, view);
  shade(image, shading, surface.vertices, surface.normals);
}

RaycastOutput OpenmpBackend::scratch_surface(Size size) {
  seen_vertices_.resize(size.count());
  seen_normals_.resize(size.count());
  return {seen_vertices_.data(), seen_normals_.data(), size};
}

void OpenmpBackend::shade(DeviceImage<Rgba8>& image, const ShadeParameters& shading,
                          const Float3* vertices, const Float3* normals) const {
  for_rows(image.size.height, [&](Rows rows) {
    shade_rows(pixels(image), vertices, normals, image.size, shading, rows);
  });
}

}  // namespace slambench
