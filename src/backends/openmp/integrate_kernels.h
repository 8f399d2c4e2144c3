// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <vector>

#include "backends/host/brick_volume.h"
#include "backends/openmp/parallel.h"
#include "kernels/volume_maths.h"

/// integrate over parts of the volume, on the widest vectors of this processor.
namespace slambench {

/// Least and greatest depth of square tiles, in levels of halving resolution; 0 stands for what is
/// no depth, so that a tile with a hole has the least depth 0.
class DepthPyramid {
 public:
  static constexpr int tile = 4;  ///< pixels of the finest level's tiles

  void build(const float* depth_m, Size size, const Parallel& parallel);
  /// Over pixels [x0, x1] x [y0, y1], which lie in the image, and some more around.
  struct Range {
    float least = 0, greatest = 0;
  };
  Range range(int x0, int y0, int x1, int y1) const;
  float greatest() const;

 private:
  struct Level {
    Size size;
    std::vector<Range> tiles;
  };
  std::vector<Level> levels_;
};

/// One call of integrate.
struct IntegrateInput {
  const float* depth_m = nullptr;
  Size size;
  IntegrateParameters parameters;
  Int3 resolution;
  Float3 voxel_m;
  float greatest_depth_m = 0;
  float tolerance_m = 0;  ///< how far rounding may move a voxel
};

/// Updates the voxels of rows [begin, end) of the flat volume (y fastest, then z).
void integrate_rows(Voxel* voxels, const IntegrateInput& input, int begin, int end);

/// What a measurement does to a brick.
enum class BrickChange {
  none,    ///< no voxel is measured
  free,    ///< every voxel is measured as free space, a truncated distance of 1
  varied,  ///< look at every voxel
};
/// A brick whose voxels have to be changed one by one.
struct BrickWork {
  std::int32_t brick = 0;
  BrickChange change = BrickChange::varied;  ///< or free
};
/// Counts a measurement of bricks with by, bz whose voxels are all found in free space once more,
/// and lists the others that change.
void classify_bricks(BrickVolume& volume, const IntegrateInput& input, const DepthPyramid& depth,
                     int by, int bz, std::vector<BrickWork>* work);
/// Updates the voxels of one brick; there must be planes in reserve.
void integrate_brick(BrickVolume& volume, const IntegrateInput& input, BrickWork work);

}  // namespace slambench
