// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>

#include "core/image.h"
#include "kernels/types.h"

/// The per-pixel maths of the image kernels, shared by host and device code. Images are row-major;
/// coordinates are in range unless said otherwise.
namespace slambench {

SLAMBENCH_HD inline int clamp_index(int i, int count) {
  return i < 0 ? 0 : (i >= count ? count - 1 : i);
}

SLAMBENCH_HD inline float meters_from_units(std::uint16_t depth, float units_per_m) {
  return static_cast<float>(depth) / units_per_m;
}

/// The spatial weight exp(-i^2 / (2 sigma^2)) of a neighbour i pixels away; sigma in pixels.
SLAMBENCH_HD inline float gaussian_weight(int i, float sigma_px) {
  return expf(-static_cast<float>(i * i) / (2.0f * sigma_px * sigma_px));
}

/// Bilateral filter (Tomasi & Manduchi 1998) at one pixel. 0 stays 0, neighbours of 0 do not
/// count, coordinates are clamped to the border. `gaussian` has 2 radius + 1 weights;
/// `inverse_two_sigma2` is 1 / (2 range_sigma^2), 1/m^2.
SLAMBENCH_HD inline float bilateral(const float* depth_m, Size size, int x, int y,
                                    const float* gaussian, int radius, float inverse_two_sigma2) {
  const float center = depth_m[y * size.width + x];
  if (!(center > 0.0f)) return 0.0f;
  float sum = 0.0f, weights = 0.0f;
  for (int dy = -radius; dy <= radius; ++dy) {
    const float* row = depth_m + clamp_index(y + dy, size.height) * size.width;
    for (int dx = -radius; dx <= radius; ++dx) {
      const float neighbour = row[clamp_index(x + dx, size.width)];
      if (!(neighbour > 0.0f)) continue;
      const float difference = neighbour - center;
      const float weight = gaussian[dx + radius] * gaussian[dy + radius] *
                           expf(-difference * difference * inverse_two_sigma2);
      sum += weight * neighbour;
      weights += weight;
    }
  }
  return sum / weights;
}

/// The mean of those values of the 2x2 block above pixel (x, y) of the smaller image that lie
/// within range_m of the block's first (top left) value, invalid zeros included as values.
SLAMBENCH_HD inline float half_sampled(const float* depth_m, Size size, int x, int y,
                                       float range_m) {
  const float* block = depth_m + 2 * y * size.width + 2 * x;
  const float first = block[0];
  float sum = 0.0f, count = 0.0f;
  for (int dy = 0; dy < 2; ++dy) {
    for (int dx = 0; dx < 2; ++dx) {
      const float value = block[dy * size.width + dx];
      if (fabsf(value - first) <= range_m) {
        sum += value;
        count += 1.0f;
      }
    }
  }
  return count > 0.0f ? sum / count : 0.0f;  // count is 0 when the first value is NaN
}

/// The direction of depth 1 through pixel (x, y).
SLAMBENCH_HD inline Float3 pixel_ray(Intrinsics camera, int x, int y) {
  return {(static_cast<float>(x) - camera.cx) / camera.fx,
          (static_cast<float>(y) - camera.cy) / camera.fy, 1.0f};
}

/// The camera-frame point of a pixel; zero where there is no depth.
SLAMBENCH_HD inline Float3 vertex_from_depth(float depth_m, Intrinsics camera, int x, int y) {
  if (!(depth_m > 0.0f)) return {};
  return pixel_ray(camera, x, y) * depth_m;
}

/// The normal from the four clamped neighbours, toward the camera; x = invalid_normal where one
/// of them has no depth or the cross product vanishes.
SLAMBENCH_HD inline Float3 normal_from_vertices(const Float3* vertices, Size size, int x, int y) {
  const Float3* row = vertices + y * size.width;
  const Float3 left = row[clamp_index(x - 1, size.width)];
  const Float3 right = row[clamp_index(x + 1, size.width)];
  const Float3 up = vertices[clamp_index(y - 1, size.height) * size.width + x];
  const Float3 down = vertices[clamp_index(y + 1, size.height) * size.width + x];
  if (left.z == 0.0f || right.z == 0.0f || up.z == 0.0f || down.z == 0.0f) {
    return {invalid_normal, 0.0f, 0.0f};
  }
  const Float3 normal = cross(down - up, right - left);
  if (!(length(normal) > 0.0f)) return {invalid_normal, 0.0f, 0.0f};
  return normalized(normal);
}

/// Where a camera-frame point falls in an image: rounded to the nearest pixel. False when it is
/// not in front of the camera or outside the image.
SLAMBENCH_HD inline bool project(Float3 point, Intrinsics camera, Size size, float min_depth,
                                 int* x, int* y) {
  if (!(point.z >= min_depth)) return false;
  const float u = camera.fx * point.x / point.z + camera.cx + 0.5f;
  const float v = camera.fy * point.y / point.z + camera.cy + 0.5f;
  if (!(u >= 0.0f && u <= static_cast<float>(size.width - 1) && v >= 0.0f &&
        v <= static_cast<float>(size.height - 1))) {
    return false;
  }
  *x = static_cast<int>(u);
  *y = static_cast<int>(v);
  return true;
}

/// Points nearer to the model camera's plane than this do not project (a point in the plane itself
/// has no image).
inline constexpr float min_projection_depth_m = 1e-6f;

/// Projective data association and the point-to-plane row (Newcombe et al. 2011, eq. 16 to 23) of
/// one live point against the model maps of size `model_size`.
SLAMBENCH_HD inline TrackData track_point(Float3 vertex, Float3 normal,
                                          const Float3* model_vertices, const Float3* model_normals,
                                          Size model_size, const TrackParameters& p) {
  TrackData row;
  if (normal.x == invalid_normal) return row;

  const Float3 point = p.T_volume_camera.apply(vertex);
  int x = 0, y = 0;
  if (!project(p.T_model_volume.apply(point), p.model_camera, model_size, min_projection_depth_m,
               &x, &y)) {
    row.outcome = TrackOutcome::outside_model;
    return row;
  }
  const int pixel = y * model_size.width + x;
  const Float3 model_normal = model_normals[pixel];
  if (model_normal.x == invalid_normal) {
    row.outcome = TrackOutcome::invalid_model;
    return row;
  }
  const Float3 difference = model_vertices[pixel] - point;
  if (!(length(difference) <= p.distance_threshold_m)) {
    row.outcome = TrackOutcome::too_far;
    return row;
  }
  if (!(dot(p.T_volume_camera.rotate(normal), model_normal) >= p.normal_threshold)) {
    row.outcome = TrackOutcome::wrong_normal;
    return row;
  }
  const Float3 moment = cross(point, model_normal);
  row.outcome = TrackOutcome::ok;
  row.error = dot(model_normal, difference);
  row.jacobian[0] = model_normal.x;
  row.jacobian[1] = model_normal.y;
  row.jacobian[2] = model_normal.z;
  row.jacobian[3] = moment.x;
  row.jacobian[4] = moment.y;
  row.jacobian[5] = moment.z;
  return row;
}

/// Adds one pixel's row to the sums.
SLAMBENCH_HD inline void accumulate(const TrackData& row, Reduction* sum) {
  switch (row.outcome) {
    case TrackOutcome::ok:
      break;
    case TrackOutcome::too_far:
      ++sum->too_far;
      return;
    case TrackOutcome::wrong_normal:
      ++sum->wrong_normal;
      return;
    default:
      ++sum->others;
      return;
  }
  ++sum->inliers;
  sum->squared_error += static_cast<double>(row.error * row.error);
  double* entry = sum->jt_j;
  for (int i = 0; i < 6; ++i) {
    sum->jt_error[i] += static_cast<double>(row.error * row.jacobian[i]);
    for (int j = i; j < 6; ++j) {
      *entry++ += static_cast<double>(row.jacobian[i] * row.jacobian[j]);
    }
  }
}

/// White nearer than near_m (and where there is no depth), black beyond far_m, a ramp of hues
/// from red over green to blue between.
SLAMBENCH_HD inline Rgba8 depth_color(float depth_m, float near_m, float far_m) {
  if (!(depth_m >= near_m)) return {255, 255, 255, 255};
  if (depth_m > far_m) return {0, 0, 0, 255};
  const float hue = (depth_m - near_m) / (far_m - near_m) * 4.0f;  // four of the circle's sextants
  const int sextant = hue >= 4.0f ? 3 : static_cast<int>(hue);
  const float rising = hue - static_cast<float>(sextant);
  constexpr float low = 64.0f, high = 191.0f;
  const auto up = static_cast<std::uint8_t>(low + (high - low) * rising + 0.5f);
  const auto down = static_cast<std::uint8_t>(high - (high - low) * rising + 0.5f);
  constexpr auto lo = static_cast<std::uint8_t>(low);
  constexpr auto hi = static_cast<std::uint8_t>(high);
  switch (sextant) {
    case 0:
      return {hi, up, lo, 255};
    case 1:
      return {down, hi, lo, 255};
    case 2:
      return {lo, hi, up, 255};
    default:
      return {lo, down, hi, 255};
  }
}

/// The published colours: grey ok, black no input, red outside, green no model, blue too far,
/// yellow wrong normal.
SLAMBENCH_HD inline Rgba8 track_color(TrackOutcome outcome) {
  switch (outcome) {
    case TrackOutcome::ok:
      return {128, 128, 128, 255};
    case TrackOutcome::invalid_input:
      return {0, 0, 0, 255};
    case TrackOutcome::outside_model:
      return {255, 0, 0, 255};
    case TrackOutcome::invalid_model:
      return {0, 255, 0, 255};
    case TrackOutcome::too_far:
      return {0, 0, 255, 255};
    case TrackOutcome::wrong_normal:
      return {255, 255, 0, 255};
  }
  return {255, 128, 128, 255};
}

}  // namespace slambench
