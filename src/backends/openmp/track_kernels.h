// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include "backends/openmp/image_kernels.h"
#include "kernels/pixel.h"

/// The kernels of the alignment over rows [begin, end), on the widest vectors of this processor.
namespace slambench {

/// A point of the model and its normal side by side, so that a lane finds both in one place.
struct ModelPoint {
  Float3 vertex;
  float normal_x = invalid_normal;
  float normal_y = 0, normal_z = 0, unused[2] = {};
};
static_assert(sizeof(ModelPoint) == 32);

/// The pointers of one call of track.
struct TrackInput {
  const Float3* vertices = nullptr;
  const Float3* normals = nullptr;
  Size size;
  const Float3* model_vertices = nullptr;
  const Float3* model_normals = nullptr;
  const ModelPoint* model = nullptr;  ///< the same, where it pays to have them so
  Size model_size;
  TrackParameters parameters;
};

/// Sums of a reduction are kept for so many rows, then added in the order of the rows: the result
/// is the same for every number of threads. Within a band, pixels are summed in single precision
/// over 16 lanes whatever the machine's vectors (and fused multiply-adds where it has them).
inline constexpr int band_rows = 4;

/// Puts points and normals of rows [begin, end) together.
void pack_model_rows(ModelPoint* model, const Float3* vertices, const Float3* normals, Size size,
                     Rows rows);
void track_rows(TrackData* track, const TrackInput& input, Rows rows);
/// The sums over a band.
Reduction reduce_band(const TrackData* track, Size size, Rows rows);
/// reduce_band of what track_rows would have written.
Reduction track_reduce_band(const TrackInput& input, Rows rows);

/// Adds a band's sums.
void add(const Reduction& band, Reduction* sum);

}  // namespace slambench
