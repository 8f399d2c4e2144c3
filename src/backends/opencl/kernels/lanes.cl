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
typedef short Shorts;
#define EACH(f) f(, 0)
#define EVERY(f) f(, 0)
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
typedef short8 Shorts;
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
typedef short16 Shorts;
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
#endif
#define PACKET_HEIGHT (LANES / PACKET_WIDTH)

// One value of all lanes, by halves: f(a, b) of two.
#define FOLD_4(f, v) f(f((v).lo, (v).hi).x, f((v).lo, (v).hi).y)
#define BITS_OF_EITHER(a, b) ((a) | (b))
#define BITS_OF_BOTH(a, b) ((a) & (b))
// Functions, as the tree repeats its argument; the drivers' any() and all() look at lane after lane.
INLINE int any_lane(Ints mask) { return FOLD(BITS_OF_EITHER, mask); }
INLINE int all_lanes(Ints mask) { return FOLD(BITS_OF_BOTH, mask); }
#define SUM_OF(a, b) ((a) + (b))
#define SUM_OF_LANES(v) FOLD(SUM_OF, v)
#define LEAST_OF_LANES(v) FOLD(min, v)
#define GREATEST_OF_LANES(v) FOLD(max, v)

// The elements of an array at an index a lane.
INLINE Floats gather(global const float* p, Ints index) {
#define AT(lane, i) p[index lane]
  return (Floats)(EACH(AT));
#undef AT
}
INLINE Ints gather_ints(global const int* p, Ints index) {
#define AT(lane, i) p[index lane]
  return (Ints)(EACH(AT));
#undef AT
}

// LANES elements from p on, of which `count` exist; the last one stands in for the others.
INLINE Floats load_part(global const float* p, int count) {
  if (count >= LANES) return LOAD(p);
#define AT(lane, i) p[min(i, count - 1)]
  return (Floats)(EACH(AT));
#undef AT
}
INLINE void store_part(Floats v, global float* p, int count) {
  if (count >= LANES) {
    STORE(v, p);
    return;
  }
#define TO(lane, i) \
  if (i < count) p[i] = v lane;
  EVERY(TO)
#undef TO
}

// The same of whole numbers.
INLINE Ints load_ints(global const int* p, int count) {
  if (count >= LANES) return LOAD(p);
#define AT(lane, i) p[min(i, count - 1)]
  return (Ints)(EACH(AT));
#undef AT
}
INLINE void store_ints(Ints v, global int* p, int count) {
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

// Between threes of floats side by side and a vector of each: compilers make one instruction of a
// vector whose elements are all written down and come from two others.
#if LANES == 16
INLINE Vec3 separated(float16 a, float16 b, float16 c) {
  const float16 x = (float16)(a.s0, a.s3, a.s6, a.s9, a.sc, a.sf, b.s2, b.s5, b.s8, b.sb, b.se, a.s0,
                              a.s0, a.s0, a.s0, a.s0);
  const float16 y = (float16)(a.s1, a.s4, a.s7, a.sa, a.sd, b.s0, b.s3, b.s6, b.s9, b.sc, b.sf, a.s0,
                              a.s0, a.s0, a.s0, a.s0);
  const float16 z = (float16)(a.s2, a.s5, a.s8, a.sb, a.se, b.s1, b.s4, b.s7, b.sa, b.sd, a.s0, a.s0,
                              a.s0, a.s0, a.s0, a.s0);
  Vec3 v;
  v.x = (float16)(x.s0, x.s1, x.s2, x.s3, x.s4, x.s5, x.s6, x.s7, x.s8, x.s9, x.sa, c.s1, c.s4, c.s7,
                  c.sa, c.sd);
  v.y = (float16)(y.s0, y.s1, y.s2, y.s3, y.s4, y.s5, y.s6, y.s7, y.s8, y.s9, y.sa, c.s2, c.s5, c.s8,
                  c.sb, c.se);
  v.z = (float16)(z.s0, z.s1, z.s2, z.s3, z.s4, z.s5, z.s6, z.s7, z.s8, z.s9, c.s0, c.s3, c.s6, c.s9,
                  c.sc, c.sf);
  return v;
}
#elif LANES == 8
INLINE Vec3 separated(float8 a, float8 b, float8 c) {
  const float8 x = (float8)(a.s0, a.s3, a.s6, b.s1, b.s4, b.s7, a.s0, a.s0);
  const float8 y = (float8)(a.s1, a.s4, a.s7, b.s2, b.s5, a.s0, a.s0, a.s0);
  const float8 z = (float8)(a.s2, a.s5, b.s0, b.s3, b.s6, a.s0, a.s0, a.s0);
  Vec3 v;
  v.x = (float8)(x.s0, x.s1, x.s2, x.s3, x.s4, x.s5, c.s2, c.s5);
  v.y = (float8)(y.s0, y.s1, y.s2, y.s3, y.s4, c.s0, c.s3, c.s6);
  v.z = (float8)(z.s0, z.s1, z.s2, z.s3, z.s4, c.s1, c.s4, c.s7);
  return v;
}
#endif

#if LANES > 1
typedef struct { Floats a, b, c; } Interleaved;
INLINE Interleaved interleaved(Vec3 v) {
  const Floats x = v.x, y = v.y, z = v.z;
  Interleaved parts;
#if LANES == 16
  const float16 a = (float16)(x.s0, y.s0, x.s0, x.s1, y.s1, x.s0, x.s2, y.s2, x.s0, x.s3, y.s3, x.s0,
                              x.s4, y.s4, x.s0, x.s5);
  const float16 b = (float16)(y.s5, x.s0, x.s6, y.s6, x.s0, x.s7, y.s7, x.s0, x.s8, y.s8, x.s0, x.s9,
                              y.s9, x.s0, x.sa, y.sa);
  const float16 c = (float16)(x.s0, x.sb, y.sb, x.s0, x.sc, y.sc, x.s0, x.sd, y.sd, x.s0, x.se, y.se,
                              x.s0, x.sf, y.sf, x.s0);
  parts.a = (float16)(a.s0, a.s1, z.s0, a.s3, a.s4, z.s1, a.s6, a.s7, z.s2, a.s9, a.sa, z.s3, a.sc,
                      a.sd, z.s4, a.sf);
  parts.b = (float16)(b.s0, z.s5, b.s2, b.s3, z.s6, b.s5, b.s6, z.s7, b.s8, b.s9, z.s8, b.sb, b.sc,
                      z.s9, b.se, b.sf);
  parts.c = (float16)(z.sa, c.s1, c.s2, z.sb, c.s4, c.s5, z.sc, c.s7, c.s8, z.sd, c.sa, c.sb, z.se,
                      c.sd, c.se, z.sf);
#else
  const float8 a = (float8)(x.s0, y.s0, x.s0, x.s1, y.s1, x.s0, x.s2, y.s2);
  const float8 b = (float8)(x.s0, x.s3, y.s3, x.s0, x.s4, y.s4, x.s0, x.s5);
  const float8 c = (float8)(y.s5, x.s0, x.s6, y.s6, x.s0, x.s7, y.s7, x.s0);
  parts.a = (float8)(a.s0, a.s1, z.s0, a.s3, a.s4, z.s1, a.s6, a.s7);
  parts.b = (float8)(z.s2, b.s1, b.s2, z.s3, b.s4, b.s5, z.s4, b.s7);
  parts.c = (float8)(c.s0, z.s5, c.s2, c.s3, z.s6, c.s5, c.s6, z.s7);
#endif
  return parts;
}
#endif

// The Float3 at an index a lane. For vectors four floats are read each: a float must follow the last.
INLINE Vec3 gather3(global const float* p, Ints index) {
  Vec3 v;
#define FOUR(lane) vload4(0, p + 3 * index lane)
#if LANES == 16
  const float16 a = (float16)(FOUR(.s0), FOUR(.s1), FOUR(.s2), FOUR(.s3));
  const float16 b = (float16)(FOUR(.s4), FOUR(.s5), FOUR(.s6), FOUR(.s7));
  const float16 c = (float16)(FOUR(.s8), FOUR(.s9), FOUR(.sa), FOUR(.sb));
  const float16 d = (float16)(FOUR(.sc), FOUR(.sd), FOUR(.se), FOUR(.sf));
  const float16 xy_ab = (float16)(a.s0, a.s4, a.s8, a.sc, b.s0, b.s4, b.s8, b.sc, a.s1, a.s5, a.s9,
                                  a.sd, b.s1, b.s5, b.s9, b.sd);
  const float16 xy_cd = (float16)(c.s0, c.s4, c.s8, c.sc, d.s0, d.s4, d.s8, d.sc, c.s1, c.s5, c.s9,
                                  c.sd, d.s1, d.s5, d.s9, d.sd);
  const float8 z_ab = (float8)(a.s2, a.s6, a.sa, a.se, b.s2, b.s6, b.sa, b.se);
  const float8 z_cd = (float8)(c.s2, c.s6, c.sa, c.se, d.s2, d.s6, d.sa, d.se);
  v.x = (float16)(xy_ab.lo, xy_cd.lo);
  v.y = (float16)(xy_ab.hi, xy_cd.hi);
  v.z = (float16)(z_ab, z_cd);
#elif LANES == 8
  const float8 a = (float8)(FOUR(.s0), FOUR(.s1)), b = (float8)(FOUR(.s2), FOUR(.s3));
  const float8 c = (float8)(FOUR(.s4), FOUR(.s5)), d = (float8)(FOUR(.s6), FOUR(.s7));
  const float8 xy_ab = (float8)(a.s0, a.s4, b.s0, b.s4, a.s1, a.s5, b.s1, b.s5);
  const float8 xy_cd = (float8)(c.s0, c.s4, d.s0, d.s4, c.s1, c.s5, d.s1, d.s5);
  v.x = (float8)(xy_ab.lo, xy_cd.lo);
  v.y = (float8)(xy_ab.hi, xy_cd.hi);
  v.z = (float8)(a.s26, b.s26, c.s26, d.s26);
#else
  v.x = p[3 * index];
  v.y = p[3 * index + 1];
  v.z = p[3 * index + 2];
#endif
#undef FOUR
  return v;
}

// LANES of them from p on, of which `count` exist; the last one stands in for the others.
INLINE Vec3 load3(global const float* p, int count) {
  Vec3 v;
#if LANES > 1
  if (count >= LANES) return separated(LOAD(p), LOAD(p + LANES), LOAD(p + 2 * LANES));
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
INLINE void store3(Vec3 v, global float* p, int count) {
#if LANES > 1
  if (count >= LANES) {
    const Interleaved parts = interleaved(v);
    STORE(parts.a, p);
    STORE(parts.b, p + LANES);
    STORE(parts.c, p + 2 * LANES);
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

// The same of the lanes of a mask in a packet of PACKET_WIDTH x PACKET_HEIGHT pixels, whose first is
// at p, of an image.
INLINE void store3_packet(Vec3 v, Ints mask, global float* p, int width) {
#if LANES > 1
  if (all_lanes(mask)) {
    const Interleaved parts = interleaved(v);
#if LANES == 16
    vstore8(parts.a.lo, 0, p);
    vstore4(parts.a.s89ab, 0, p + 8);
    p += 3 * width;
    vstore4(parts.a.scdef, 0, p);
    vstore8(parts.b.lo, 0, p + 4);
    p += 3 * width;
    vstore8(parts.b.hi, 0, p);
    vstore4(parts.c.s0123, 0, p + 8);
    p += 3 * width;
    vstore4(parts.c.s4567, 0, p);
    vstore8(parts.c.hi, 0, p + 4);
#else
    vstore8(parts.a, 0, p);
    vstore4(parts.b.lo, 0, p + 8);
    p += 3 * width;
    vstore4(parts.b.hi, 0, p);
    vstore8(parts.c, 0, p + 4);
#endif
    return;
  }
#endif
  const Ints at = 3 * (ROW_OF_LANE * width + COLUMN_OF_LANE);
#define TO(lane, i)           \
  if (mask lane) {            \
    p[at lane] = v.x lane;    \
    p[at lane + 1] = v.y lane; \
    p[at lane + 2] = v.z lane; \
  }
  EVERY(TO)
#undef TO
}

// Each work-item takes PACKETS packets of LANES elements, a group neighbouring ones.
#define FOR_PACKETS(i, count)                                                         \
  for (int i = get_group_id(0) * GROUP * PACKETS + get_local_id(0),                   \
           i##_end = min((int)(count), (int)(get_group_id(0) + 1) * GROUP * PACKETS); \
       i < i##_end; i += GROUP)

#define KERNEL kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void

INLINE int packets_of(int count) { return (count + LANES - 1) / LANES; }

// The packet of pixels from (x, y) on: packets do not reach over the end of a row.
typedef struct { int x, y, count; } RowPacket;
INLINE RowPacket row_packet(int i, Size size) {
  const int per_row = packets_of(size.width);
  RowPacket p;
  p.y = i / per_row;
  p.x = (i - p.y * per_row) * LANES;
  p.count = size.width - p.x;
  return p;
}
INLINE int row_packets(Size size) { return packets_of(size.width) * size.height; }
