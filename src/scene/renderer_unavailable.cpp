// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "core/error.h"
#include "scene/renderer.h"

namespace slambench {

struct Renderer::Impl {};

bool can_render() { return false; }

Renderer::Renderer(const Mesh&, Size, Intrinsics, Shading, int) {
  throw UnavailableError(
      "rendering: this build has no Embree; install libembree-dev and configure again");
}

Renderer::~Renderer() = default;

void Renderer::render(const Pose&, Rendering&) const {}

}  // namespace slambench
