// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/record.h"

namespace slambench {

Pose in_own_axes(const Record& record, const Pose& T_start_camera) {
  Pose own;
  own.linear() =
      record.own_from_camera * T_start_camera.linear() * record.own_from_camera.inverse();
  own.translation() = record.own_from_camera * T_start_camera.translation();
  own.makeAffine();
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
