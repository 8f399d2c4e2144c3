// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace slambench {

/// A rigid transform. `T_a_b` maps points given in frame b to frame a.
using Pose = Eigen::Isometry3d;

/// A camera pose at a time; the pose maps camera points to the trajectory's world.
struct StampedPose {
  double time_s = 0;
  Pose T_world_camera = Pose::Identity();
};

/// Poses in the order of their file or frames; functions that need order by time sort.
using Trajectory = std::vector<StampedPose>;

}  // namespace slambench
