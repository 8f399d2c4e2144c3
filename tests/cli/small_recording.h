// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/image.h"

namespace slambench::testing {

inline constexpr Size small_size{64, 48};

/// A box in front of a wall, in millimetres: enough structure for every direction of motion.
inline Image<std::uint16_t> small_depth() {
  Image<std::uint16_t> depth(small_size);
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 0; x < depth.width(); ++x) {
      const bool box = x > 20 && x < 40 && y > 15 && y < 35;
      depth(x, y) = static_cast<std::uint16_t>(box ? 1200 + 4 * x + 3 * y : 1800 + 2 * x - 3 * y);
    }
  }
  return depth;
}

/// `frames` times the same image as SLAMBench 1 records depth without colour.
inline std::string small_raw(int frames) {
  const auto number = [](std::uint32_t value) {
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xff);
    return bytes;
  };
  const Image<std::uint16_t> depth = small_depth();
  std::string frame = number(small_size.width) + number(small_size.height);
  for (const std::uint16_t value : depth) {
    frame += static_cast<char>(value & 0xff);
    frame += static_cast<char>(value >> 8);
  }
  std::string all;
  for (int i = 0; i < frames; ++i) all += frame;
  return all;
}

/// Arguments of a run over such a recording that takes milliseconds and tracks.
inline std::vector<std::string> small_run() {
  return {
      "run", "small.raw", "-k", "60,60,31.5,23.5", "-v", "32", "-s", "3", "-p", "0.5,0.5,0.1", "-y",
      "4,3", "-c",        "1",  "--out",           "out"};
}

}  // namespace slambench::testing
