// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

KERNEL depth2vertex(global float* vertices, global const float* depth_m, Size size,
                    Intrinsics camera) {
  FOR_PACKETS(i, row_packets(size)) {
    const RowPacket p = row_packet(i, size);
    const int pixel = p.y * size.width + p.x;
    const Floats zero = (Floats)(0.0f);
    const Floats depth = load_floats(depth_m + pixel, p.count);
    const Vec3 vertex = mul(pixel_ray(camera, p.x + IOTA, (Ints)(p.y)), depth);
    store3(select3(depth > 0.0f, vertex, vec3(zero, zero, zero)), vertices + 3 * pixel, p.count);
  }
}
