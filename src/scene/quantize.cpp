// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "scene/renderer.h"

namespace slambench {

void quantize_depth(const Image<float>& depth_m, float units_per_m, Image<std::uint16_t>& depth) {
  depth.resize(depth_m.size());
  for (std::size_t i = 0; i < depth.count(); ++i) {
    const float units = depth_m.data()[i] * units_per_m + 0.5f;
    const bool fits = units >= 0.0f && units < 65536.0f;
    depth.data()[i] = fits ? static_cast<std::uint16_t>(static_cast<int>(units)) : std::uint16_t{0};
  }
}

}  // namespace slambench
