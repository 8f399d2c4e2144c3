// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "core/trajectory.h"

namespace slambench::testing {

inline Pose pose_at(double x, double y, double z) { return Pose(Eigen::Translation3d(x, y, z)); }

inline Pose turned_by(double degrees, const Eigen::Vector3d& axis) {
  return Pose(Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis.normalized()));
}

/// Poses without rotation, one a second from 0 on.
inline Trajectory positions_each_second(std::initializer_list<Eigen::Vector3d> positions) {
  Trajectory trajectory;
  for (const auto& p : positions) {
    trajectory.push_back({static_cast<double>(trajectory.size()), pose_at(p.x(), p.y(), p.z())});
  }
  return trajectory;
}

/// A path that bends and turns in all directions, `rate` poses a second.
inline Trajectory winding_path(int count, double rate = 30) {
  Trajectory trajectory;
  for (int i = 0; i < count; ++i) {
    const double t = i / rate;
    const Pose pose = pose_at(std::sin(t), 0.5 * std::cos(2 * t), 0.3 * t) *
                      turned_by(20 * std::sin(3 * t), {1, 2, 3});
    trajectory.push_back({t, pose});
  }
  return trajectory;
}

inline Trajectory moved(Trajectory trajectory, const Pose& by) {
  for (auto& pose : trajectory) pose.T_world_camera = by * pose.T_world_camera;
  return trajectory;
}

}  // namespace slambench::testing
