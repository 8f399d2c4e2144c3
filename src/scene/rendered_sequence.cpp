// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "scene/rendered_sequence.h"

#include <utility>

#include "scene/noise.h"

namespace slambench {

RenderedSequence::RenderedSequence(const Mesh& mesh, Trajectory trajectory, Shading shading,
                                   std::optional<std::uint64_t> noise_seed, int threads)
    : trajectory_(std::move(trajectory)),
      noise_seed_(noise_seed),
      renderer_(mesh, rendered_size, rendered_camera, shading, threads) {}

void RenderedSequence::render(int index, Rendering& out) const {
  renderer_.render(trajectory_.at(static_cast<std::size_t>(index)).T_world_camera, out);
  if (!noise_seed_) return;
  Image<float> noisy_m;
  add_kinect_noise(out.depth_m, out.incidence, *noise_seed_, index, noisy_m);
  std::swap(out.depth_m, noisy_m);
}

}  // namespace slambench
