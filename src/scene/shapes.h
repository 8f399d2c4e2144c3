// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <span>

#include "scene/mesh.h"

/// The shapes that furniture is made of. Here y points up; lengths are in metres.
namespace slambench {

/// The sheet of points point(u, v), u and v in [0, 1], cut into columns x rows quads; its outside
/// is where the derivatives' cross product du x dv points.
Mesh sheet(int columns, int rows, Rgb8 color,
           const std::function<Eigen::Vector3f(float u, float v)>& point);

/// A box around the origin's column: x and z in [-size/2, size/2], y in [0, size.y]; edges are
/// rounded with the radius (0: sharp). Faces are cut into cells no longer than `cell_m`.
Mesh box(const Eigen::Vector3f& size, Rgb8 color, float radius = 0, float cell_m = 0.2f);

/// A superellipsoid around the origin (Barr 1981): exponents of 1 make an ellipsoid, smaller ones
/// approach a box, as a cushion does.
Mesh superellipsoid(const Eigen::Vector3f& radii, float exponent_vertical, float exponent_round,
                    Rgb8 color, int segments = 24);

/// Turns a profile of (radius, height) points, from the bottom to the top, about the y axis.
Mesh lathe(std::span<const Eigen::Vector2f> profile, Rgb8 color, int segments = 28);

/// A round rod along the points of `spine`; the radius runs from `radius_begin` to `radius_end`.
Mesh rod(std::span<const Eigen::Vector3f> spine, float radius_begin, float radius_end, Rgb8 color,
         int segments = 10);

/// A closed outline (x, y), counter-clockwise seen from +z, drawn out along z from 0 to `length`;
/// its ends are open.
Mesh extrusion(std::span<const Eigen::Vector2f> outline, float length, Rgb8 color);

/// A pointed leaf: starts at the origin along +z, rises and droops; both sides are drawn.
Mesh leaf(float length, float width, float rise, float droop, Rgb8 color);

/// Moved by (x, y, z) after a turn about the y axis (z towards x), degrees.
Eigen::Affine3f placed(float x, float y, float z, float turn_deg = 0);

/// The colour times a factor, clamped.
Rgb8 shaded(Rgb8 color, float factor);

}  // namespace slambench
