// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>
#include <cstring>
#include <string>

#include "core/image.h"

namespace slambench::testing {

/// A depth image that differs in every pixel and for every frame.
inline Image<std::uint16_t> sample_depth(Size size, int frame) {
  Image<std::uint16_t> image(size);
  std::uint16_t value = static_cast<std::uint16_t>(1000 * frame + 1);
  for (auto& pixel : image) pixel = value++;
  return image;
}

/// A colour image of one colour that tells the frame.
inline Image<Rgb8> sample_color(Size size, int frame) {
  return Image<Rgb8>(size, {static_cast<std::uint8_t>(frame + 1), 200, 7});
}

template <class T>
std::string bytes_of(const T* values, std::size_t count) {
  std::string bytes(count * sizeof(T), '\0');
  std::memcpy(bytes.data(), values, bytes.size());
  return bytes;
}

/// One frame of a SLAMBench 1 file.
inline std::string raw_frame(Size size, int frame, bool with_color) {
  const std::uint32_t header[] = {static_cast<std::uint32_t>(size.width),
                                  static_cast<std::uint32_t>(size.height)};
  const auto depth = sample_depth(size, frame);
  std::string bytes = bytes_of(header, 2) + bytes_of(depth.data(), depth.count());
  if (with_color) {
    const auto color = sample_color(size, frame);
    bytes += bytes_of(header, 2) + bytes_of(color.data(), color.count());
  }
  return bytes;
}

}  // namespace slambench::testing
