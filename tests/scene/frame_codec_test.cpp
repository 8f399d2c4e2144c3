// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "scene/frame_codec.h"

#include <gtest/gtest.h>

#include <random>

namespace slambench {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

Image<std::uint16_t> random_depth(Size size) {
  std::mt19937 random(4);
  Image<std::uint16_t> image(size);
  for (auto& value : image) value = static_cast<std::uint16_t>(random());
  return image;
}

TEST(FrameCodec, RestoresAnyDepth) {
  for (const Size size : {Size{640, 480}, Size{1, 1}, Size{1, 9}, Size{9, 1}, Size{7, 3}}) {
    const Image<std::uint16_t> image = random_depth(size);
    Image<std::uint16_t> restored;
    ASSERT_TRUE(decode_image(bytes_of(encode_image(image)), size, restored));
    EXPECT_EQ(image, restored);
  }
}

TEST(FrameCodec, RestoresAnyColour) {
  std::mt19937 random(4);
  for (const Size size : {Size{64, 48}, Size{1, 1}, Size{1, 9}, Size{9, 1}}) {
    Image<Rgb8> image(size);
    for (auto& p : image) {
      const auto bits = random();
      p = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8),
           static_cast<std::uint8_t>(bits >> 16)};
    }
    Image<Rgb8> restored;
    ASSERT_TRUE(decode_image(bytes_of(encode_image(image)), size, restored));
    EXPECT_EQ(image, restored);
  }
}

TEST(FrameCodec, MakesASlopeSmall) {
  Image<std::uint16_t> slope(Size{640, 480});
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) slope(x, y) = static_cast<std::uint16_t>(5000 + 3 * x + 2 * y);
  }
  EXPECT_LT(encode_image(slope).size(), 2000u);
}

TEST(FrameCodec, RejectsWhatIsNoImageOfThatSize) {
  const Size size{32, 24};
  const std::string good = encode_image(random_depth(size));
  Image<std::uint16_t> image;
  EXPECT_FALSE(decode_image(bytes_of(good), Size{32, 25}, image));
  EXPECT_FALSE(decode_image(bytes_of(good), Size{32, 23}, image));
  for (std::size_t n = 0; n < good.size(); ++n) {
    EXPECT_FALSE(decode_image(bytes_of(good.substr(0, n)), size, image));
  }
}

}  // namespace
}  // namespace slambench
