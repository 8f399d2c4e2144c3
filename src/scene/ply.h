// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>
#include <string_view>

#include "scene/mesh.h"

namespace slambench {

/// The mesh in the contents of a PLY file: ASCII or binary of either byte order; elements and
/// properties of other names than x, y, z, red, green, blue and vertex_indices (or vertex_index)
/// are skipped; polygons are cut into triangles; vertices without a colour are grey. Throws
/// InputError naming `path` and what is wrong where.
Mesh parse_ply(const std::string& path, std::string_view contents);

}  // namespace slambench
