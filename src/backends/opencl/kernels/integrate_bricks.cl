// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// A group updates one brick of the list. A brick whose distances are all +1 keeps no plane of them,
// one whose weights are all equal keeps that number (-1 - weight) instead of a plane.
// counters[0] and [1]: planes of distances and of weights in use.

// A packet of voxels from index i of a plane on. Planes and packets begin at multiples of their size:
// compilers store vectors of shorts of which they do not know that one by one.
#define PACKET(plane, i) ((global Shorts*)(plane))[(i) / LANES]

// A new plane for a brick's distances; samples whose lower corner lies in it or below see it.
INLINE int take_plane(int brick, Int3 bricks, global int* counters, global int* planes,
                      global int* owners, global uchar* occupied) {
  const int plane = atomic_inc(&counters[0]);
  planes[brick] = plane;
  owners[plane] = brick;
  const Int3 at = brick_position(brick, bricks);
  for (int z = max(0, at.z - 1); z <= at.z; ++z) {
    for (int y = max(0, at.y - 1); y <= at.y; ++y) {
      for (int x = max(0, at.x - 1); x <= at.x; ++x) occupied[(z * bricks.y + y) * bricks.x + x] = 1;
    }
  }
  return plane;
}

KERNEL integrate_bricks(global const int* varied, global int* counters,
                        global int* distance_planes, global int* weight_planes,
                        global short* distances, global short* weights, global int* owners,
                        global uchar* occupied, Int3 bricks, Float3 voxel_m,
                        global const float* depth_m, Size size, IntegrateParameters p) {
  local Shorts new_tsdf[BRICK_VOXELS / LANES], new_weights[BRICK_VOXELS / LANES];
  local int differs, changed, least_weight, greatest_weight, plane_of_tsdf, plane_of_weights;
  const int brick = varied[get_group_id(0)];
  const Int3 at = brick_position(brick, bricks);
  const int first_x = at.x * EDGE, first_y = at.y * EDGE, first_z = at.z * EDGE;
  if (get_local_id(0) == 0) {  // alone reads and writes the tables
    plane_of_tsdf = distance_planes[brick];
    plane_of_weights = weight_planes[brick];
    differs = changed = greatest_weight = 0;
    least_weight = INT_MAX;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  const int plane = plane_of_tsdf, weight_plane = plane_of_weights;
  global const short* old_tsdfs = distances + plane * BRICK_VOXELS;
  global const short* old_weights = weights + max(0, weight_plane) * BRICK_VOXELS;

  Ints any_differs = (Ints)(0), any_changed = (Ints)(0);
  Ints least = (Ints)(INT_MAX), greatest = (Ints)(0);
  for (int i = get_local_id(0) * LANES; i < BRICK_VOXELS; i += GROUP * LANES) {
    const Ints voxel = i + IOTA;
    const Vec3 center = apply(
        p.T_camera_volume, vec3(center_axis(first_x + (voxel & 7), voxel_m.x),
                                center_axis(first_y + (voxel >> 3 & 7), voxel_m.y),
                                center_axis(first_z + (voxel >> 6), voxel_m.z)));
    const Ints old_tsdf = TO_INTS(PACKET(old_tsdfs, i));
    Ints old_weight = (Ints)(-1 - weight_plane);
    if (weight_plane >= 0) old_weight = TO_INTS(PACKET(old_weights, i));
    Ints tsdf = old_tsdf, weight = old_weight;
    integrate_lanes(center, depth_m, size, p, &tsdf, &weight);
    any_changed |= (tsdf ^ old_tsdf) | (weight ^ old_weight);
    any_differs |= tsdf ^ FREE_SPACE;
    least = min(least, weight);
    greatest = max(greatest, weight);
    new_tsdf[i / LANES] = TO_SHORTS(tsdf);
    new_weights[i / LANES] = TO_SHORTS(weight);
  }
  if (any_lane(any_changed)) atomic_or(&changed, 1);
  if (any_lane(any_differs)) atomic_or(&differs, 1);
  atomic_min(&least_weight, LEAST_OF_LANES(least));
  atomic_max(&greatest_weight, GREATEST_OF_LANES(greatest));
  barrier(CLK_LOCAL_MEM_FENCE);

  if (get_local_id(0) == 0) {
    if (changed && plane == 0 && differs) {
      plane_of_tsdf = take_plane(brick, bricks, counters, distance_planes, owners, occupied);
    }
    if (changed && weight_plane < 0) {
      plane_of_weights =
          least_weight == greatest_weight ? -1 - least_weight : atomic_inc(&counters[1]);
      weight_planes[brick] = plane_of_weights;
    }
  }
  barrier(CLK_LOCAL_MEM_FENCE);

  if (!changed) return;
  global short* tsdfs = distances + plane_of_tsdf * BRICK_VOXELS;
  global short* counts = weights + max(0, plane_of_weights) * BRICK_VOXELS;
  for (int i = get_local_id(0) * LANES; i < BRICK_VOXELS; i += GROUP * LANES) {
    if (plane_of_tsdf != 0) PACKET(tsdfs, i) = new_tsdf[i / LANES];
    if (plane_of_weights >= 0) PACKET(counts, i) = new_weights[i / LANES];
  }
}
