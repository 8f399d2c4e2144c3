// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "io/trajectory_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>

#include "core/error.h"
#include "io/files.h"
#include "io/text.h"

namespace slambench {
namespace {

constexpr std::array<std::string_view, 8> field_names = {"time", "tx", "ty", "tz",
                                                         "qx",   "qy", "qz", "qw"};

StampedPose parse_pose(const std::string& path, const TextLine& line) {
  const std::string where = fmt::format("{}:{}", path, line.number);
  if (line.fields.size() != field_names.size()) {
    throw InputError(where, "fields", fmt::format("{}", line.fields.size()),
                     "8: time tx ty tz qx qy qz qw");
  }
  std::array<double, field_names.size()> v{};
  for (std::size_t i = 0; i < v.size(); ++i) {
    const auto number = parse_finite(line.fields[i]);
    if (!number) {
      throw InputError(where, field_names[i], quote(line.fields[i]), "a finite number");
    }
    v[i] = *number;
  }
  constexpr double farthest_m = 1e6;  // beyond it, squares and sums of positions lose their meaning
  for (std::size_t i = 1; i <= 3; ++i) {
    if (std::abs(v[i]) > farthest_m) {
      throw InputError(where, field_names[i], quote(line.fields[i]), "at most 1e6 m");
    }
  }
  Eigen::Vector4d q(v[4], v[5], v[6], v[7]);
  constexpr double least_norm = 1e-6;  // files are written with at least this many digits
  if (q.stableNorm() < least_norm) {
    throw InputError(where, "quaternion qx qy qz qw", fmt::format("norm {}", q.stableNorm()),
                     "norm 1");
  }
  q.stableNormalize();
  StampedPose pose;
  pose.time_s = v[0];
  pose.T_world_camera.translation() = Eigen::Vector3d(v[1], v[2], v[3]);
  pose.T_world_camera.linear() = Eigen::Quaterniond(q).toRotationMatrix();
  return pose;
}

}  // namespace

Trajectory read_trajectory(const std::string& path) {
  const std::string text = read_file(path);
  Trajectory trajectory;
  for (const TextLine& line : text_lines(text)) trajectory.push_back(parse_pose(path, line));
  if (trajectory.empty()) {
    throw InputError(path, "poses", "none", "lines 'time tx ty tz qx qy qz qw'");
  }
  return trajectory;
}

std::string trajectory_text(const Trajectory& trajectory) {
  std::string text = "# time tx ty tz qx qy qz qw\n";
  for (const StampedPose& pose : trajectory) {
    const Eigen::Vector3d t = pose.T_world_camera.translation();
    const Eigen::Quaterniond q(pose.T_world_camera.rotation());
    fmt::format_to(std::back_inserter(text), "{} {} {} {} {} {} {} {}\n", pose.time_s, t.x(), t.y(),
                   t.z(), q.x(), q.y(), q.z(), q.w());
  }
  return text;
}

}  // namespace slambench
