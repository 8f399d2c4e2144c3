// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// The flat volume: packets along x of a layer of it, which the second index of the group tells. A
// layer's packets can be counted in 32 bits, those of the volume need not.
KERNEL integrate(global short* voxels, Int3 n, Float3 voxel_m, global const float* depth_m,
                 Size size, IntegrateParameters p) {
  const int per_row = packets_of(n.x);
  const int z = get_group_id(1);
  global short* layer = voxels + 2 * ((size_t)z * n.y * n.x);
  FOR_PACKETS(packet, per_row * n.y) {
    const int y = packet / per_row, x0 = (packet - y * per_row) * LANES;
    const Vec3 center =
        apply(p.T_camera_volume,
              vec3(center_axis(x0 + IOTA, voxel_m.x), center_axis((Ints)(y), voxel_m.y),
                   center_axis((Ints)(z), voxel_m.z)));
    global short* first = layer + 2 * ((size_t)y * n.x + x0);
    const int left = n.x - x0;
    Ints u, v;
    if (!ANY(project(center, p.camera, size, p.min_depth_m, &u, &v))) continue;
#define DISTANCE(lane, i) first[2 * min(i, left - 1)]
#define WEIGHT(lane, i) first[2 * min(i, left - 1) + 1]
    Ints tsdf = (Ints)(EACH(DISTANCE)), weight = (Ints)(EACH(WEIGHT));
    integrate_lanes(center, depth_m, size, p, &tsdf, &weight);
#define TO(lane, i)                  \
  if (i < left) {                    \
    first[2 * i] = (short)(tsdf lane); \
    first[2 * i + 1] = (short)(weight lane); \
  }
    EVERY(TO)
  }
}
