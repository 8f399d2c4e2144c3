// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "core/error.h"
#include "scene/obj.h"

namespace slambench {

bool can_read_obj() { return false; }

Mesh read_obj(const std::string& path) {
  throw UnavailableError(path +
                         ": this build has no Assimp and reads meshes from PLY files only; install "
                         "libassimp-dev and configure again");
}

}  // namespace slambench
