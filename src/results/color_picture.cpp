// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/color_picture.h"

namespace slambench {
namespace {

/// How many pixels of `color` in each direction make one of the picture.
int block_side(Size color, Size size) {
  if (size.empty() || color.width % size.width != 0) return 1;
  const int side = color.width / size.width;
  return side * size.height == color.height ? side : 1;
}

Rgba8 mean_of_block(const Image<Rgb8>& color, int x, int y, int side) {
  int r = 0, g = 0, b = 0;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const Rgb8& pixel = color(x * side + i, y * side + j);
      r += pixel.r;
      g += pixel.g;
      b += pixel.b;
    }
  }
  const int count = side * side;
  const auto mean = [&](int sum) { return static_cast<std::uint8_t>((sum + count / 2) / count); };
  constexpr std::uint8_t opaque = 255;
  return {mean(r), mean(g), mean(b), opaque};
}

}  // namespace

Image<Rgba8> color_picture(const Image<Rgb8>& color, Size size) {
  if (color.empty()) return {};
  const int side = block_side(color.size(), size);
  Image<Rgba8> picture({color.width() / side, color.height() / side});
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) picture(x, y) = mean_of_block(color, x, y, side);
  }
  return picture;
}

}  // namespace slambench
