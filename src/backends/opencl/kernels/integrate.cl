// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// The flat volume: packets along x of a layer of it, which the second index of the group tells. A
// layer's packets can be counted in 32 bits, those of the volume need not.
KERNEL integrate(global int* voxels, Int3 n, Float3 voxel_m, global const float* depth_m, Size size,
                 IntegrateParameters p) {
  const int per_row = packets_of(n.x);
  const int z = get_group_id(1);
  global int* layer = voxels + (size_t)z * n.y * n.x;
  FOR_PACKETS(packet, per_row * n.y) {
    const int y = packet / per_row, x0 = (packet - y * per_row) * LANES;
    const Vec3 center =
        apply(p.T_camera_volume,
              vec3(center_axis(x0 + IOTA, voxel_m.x), center_axis((Ints)(y), voxel_m.y),
                   center_axis((Ints)(z), voxel_m.z)));
    global int* first = layer + ((size_t)y * n.x + x0);
    Ints u, v;
    if (!any_lane(project(center, p.camera, size, p.min_depth_m, &u, &v))) continue;
    const Ints voxel = load_ints(first, n.x - x0);
    Ints tsdf = low_half(voxel), weight = voxel >> 16;
    integrate_lanes(center, depth_m, size, p, &tsdf, &weight);
    store_ints((tsdf & 0xffff) | weight << 16, first, n.x - x0);
  }
}
