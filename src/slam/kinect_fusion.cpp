// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "slam/kinect_fusion.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "io/files.h"

namespace slambench {
namespace {

Float3 to_float3(const std::array<double, 3>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

/// `auto` is bricks where the backend has them.
MapKind map_kind(const std::string& word, const Backend& backend) {
  if (word == "auto") {
    return backend.missing_kernel(MapKind::bricks) ? MapKind::grid : MapKind::bricks;
  }
  return map_from_name(word);
}

/// The size of the images that kernels work on.
Size computation_size(Size input, int ratio) {
  if (input.width % ratio != 0 || input.height % ratio != 0) {
    throw UsageError(fmt::format(
        "--compute-size-ratio: found {}, expected a divisor of the input's {}x{} pixels", ratio,
        input.width, input.height));
  }
  return {input.width / ratio, input.height / ratio};
}

std::int64_t pixels(Size size) { return static_cast<std::int64_t>(size.count()); }

/// Level sizes from full computation resolution to the coarsest, each half of the one before.
std::vector<Size> pyramid_sizes(Size finest, std::size_t levels) {
  std::vector<Size> sizes;
  for (std::size_t level = 0; level < levels; ++level) {
    sizes.push_back({finest.width >> level, finest.height >> level});
    if (sizes.back().empty()) {
      throw UsageError(
          fmt::format("--pyramid-levels: found {} levels, expected at most {} for {}x{}", levels,
                      level, finest.width, finest.height));
    }
  }
  return sizes;
}

Volume make_volume(Backend& backend, MapKind map, const KinectFusionParameters& p) {
  const auto& [x, y, z] = p.volume_resolution;
  try {
    return backend.make_volume(map, {x, y, z}, to_float3(p.volume_size_m));
  } catch (const UnavailableError& error) {
    throw UnavailableError(fmt::format("volume of {}x{}x{} voxels: {}", x, y, z, error.what()));
  }
}

void require_kernels(const Backend& backend, MapKind map) {
  if (const auto missing = backend.missing_kernel(map)) {
    throw UnavailableError(fmt::format("backend {}: no kernel {} for map {}", backend.name(),
                                       name(*missing), name(map)));
  }
}

}  // namespace

KinectFusion::KinectFusion(Backend& backend, const KinectFusionParameters& parameters, Size input,
                           Intrinsics camera, float units_per_m, Observer* observer)
    : backend_(backend),
      p_(parameters),
      camera_(camera.divided_by(static_cast<float>(parameters.compute_size_ratio))),
      units_per_m_(units_per_m),
      observer_(observer) {
  const MapKind map = map_kind(p_.map, backend_);
  require_kernels(backend_, map);
  const Size size = computation_size(input, p_.compute_size_ratio);

  raw_depth_ = backend_.make_image<std::uint16_t>(input);
  depth_m_ = backend_.make_image<float>(size);
  for (const Size level : pyramid_sizes(size, p_.pyramid_levels.size())) {
    filtered_m_.push_back(backend_.make_image<float>(level));
    vertices_.push_back(backend_.make_image<Float3>(level));
    normals_.push_back(backend_.make_image<Float3>(level));
    rows_.push_back(backend_.make_image<TrackData>(level));
    backend_.write(rows_.back(), Image<TrackData>(level));
  }
  model_vertices_ = backend_.make_image<Float3>(size);
  model_normals_ = backend_.make_image<Float3>(size);
  for (DeviceImage<Rgba8>* picture : {&depth_picture_, &track_picture_, &volume_picture_}) {
    *picture = backend_.make_image<Rgba8>(size);
    backend_.write(*picture, Image<Rgba8>(size, Rgba8{0, 0, 0, 255}));
  }

  T_volume_start_.translation() =
      Eigen::Vector3d(p_.init_pose[0] * p_.volume_size_m[0], p_.init_pose[1] * p_.volume_size_m[1],
                      p_.init_pose[2] * p_.volume_size_m[2]);
  T_volume_camera_ = T_volume_start_;

  const StageScope scope(observer_, Stage::init);
  gaussian_ = backend_.make_image<float>({2 * p_.bilateral_radius_px + 1, 1});
  backend_.generate_gaussian(gaussian_, static_cast<float>(p_.bilateral_sigma_px));
  volume_ = make_volume(backend_, map, p_);
  backend_.finish();
}

FrameResult KinectFusion::process(const Frame& frame) {
  FrameResult result;
  if (p_.fused && backend_.advances_in_one_go() && tracking_is_due()) {
    process_in_one_go(frame, &result);
  } else {
    preprocess(frame);
    track(&result);
    integrate(&result);
    raycast();
  }
  ++processed_;
  result.T_start_camera = T_volume_start_.inverse() * T_volume_camera_;
  return result;
}

void KinectFusion::preprocess(const Frame& frame) {
  const StageScope scope(observer_, Stage::preprocess);
  filter_depth(frame);
  backend_.finish();
}

void KinectFusion::track(FrameResult* result) {
  if (!tracking_is_due()) return;
  const StageScope scope(observer_, Stage::track);
  build_pyramid();
  const AlignInput input = align_input();
  const AlignResult aligned = backend_.align(input, p_.solve_condition);
  accept(aligned, is_believed(input, aligned, limits()), result);
  backend_.finish();
}

void KinectFusion::integrate(FrameResult* result) {
  const bool due = result->tracked && integration_is_due();
  if (!due && processed_ >= p_.bootstrap_frames) return;
  const StageScope scope(observer_, Stage::integrate);
  backend_.integrate(volume_, depth_m_, measurement());
  backend_.finish();
  result->integrated = true;
}

void KinectFusion::raycast() {
  if (processed_ + 1 < p_.bootstrap_frames) return;
  const StageScope scope(observer_, Stage::raycast);
  backend_.raycast(model_vertices_, model_normals_, volume_, view(p_.far_m));
  T_volume_model_ = T_volume_camera_;
  backend_.finish();
}

// From the first model on, bootstrap_frames no longer matters.
void KinectFusion::process_in_one_go(const Frame& frame, FrameResult* result) {
  const InOneGoScope scope(observer_);
  filter_depth(frame);
  build_pyramid();
  const bool due = integration_is_due();
  const AdvanceResult advanced = backend_.advance({
      .align = align_input(),
      .condition = p_.solve_condition,
      .limits = limits(),
      .volume = &volume_,
      .depth_m = &depth_m_,
      .integrate = due ? std::optional(measurement()) : std::nullopt,
      .model_vertices = &model_vertices_,
      .model_normals = &model_normals_,
      .raycast = view(p_.far_m),
  });
  accept(advanced.aligned, advanced.tracked, result);
  result->integrated = result->tracked && due;
  T_volume_model_ = T_volume_camera_;
}

bool KinectFusion::tracking_is_due() const {
  return T_volume_model_ && processed_ % p_.tracking_rate == 0;
}

bool KinectFusion::integration_is_due() const { return processed_ % p_.integration_rate == 0; }

void KinectFusion::filter_depth(const Frame& frame) {
  backend_.write(raw_depth_, frame.depth);
  backend_.mm2meters(depth_m_, raw_depth_, units_per_m_);
  backend_.bilateral_filter(filtered_m_[0], depth_m_, gaussian_,
                            static_cast<float>(p_.bilateral_range_sigma_m));
}

void KinectFusion::build_pyramid() {
  for (std::size_t level = 0; level < filtered_m_.size(); ++level) {
    if (level > 0) {
      backend_.half_sample(filtered_m_[level], filtered_m_[level - 1],
                           static_cast<float>(p_.half_sample_range_m));
    }
    backend_.depth2vertex(vertices_[level], filtered_m_[level],
                          camera_.divided_by(static_cast<float>(1 << level)));
    backend_.vertex2normal(normals_[level], vertices_[level]);
  }
}

AlignInput KinectFusion::align_input() {
  AlignInput input = slambench::align_input(vertices_, normals_, rows_);
  input.model_vertices = &model_vertices_;
  input.model_normals = &model_normals_;
  input.iterations = p_.pyramid_levels;
  input.T_volume_camera = T_volume_camera_;
  input.parameters = {to_rigid3f(T_volume_camera_), to_rigid3f(T_volume_model_->inverse()), camera_,
                      static_cast<float>(p_.icp_distance_threshold_m),
                      static_cast<float>(p_.icp_normal_threshold)};
  input.convergence = p_.icp_threshold;
  input.keep_rows = true;
  input.fused = p_.fused;
  return input;
}

TrackingLimits KinectFusion::limits() const { return {p_.tracked_residual_m, p_.tracked_fraction}; }

void KinectFusion::accept(const AlignResult& aligned, bool tracked, FrameResult* result) {
  const Size size = vertices_[static_cast<std::size_t>(aligned.last_level)].size;
  result->iterations = aligned.iterations;
  result->inliers = static_cast<std::size_t>(aligned.last.inliers);
  result->inlier_fraction = inlier_fraction(aligned.last, pixels(size));
  result->residual_m = residual_m(aligned.last);
  result->tracked = tracked;
  if (tracked) T_volume_camera_ = aligned.T_volume_camera;
}

IntegrateParameters KinectFusion::measurement() const {
  return {to_rigid3f(T_volume_camera_.inverse()), camera_, static_cast<float>(p_.mu_m),
          static_cast<float>(p_.max_weight), static_cast<float>(p_.integrate_min_depth_m)};
}

RaycastParameters KinectFusion::view(double far_m) const {
  const double voxel_m =
      *std::min_element(p_.volume_size_m.begin(), p_.volume_size_m.end()) /
      *std::max_element(p_.volume_resolution.begin(), p_.volume_resolution.end());
  return {to_rigid3f(T_volume_camera_),
          camera_,
          static_cast<float>(p_.near_m),
          static_cast<float>(far_m),
          static_cast<float>(p_.raycast_large_step * p_.mu_m),
          static_cast<float>(p_.raycast_small_step * voxel_m),
          static_cast<float>(p_.raycast_slow_below)};
}

ShadeParameters KinectFusion::shading() const {
  const Float3 light_m = to_float3(p_.light_m);
  const bool with_camera = p_.light_frame == "camera";
  return {with_camera ? to_rigid3f(T_volume_camera_).apply(light_m) : light_m,
          static_cast<float>(p_.ambient)};
}

void KinectFusion::render() {
  const StageScope scope(observer_, Stage::render);
  backend_.render_depth(depth_picture_, depth_m_, static_cast<float>(p_.near_m),
                        static_cast<float>(p_.far_m));
  backend_.render_track(track_picture_, rows_[0]);
  if ((processed_ - 1) % p_.rendering_rate == 0) {
    const SeenSurface seen{&model_vertices_, &model_normals_, view(p_.far_m)};
    backend_.render_volume(volume_picture_, volume_, view(p_.far_m * p_.render_far_factor),
                           shading(), p_.fused && T_volume_model_ ? &seen : nullptr);
  }
  backend_.finish();
}

Pictures KinectFusion::pictures() {
  Pictures pictures;
  backend_.read(pictures.depth, depth_picture_);
  backend_.read(pictures.track, track_picture_);
  backend_.read(pictures.volume, volume_picture_);
  backend_.finish();  // these transfers are told of now, and are not the next frame's
  return pictures;
}

std::size_t KinectFusion::map_bytes() const { return backend_.volume_bytes(volume_); }

void KinectFusion::dump_volume(const std::string& path) {
  std::vector<Voxel> voxels;
  backend_.read_volume(voxels, volume_);
  std::string bytes;
  bytes.reserve(voxels.size() * 2);
  for (const Voxel& voxel : voxels) {
    const auto bits = static_cast<std::uint16_t>(voxel.tsdf);
    bytes.push_back(static_cast<char>(bits & 0xff));
    bytes.push_back(static_cast<char>(bits >> 8));
  }
  write_file(path, bytes);
}

}  // namespace slambench
