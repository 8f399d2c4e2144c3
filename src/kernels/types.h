// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>
#include <type_traits>

#include "core/intrinsics.h"
#include "kernels/float3.h"

namespace slambench {

/// The x of a normal that does not exist.
inline constexpr float invalid_normal = -2.0f;

/// One voxel: the truncated signed distance x 32766, rounded toward zero (+ in free space, - behind
/// the surface), and the number of measurements it averages. A fresh voxel is {32766, 0}.
struct Voxel {
  std::int16_t tsdf = 32766;
  std::int16_t weight = 0;
  friend bool operator==(const Voxel&, const Voxel&) = default;
};
inline constexpr float tsdf_scale = 32766.0f;

/// How the ICP judged a pixel. The values are the published ones.
enum class TrackOutcome : std::int32_t {
  ok = 1,
  invalid_input = -1,  ///< no normal in the live frame
  outside_model = -2,  ///< projects outside the model's view
  invalid_model = -3,  ///< no normal in the model there
  too_far = -4,        ///< further from the model than the distance threshold
  wrong_normal = -5,   ///< normals differ by more than the threshold
};

/// A pixel's row of the point-to-plane system; `error` (m) and `jacobian` hold only when `ok`.
struct TrackData {
  TrackOutcome outcome = TrackOutcome::invalid_input;
  float error = 0;
  float jacobian[6] = {};
};
static_assert(sizeof(Voxel) == 4 && sizeof(TrackData) == 32 && sizeof(Float3) == 12);
static_assert(std::is_trivially_copyable_v<TrackData>);

/// The sums of the point-to-plane system over the pixels with outcome `ok`, and how many had which
/// outcome. The same shape on every backend; sums are accumulated in an order the backend fixes.
struct Reduction {
  double squared_error = 0;  ///< sum of error^2, m^2
  double jt_error[6] = {};   ///< sum of error J
  double jt_j[21] = {};      ///< sum of the upper triangle of J^T J, row by row
  std::int64_t inliers = 0;
  std::int64_t too_far = 0;
  std::int64_t wrong_normal = 0;
  std::int64_t others = 0;  ///< invalid input, outside the model, invalid model
};

/// A small motion: translation (m), then rotation (rad), in volume axes.
struct Twist {
  double v[6] = {};
};

struct TrackParameters {
  Rigid3f T_volume_camera;  ///< the current estimate
  Rigid3f T_model_volume;   ///< inverse of the pose the model was raycast from
  Intrinsics model_camera;  ///< of the model maps, whatever level the live maps are
  float distance_threshold_m = 0;
  float normal_threshold = 0;  ///< least dot product of the two normals
};

struct IntegrateParameters {
  Rigid3f T_camera_volume;
  Intrinsics camera;
  float mu_m = 0;
  float max_weight = 0;
  float min_depth_m = 0;  ///< voxels nearer to the camera plane are left alone
};

struct RaycastParameters {
  Rigid3f T_volume_camera;
  Intrinsics camera;
  float near_m = 0, far_m = 0;  ///< in camera depth, as rays are not normalised
  float large_step_m = 0;       ///< while the distance is at least slow_below
  float small_step_m = 0;
  float slow_below = 0;  ///< truncated distance, in units of mu
};

struct ShadeParameters {
  Float3 light_m;  ///< position of the light in the volume's axes
  float ambient = 0;
};

}  // namespace slambench
