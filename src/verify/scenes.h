// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/intrinsics.h"
#include "core/trajectory.h"

namespace slambench {

struct Sphere {
  Eigen::Vector3d center_m;
  double radius_m = 0;
};

/// A box along the axes.
struct Box {
  Eigen::Vector3d low_m, high_m;
};

/// Half of space: behind the plane through `point_m`, whose normal points to the free side.
struct Plane {
  Eigen::Vector3d point_m, normal;
};

/// Solids whose depth images have a closed form.
struct Scene {
  std::vector<Plane> planes;
  std::vector<Box> boxes;
  std::vector<Sphere> spheres;
};

/// A wall across the view, seen from near the origin along +z.
Scene plane_scene(double distance_m);
/// One ball and nothing else: most rays meet nothing.
Scene sphere_scene(const Eigen::Vector3d& center_m, double radius_m);
/// The inside of a cube of that edge with its corner at the origin, with solids in its far half
/// (+z) that constrain all six degrees of freedom.
Scene room_scene(double edge_m);

/// Depth (z, metres) that each pixel's centre sees from outside all solids; 0 where nothing is.
Image<float> depth_of(const Scene& scene, const Pose& T_world_camera, Intrinsics camera, Size size);

/// The nearest whole units; 0 for what does not fit 16 bits.
Image<std::uint16_t> quantized(const Image<float>& depth_m, float units_per_m);

/// A camera with a field of view of about 67 degrees and nothing symmetric about it.
Intrinsics camera_for(Size size);

}  // namespace slambench
