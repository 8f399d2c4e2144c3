// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include "backends/cuda/device_maths.h"
#include "kernels/pixel.h"
#include "kernels/volume_maths.h"

/// The kernels that compute every element of an image by itself: function objects that hold the
/// pointers of one call; (x, y) is a pixel of the destination.
namespace slambench::cuda {

struct GenerateGaussian {
  float* weights;
  int radius;
  float sigma_px;
  SLAMBENCH_HD void operator()(int x, int) const {
    weights[x] = gaussian_weight(x - radius, sigma_px);
  }
};

struct MetersFromUnits {
  float* depth_m;
  Size size;
  const std::uint16_t* depth;
  int ratio;
  float units_per_m;
  SLAMBENCH_HD void operator()(int x, int y) const {
    const int input_width = size.width * ratio;
    depth_m[pixel_index(size, x, y)] =
        meters_from_units(depth[y * ratio * input_width + x * ratio], units_per_m);
  }
};

struct BilateralFilter {
  float* filtered_m;
  const float* depth_m;
  Size size;
  const float* gaussian;
  int radius;
  float inverse_two_sigma2;
  SLAMBENCH_HD void operator()(int x, int y) const {
    filtered_m[pixel_index(size, x, y)] =
        bilateral(depth_m, size, x, y, gaussian, radius, inverse_two_sigma2);
  }
};

struct HalfSample {
  float* half_m;
  Size half;
  const float* depth_m;
  Size size;
  float range_m;
  SLAMBENCH_HD void operator()(int x, int y) const {
    half_m[pixel_index(half, x, y)] = half_sampled(depth_m, size, x, y, range_m);
  }
};

struct VertexFromDepth {
  Float3* vertices;
  const float* depth_m;
  Size size;
  Intrinsics camera;
  SLAMBENCH_HD void operator()(int x, int y) const {
    const int i = pixel_index(size, x, y);
    vertices[i] = vertex_from_depth(depth_m[i], camera, x, y);
  }
};

struct NormalFromVertices {
  Float3* normals;
  const Float3* vertices;
  Size size;
  SLAMBENCH_HD void operator()(int x, int y) const {
    normals[pixel_index(size, x, y)] = normal_from_vertices(vertices, size, x, y);
  }
};

struct Track {
  TrackData* rows;
  const Float3* vertices;
  const Float3* normals;
  Size size;
  const Float3* model_vertices;
  const Float3* model_normals;
  Size model_size;
  TrackParameters parameters;
  SLAMBENCH_HD void operator()(int x, int y) const {
    const int i = pixel_index(size, x, y);
    rows[i] =
        track_point(vertices[i], normals[i], model_vertices, model_normals, model_size, parameters);
  }
};

struct RenderDepth {
  Rgba8* image;
  const float* depth_m;
  Size size;
  float near_m, far_m;
  SLAMBENCH_HD void operator()(int x, int y) const {
    const int i = pixel_index(size, x, y);
    image[i] = depth_color(depth_m[i], near_m, far_m);
  }
};

struct RenderTrack {
  Rgba8* image;
  const TrackData* rows;
  Size size;
  SLAMBENCH_HD void operator()(int x, int y) const {
    const int i = pixel_index(size, x, y);
    image[i] = track_color(rows[i].outcome);
  }
};

}  // namespace slambench::cuda
