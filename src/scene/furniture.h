// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>

#include "scene/mesh.h"

/// The pieces of the living room. Each stands on the floor (y = 0, y up) with its back at z = 0,
/// its middle at x = 0 and its front towards +z; what hangs on a wall has its own height.
namespace slambench {

Mesh sofa();
Mesh armchair(Rgb8 cloth);
Mesh coffee_table();
Mesh side_table();
Mesh bookshelf();
Mesh television();
Mesh radiator();
Mesh footstool();

Mesh floor_lamp();
Mesh table_lamp();
Mesh ceiling_lamp();  ///< hangs from y = 0 downwards, around the origin
Mesh vase(float height, Rgb8 color);
Mesh bowl_of_fruit();
Mesh book_pile(unsigned seed);
Mesh book_row(float length, float height, unsigned seed);  ///< from x = 0 to `length`
Mesh plant(float height, unsigned seed);
Mesh flowers(unsigned seed);
Mesh picture(float width, float height, unsigned seed);  ///< its middle at the origin, hung
Mesh window(float width, float height);                  ///< its sill at y = 0
Mesh curtain(float width, float height);                 ///< hung, its lower edge at y = 0
Mesh door();
Mesh wall_clock();  ///< its middle at the origin

}  // namespace slambench
