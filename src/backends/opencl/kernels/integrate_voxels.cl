// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// slambench::integrate_voxel: what distance and weight of the voxels with these centres (camera
// frame) become.
INLINE void integrate_lanes(Vec3 center, global const float* depth_m, Size size,
                            IntegrateParameters p, Ints* tsdf, Ints* weight) {
  const Floats one = (Floats)(1.0f);
  Ints x, y;
  const Ints inside = project(center, p.camera, size, p.min_depth_m, &x, &y);
  if (!any_lane(inside)) return;
  const Floats depth = gather_floats(depth_m, y * size.width + x);
  const Floats slope_x = center.x / center.z, slope_y = center.y / center.z;
  const Floats distance =
      (depth - center.z) * sqrt(1.0f + slope_x * slope_x + slope_y * slope_y);
  const Ints measured = inside & (depth > 0.0f) & (distance > -p.mu_m);

  const Floats sdf = fmin(one, distance / p.mu_m);
  const Floats count = TO_FLOATS(*weight), more = count + 1.0f;
  const Floats old = TO_FLOATS(*tsdf) * (1.0f / TSDF_SCALE);
  const Floats mean = (count * old + sdf) / more;
  const Ints stored = TO_INTS(fmax(-one, fmin(one, mean)) * TSDF_SCALE);
  *tsdf = measured ? stored : *tsdf;
  *weight = measured ? TO_INTS(fmin(more, (Floats)(p.max_weight))) : *weight;
}

INLINE Floats center_axis(Ints i, float voxel_m) { return (TO_FLOATS(i) + 0.5f) * voxel_m; }
