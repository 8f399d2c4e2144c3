// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <benchmark/benchmark.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "backends/registry.h"
#include "meters/machine.h"
#include "verify/recording.h"

namespace slambench {

/// The memory of a run of KinectFusion after the frames of a recording: what each kernel finds when
/// the next frame arrives.
class KernelBench {
 public:
  KernelBench(std::unique_ptr<Backend> backend, MapKind map, const Recording& recording);

  Backend& backend() { return *backend_; }
  /// Times of host backends can be held against what the cores reach.
  bool on_host() const;

  /// Brings into being what only this kernel needs; not timed.
  void prepare(Kernel kernel);
  /// One call, waited for.
  void run(Kernel kernel);
  /// By the kernel table's model; of the whole loop for align.
  Cost cost(Kernel kernel) const;

 private:
  void preprocess(std::size_t frame);
  void make_pyramid();
  void fuse_all(Volume* volume);
  AlignInput align_input();
  ProblemSize problem(std::size_t level) const;
  RaycastParameters view() const;
  IntegrateParameters integration(std::size_t frame) const;

  std::unique_ptr<Backend> backend_;
  const MapKind map_;
  const Recording& recording_;
  const KinectFusionParameters& p_;
  Intrinsics camera_;  ///< of the computation size
  Pose T_volume_model_ = Pose::Identity();

  DeviceImage<std::uint16_t> raw_;
  DeviceImage<float> gaussian_, depth_m_;
  std::vector<DeviceImage<float>> filtered_m_;
  std::vector<DeviceImage<Float3>> vertices_, normals_;
  std::vector<DeviceImage<TrackData>> rows_;
  DeviceImage<Float3> model_vertices_, model_normals_;
  DeviceImage<Rgba8> picture_;
  Volume volume_;
  std::optional<Volume> scratch_;  ///< for what changes the volume
  Reduction reduction_;
  std::size_t render_pose_ = 0;  ///< the frame that the volume was last drawn from
  std::vector<int> iterations_;  ///< that align takes
};

}  // namespace slambench
