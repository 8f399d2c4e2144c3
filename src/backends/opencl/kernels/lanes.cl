// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// A work-item computes LANES elements at once: 1 where the device makes vectors of work-items
// itself (GPUs), 8 or 16 where the vectors have to be written down (CPUs). The code below reads
// the same for all: masks are integers, not 0 where true, for vectors all bits; `mask ? a : b`
// selects lane by lane; EACH(f) lists f(lane, index) of every lane, where the lane is what follows
// the vector's name: v lane.

#if LANES == 1
typedef float Floats;
typedef int Ints;
#define EACH(f) f(, 0)
#define EVERY(f) f(, 0)
#define ANY(mask) (mask)
#define ALL(mask) (mask)
#define TO_FLOATS(v) convert_float(v)
#define TO_INTS(v) convert_int(v)
#define TO_SHORTS(v) convert_short(v)
#define AS_INTS(v) as_int(v)
#define IOTA 0
#define FIRST(v) (v)
#define LOAD(p) (*(p))
#define STORE(v, p) (*(p) = (v))
#define PACKET_WIDTH 1
#define COLUMN_OF_LANE 0
#define ROW_OF_LANE 0
#define FOLD(f, v) (v)
#elif LANES == 8
typedef float8 Floats;
typedef int8 Ints;
#define EACH(f) f(.s0, 0), f(.s1, 1), f(.s2, 2), f(.s3, 3), f(.s4, 4), f(.s5, 5), f(.s6, 6), f(.s7, 7)
#define EVERY(f) f(.s0, 0) f(.s1, 1) f(.s2, 2) f(.s3, 3) f(.s4, 4) f(.s5, 5) f(.s6, 6) f(.s7, 7)
#define TO_FLOATS(v) convert_float8(v)
#define TO_INTS(v) convert_int8(v)
#define TO_SHORTS(v) convert_short8(v)
#define AS_INTS(v) as_int8(v)
#define IOTA (int8)(0, 1, 2, 3, 4, 5, 6, 7)
#define LOAD(p) vload8(0, p)
#define STORE(v, p) vstore8(v, 0, p)
#define FOLD(f, v) FOLD_4(f, f((v).lo, (v).hi))
#elif LANES == 16
typedef float16 Floats;
typedef int16 Ints;
#define EACH(f)                                                                                \
  f(.s0, 0), f(.s1, 1), f(.s2, 2), f(.s3, 3), f(.s4, 4), f(.s5, 5), f(.s6, 6), f(.s7, 7),      \
      f(.s8, 8), f(.s9, 9), f(.sa, 10), f(.sb, 11), f(.sc, 12), f(.sd, 13), f(.se, 14), f(.sf, 15)
#define EVERY(f)                                                                               \
  f(.s0, 0) f(.s1, 1) f(.s2, 2) f(.s3, 3) f(.s4, 4) f(.s5, 5) f(.s6, 6) f(.s7, 7) f(.s8, 8)    \
  f(.s9, 9) f(.sa, 10) f(.sb, 11) f(.sc, 12) f(.sd, 13) f(.se, 14) f(.sf, 15)
#define TO_FLOATS(v) convert_float16(v)
#define TO_INTS(v) convert_int16(v)
#define TO_SHORTS(v) convert_short16(v)
#define AS_INTS(v) as_int16(v)
#define IOTA (int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)
#define LOAD(p) vload16(0, p)
#define STORE(v, p) vstore16(v, 0, p)
#define FOLD(f, v) FOLD_4(f, f(f((v).lo, (v).hi).lo, f((v).lo, (v).hi).hi))
#else
#error "LANES: expected 1, 8 or 16"
#endif

#if LANES > 1
// A packet of an image's pixels where rays march together: 4 wide.
#define PACKET_WIDTH 4
#define COLUMN_OF_LANE (IOTA & 3)
#define ROW_OF_LANE (IOTA >> 2)
#define FIRST(v) (v).s0
// A tree: the drivers' any() and all() look at lane after lane.
#define ANY(mask) FOLD(BITS_OF_EITHER, mask)
#define ALL(mask) FOLD(BITS_OF_BOTH, mask)
#endif
#define PACKET_HEIGHT (LANES / PACKET_WIDTH)

// One value of all lanes, by halves: f(a, b) of two.
#define FOLD_4(f, v) f(f((v).lo, (v).hi).x, f((v).lo, (v).hi).y)
#define BITS_OF_EITHER(a, b) ((a) | (b))
#define BITS_OF_BOTH(a, b) ((a) & (b))
#define SUM_OF(a, b) ((a) + (b))
#define SUM_OF_LANES(v) FOLD(SUM_OF, v)
#define LEAST_OF_LANES(v) FOLD(min, v)
#define GREATEST_OF_LANES(v) FOLD(max, v)

// The elements of an array at an index a lane.
inline Floats gather(global const float* p, Ints index) {
#define AT(lane, i) p[index lane]
  return (Floats)(EACH(AT));
#undef AT
}
inline Ints gather_ints(global const int* p, Ints index) {
#define AT(lane, i) p[index lane]
  return (Ints)(EACH(AT));
#undef AT
}

// LANES elements from p on, of which `count` exist; the last one stands in for the others.
inline Floats load_part(global const float* p, int count) {
  if (count >= LANES) return LOAD(p);
#define AT(lane, i) p[min(i, count - 1)]
  return (Floats)(EACH(AT));
#undef AT
}
inline void store_part(Floats v, global float* p, int count) {
  if (count >= LANES) {
    STORE(v, p);
    return;
  }
#define TO(lane, i) \
  if (i < count) p[i] = v lane;
  EVERY(TO)
#undef TO
}

typedef struct { Floats x, y, z; } Vec3;

// The same of Float3.
inline Vec3 load3(global const float* p, int count) {
  Vec3 v;
#if LANES == 16
  if (count >= LANES) {
    const float16 a = vload16(0, p), b = vload16(1, p), c = vload16(2, p);
    v.x = (float16)(a.s0369, a.scf, b.s258b, b.se, c.s147a, c.sd);
    v.y = (float16)(a.s147a, a.sd, b.s0369, b.scf, c.s258b, c.se);
    v.z = (float16)(a.s258b, a.se, b.s147a, b.sd, c.s0369, c.scf);
    return v;
  }
#elif LANES == 8
  if (count >= LANES) {
    const float8 a = vload8(0, p), b = vload8(1, p), c = vload8(2, p);
    v.x = (float8)(a.s036, b.s147, c.s25);
    v.y = (float8)(a.s147, b.s25, c.s036);
    v.z = (float8)(a.s25, b.s036, c.s147);
    return v;
  }
#endif
#define AT(lane, i) p[3 * min(i, count - 1)]
  v.x = (Floats)(EACH(AT));
  ++p;
  v.y = (Floats)(EACH(AT));
  ++p;
  v.z = (Floats)(EACH(AT));
#undef AT
  return v;
}
inline void store3(Vec3 v, global float* p, int count) {
#if LANES == 16
  if (count >= LANES) {
    const float16 x = v.x, y = v.y, z = v.z;
    vstore16((float16)(x.s0, y.s0, z.s0, x.s1, y.s1, z.s1, x.s2, y.s2, z.s2, x.s3, y.s3, z.s3,
                       x.s4, y.s4, z.s4, x.s5), 0, p);
    vstore16((float16)(y.s5, z.s5, x.s6, y.s6, z.s6, x.s7, y.s7, z.s7, x.s8, y.s8, z.s8, x.s9,
                       y.s9, z.s9, x.sa, y.sa), 1, p);
    vstore16((float16)(z.sa, x.sb, y.sb, z.sb, x.sc, y.sc, z.sc, x.sd, y.sd, z.sd, x.se, y.se,
                       z.se, x.sf, y.sf, z.sf), 2, p);
    return;
  }
#elif LANES == 8
  if (count >= LANES) {
    const float8 x = v.x, y = v.y, z = v.z;
    vstore8((float8)(x.s0, y.s0, z.s0, x.s1, y.s1, z.s1, x.s2, y.s2), 0, p);
    vstore8((float8)(z.s2, x.s3, y.s3, z.s3, x.s4, y.s4, z.s4, x.s5), 1, p);
    vstore8((float8)(y.s5, z.s5, x.s6, y.s6, z.s6, x.s7, y.s7, z.s7), 2, p);
    return;
  }
#endif
#define TO(lane, i)       \
  if (i < count) {        \
    p[3 * i] = v.x lane;  \
    p[3 * i + 1] = v.y lane; \
    p[3 * i + 2] = v.z lane; \
  }
  EVERY(TO)
#undef TO
}

// Each work-item takes PER_ITEM packets of LANES elements, a group neighbouring ones.
#define FOR_PACKETS(i, count)                                                          \
  for (int i = get_group_id(0) * GROUP * PER_ITEM + get_local_id(0),                   \
           i##_end = min((int)(count), (int)(get_group_id(0) + 1) * GROUP * PER_ITEM); \
       i < i##_end; i += GROUP)

#define KERNEL kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void

inline int packets_of(int count) { return (count + LANES - 1) / LANES; }

// The packet of pixels from (x, y) on: packets do not reach over the end of a row.
typedef struct { int x, y, count; } RowPacket;
inline RowPacket row_packet(int i, Size size) {
  const int per_row = packets_of(size.width);
  RowPacket p;
  p.y = i / per_row;
  p.x = (i - p.y * per_row) * LANES;
  p.count = size.width - p.x;
  return p;
}
inline int row_packets(Size size) { return packets_of(size.width) * size.height; }
