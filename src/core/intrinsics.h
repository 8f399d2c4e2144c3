// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

namespace slambench {

/// A pinhole camera: focal lengths and principal point in pixels; x right, y down, z forward.
/// The centre of pixel (u, v) is at (u, v): it sees the ray ((u - cx) / fx, (v - cy) / fy, 1).
struct Intrinsics {
  float fx = 0, fy = 0, cx = 0, cy = 0;

  /// The camera of an image reduced by `factor` in both directions: K / factor, as SLAMBench 1
  /// divides it for its computation size and its pyramid levels.
  Intrinsics divided_by(float factor) const {
    return {fx / factor, fy / factor, cx / factor, cy / factor};
  }
  friend bool operator==(const Intrinsics&, const Intrinsics&) = default;
};

}  // namespace slambench
