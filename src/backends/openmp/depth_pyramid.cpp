// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <algorithm>

#include "backends/openmp/integrate_kernels.h"

namespace slambench {
namespace {

void include(DepthPyramid::Range other, DepthPyramid::Range* range) {
  range->least = std::min(range->least, other.least);
  range->greatest = std::max(range->greatest, other.greatest);
}

std::size_t index(Size size, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
         static_cast<std::size_t>(x);
}

Size fewer(Size size, int factor) {
  return {(size.width + factor - 1) / factor, (size.height + factor - 1) / factor};
}

}  // namespace

void DepthPyramid::build(const float* depth_m, Size size) {
  std::size_t count = 1;
  for (Size s = fewer(size, tile); s.width > 1 || s.height > 1; s = fewer(s, 2)) ++count;
  levels_.resize(count);

  Level& finest = levels_[0];
  finest.size = fewer(size, tile);
  finest.tiles.resize(finest.size.count());
  for (int ty = 0; ty < finest.size.height; ++ty) {
    for (int tx = 0; tx < finest.size.width; ++tx) {
      const int x1 = std::min(size.width, (tx + 1) * tile);
      const int y1 = std::min(size.height, (ty + 1) * tile);
      const float first = std::max(0.0f, depth_m[index(size, tx * tile, ty * tile)]);
      Range range{first, first};
      for (int y = ty * tile; y < y1; ++y) {
        for (int x = tx * tile; x < x1; ++x) {
          const float depth = depth_m[index(size, x, y)];
          const float valid = depth > 0.0f ? depth : 0.0f;
          include({valid, valid}, &range);
        }
      }
      finest.tiles[index(finest.size, tx, ty)] = range;
    }
  }
  for (std::size_t i = 1; i < levels_.size(); ++i) {
    const Level& below = levels_[i - 1];
    Level& level = levels_[i];
    level.size = fewer(below.size, 2);
    level.tiles.resize(level.size.count());
    for (int y = 0; y < level.size.height; ++y) {
      for (int x = 0; x < level.size.width; ++x) {
        Range range = below.tiles[index(below.size, 2 * x, 2 * y)];
        for (int dy = 0; dy < 2 && 2 * y + dy < below.size.height; ++dy) {
          for (int dx = 0; dx < 2 && 2 * x + dx < below.size.width; ++dx) {
            include(below.tiles[index(below.size, 2 * x + dx, 2 * y + dy)], &range);
          }
        }
        level.tiles[index(level.size, x, y)] = range;
      }
    }
  }
}

DepthPyramid::Range DepthPyramid::range(int x0, int y0, int x1, int y1) const {
  constexpr int most_tiles = 3;
  x0 /= tile, y0 /= tile, x1 /= tile, y1 /= tile;
  std::size_t i = 0;
  for (; (x1 - x0 >= most_tiles || y1 - y0 >= most_tiles) && i + 1 < levels_.size(); ++i) {
    x0 /= 2, y0 /= 2, x1 /= 2, y1 /= 2;
  }
  const Level& level = levels_[i];
  Range range = level.tiles[index(level.size, x0, y0)];
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) include(level.tiles[index(level.size, x, y)], &range);
  }
  return range;
}

float DepthPyramid::greatest() const { return levels_.back().tiles[0].greatest; }

}  // namespace slambench
