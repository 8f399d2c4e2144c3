// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include "backends/host/brick_volume.h"
#include "backends/openmp/image_kernels.h"
#include "backends/openmp/start_depths.h"
#include "kernels/volume_maths.h"

/// raycast and the shading of render_volume over rows [begin, end), on the widest vectors of this
/// processor. Sampling and marching round as the per-element functions do: the same bits.
namespace slambench {

/// The images of one call, all of the same size.
struct RaycastOutput {
  Float3* vertices = nullptr;
  Float3* normals = nullptr;
  Size size;
  bool only_misses = false;            ///< leave pixels alone whose normal is valid
  const StartDepths* start = nullptr;  ///< of this view, where there are some
};

void raycast_rows(const RaycastOutput& output, const GridView& map,
                  const RaycastParameters& parameters, Rows rows);
void raycast_rows(const RaycastOutput& output, const BrickView& map,
                  const RaycastParameters& parameters, Rows rows);

void shade_rows(Rgba8* image, const Float3* vertices, const Float3* normals, Size size,
                const ShadeParameters& parameters, Rows rows);

/// Whether the kernels' 32-bit offsets reach all of the volume.
bool raycast_reaches(const GridView& map);
bool raycast_reaches(const BrickView& map);

}  // namespace slambench
