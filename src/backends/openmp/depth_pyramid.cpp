// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <algorithm>
#include <limits>
#include <vector>

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

/// The finest level's rows [begin, end).
void fill_rows(const float* depth_m, Size size, int begin, int end, Size tiles,
               DepthPyramid::Range* ranges) {
  constexpr int tile = DepthPyramid::tile;
  // Of a row of tiles' columns of pixels: loops over these make whole vectors.
  std::vector<float> columns(2 * static_cast<std::size_t>(size.width));
  float *least = columns.data(), *greatest = least + size.width;
  for (int ty = begin; ty < end; ++ty) {
    std::fill_n(least, size.width, std::numeric_limits<float>::infinity());
    std::fill_n(greatest, size.width, 0.0f);
    const int y1 = std::min(size.height, (ty + 1) * tile);
    for (int y = ty * tile; y < y1; ++y) {
      const float* row = depth_m + index(size, 0, y);
      for (int x = 0; x < size.width; ++x) {
        const float depth = row[x] > 0.0f ? row[x] : 0.0f;
        least[x] = depth < least[x] ? depth : least[x];
        greatest[x] = depth > greatest[x] ? depth : greatest[x];
      }
    }
    for (int tx = 0; tx < tiles.width; ++tx) {
      const int x1 = std::min(size.width, (tx + 1) * tile);
      DepthPyramid::Range range{least[tx * tile], greatest[tx * tile]};
      for (int x = tx * tile + 1; x < x1; ++x) include({least[x], greatest[x]}, &range);
      ranges[index(tiles, tx, ty)] = range;
    }
  }
}

}  // namespace

void DepthPyramid::build(const float* depth_m, Size size, const Parallel& parallel) {
  std::size_t count = 1;
  for (Size s = fewer(size, tile); s.width > 1 || s.height > 1; s = fewer(s, 2)) ++count;
  levels_.resize(count);

  Level& finest = levels_[0];
  finest.size = fewer(size, tile);
  finest.tiles.resize(finest.size.count());
  constexpr int rows_at_once = 8;
  parallel.for_chunks(finest.size.height, rows_at_once, [&](int begin, int end) {
    fill_rows(depth_m, size, begin, end, finest.size, finest.tiles.data());
  });
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
