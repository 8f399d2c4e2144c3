// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/frame.h"
#include "core/image.h"
#include "core/trajectory.h"

namespace slambench {

/// What a system reports about one frame.
struct FrameResult {
  bool tracked = false;                    ///< the pose was updated from this frame
  bool integrated = false;                 ///< the map was updated from this frame
  Pose T_start_camera = Pose::Identity();  ///< relative to the camera at the first frame
  std::vector<int> iterations;             ///< of the alignment, per pyramid level, finest first
  std::size_t inliers = 0;                 ///< pixels in the last iteration's system
  double inlier_fraction = 0;              ///< of that level's pixels
  double residual_m = 0;                   ///< root mean square of its point-to-plane errors
};

/// The pictures last drawn; empty ones do not exist for this system.
struct Pictures {
  Image<Rgba8> depth, track, volume;
};

/// A SLAM system under test: takes frames in order and says where the camera is. It reports
/// stages and kernels to the observer it was made with.
class System {
 public:
  virtual ~System() = default;
  virtual FrameResult process(const Frame& frame) = 0;
  /// Draws what a user would watch (part of the measured work, as in the paper).
  virtual void render() = 0;
  /// Copies the last pictures out (not part of the measured work).
  virtual Pictures pictures() = 0;
  /// How the map is stored, as on the command line.
  virtual std::string map() const = 0;
  /// Processors of this machine that process() keeps busy, its caller's included.
  virtual int busy_processors() const = 0;
  /// Memory of the map now.
  virtual std::size_t map_bytes() const = 0;
  /// Writes the map as raw 16-bit distances, x fastest, then y, then z.
  virtual void dump_volume(const std::string& path) = 0;
};

}  // namespace slambench
