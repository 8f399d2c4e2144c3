// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "verify/recording.h"

#include <algorithm>
#include <string>
#include <utility>

#include "backends/registry.h"
#include "core/se3.h"
#include "kernels/pixel.h"
#include "verify/scenes.h"

namespace slambench {
namespace {

constexpr double room_edge_m = 4.0;

/// Relative to the start, `step` frames after the camera began to move: about a centimetre and a
/// third of a degree a frame.
Pose path(int step) {
  const double s = step;
  Eigen::Matrix<double, 6, 1> xi;
  xi << 0.009 * s, -0.004 * s, 0.006 * s, 0.003 * s, 0.005 * s, -0.002 * s;
  return se3_exp(xi);
}

KinectFusionParameters room_parameters() {
  KinectFusionParameters parameters;
  parameters.volume_resolution = {96, 96, 96};
  parameters.volume_size_m = {room_edge_m, room_edge_m, room_edge_m};
  parameters.init_pose = {0.47, 0.52, 0.23};
  parameters.mu_m = 0.12;
  return parameters;
}

}  // namespace

Recording synthetic_recording(Size size, int frames) {
  Recording recording;
  recording.name = "room " + std::to_string(size.width) + "x" + std::to_string(size.height);
  recording.camera = camera_for(size);
  recording.parameters = room_parameters();
  const Scene scene = room_scene(room_edge_m);
  const Pose start = start_pose(recording.parameters);
  for (int i = 0; i < frames; ++i) {
    const int standing = recording.parameters.bootstrap_frames - 1;
    const Pose pose = start * path(std::max(0, i - standing));
    Frame frame;
    frame.index = i;
    frame.time_s = i / 30.0;
    frame.depth = quantized(depth_of(scene, pose, recording.camera, size), recording.units_per_m);
    recording.frames.push_back(std::move(frame));
    recording.T_volume_camera.push_back(pose);
  }
  return recording;
}

Recording tracked_recording(std::string name, std::vector<Frame> frames, Intrinsics camera,
                            float units_per_m, const KinectFusionParameters& parameters) {
  Recording recording{std::move(name), camera, units_per_m, parameters, std::move(frames), {}};
  if (recording.frames.empty()) return recording;
  const auto backend = create_backend("serial", {});
  recording.parameters.map = std::string(slambench::name(MapKind::grid));
  KinectFusion system(*backend, recording.parameters, recording.frames[0].depth.size(), camera,
                      units_per_m, nullptr);
  for (const Frame& frame : recording.frames) {
    recording.T_volume_camera.push_back(start_pose(parameters) *
                                        system.process(frame).T_start_camera);
  }
  return recording;
}

View view(const Recording& recording, std::size_t frame) {
  const Image<std::uint16_t>& in = recording.frames[frame].depth;
  const int ratio = recording.parameters.compute_size_ratio;
  View view{Image<float>({in.width() / ratio, in.height() / ratio}),
            recording.camera.divided_by(static_cast<float>(ratio)),
            recording.T_volume_camera[frame]};
  for (int y = 0; y < view.depth_m.height(); ++y) {
    for (int x = 0; x < view.depth_m.width(); ++x) {
      view.depth_m(x, y) = meters_from_units(in(x * ratio, y * ratio), recording.units_per_m);
    }
  }
  return view;
}

Pose start_pose(const KinectFusionParameters& p) {
  Pose pose = Pose::Identity();
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    pose.translation()[axis] = p.init_pose[i] * p.volume_size_m[i];
  }
  return pose;
}

Int3 volume_resolution(const KinectFusionParameters& p) {
  return {p.volume_resolution[0], p.volume_resolution[1], p.volume_resolution[2]};
}

Float3 volume_size_m(const KinectFusionParameters& p) {
  return {static_cast<float>(p.volume_size_m[0]), static_cast<float>(p.volume_size_m[1]),
          static_cast<float>(p.volume_size_m[2])};
}

}  // namespace slambench
