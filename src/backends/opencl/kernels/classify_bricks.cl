// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// What a measurement does to a brick, from its eight corners: between them the projection is
// convex. Tolerances make up for the rounding of single voxels.
#define NONE 0    // no voxel is measured
#define FREE 1    // every voxel is measured as free space, a truncated distance of 1
#define VARIED 2  // every voxel has to be looked at

INLINE int change_of(float8 x, float8 y, float8 z, global const float2* ranges, Size tiles,
                     Size size, IntegrateParameters p, float tolerance_m) {
  const float near_m = least_of(z), far_m = greatest_of(z);
  if (far_m < p.min_depth_m - tolerance_m) return NONE;
  if (near_m < p.min_depth_m + tolerance_m) return VARIED;
  const float8 u = p.camera.fx * x / z + p.camera.cx + 0.5f;
  const float8 v = p.camera.fy * y / z + p.camera.cy + 0.5f;
  const float tolerance_px =
      1e-3f + fmax(fabs(p.camera.fx), fabs(p.camera.fy)) * tolerance_m / near_m;
  const float u0 = least_of(u) - tolerance_px, u1 = greatest_of(u) + tolerance_px;
  const float v0 = least_of(v) - tolerance_px, v1 = greatest_of(v) + tolerance_px;
  const float last_x = (float)(size.width - 1), last_y = (float)(size.height - 1);
  if (!(u1 >= 0 && v1 >= 0 && u0 <= last_x && v0 <= last_y)) return NONE;
  const int whole = u0 >= 0 && v0 >= 0 && u1 <= last_x && v1 <= last_y;
  const int tx0 = (int)(fmax(0.0f, u0)) / TILE, tx1 = (int)(fmin(last_x, u1)) / TILE;
  const int ty0 = (int)(fmax(0.0f, v0)) / TILE, ty1 = (int)(fmin(last_y, v1)) / TILE;
  float least = INFINITY, greatest = 0.0f;
  for (int ty = ty0; ty <= ty1; ++ty) {
    for (int tx = tx0; tx <= tx1; ++tx) {
      const float2 range = ranges[ty * tiles.width + tx];
      least = fmin(least, range.x);
      greatest = fmax(greatest, range.y);
    }
  }
  // A distance along the ray is at least the one along the axis, which these compare.
  if (greatest - near_m < -p.mu_m - tolerance_m) return NONE;
  if (whole && least - far_m > p.mu_m + tolerance_m) return FREE;
  return VARIED;
}

INLINE float dot1(Float3 row, float x, float y, float z) {
  return row.x * x + row.y * y + row.z * z;
}

// Counts a measurement of bricks found in free space that own no plane, and lists the bricks that
// have to be looked at (counters[2] is their number).
KERNEL classify_bricks(global int* varied, global int* counters, global const int* distance_planes,
                       global int* weight_planes, Int3 bricks, Float3 voxel_m,
                       global const float2* ranges, Size tiles, Size size, IntegrateParameters p,
                       float tolerance_m) {
  FOR_PACKETS(brick, bricks.x * bricks.y * bricks.z) {
    const Int3 at = brick_position(brick, bricks);
    const Rigid3f t = p.T_camera_volume;
    const float x0 = (at.x * EDGE + 0.5f) * voxel_m.x, y0 = (at.y * EDGE + 0.5f) * voxel_m.y;
    const float z0 = (at.z * EDGE + 0.5f) * voxel_m.z;
    const float last = EDGE - 1;
    const float8 dx = (float8)(0, 1, 0, 1, 0, 1, 0, 1) * (last * voxel_m.x);
    const float8 dy = (float8)(0, 0, 1, 1, 0, 0, 1, 1) * (last * voxel_m.y);
    const float8 dz = (float8)(0, 0, 0, 0, 1, 1, 1, 1) * (last * voxel_m.z);
    const float8 z = dot1(t.row2, x0, y0, z0) + t.translation.z + t.row2.x * dx + t.row2.y * dy +
                     t.row2.z * dz;
    if (greatest_of(z) < p.min_depth_m - tolerance_m) continue;
    const float8 x = dot1(t.row0, x0, y0, z0) + t.translation.x + t.row0.x * dx + t.row0.y * dy +
                     t.row0.z * dz;
    const float8 y = dot1(t.row1, x0, y0, z0) + t.translation.y + t.row1.x * dx + t.row1.y * dy +
                     t.row1.z * dz;
    const int change = change_of(x, y, z, ranges, tiles, size, p, tolerance_m);
    if (change == NONE) continue;
    const int weight = weight_planes[brick];
    if (change == FREE && distance_planes[brick] == 0 && weight < 0) {
      weight_planes[brick] = -1 - (int)(fmin((float)(-1 - weight) + 1.0f, p.max_weight));
    } else {
      varied[atomic_inc(&counters[2])] = brick;
    }
  }
}
