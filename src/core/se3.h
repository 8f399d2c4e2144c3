// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <Eigen/Core>

#include "core/trajectory.h"

namespace slambench {

/// The exponential map of SE(3): `xi` is translation (m), then rotation (rad). Exact to rounding
/// for any angle, zero included.
Pose se3_exp(const Eigen::Matrix<double, 6, 1>& xi);

/// Its inverse for rotations by less than pi.
Eigen::Matrix<double, 6, 1> se3_log(const Pose& pose);

}  // namespace slambench
