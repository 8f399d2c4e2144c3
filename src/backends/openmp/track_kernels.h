// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include "backends/openmp/image_kernels.h"
#include "kernels/pixel.h"

/// The kernels of the alignment over rows [begin, end), on the widest vectors of this processor.
namespace slambench {

/// The pointers of one call of track: to images of a HostBackend, behind which some bytes may be
/// read.
struct TrackInput {
  const Float3* vertices = nullptr;
  const Float3* normals = nullptr;
  Size size;
  const Float3* model_vertices = nullptr;
  const Float3* model_normals = nullptr;
  Size model_size;
  TrackParameters parameters;
};

/// Sums of a reduction are kept for so many rows, then added in the order of the rows: the result
/// is the same for every number of threads. Within a band, pixels are summed in single precision
/// over 16 lanes whatever the machine's vectors (and fused multiply-adds where it has them).
inline constexpr int band_rows = 4;

void track_rows(TrackData* track, const TrackInput& input, Rows rows);
/// The sums over a band.
Reduction reduce_band(const TrackData* track, Size size, Rows rows);
/// reduce_band of what track_rows would have written.
Reduction track_reduce_band(const TrackInput& input, Rows rows);

/// Adds a band's sums.
void add(const Reduction& band, Reduction* sum);

}  // namespace slambench
