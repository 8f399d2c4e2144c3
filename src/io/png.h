// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>
#include <string>

#include "core/image.h"

namespace slambench {

/// Reads a 16-bit greyscale PNG into `image`. Throws InputError naming the file and what is wrong:
/// missing, not a PNG, truncated, corrupt, another bit depth or colour type.
void read_png(const std::string& path, Image<std::uint16_t>& image);

/// Reads any 8-bit colour or grey PNG as RGB. Throws like the above.
void read_png(const std::string& path, Image<Rgb8>& image);

/// The encoded file. Throws Error when encoding fails.
std::string png_bytes(const Image<std::uint16_t>& image);
std::string png_bytes(const Image<Rgb8>& image);
std::string png_bytes(const Image<Rgba8>& image);

}  // namespace slambench
