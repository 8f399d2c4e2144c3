// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <memory>
#include <string>

#include "datasets/source.h"

namespace slambench {

/// The layout of the TUM RGB-D benchmark (Sturm et al., IROS 2012): depth.txt names 16-bit PNGs of
/// 5000 units per metre with their time stamps, rgb.txt (optional) colour images, and
/// groundtruth.txt (optional) has the poses. The depth images are the frames. camera.txt
/// (optional, "fx fy cx cy") has the camera where it is none of the published ones.
bool is_tum_rgbd(const std::string& sequence);
std::unique_ptr<Source> open_tum_rgbd(const std::string& sequence, const SourceParameters&);

}  // namespace slambench
