// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "scene/frame_codec.h"

#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <vector>

namespace slambench {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Calls step(i, prediction) for all values of an image in reading order, channels interleaved.
/// Earlier values must be known by then. The prediction is the median of left, upper, and their
/// plane through the corner; in the first row and column, of what there is.
template <int channels, class T, class Step>
void predict_all(Size size, const T* values, const Step& step) {
  const std::ptrdiff_t row = std::ptrdiff_t{channels} * size.width;
  for (std::ptrdiff_t i = 0; i < channels; ++i) step(i, 0);
  for (std::ptrdiff_t i = channels; i < row; ++i) step(i, static_cast<int>(values[i - channels]));
  for (int y = 1; y < size.height; ++y) {
    const std::ptrdiff_t begin = y * row;
    for (std::ptrdiff_t i = begin; i < begin + channels; ++i) {
      step(i, static_cast<int>(values[i - row]));
    }
    for (std::ptrdiff_t i = begin + channels; i < begin + row; ++i) {
      const int left = values[i - channels], up = values[i - row];
      const int corner = values[i - row - channels];
      step(i, std::clamp(left + up - corner, std::min(left, up), std::max(left, up)));
    }
  }
}

/// Small differences of either sign become small numbers.
std::uint16_t folded(std::uint16_t difference) {
  return static_cast<std::uint16_t>((difference << 1) ^ (0 - (difference >> 15)));
}
std::uint16_t unfolded(std::uint16_t code) {
  return static_cast<std::uint16_t>((code >> 1) ^ (0 - (code & 1)));
}

std::string compress(const Bytes& planes) {
  constexpr int level = 1;
  std::string bytes(ZSTD_compressBound(planes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(bytes.data(), bytes.size(), planes.data(), planes.size(), level);
  if (ZSTD_isError(size) != 0) throw std::bad_alloc();
  bytes.resize(size);
  return bytes;
}

bool decompress(std::span<const std::byte> bytes, std::size_t expected, Bytes& planes) {
  planes.resize(expected);
  return ZSTD_decompress(planes.data(), planes.size(), bytes.data(), bytes.size()) == expected;
}

/// The channels of a colour image one after the other, as they lie in memory.
const std::uint8_t* bytes_of(const Image<Rgb8>& image) {
  static_assert(sizeof(Rgb8) == 3);
  return reinterpret_cast<const std::uint8_t*>(image.data());
}

}  // namespace

std::string encode_image(const Image<std::uint16_t>& image) {
  const auto count = static_cast<std::ptrdiff_t>(image.count());
  Bytes planes(2 * image.count());
  std::uint8_t* const low = planes.data();
  std::uint8_t* const high = low + count;
  predict_all<1>(image.size(), image.data(), [&](std::ptrdiff_t i, int prediction) {
    const std::uint16_t code = folded(static_cast<std::uint16_t>(image.data()[i] - prediction));
    low[i] = static_cast<std::uint8_t>(code & 0xff);
    high[i] = static_cast<std::uint8_t>(code >> 8);
  });
  return compress(planes);
}

std::string encode_image(const Image<Rgb8>& image) {
  Bytes differences(3 * image.count());
  const std::uint8_t* const values = bytes_of(image);
  predict_all<3>(image.size(), values, [&](std::ptrdiff_t i, int prediction) {
    differences[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(values[i] - prediction);
  });
  return compress(differences);
}

bool decode_image(std::span<const std::byte> bytes, Size size, Image<std::uint16_t>& image) {
  Bytes planes;
  if (!decompress(bytes, 2 * size.count(), planes)) return false;
  image.resize(size);
  std::uint16_t* const values = image.data();
  const std::uint8_t* const low = planes.data();
  const std::uint8_t* const high = low + size.count();
  predict_all<1>(size, values, [&](std::ptrdiff_t i, int prediction) {
    const auto code = static_cast<std::uint16_t>(low[i] | (high[i] << 8));
    values[i] = static_cast<std::uint16_t>(prediction + unfolded(code));
  });
  return true;
}

bool decode_image(std::span<const std::byte> bytes, Size size, Image<Rgb8>& image) {
  Bytes values;
  if (!decompress(bytes, 3 * size.count(), values)) return false;
  // In place: each difference is replaced by its value.
  std::uint8_t* const at = values.data();
  predict_all<3>(size, at, [at](std::ptrdiff_t i, int prediction) {
    at[i] = static_cast<std::uint8_t>(at[i] + prediction);
  });
  image.resize(size);
  std::memcpy(static_cast<void*>(image.data()), at, values.size());
  return true;
}

}  // namespace slambench
