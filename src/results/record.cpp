// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/record.h"

namespace slambench {

Pose in_own_axes(const Record& record, const Pose& T_start_camera) {
  const Eigen::Matrix3d& M = record.own_from_camera;
  Pose own = Pose::Identity();
  // Adding zero makes zeros positive: a flipped axis must not show as "-0" in files.
  own.linear() = (M * T_start_camera.linear() * M.inverse()).array() + 0.0;
  own.translation() = (M * T_start_camera.translation()).array() + 0.0;
  return own;
}

Trajectory estimated_trajectory(const Record& record) {
  Trajectory trajectory;
  trajectory.reserve(record.frames.size());
  for (const FrameRecord& frame : record.frames) {
    if (frame.dropped || !frame.T_start_camera.matrix().allFinite()) continue;
    trajectory.push_back({frame.time_s, in_own_axes(record, frame.T_start_camera)});
  }
  return trajectory;
}

}  // namespace slambench
