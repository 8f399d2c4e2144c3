// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <vector>

#include "backends/host/brick_volume.h"
#include "backends/openmp/parallel.h"
#include "kernels/types.h"

namespace slambench {

/// The level (BrickVolume::level_of) from which on distances need not be sampled: no sample between
/// such distances makes a ray slower or ends it. Above all levels where there is none.
int skip_level(const RaycastParameters& view);

/// Per tile of a view, a depth before which no sample of the volume is needed: the least depth of
/// the bricks with distances below the skip level, projected into the image.
class StartDepths {
 public:
  static constexpr int tile = 4;  ///< pixels

  void build(const BrickView& map, const RaycastParameters& view, Size size,
             const Parallel& parallel);
  /// Of the pixels from (x, y) on, within one tile.
  float at(int x, int y) const {
    return depths_[static_cast<std::size_t>(y / tile) * static_cast<std::size_t>(tiles_.width) +
                   static_cast<std::size_t>(x / tile)];
  }

 private:
  Size tiles_;
  std::vector<float> depths_;
  std::vector<std::vector<float>> parts_;  ///< of chunks of the bricks
};

}  // namespace slambench
