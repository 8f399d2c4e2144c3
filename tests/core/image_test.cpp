// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "core/image.h"

#include <gtest/gtest.h>

#include "core/intrinsics.h"

namespace slambench {
namespace {

TEST(Size, CountsPixelsBeyondThirtyTwoBits) {
  EXPECT_EQ((Size{70000, 70000}).count(), 4900000000u);
  EXPECT_FALSE((Size{1, 1}).empty());
  EXPECT_TRUE((Size{0, 1}).empty());
  EXPECT_TRUE((Size{1, 0}).empty());
  EXPECT_TRUE((Size{-1, 1}).empty());
}

TEST(Image, RunsRowByRow) {
  Image<int> image({3, 2}, 7);
  image(2, 0) = 1;
  image(0, 1) = 2;
  const Image<int>& constant = image;
  EXPECT_EQ(std::vector<int>(constant.begin(), constant.end()),
            (std::vector<int>{7, 7, 1, 2, 7, 7}));
  EXPECT_EQ(constant(2, 0), 1);
  EXPECT_EQ(constant.data()[3], 2);
  EXPECT_EQ(image.width(), 3);
  EXPECT_EQ(image.height(), 2);
  EXPECT_EQ(image.count(), 6u);
  EXPECT_EQ(image.bytes(), 6 * sizeof(int));
}

TEST(Image, IsEmptyUntilItHasASize) {
  Image<float> image;
  EXPECT_TRUE(image.empty());
  EXPECT_EQ(image.size(), Size{});
  image.resize({2, 5});
  EXPECT_FALSE(image.empty());
  EXPECT_EQ(image.size(), (Size{2, 5}));
  EXPECT_EQ(image.count(), 10u);
}

TEST(Image, ComparesSizeAndPixels) {
  EXPECT_EQ(Image<int>({2, 3}, 1), Image<int>({2, 3}, 1));
  EXPECT_NE(Image<int>({2, 3}, 1), Image<int>({3, 2}, 1));
  EXPECT_NE(Image<int>({2, 3}, 1), Image<int>({2, 3}, 2));
}

TEST(Intrinsics, DivideEveryComponent) {
  EXPECT_EQ((Intrinsics{500, 400, 320, 240}).divided_by(4), (Intrinsics{125, 100, 80, 60}));
}

}  // namespace
}  // namespace slambench
