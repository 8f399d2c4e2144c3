// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/backend.h"

#include <stdexcept>

#include "backends/align.h"
#include "core/error.h"
#include "core/se3.h"

namespace slambench {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

Float3 to_float3(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

bool same_ray(const Rigid3f& a, const Rigid3f& b) {
  return a.row0 == b.row0 && a.row1 == b.row1 && a.row2 == b.row2 && a.translation == b.translation;
}

/// Whether rays of both march through the same samples, up to where the nearer ends.
bool same_march(const RaycastParameters& a, const RaycastParameters& b) {
  return same_ray(a.T_volume_camera, b.T_volume_camera) && a.camera == b.camera &&
         a.near_m == b.near_m && a.large_step_m == b.large_step_m &&
         a.small_step_m == b.small_step_m && a.slow_below == b.slow_below;
}

}  // namespace

std::span<const MapInfo> map_table() {
  static constexpr MapInfo table[] = {
      {MapKind::grid, "grid", "the paper's flat array of voxels"},
      {MapKind::bricks, "bricks", "the same voxels in bricks of 8^3, free space not stored singly"},
  };
  return table;
}

std::string_view name(MapKind map) {
  for (const MapInfo& info : map_table()) {
    if (info.map == map) return info.name;
  }
  throw std::invalid_argument("name: a map that is not in the table");
}

MapKind map_from_name(std::string_view name) {
  std::string known;
  for (const MapInfo& info : map_table()) {
    if (info.name == name) return info.map;
    known += known.empty() ? "" : ", ";
    known += info.name;
  }
  throw UsageError("--map: found '" + std::string(name) + "', expected one of " + known);
}

AlignInput align_input(const std::vector<DeviceImage<Float3>>& vertices,
                       const std::vector<DeviceImage<Float3>>& normals,
                       std::vector<DeviceImage<TrackData>>& rows) {
  AlignInput input;
  for (const auto& image : vertices) input.vertices.push_back(&image);
  for (const auto& image : normals) input.normals.push_back(&image);
  for (auto& image : rows) input.rows.push_back(&image);
  return input;
}

bool is_believed(const AlignInput& input, const AlignResult& aligned,
                 const TrackingLimits& limits) {
  const Size level = input.vertices[static_cast<std::size_t>(aligned.last_level)]->size;
  return is_believed(aligned.T_volume_camera.matrix().allFinite(), aligned.last,
                     static_cast<std::int64_t>(level.count()), limits);
}

Rigid3f to_rigid3f(const Pose& pose) {
  const Eigen::Matrix3d r = pose.linear();
  return {to_float3(r.row(0)), to_float3(r.row(1)), to_float3(r.row(2)),
          to_float3(pose.translation())};
}

Pose moved(const Pose& pose, const Twist& twist) {
  return se3_exp(Eigen::Map<const Vector6>(twist.v)) * pose;
}

double norm(const Twist& twist) { return Eigen::Map<const Vector6>(twist.v).norm(); }

void Backend::check(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(message);
}

std::optional<Kernel> Backend::missing_kernel(MapKind map) const {
  for (const KernelInfo& row : kernel_table()) {
    const bool needed = row.kernel != Kernel::acquire && row.kernel != Kernel::align;
    if (needed && !supports(row.kernel, map)) return row.kernel;
  }
  return std::nullopt;
}

Volume Backend::make_volume(MapKind map, Int3 resolution, Float3 size_m) {
  check(resolution.x > 0 && resolution.y > 0 && resolution.z > 0, "make_volume: no voxels");
  check(size_m.x > 0 && size_m.y > 0 && size_m.z > 0, "make_volume: no extent");
  Volume volume{map, resolution, size_m, allocate_volume(map, resolution, size_m)};
  init_volume(volume);
  return volume;
}

void Backend::generate_gaussian(DeviceImage<float>& weights, float sigma_px) {
  check(weights.size.height == 1 && weights.size.width % 2 == 1,
        "generate_gaussian: not one row of odd length");
  const KernelScope scope(launch_observer(), Kernel::generate_gaussian);
  do_generate_gaussian(weights, sigma_px);
}

void Backend::init_volume(Volume& volume) {
  const KernelScope scope(launch_observer(), Kernel::init_volume);
  do_init_volume(volume);
}

void Backend::mm2meters(DeviceImage<float>& depth_m, const DeviceImage<std::uint16_t>& depth,
                        float units_per_m) {
  check(!depth_m.size.empty(), "mm2meters: empty image");
  const int ratio = depth.size.width / depth_m.size.width;
  check(depth_m.size.width * ratio == depth.size.width &&
            depth_m.size.height * ratio == depth.size.height,
        "mm2meters: ratio not integral or not equal");
  const KernelScope scope(launch_observer(), Kernel::mm2meters);
  do_mm2meters(depth_m, depth, units_per_m);
}

void Backend::bilateral_filter(DeviceImage<float>& filtered_m, const DeviceImage<float>& depth_m,
                               const DeviceImage<float>& gaussian, float range_sigma_m) {
  check(filtered_m.size == depth_m.size, "bilateral_filter: sizes differ");
  check(gaussian.size.height == 1 && gaussian.size.width % 2 == 1,
        "bilateral_filter: weights not one row of odd length");
  const KernelScope scope(launch_observer(), Kernel::bilateral_filter);
  do_bilateral_filter(filtered_m, depth_m, gaussian, range_sigma_m);
}

void Backend::half_sample(DeviceImage<float>& half_m, const DeviceImage<float>& depth_m,
                          float range_m) {
  check(
      half_m.size.width == depth_m.size.width / 2 && half_m.size.height == depth_m.size.height / 2,
      "half_sample: not half the size");
  const KernelScope scope(launch_observer(), Kernel::half_sample);
  do_half_sample(half_m, depth_m, range_m);
}

void Backend::depth2vertex(DeviceImage<Float3>& vertices, const DeviceImage<float>& depth_m,
                           Intrinsics camera) {
  check(vertices.size == depth_m.size, "depth2vertex: sizes differ");
  const KernelScope scope(launch_observer(), Kernel::depth2vertex);
  do_depth2vertex(vertices, depth_m, camera);
}

void Backend::vertex2normal(DeviceImage<Float3>& normals, const DeviceImage<Float3>& vertices) {
  check(normals.size == vertices.size, "vertex2normal: sizes differ");
  const KernelScope scope(launch_observer(), Kernel::vertex2normal);
  do_vertex2normal(normals, vertices);
}

void Backend::track(DeviceImage<TrackData>& rows, const DeviceImage<Float3>& vertices,
                    const DeviceImage<Float3>& normals, const DeviceImage<Float3>& model_vertices,
                    const DeviceImage<Float3>& model_normals, const TrackParameters& parameters) {
  check(rows.size == vertices.size && normals.size == vertices.size, "track: live sizes differ");
  check(model_vertices.size == model_normals.size, "track: model sizes differ");
  const KernelScope scope(launch_observer(), Kernel::track);
  do_track(rows, vertices, normals, model_vertices, model_normals, parameters);
}

Reduction Backend::reduce(const DeviceImage<TrackData>& rows) {
  const KernelScope scope(launch_observer(), Kernel::reduce);
  return do_reduce(rows);
}

Twist Backend::solve(const Reduction& reduction, double condition) {
  const KernelScope scope(observer_, Kernel::solve);
  return do_solve(reduction, condition);
}

Twist Backend::do_solve(const Reduction& reduction, double condition) {
  return solve_motion(reduction, condition);
}

void Backend::check_shapes(const AlignInput& input) {
  check(input.model_vertices != nullptr && input.model_normals != nullptr, "align: no model");
  check(!input.iterations.empty() && input.vertices.size() == input.iterations.size() &&
            input.normals.size() == input.iterations.size() &&
            input.rows.size() == input.iterations.size(),
        "align: numbers of levels differ");
}

AlignResult Backend::align(const AlignInput& input, double condition) {
  check_shapes(input);
  if (fuses_align() && !input.fused) return Backend::do_align(input, condition);
  const KernelScope scope(fuses_align() ? launch_observer() : nullptr, Kernel::align);
  return do_align(input, condition);
}

AlignResult Backend::do_align(const AlignInput& input, double condition) {
  const auto match = [&](std::size_t level, const TrackParameters& at) {
    track(*input.rows[level], *input.vertices[level], *input.normals[level], *input.model_vertices,
          *input.model_normals, at);
    return reduce(*input.rows[level]);
  };
  return iterate_align(input, match, [&](const Reduction& sums) { return solve(sums, condition); });
}

AdvanceResult Backend::advance(const AdvanceInput& input) {
  check_shapes(input.align);
  check(input.volume != nullptr && input.depth_m != nullptr, "advance: no volume or no depth");
  check(input.model_vertices != nullptr && input.model_normals != nullptr &&
            input.model_vertices->size == input.model_normals->size,
        "advance: no model, or its sizes differ");
  return do_advance(input);
}

AdvanceResult Backend::do_advance(const AdvanceInput& input) {
  AdvanceResult result;
  result.aligned = align(input.align, input.condition);
  result.tracked = is_believed(input.align, result.aligned, input.limits);
  const Pose& pose = result.tracked ? result.aligned.T_volume_camera : input.align.T_volume_camera;
  if (result.tracked && input.integrate) {
    IntegrateParameters there = *input.integrate;
    there.T_camera_volume = to_rigid3f(pose.inverse());
    integrate(*input.volume, *input.depth_m, there);
  }
  RaycastParameters view = input.raycast;
  view.T_volume_camera = to_rigid3f(pose);
  raycast(*input.model_vertices, *input.model_normals, *input.volume, view);
  finish();
  return result;
}

void Backend::integrate(Volume& volume, const DeviceImage<float>& depth_m,
                        const IntegrateParameters& parameters) {
  const KernelScope scope(launch_observer(), Kernel::integrate);
  do_integrate(volume, depth_m, parameters);
}

void Backend::raycast(DeviceImage<Float3>& vertices, DeviceImage<Float3>& normals,
                      const Volume& volume, const RaycastParameters& parameters) {
  check(vertices.size == normals.size, "raycast: sizes differ");
  const KernelScope scope(launch_observer(), Kernel::raycast);
  do_raycast(vertices, normals, volume, parameters);
}

void Backend::render_depth(DeviceImage<Rgba8>& image, const DeviceImage<float>& depth_m,
                           float near_m, float far_m) {
  check(image.size == depth_m.size, "render_depth: sizes differ");
  const KernelScope scope(launch_observer(), Kernel::render_depth);
  do_render_depth(image, depth_m, near_m, far_m);
}

void Backend::render_track(DeviceImage<Rgba8>& image, const DeviceImage<TrackData>& rows) {
  check(image.size == rows.size, "render_track: sizes differ");
  const KernelScope scope(launch_observer(), Kernel::render_track);
  do_render_track(image, rows);
}

void Backend::render_volume(DeviceImage<Rgba8>& image, const Volume& volume,
                            const RaycastParameters& view, const ShadeParameters& shading,
                            const SeenSurface* seen) {
  const KernelScope scope(launch_observer(), Kernel::render_volume);
  if (seen != nullptr && seen->vertices->size == image.size && same_march(seen->view, view) &&
      seen->view.far_m <= view.far_m) {
    do_render_seen(image, volume, view, shading, *seen);
  } else {
    do_render_volume(image, volume, view, shading);
  }
}

void Backend::do_render_seen(DeviceImage<Rgba8>& image, const Volume& volume,
                             const RaycastParameters& view, const ShadeParameters& shading,
                             const SeenSurface&) {
  do_render_volume(image, volume, view, shading);
}

}  // namespace slambench
