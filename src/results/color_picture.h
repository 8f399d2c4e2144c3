// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include "core/image.h"

namespace slambench {

/// A colour image as a picture of at least this size: where it is a whole number of times as large
/// in both directions, the mean of each block of pixels, else as it is.
Image<Rgba8> color_picture(const Image<Rgb8>& color, Size size);

}  // namespace slambench
