// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// Elements 0, 2, ... and 1, 3, ... from p on, `count` of each.
INLINE void load_pairs(global const float* p, int count, Floats* even, Floats* odd) {
#if LANES > 1
  if (count >= LANES) {
    const Floats a = LOAD(p), b = LOAD(p + LANES);
    *even = (Floats)(a.even, b.even);
    *odd = (Floats)(a.odd, b.odd);
    return;
  }
#endif
#define AT(lane, i) p[2 * min(i, count - 1)]
  *even = (Floats)(EACH(AT));
  ++p;
  *odd = (Floats)(EACH(AT));
#undef AT
}

INLINE void count_similar(Floats value, Floats first, float range_m, Floats* sum, Floats* count) {
  const Floats zero = (Floats)(0.0f);
  const Ints similar = fabs(value - first) <= range_m;
  *sum += similar ? value : zero;
  *count += similar ? (Floats)(1.0f) : zero;
}

KERNEL half_sample(global float* half_m, Size half_size, global const float* depth_m, Size size,
                   float range_m) {
  const Floats zero = (Floats)(0.0f);
  FOR_PACKETS(i, row_packets(half_size)) {
    const RowPacket p = row_packet(i, half_size);
    global const float* block = depth_m + 2 * (p.y * size.width + p.x);
    Floats first, second, third, fourth;
    load_pairs(block, p.count, &first, &second);
    load_pairs(block + size.width, p.count, &third, &fourth);
    Floats sum = zero, count = zero;
    count_similar(first, first, range_m, &sum, &count);
    count_similar(second, first, range_m, &sum, &count);
    count_similar(third, first, range_m, &sum, &count);
    count_similar(fourth, first, range_m, &sum, &count);
    const Ints any = count > 0.0f;  // none when the first value is NaN
    store_floats(any ? sum / count : zero, half_m + p.y * half_size.width + p.x, p.count);
  }
}
