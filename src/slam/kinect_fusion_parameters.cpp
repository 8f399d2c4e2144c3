// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "slam/kinect_fusion.h"

namespace slambench {

ParameterList KinectFusionParameters::describe() {
  std::vector<std::string_view> maps = {"auto"};
  for (const MapInfo& info : map_table()) maps.push_back(info.name);
  return {
      "kinectfusion",
      {
          {"map", 0, "", &map, 0, 0, "how the volume is stored; auto: as the backend is quickest",
           maps, ParameterRole::implementation},
          {"compute-size-ratio", 'c', "", &compute_size_ratio, 1, 8,
           "input size divided by computation size; divides width and height"},
          {"volume-resolution", 'v', "voxels", &volume_resolution, 8, 4096,
           "voxels along each axis"},
          {"volume-size", 's', "m", &volume_size_m, 0.01, 1000, "edges of the volume"},
          {"init-pose", 'p', "", &init_pose, 0, 1,
           "start of the camera in the volume, as factors of its size"},
          {"mu", 'm', "m", &mu_m, 1e-4, 10, "truncation band of the signed distance"},
          {"tracking-rate", 't', "frames", &tracking_rate, 1, 1000000,
           "track every so many frames"},
          {"integration-rate", 'r', "frames", &integration_rate, 1, 1000000,
           "integrate every so many frames"},
          {"rendering-rate", 'z', "frames", &rendering_rate, 1, 1000000,
           "draw the volume every so many frames"},
          {"pyramid-levels", 'y', "", &pyramid_levels, 0, 1000,
           "most iterations of the alignment per level, finest level first"},
          {"icp-threshold", 'l', "", &icp_threshold, 0, 1,
           "a level ends when the update's norm is below this"},
          {"icp-distance-threshold", 0, "m", &icp_distance_threshold_m, 0, 10,
           "points further from the model than this are no pair"},
          {"icp-normal-threshold", 0, "", &icp_normal_threshold, -1, 1,
           "least dot product of the normals of a pair"},
          {"tracked-fraction", 0, "", &tracked_fraction, 0, 1,
           "tracking is lost when a smaller part of the pixels is paired"},
          {"tracked-residual", 0, "m", &tracked_residual_m, 0, 10,
           "tracking is lost when the root mean square error is larger"},
          {"solve-condition", 0, "", &solve_condition, 1, 1e15,
           "singular values smaller than the largest by this factor count as zero"},
          {"bootstrap-frames", 0, "frames", &bootstrap_frames, 1, 1000000,
           "first frames that are integrated at the start pose, untracked"},
          {"bilateral-radius", 0, "px", &bilateral_radius_px, 0, 16,
           "radius of the bilateral filter"},
          {"bilateral-sigma", 0, "px", &bilateral_sigma_px, 1e-3, 1000,
           "spatial standard deviation of the bilateral filter"},
          {"bilateral-range-sigma", 0, "m", &bilateral_range_sigma_m, 1e-4, 1000,
           "depth standard deviation of the bilateral filter"},
          {"half-sample-range", 0, "m", &half_sample_range_m, 0, 1000,
           "depths this close are averaged when the image is halved"},
          {"near", 0, "m", &near_m, 0, 1000, "nearest depth that rays see"},
          {"far", 0, "m", &far_m, 0, 1000, "farthest depth that rays see"},
          {"max-weight", 0, "", &max_weight, 1, 32767,
           "most measurements that a voxel's average counts"},
          {"integrate-min-depth", 0, "m", &integrate_min_depth_m, 0, 1000,
           "voxels nearer to the camera's plane are left alone"},
          {"raycast-large-step", 0, "mu", &raycast_large_step, 1e-3, 10,
           "step along a ray far from surfaces"},
          {"raycast-small-step", 0, "", &raycast_small_step, 1e-3, 10,
           "step close to surfaces, in smallest volume size / largest resolution"},
          {"raycast-slow-below", 0, "mu", &raycast_slow_below, -1, 1,
           "a ray goes on in small steps once the distance is below this"},
          {"render-far-factor", 0, "", &render_far_factor, 1e-3, 1000,
           "how much farther than for tracking rays see when the volume is drawn"},
          {"light", 0, "m", &light_m, -1000, 1000,
           "position of the light when the volume is drawn: x right, y down, z forward"},
          {"light-frame",
           0,
           "",
           &light_frame,
           0,
           0,
           "what that is relative to: the camera, or the corner of the volume",
           {"camera", "volume"}},
          {"ambient", 0, "", &ambient, 0, 1, "brightness of surfaces turned away from the light"},
          {"fused",
           0,
           "",
           &fused,
           0,
           0,
           "kernels share work where the backend can: the alignment runs as one, a tracked frame "
           "is "
           "computed with a single wait, and the volume is drawn from the raycast of the same view "
           "instead of casting its rays again",
           {},
           ParameterRole::implementation},
      },
  };
}

}  // namespace slambench
