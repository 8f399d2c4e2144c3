// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>
#include <vector>

#include "core/frame.h"
#include "core/image.h"
#include "core/intrinsics.h"
#include "core/trajectory.h"
#include "slam/kinect_fusion.h"

namespace slambench {

/// Depth frames, where they were taken from, and the settings they are to be processed with.
struct Recording {
  std::string name;
  Intrinsics camera;  ///< at full resolution
  float units_per_m = 1000;
  KinectFusionParameters parameters;
  std::vector<Frame> frames;
  std::vector<Pose> T_volume_camera;  ///< one per frame
};

/// What the kernels see of a frame: metric depth at the computation size.
struct View {
  Image<float> depth_m;
  Intrinsics camera;
  Pose T_volume_camera = Pose::Identity();
};

/// A camera that stands for the first frames and then moves through a room, exactly known.
Recording synthetic_recording(Size size, int frames);

/// A recording of real frames; the poses are those that the reference backend tracks.
Recording tracked_recording(std::string name, std::vector<Frame> frames, Intrinsics camera,
                            float units_per_m, const KinectFusionParameters& parameters);

View view(const Recording& recording, std::size_t frame);

/// Where the first camera stands in the volume.
Pose start_pose(const KinectFusionParameters& parameters);

/// The settings' volume in the units of the kernels.
Int3 volume_resolution(const KinectFusionParameters& parameters);
Float3 volume_size_m(const KinectFusionParameters& parameters);

}  // namespace slambench
