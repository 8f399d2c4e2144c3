// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/color_picture.h"

#include <gtest/gtest.h>

namespace slambench {
namespace {

TEST(ColorPicture, IsTheMeanOfBlocks) {
  Image<Rgb8> color(Size{4, 2});
  color(0, 0) = {10, 0, 255};
  color(1, 0) = {20, 0, 255};
  color(0, 1) = {30, 0, 255};
  color(1, 1) = {41, 1, 255};
  const Image<Rgba8> picture = color_picture(color, {2, 1});
  EXPECT_EQ(picture.size(), (Size{2, 1}));
  EXPECT_EQ(picture(0, 0), (Rgba8{25, 0, 255, 255}));
  EXPECT_EQ(picture(1, 0), (Rgba8{0, 0, 0, 255}));
}

TEST(ColorPicture, KeepsItsSizeWhereBlocksDoNotFit) {
  const Image<Rgb8> color(Size{6, 4}, Rgb8{1, 2, 3});
  for (const Size size : {Size{6, 4}, Size{4, 4}, Size{3, 4}, Size{12, 8}, Size{}}) {
    const Image<Rgba8> picture = color_picture(color, size);
    EXPECT_EQ(picture.size(), color.size());
    EXPECT_EQ(picture(5, 3), (Rgba8{1, 2, 3, 255}));
  }
  EXPECT_TRUE(color_picture({}, {2, 2}).empty());
}

}  // namespace
}  // namespace slambench
