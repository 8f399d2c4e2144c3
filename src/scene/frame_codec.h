// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "core/image.h"

namespace slambench {

/// Lossless compression of rendered images that is read back in a millisecond or two: each value
/// is predicted from its neighbours (LOCO-I's median predictor, Weinberger et al. 2000), the
/// differences, of depth in planes of low and high bytes, are compressed with Zstandard.
std::string encode_image(const Image<std::uint16_t>& image);
std::string encode_image(const Image<Rgb8>& image);

/// The image of that size that the bytes were made of; false when they are no such image.
bool decode_image(std::span<const std::byte> bytes, Size size, Image<std::uint16_t>& image);
bool decode_image(std::span<const std::byte> bytes, Size size, Image<Rgb8>& image);

}  // namespace slambench
