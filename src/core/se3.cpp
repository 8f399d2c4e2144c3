// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "core/se3.h"

#include <cmath>

namespace slambench {
namespace {

Eigen::Matrix3d skew(const Eigen::Vector3d& w) {
  Eigen::Matrix3d m;
  m << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return m;
}

/// The matrix that maps the twist's translation to the pose's (Barfoot 2017, eq. 7.37).
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  const double squared = angle * angle;
  // Series below the angle where the closed forms lose digits.
  const bool small = angle < 1e-4;
  const double a = small ? 0.5 - squared / 24 : (1 - std::cos(angle)) / squared;
  const double b = small ? 1.0 / 6 - squared / 120 : (angle - std::sin(angle)) / (squared * angle);
  const Eigen::Matrix3d cross = skew(w);
  return Eigen::Matrix3d::Identity() + a * cross + b * cross * cross;
}

}  // namespace

Pose se3_exp(const Eigen::Matrix<double, 6, 1>& xi) {
  const Eigen::Vector3d v = xi.head<3>(), w = xi.tail<3>();
  const double angle = w.norm();
  Pose pose = Pose::Identity();
  if (angle > 0) pose.linear() = Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
  pose.translation() = left_jacobian(w) * v;
  return pose;
}

Eigen::Matrix<double, 6, 1> se3_log(const Pose& pose) {
  const Eigen::AngleAxisd rotation(Eigen::Quaterniond(pose.linear()));
  const Eigen::Vector3d w = rotation.angle() * rotation.axis();
  Eigen::Matrix<double, 6, 1> xi;
  xi.tail<3>() = w;
  xi.head<3>() = left_jacobian(w).partialPivLu().solve(pose.translation());
  return xi;
}

}  // namespace slambench
