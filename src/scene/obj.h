// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>

#include "scene/mesh.h"

namespace slambench {

/// Whether this build can.
bool can_read_obj();

/// Reads an OBJ file with its materials, which lie in files beside it. Throws InputError naming the
/// file, UnavailableError when this build cannot.
Mesh read_obj(const std::string& path);

}  // namespace slambench
