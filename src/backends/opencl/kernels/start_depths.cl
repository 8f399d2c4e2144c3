// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// Per tile of a view, a depth before which every sample of the volume is +1: the least depth of
// the bricks with distances of their own, projected into the image. Depths are kept as the bits of
// floats that are not negative, which are in the order of the integers.

// Work-items of the group share the tiles.
#if GROUP == 1
#define LOWER(p, v) (*(p) = min(*(p), v))
#else
#define LOWER(p, v) atomic_min(p, v)
#endif

// Samples that read a brick lie up to a voxel beside it, at the volume's border anywhere beyond its
// last voxels' centres, and a little more for rounding.
#define MARGIN 1.01f

// The eight corners along one axis of the box around a brick, in the camera's axes.
INLINE float8 corners_along(int brick, int n, float voxel_m, float8 upper) {
  const float low = (brick * EDGE - MARGIN + 0.5f) * voxel_m;
  const float high = (min(n, brick * EDGE + EDGE) + MARGIN - 0.5f) * voxel_m;
  return low + upper * (high - low);
}

INLINE void mark(local int* tiles, Size count, int tile, float8 x, float8 y, float8 z, Size size,
                 RaycastParameters view) {
  const float least = least_of(z);
  const float8 uz = view.camera.fx * x + view.camera.cx * z;
  const float8 vz = view.camera.fy * y + view.camera.cy * z;
  if (greatest_of(z) < view.near_m || greatest_of(uz + z) < 0 || greatest_of(vz + z) < 0 ||
      least_of(uz - size.width * z) > 0 || least_of(vz - size.height * z) > 0) {
    return;
  }
  int tx0 = 0, ty0 = 0, tx1 = count.width - 1, ty1 = count.height - 1, depth = 0;
  if (least >= 1e-3f) {  // else its image is not bounded
    const float8 u = uz / z, v = vz / z;
    // Half a pixel would do; one makes up for rounding.
    const float u0 = least_of(u) - 1.0f, u1 = greatest_of(u) + 1.0f;
    const float v0 = least_of(v) - 1.0f, v1 = greatest_of(v) + 1.0f;
    tx0 = min(tx1, (int)(clamp(u0, 0.0f, (float)(size.width))) / tile);
    ty0 = min(ty1, (int)(clamp(v0, 0.0f, (float)(size.height))) / tile);
    tx1 = min(tx1, (int)(clamp(u1, 0.0f, (float)(size.width))) / tile);
    ty1 = min(ty1, (int)(clamp(v1, 0.0f, (float)(size.height))) / tile);
    depth = as_int(least);
  }
  for (int ty = ty0; ty <= ty1; ++ty) {
    for (int tx = tx0; tx <= tx1; ++tx) LOWER(&tiles[ty * count.width + tx], depth);
  }
}

KERNEL start_depths(global int* tiles, Size count, int tile, global const int* owners,
                    global const int* counters, Int3 n, Int3 bricks, Float3 voxel_m, Size size,
                    RaycastParameters view) {
  local int own_tiles[MOST_TILES];
  const int tile_count = count.width * count.height;
  const int infinite = as_int(INFINITY);
  for (int i = get_local_id(0); i < tile_count; i += GROUP) own_tiles[i] = infinite;
  barrier(CLK_LOCAL_MEM_FENCE);
  const Rigid3f t = view.T_volume_camera;
  const int planes = counters[0];
  for (int plane = 1 + get_global_id(0); plane < planes; plane += get_global_size(0)) {
    const Int3 at = brick_position(owners[plane], bricks);
    const float8 vx = corners_along(at.x, n.x, voxel_m.x,
                                    (float8)(0, 1, 0, 1, 0, 1, 0, 1)) - t.translation.x;
    const float8 vy = corners_along(at.y, n.y, voxel_m.y,
                                    (float8)(0, 0, 1, 1, 0, 0, 1, 1)) - t.translation.y;
    const float8 vz = corners_along(at.z, n.z, voxel_m.z,
                                    (float8)(0, 0, 0, 0, 1, 1, 1, 1)) - t.translation.z;
    mark(own_tiles, count, tile, t.row0.x * vx + t.row1.x * vy + t.row2.x * vz,
         t.row0.y * vx + t.row1.y * vy + t.row2.y * vz,
         t.row0.z * vx + t.row1.z * vy + t.row2.z * vz, size, view);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  for (int i = get_local_id(0); i < tile_count; i += GROUP) {
    if (own_tiles[i] != infinite) atomic_min(&tiles[i], own_tiles[i]);
  }
}
