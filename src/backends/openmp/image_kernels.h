// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>

#include "kernels/pixel.h"

/// The image kernels over rows [y0, y1), on the widest vectors of this processor. Pointers are to
/// whole images.
namespace slambench {

/// The rows of an image that one call writes.
struct Rows {
  int begin = 0, end = 0;
};

/// Highway's name of what these and all other kernels of this backend were chosen for here.
std::string kernels_instruction_set();

void mm2meters_rows(float* depth_m, Size size, const std::uint16_t* depth, int ratio,
                    float units_per_m, Rows rows);
/// exp within 2 units in the last place, else as slambench::bilateral.
void bilateral_rows(float* filtered_m, const float* depth_m, Size size, const float* gaussian,
                    int radius, float inverse_two_sigma2, Rows rows);
void half_sample_rows(float* half_m, Size half, const float* depth_m, Size size, float range_m,
                      Rows rows);
void depth2vertex_rows(Float3* vertices, const float* depth_m, Size size, Intrinsics camera,
                       Rows rows);
void vertex2normal_rows(Float3* normals, const Float3* vertices, Size size, Rows rows);
void render_depth_rows(Rgba8* image, const float* depth_m, Size size, float near_m, float far_m,
                       Rows rows);
void render_track_rows(Rgba8* image, const TrackData* track, Size size, Rows rows);

}  // namespace slambench
