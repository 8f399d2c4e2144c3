// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>

#include "core/image.h"

namespace slambench {

/// One RGB-D frame as a source delivers it, at full input resolution.
struct Frame {
  int index = 0;               ///< number in the sequence, from 0
  double time_s = 0;           ///< the sequence's own time stamp
  Image<std::uint16_t> depth;  ///< in the source's depth units; 0 = no measurement
  Image<Rgb8> color;           ///< empty when the source has none
};

}  // namespace slambench
