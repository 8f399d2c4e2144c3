// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// The structs of src/kernels/types.h, byte for byte. What comes before every kernel, in which order,
// stands in program.cpp (`shared`).

#pragma OPENCL FP_CONTRACT OFF

// Every function becomes part of its kernel: a compiler for processors may else call it, with all
// vectors and parameters through memory.
#define INLINE inline __attribute__((always_inline))
// Before a loop over a few vectors in an array, which are then kept in registers.
#define UNROLL _Pragma("unroll")

typedef struct { int width, height; } Size;
typedef struct { int x, y, z; } Int3;
typedef struct { float x, y, z; } Float3;
typedef struct { float fx, fy, cx, cy; } Intrinsics;
typedef struct { Float3 row0, row1, row2, translation; } Rigid3f;

typedef struct {
  Rigid3f T_volume_camera, T_model_volume;
  Intrinsics model_camera;
  float distance_threshold_m, normal_threshold;
} TrackParameters;

typedef struct {
  Rigid3f T_camera_volume;
  Intrinsics camera;
  float mu_m, max_weight, min_depth_m;
} IntegrateParameters;

typedef struct {
  Rigid3f T_volume_camera;
  Intrinsics camera;
  float near_m, far_m, large_step_m, small_step_m, slow_below;
} RaycastParameters;

typedef struct {
  Float3 light_m;
  float ambient;
} ShadeParameters;

// A TrackData is eight 32-bit words: outcome, error, jacobian[6].
#define TRACK_WORDS 8
#define OK 1
#define INVALID_INPUT -1
#define OUTSIDE_MODEL -2
#define INVALID_MODEL -3
#define TOO_FAR -4
#define WRONG_NORMAL -5

#define INVALID_NORMAL -2.0f
#define TSDF_SCALE 32766.0f
#define FREE_SPACE 32766
