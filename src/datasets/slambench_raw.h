// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <memory>
#include <string>

#include "datasets/source.h"

namespace slambench {

/// SLAMBench 1's files. Per frame, little endian and without a header of the file: u32 width, u32
/// height, u16 depth_mm[width height], u32 width, u32 height, u8 rgb[3 width height]; the "light"
/// variant has the depth part alone. Time stamps are the numbers of frames; the ground
/// truth of NAME.raw, if any, is NAME.groundtruth.txt beside it, in the format of TUM, and its
/// camera, if it is not the usual one, in NAME.camera.txt.
bool is_slambench_raw(const std::string& sequence);
std::unique_ptr<Source> open_slambench_raw(const std::string& sequence, const SourceParameters&);

}  // namespace slambench
