// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <optional>

#include "backends/backend.h"
#include "core/intrinsics.h"
#include "core/parameter.h"
#include "slam/system.h"

namespace slambench {

/// Everything a user can turn in KinectFusion; the defaults are SLAMBench 1's but for the light,
/// which there is at (1, 1, -1) in the volume and burns walls white.
struct KinectFusionParameters {
  std::string map = "grid";
  int compute_size_ratio = 1;
  std::array<int, 3> volume_resolution = {256, 256, 256};
  std::array<double, 3> volume_size_m = {2, 2, 2};
  std::array<double, 3> init_pose = {0.5, 0.5, 0.0};
  double mu_m = 0.1;
  int tracking_rate = 1;
  int integration_rate = 2;
  int rendering_rate = 4;
  std::vector<int> pyramid_levels = {10, 5, 4};
  double icp_threshold = 1e-5;
  double icp_distance_threshold_m = 0.1;
  double icp_normal_threshold = 0.8;
  double tracked_fraction = 0.15;
  double tracked_residual_m = 0.02;
  double solve_condition = 1e6;
  int bootstrap_frames = 4;
  int bilateral_radius_px = 2;
  double bilateral_sigma_px = 4;
  double bilateral_range_sigma_m = 0.1;
  double half_sample_range_m = 0.3;
  double near_m = 0.4;
  double far_m = 4.0;
  double max_weight = 100;
  double integrate_min_depth_m = 0.0001;
  double raycast_large_step = 0.75;
  double raycast_small_step = 1.0;
  double raycast_slow_below = 0.8;
  double render_far_factor = 2.0;
  std::array<double, 3> light_m = {-4, -7, -6};
  std::string light_frame = "camera";
  double ambient = 0.1;
  bool fused = false;

  ParameterList describe();
};

/// KinectFusion (Newcombe et al., ISMAR 2011) as SLAMBench (Nardi et al., ICRA 2015) cuts it into
/// kernels, over any backend.
class KinectFusion final : public System {
 public:
  /// `camera` and `input` are those of the full-resolution depth image, whose values divided by
  /// `units_per_m` are metres. Throws UsageError when the parameters do not fit together or the
  /// input, UnavailableError when the backend lacks a kernel or memory.
  KinectFusion(Backend& backend, const KinectFusionParameters& parameters, Size input,
               Intrinsics camera, float units_per_m, Observer* observer);

  FrameResult process(const Frame& frame) override;
  void render() override;
  Pictures pictures() override;
  std::string map() const override { return std::string(name(volume_.map)); }
  int busy_processors() const override { return backend_.busy_processors(); }
  std::size_t map_bytes() const override;
  void dump_volume(const std::string& path) override;

 private:
  // Each stage waits at its end, so that its wall time is its own.
  void preprocess(const Frame& frame);
  void track(FrameResult* result);
  void integrate(FrameResult* result);
  void raycast();
  /// All of them for a frame that is to be tracked, in one go.
  void process_in_one_go(const Frame& frame, FrameResult* result);

  bool tracking_is_due() const;
  bool integration_is_due() const;
  void filter_depth(const Frame& frame);
  void build_pyramid();
  AlignInput align_input();
  TrackingLimits limits() const;
  /// Takes the aligned pose over if the alignment is believed.
  void accept(const AlignResult& aligned, bool tracked, FrameResult* result);
  IntegrateParameters measurement() const;
  RaycastParameters view(double far_m) const;
  ShadeParameters shading() const;

  Backend& backend_;
  const KinectFusionParameters p_;
  const Intrinsics camera_;  ///< of the computation size
  const float units_per_m_;
  Observer* const observer_;

  DeviceImage<std::uint16_t> raw_depth_;
  DeviceImage<float> gaussian_, depth_m_;
  std::vector<DeviceImage<float>> filtered_m_;           ///< per level, finest first
  std::vector<DeviceImage<Float3>> vertices_, normals_;  ///< per level
  std::vector<DeviceImage<TrackData>> rows_;             ///< per level
  DeviceImage<Float3> model_vertices_, model_normals_;
  DeviceImage<Rgba8> depth_picture_, track_picture_, volume_picture_;
  Volume volume_;

  int processed_ = 0;  ///< frames so far; rates count these, so that dropped frames do not matter
  Pose T_volume_start_ = Pose::Identity();
  Pose T_volume_camera_ = Pose::Identity();
  std::optional<Pose> T_volume_model_;  ///< where the model was raycast from; none yet: no model
};

}  // namespace slambench
