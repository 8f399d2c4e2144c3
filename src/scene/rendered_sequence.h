// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>
#include <optional>

#include "core/trajectory.h"
#include "scene/mesh.h"
#include "scene/renderer.h"

namespace slambench {

/// What a camera sees on its way through a scene: frame i is seen from pose i.
class RenderedSequence {
 public:
  /// With a noise seed, depth gets the errors of a Kinect (scene/noise.h). Throws UnavailableError
  /// when this build cannot render.
  RenderedSequence(const Mesh& mesh, Trajectory trajectory, Shading shading,
                   std::optional<std::uint64_t> noise_seed, int threads);

  const Trajectory& trajectory() const { return trajectory_; }

  /// Several threads may render at once, each into its own `out`. The same frame has the same
  /// bytes every time.
  void render(int index, Rendering& out) const;

 private:
  Trajectory trajectory_;
  std::optional<std::uint64_t> noise_seed_;
  Renderer renderer_;
};

}  // namespace slambench
