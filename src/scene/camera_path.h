// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include "core/trajectory.h"

namespace slambench {

inline constexpr int living_room_path_count = 4;
inline constexpr double living_room_fps = 30;

/// Camera path 0 to 3 through the living room, one exact pose a frame, in the room's axes: frame i
/// at i / 30 s. Frame counts and lengths are those of ICL-NUIM's living room (1510, 967, 882, 1242
/// frames; 6.5, 2.1, 8.4, 11.3 m). Starts at rest, level, looking along an axis of the room, so
/// that a volume with the axes of the first camera has the axes of the room. Path 3 ends where it
/// began.
Trajectory living_room_path(int path);

/// Sum of the distances between consecutive positions, m.
double path_length(const Trajectory& trajectory);

}  // namespace slambench
