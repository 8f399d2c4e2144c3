// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// LANES pixels of a row of `width`, from x on; beyond the ends the end's pixel continues.
INLINE Floats clamped_row(global const float* row, int x, int width) {
  if (x >= 0 && x + LANES <= width) return LOAD(row + x);
#define AT(lane, i) row[clamp(x + i, 0, width - 1)]
  return (Floats)(EACH(AT));
#undef AT
}

KERNEL bilateral_filter(global float* filtered_m, global const float* depth_m, Size size,
                        global const float* gaussian, int radius, float inverse_two_sigma2) {
  const Floats zero = (Floats)(0.0f);
  FOR_PACKETS(i, row_packets(size)) {
    const RowPacket p = row_packet(i, size);
    const Floats center = clamped_row(depth_m + p.y * size.width, p.x, size.width);
    Floats sum = zero, weights = zero;
    for (int dy = -radius; dy <= radius; ++dy) {
      global const float* row = depth_m + clamp(p.y + dy, 0, size.height - 1) * size.width;
      for (int dx = -radius; dx <= radius; ++dx) {
        const Floats neighbour = clamped_row(row, p.x + dx, size.width);
        const Ints valid = neighbour > 0.0f;
        const Floats difference = neighbour - center;
        const Floats weight = gaussian[dx + radius] * gaussian[dy + radius] *
                              exp(-difference * difference * inverse_two_sigma2);
        sum += valid ? weight * neighbour : zero;
        weights += valid ? weight : zero;
      }
    }
    const Ints valid = center > 0.0f;
    store_floats(valid ? sum / weights : zero, filtered_m + p.y * size.width + p.x, p.count);
  }
}
