// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/image.h"

namespace slambench {

/// A coloured triangle mesh. Triangles that share vertices are shaded smoothly across their edge;
/// a crease has its vertices twice. Counter-clockwise seen from outside.
struct Mesh {
  std::vector<Eigen::Vector3f> vertices;  ///< m
  std::vector<Rgb8> colors;               ///< one a vertex
  std::vector<std::array<std::uint32_t, 3>> triangles;

  /// Adds a copy of `part`, moved by `pose` (which must not mirror).
  void append(const Mesh& part, const Eigen::Affine3f& pose = Eigen::Affine3f::Identity());
  void transform(const Eigen::Affine3f& pose);
};

/// Unit normals of the vertices: the area-weighted mean of the triangles around each; zero where
/// there is none.
std::vector<Eigen::Vector3f> vertex_normals(const Mesh& mesh);

/// Reads a triangle mesh from an OBJ or PLY file; polygons are cut into triangles, vertices
/// without a colour get their material's or grey. Throws InputError naming the file: missing, not
/// a mesh, without triangles, a coordinate that is not finite.
Mesh read_mesh(const std::string& path);

/// The bytes of a binary PLY file with vertex colours.
std::string ply_bytes(const Mesh& mesh);

}  // namespace slambench
