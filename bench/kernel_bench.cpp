// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "kernel_bench.h"

#include <algorithm>

#include "backends/host/host_backend.h"

namespace slambench {
namespace {

Float3 to_float3(const std::array<double, 3>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

}  // namespace

KernelBench::KernelBench(std::unique_ptr<Backend> backend, MapKind map, const Recording& recording)
    : backend_(std::move(backend)),
      map_(map),
      recording_(recording),
      p_(recording.parameters),
      camera_(recording.camera.divided_by(static_cast<float>(p_.compute_size_ratio))) {
  const Size input = recording.frames[0].depth.size();
  const Size size{input.width / p_.compute_size_ratio, input.height / p_.compute_size_ratio};
  raw_ = backend_->make_image<std::uint16_t>(input);
  gaussian_ = backend_->make_image<float>({2 * p_.bilateral_radius_px + 1, 1});
  depth_m_ = backend_->make_image<float>(size);
  for (std::size_t level = 0; level < p_.pyramid_levels.size(); ++level) {
    const Size level_size{size.width >> level, size.height >> level};
    filtered_m_.push_back(backend_->make_image<float>(level_size));
    vertices_.push_back(backend_->make_image<Float3>(level_size));
    normals_.push_back(backend_->make_image<Float3>(level_size));
    rows_.push_back(backend_->make_image<TrackData>(level_size));
  }
  model_vertices_ = backend_->make_image<Float3>(size);
  model_normals_ = backend_->make_image<Float3>(size);
  picture_ = backend_->make_image<Rgba8>(size);
  volume_ = backend_->make_volume(map_, volume_resolution(p_), volume_size_m(p_));

  backend_->generate_gaussian(gaussian_, static_cast<float>(p_.bilateral_sigma_px));
  fuse_all(&volume_);
  T_volume_model_ = recording.T_volume_camera[recording.frames.size() - 2];
  backend_->raycast(model_vertices_, model_normals_, volume_, view());
  make_pyramid();
  run(Kernel::track);
  reduction_ = backend_->reduce(rows_[0]);
  iterations_ = backend_->align(align_input(), p_.solve_condition).iterations;
  backend_->finish();
}

bool KernelBench::on_host() const { return dynamic_cast<const HostBackend*>(backend_.get()); }

void KernelBench::preprocess(std::size_t frame) {
  backend_->write(raw_, recording_.frames[frame].depth);
  backend_->mm2meters(depth_m_, raw_, recording_.units_per_m);
}

void KernelBench::make_pyramid() {
  backend_->bilateral_filter(filtered_m_[0], depth_m_, gaussian_,
                             static_cast<float>(p_.bilateral_range_sigma_m));
  for (std::size_t level = 0; level < filtered_m_.size(); ++level) {
    if (level > 0) {
      backend_->half_sample(filtered_m_[level], filtered_m_[level - 1],
                            static_cast<float>(p_.half_sample_range_m));
    }
    backend_->depth2vertex(vertices_[level], filtered_m_[level],
                           camera_.divided_by(static_cast<float>(1 << level)));
    backend_->vertex2normal(normals_[level], vertices_[level]);
  }
}

void KernelBench::fuse_all(Volume* volume) {
  for (std::size_t frame = 0; frame < recording_.frames.size(); ++frame) {
    preprocess(frame);
    backend_->integrate(*volume, depth_m_, integration(frame));
  }
}

IntegrateParameters KernelBench::integration(std::size_t frame) const {
  return {to_rigid3f(recording_.T_volume_camera[frame].inverse()), camera_,
          static_cast<float>(p_.mu_m), static_cast<float>(p_.max_weight),
          static_cast<float>(p_.integrate_min_depth_m)};
}

RaycastParameters KernelBench::view() const {
  const double voxel_m =
      *std::min_element(p_.volume_size_m.begin(), p_.volume_size_m.end()) /
      *std::max_element(p_.volume_resolution.begin(), p_.volume_resolution.end());
  return {to_rigid3f(T_volume_model_),
          camera_,
          static_cast<float>(p_.near_m),
          static_cast<float>(p_.far_m),
          static_cast<float>(p_.raycast_large_step * p_.mu_m),
          static_cast<float>(p_.raycast_small_step * voxel_m),
          static_cast<float>(p_.raycast_slow_below)};
}

AlignInput KernelBench::align_input() {
  AlignInput input = slambench::align_input(vertices_, normals_, rows_);
  input.model_vertices = &model_vertices_;
  input.model_normals = &model_normals_;
  input.iterations = p_.pyramid_levels;
  input.T_volume_camera = T_volume_model_;
  input.parameters = {to_rigid3f(T_volume_model_), to_rigid3f(T_volume_model_.inverse()), camera_,
                      static_cast<float>(p_.icp_distance_threshold_m),
                      static_cast<float>(p_.icp_normal_threshold)};
  input.convergence = p_.icp_threshold;
  return input;
}

void KernelBench::prepare(Kernel kernel) {
  if (kernel != Kernel::integrate && kernel != Kernel::init_volume) return;
  if (!scratch_) {
    scratch_ = backend_->make_volume(map_, volume_resolution(p_), volume_size_m(p_));
  }
  backend_->init_volume(*scratch_);
  fuse_all(&*scratch_);
  backend_->finish();
}

void KernelBench::run(Kernel kernel) {
  const std::size_t last = recording_.frames.size() - 1;
  switch (kernel) {
    case Kernel::acquire:
      break;
    case Kernel::mm2meters:
      backend_->mm2meters(depth_m_, raw_, recording_.units_per_m);
      break;
    case Kernel::bilateral_filter:
      backend_->bilateral_filter(filtered_m_[0], depth_m_, gaussian_,
                                 static_cast<float>(p_.bilateral_range_sigma_m));
      break;
    case Kernel::half_sample:
      backend_->half_sample(filtered_m_.at(1), filtered_m_[0],
                            static_cast<float>(p_.half_sample_range_m));
      break;
    case Kernel::depth2vertex:
      backend_->depth2vertex(vertices_[0], filtered_m_[0], camera_);
      break;
    case Kernel::vertex2normal:
      backend_->vertex2normal(normals_[0], vertices_[0]);
      break;
    case Kernel::track:
      backend_->track(rows_[0], vertices_[0], normals_[0], model_vertices_, model_normals_,
                      align_input().parameters);
      break;
    case Kernel::reduce:
      benchmark::DoNotOptimize(backend_->reduce(rows_[0]));
      break;
    case Kernel::solve:
      benchmark::DoNotOptimize(backend_->solve(reduction_, p_.solve_condition));
      break;
    case Kernel::align:
      benchmark::DoNotOptimize(backend_->align(align_input(), p_.solve_condition));
      break;
    case Kernel::integrate:
      backend_->integrate(*scratch_, depth_m_, integration(last));
      break;
    case Kernel::raycast:
      backend_->raycast(model_vertices_, model_normals_, volume_, view());
      break;
    case Kernel::render_depth:
      backend_->render_depth(picture_, depth_m_, static_cast<float>(p_.near_m),
                             static_cast<float>(p_.far_m));
      break;
    case Kernel::render_track:
      backend_->render_track(picture_, rows_[0]);
      break;
    case Kernel::render_volume: {
      // Never twice from the same place, so that no earlier picture or raycast can be used again.
      render_pose_ = render_pose_ == last ? last - 1 : last;
      RaycastParameters parameters = view();
      parameters.T_volume_camera = to_rigid3f(recording_.T_volume_camera[render_pose_]);
      parameters.far_m *= static_cast<float>(p_.render_far_factor);
      backend_->render_volume(picture_, volume_, parameters,
                              {to_float3(p_.light_m), static_cast<float>(p_.ambient)});
      break;
    }
    case Kernel::init_volume:
      backend_->init_volume(*scratch_);
      break;
    case Kernel::generate_gaussian:
      backend_->generate_gaussian(gaussian_, static_cast<float>(p_.bilateral_sigma_px));
      break;
  }
  backend_->finish();
}

ProblemSize KernelBench::problem(std::size_t level) const {
  return {raw_.size, filtered_m_[level].size, volume_.resolution, p_.bilateral_radius_px};
}

Cost KernelBench::cost(Kernel kernel) const {
  if (kernel != Kernel::align) return info(kernel).cost(problem(0));
  Cost sum;
  for (std::size_t level = 0; level < iterations_.size(); ++level) {
    const Cost one = info(kernel).cost(problem(level));
    sum.bytes += one.bytes * iterations_[level];
    sum.flops += one.flops * iterations_[level];
  }
  return sum;
}

}  // namespace slambench
