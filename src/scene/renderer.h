// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>
#include <memory>

#include "core/image.h"
#include "core/intrinsics.h"
#include "core/trajectory.h"
#include "scene/mesh.h"

namespace slambench {

/// What a camera sees of a mesh.
struct Rendering {
  Image<float> depth_m;    ///< along the optical axis; 0 where there is no surface
  Image<float> incidence;  ///< cosine between ray and surface normal, in [0, 1]
  Image<Rgb8> color;       ///< black where there is no surface
};

/// The camera of the rendered sequences: ICL-NUIM's, with y down.
inline constexpr Intrinsics rendered_camera{481.2f, 480.0f, 319.5f, 239.5f};
inline constexpr Size rendered_size{640, 480};
/// Depth units of the rendered sequences, as in ICL-NUIM's TUM-compatible layout.
inline constexpr float rendered_units_per_m = 5000;

/// Whether this build can render; else making a Renderer throws.
bool can_render();

/// Whether colour is wanted.
enum class Shading {
  none,     ///< depth alone: `Rendering::color` is empty
  diffuse,  ///< lit from above (-y) and by one broad lamp, darker in corners (ambient occlusion)
};

/// Casts one ray through each pixel's centre.
class Renderer {
 public:
  /// Works out the light at each vertex, with `threads` threads. Throws UnavailableError, with the
  /// package to install, when built without Embree.
  Renderer(const Mesh& mesh, Size size, Intrinsics camera, Shading shading, int threads);
  ~Renderer();

  /// Renders on the calling thread; several threads may render at once.
  void render(const Pose& T_world_camera, Rendering& out) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Depth in units of 1 / units_per_m, rounded; what does not fit 16 bits is 0, no measurement.
void quantize_depth(const Image<float>& depth_m, float units_per_m, Image<std::uint16_t>& depth);

}  // namespace slambench
