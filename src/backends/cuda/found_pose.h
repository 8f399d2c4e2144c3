// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include "backends/cuda/solver.h"

/// Kernels that go on where an alignment on the device has ended, of which the host knows nothing.
namespace slambench::cuda {

/// What an alignment says to the kernels behind it.
struct FoundPose {
  int tracked = 0;  ///< it is believed; otherwise the poses are those that it started from
  Rigid3f T_volume_camera, T_camera_volume;
};

/// A kernel at a found pose, which its move_to() takes over. Does nothing on a lost frame where
/// F::of_tracked_frames.
template <class F>
struct AtFoundPose : F {
  const FoundPose* found;

  template <class... Arguments>
  SLAMBENCH_HD void operator()(Arguments&&... arguments) const {
    if (F::of_tracked_frames && found->tracked == 0) return;
    F there = *this;
    there.move_to(*found);
    there(arguments...);
  }
};

}  // namespace slambench::cuda
