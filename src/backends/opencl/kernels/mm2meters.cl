// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

KERNEL mm2meters(global float* depth_m, Size size, global const ushort* depth, int ratio,
                 float units_per_m) {
  FOR_PACKETS(i, row_packets(size)) {
    const RowPacket p = row_packet(i, size);
    global const ushort* in = depth + (p.y * size.width * ratio + p.x) * ratio;
#define AT(lane, i) in[min(i, p.count - 1) * ratio]
    const Floats units = (Floats)(EACH(AT));
#undef AT
    store_floats(units / units_per_m, depth_m + p.y * size.width + p.x, p.count);
  }
}
