// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/record.h"

namespace slambench {

Trajectory estimated_trajectory(const Record& record) {
  const Eigen::Matrix3d camera_from_own = record.own_from_camera.inverse();
  Trajectory trajectory;
  trajectory.reserve(record.frames.size());
  for (const FrameRecord& frame : record.frames) {
    const Pose& T = frame.T_start_camera;
    if (frame.dropped || !T.matrix().allFinite()) continue;
    StampedPose own;
    own.time_s = frame.time_s;
    own.T_world_camera.linear() = record.own_from_camera * T.linear() * camera_from_own;
    own.T_world_camera.translation() = record.own_from_camera * T.translation();
    trajectory.push_back(own);
  }
  return trajectory;
}

}  // namespace slambench
