// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// Threes of floats: side by side in memory, a vector of each of the three in a work-item.

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

// LANES of them side by side from p on, of which `count` exist; the last one stands in for the others.
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
