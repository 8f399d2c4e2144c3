// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "io/png.h"

#include <gmock/gmock.h>
#include <spng.h>

#include <memory>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

Image<std::uint16_t> depth_image(Size size) {
  Image<std::uint16_t> image(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      image(x, y) = static_cast<std::uint16_t>(x * 4099 + y * 257 + (x * y) % 7);
    }
  }
  return image;
}

Image<Rgb8> color_image(Size size) {
  Image<Rgb8> image(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      image(x, y) = {static_cast<std::uint8_t>(x * 16), static_cast<std::uint8_t>(y * 8),
                     static_cast<std::uint8_t>(x ^ y)};
    }
  }
  return image;
}

/// A PNG of a kind that the project does not write itself.
std::string encode(Size size, int color_type, int bit_depth, const std::string& pixels,
                   bool interlaced = false) {
  const std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> context(spng_ctx_new(SPNG_CTX_ENCODER),
                                                               spng_ctx_free);
  spng_ihdr header = {};
  header.width = static_cast<std::uint32_t>(size.width);
  header.height = static_cast<std::uint32_t>(size.height);
  header.color_type = static_cast<std::uint8_t>(color_type);
  header.bit_depth = static_cast<std::uint8_t>(bit_depth);
  header.interlace_method = interlaced ? SPNG_INTERLACE_ADAM7 : SPNG_INTERLACE_NONE;
  spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1);
  spng_set_ihdr(context.get(), &header);
  if (color_type == SPNG_COLOR_TYPE_INDEXED) {
    spng_plte palette = {2, {{10, 20, 30, 255}, {40, 50, 60, 255}}};
    spng_set_plte(context.get(), &palette);
  }
  EXPECT_EQ(spng_encode_image(context.get(), pixels.data(), pixels.size(), SPNG_FMT_PNG,
                              SPNG_ENCODE_FINALIZE),
            0);
  std::size_t length = 0;
  int error = 0;
  char* const bytes = static_cast<char*>(spng_get_png_buffer(context.get(), &length, &error));
  EXPECT_EQ(error, 0);
  const std::string file(bytes, length);
  std::free(bytes);
  return file;
}

std::string error_of_depth(const std::string& bytes) {
  const TemporaryFolder folder;
  const std::string file = folder.write("image.png", bytes);
  Image<std::uint16_t> image;
  const std::string message = message_of<InputError>([&] { read_png(file, image); });
  EXPECT_THAT(message, HasSubstr(file));
  return message.substr(message.find("image.png"));
}

TEST(Png, DepthRoundTrips) {
  const TemporaryFolder folder;
  for (const Size size : {Size{1, 1}, Size{7, 3}, Size{64, 48}}) {
    const auto image = depth_image(size);
    Image<std::uint16_t> read(Size{2, 9}, 5);
    read_png(folder.write("tiefe_深度.png", png_bytes(image)), read);
    EXPECT_EQ(read, image);
  }
}

TEST(Png, ColorRoundTrips) {
  const TemporaryFolder folder;
  const auto image = color_image({9, 5});
  Image<Rgb8> read;
  read_png(folder.write("image.png", png_bytes(image)), read);
  EXPECT_EQ(read, image);
}

TEST(Png, ColorIsReadFromEveryKindOfEightBits) {
  const TemporaryFolder folder;
  Image<Rgb8> read;
  Image<Rgba8> picture(Size{2, 1});
  picture(0, 0) = {1, 2, 3, 255};
  picture(1, 0) = {4, 5, 6, 0};
  read_png(folder.write("rgba.png", png_bytes(picture)), read);
  EXPECT_EQ(read(0, 0), (Rgb8{1, 2, 3}));
  EXPECT_EQ(read(1, 0), (Rgb8{4, 5, 6}));
  read_png(folder.write("grey.png", encode({2, 1}, SPNG_COLOR_TYPE_GRAYSCALE, 8, "\x07\x09")),
           read);
  EXPECT_EQ(read(1, 0), (Rgb8{9, 9, 9}));
  read_png(folder.write("palette.png",
                        encode({2, 1}, SPNG_COLOR_TYPE_INDEXED, 8, std::string("\x01\x00", 2))),
           read);
  EXPECT_EQ(read(0, 0), (Rgb8{40, 50, 60}));
  EXPECT_EQ(read(1, 0), (Rgb8{10, 20, 30}));
}

TEST(Png, DepthOfAnotherKindIsRejected) {
  EXPECT_EQ(error_of_depth(encode({2, 1}, SPNG_COLOR_TYPE_GRAYSCALE, 8, "ab")),
            "image.png: PNG: found 8 bits greyscale, expected 16 bits greyscale");
  EXPECT_EQ(error_of_depth(png_bytes(color_image({2, 2}))),
            "image.png: PNG: found 8 bits RGB, expected 16 bits greyscale");
  EXPECT_EQ(error_of_depth(png_bytes(Image<Rgba8>(Size{2, 2}))),
            "image.png: PNG: found 8 bits RGB with alpha, expected 16 bits greyscale");
  EXPECT_EQ(error_of_depth(encode({1, 1}, SPNG_COLOR_TYPE_GRAYSCALE_ALPHA, 16, "abcd")),
            "image.png: PNG: found 16 bits greyscale with alpha, expected 16 bits greyscale");
  EXPECT_EQ(error_of_depth(encode({2, 1}, SPNG_COLOR_TYPE_INDEXED, 8, std::string(2, '\0'))),
            "image.png: PNG: found 8 bits palette, expected 16 bits greyscale");
}

TEST(Png, ColorOfSixteenBitsIsRejected) {
  const TemporaryFolder folder;
  const std::string file = folder.write("image.png", png_bytes(depth_image({2, 2})));
  Image<Rgb8> image;
  EXPECT_EQ(message_of<InputError>([&] { read_png(file, image); }),
            file + ": PNG: found 16 bits greyscale, expected 8 bits colour or greyscale");
}

TEST(Png, SaysWhenItIsNoImage) {
  EXPECT_EQ(error_of_depth(""), "image.png: the file is empty, expected a PNG");
  EXPECT_EQ(error_of_depth("GIF89a, a long time ago, in a galaxy far away"),
            "image.png: not a PNG");
  const TemporaryFolder folder;
  Image<std::uint16_t> image;
  EXPECT_EQ(message_of<InputError>([&] { read_png(folder.path("none.png"), image); }),
            folder.path("none.png") + ": cannot read: No such file or directory");
  EXPECT_EQ(message_of<InputError>([&] { read_png(folder.path(), image); }),
            folder.path() + ": cannot read: it is a folder, not a file");
}

TEST(Png, EveryTruncationIsNoticed) {
  const TemporaryFolder folder;
  const std::string depth = png_bytes(depth_image({11, 7}));
  const std::string color = png_bytes(color_image({11, 7}));
  Image<std::uint16_t> depth_read;
  Image<Rgb8> color_read;
  for (std::size_t length = 0; length < depth.size(); ++length) {
    const std::string file = folder.write("image.png", std::string_view(depth).substr(0, length));
    EXPECT_THROW(read_png(file, depth_read), InputError) << length;
  }
  for (std::size_t length = 0; length < color.size(); ++length) {
    const std::string file = folder.write("image.png", std::string_view(color).substr(0, length));
    EXPECT_THROW(read_png(file, color_read), InputError) << length;
  }
  EXPECT_EQ(error_of_depth(depth.substr(0, depth.size() - 1)),
            "image.png: truncated PNG: no end mark within its " + std::to_string(depth.size() - 1) +
                " bytes");
  EXPECT_EQ(error_of_depth(depth.substr(0, 4)),
            "image.png: truncated PNG: no end mark within its 4 bytes");
  EXPECT_EQ(error_of_depth(depth.substr(0, depth.size() / 2)),
            "image.png: truncated PNG: no end mark within its " + std::to_string(depth.size() / 2) +
                " bytes");
}

TEST(Png, EveryChangedByteIsNoticed) {
  const TemporaryFolder folder;
  const std::string bytes = png_bytes(depth_image({11, 7}));
  Image<std::uint16_t> image;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^ 0x41);
    EXPECT_THROW(read_png(folder.write("image.png", changed), image), InputError) << i;
  }
  std::string changed = bytes;
  changed[changed.size() / 2] = static_cast<char>(changed[changed.size() / 2] + 1);
  EXPECT_THAT(error_of_depth(changed), HasSubstr("image.png: corrupt PNG: "));
}

TEST(Png, AHugeHeaderIsRejectedBeforeMemoryIsTaken) {
  // The header of a 2,000,000,000 x 2,000,000,000 image with a right checksum.
  std::string bytes = encode({1, 1}, SPNG_COLOR_TYPE_GRAYSCALE, 16, "ab");
  const auto put = [&](std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(value >> (24 - 8 * i));
  };
  put(16, 2'000'000'000);
  put(20, 2'000'000'000);
  std::uint32_t crc = 0xFFFFFFFF;
  for (std::size_t i = 12; i < 29; ++i) {
    crc ^= static_cast<std::uint8_t>(bytes[i]);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xEDB88320 : 0);
  }
  put(29, ~crc);
  EXPECT_THAT(error_of_depth(bytes), HasSubstr("corrupt PNG: "));
}

TEST(Png, AnEmptyImageCannotBeEncoded) {
  EXPECT_THAT(message_of<Error>([] { png_bytes(Image<Rgb8>()); }), HasSubstr("cannot encode PNG"));
}

}  // namespace
}  // namespace slambench
