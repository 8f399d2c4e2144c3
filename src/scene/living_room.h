// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include "scene/mesh.h"

namespace slambench {

/// The living room's world: x east, y DOWN, z north, m; the origin on the floor, in the middle of
/// the room, which spans [-half, half] in x and z and [-height, 0] in y.
inline constexpr float living_room_half_m = 2.3f;
inline constexpr float living_room_height_m = 2.6f;

/// The furnished room, closed on all sides; the same triangles every time. Its size lets all walls
/// with a truncation band of 0.1 m lie in a volume of 4.8 m.
Mesh living_room();

}  // namespace slambench
