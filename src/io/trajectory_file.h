// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>

#include "core/trajectory.h"

namespace slambench {

/// Reads "time tx ty tz qx qy qz qw" lines (TUM format; '#' comments; blanks, tabs, CRLF).
/// Throws InputError naming file, line and field: missing file, too few or too many fields, what
/// is not a finite number, a zero quaternion, no pose at all.
Trajectory read_trajectory(const std::string& path);

/// The text of a TUM-format file; numbers are locale-independent and round-trip.
std::string trajectory_text(const Trajectory& trajectory);

}  // namespace slambench
