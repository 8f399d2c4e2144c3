// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// Every second of up to 2 LANES elements from p on.
inline Floats every_second(global const float* p, int count) {
#define AT(lane, i) p[2 * min(i, count - 1)]
  return (Floats)(EACH(AT));
#undef AT
}

inline void count_similar(Floats value, Floats first, float range_m, Floats* sum, Floats* count) {
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
    const Floats first = every_second(block, p.count);
    Floats sum = zero, count = zero;
    count_similar(first, first, range_m, &sum, &count);
    count_similar(every_second(block + 1, p.count), first, range_m, &sum, &count);
    count_similar(every_second(block + size.width, p.count), first, range_m, &sum, &count);
    count_similar(every_second(block + size.width + 1, p.count), first, range_m, &sum, &count);
    const Ints any = count > 0.0f;  // none when the first value is NaN
    store_part(any ? sum / count : zero, half_m + p.y * half_size.width + p.x, p.count);
  }
}
