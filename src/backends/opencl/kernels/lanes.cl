// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// A work-item computes LANES elements at once: 1 where the device makes vectors of work-items
// itself (GPUs), 8 or 16 where the vectors have to be written down (CPUs). The code below reads
// the same for all: masks are integers, not 0 where true, for vectors all bits; `mask ? a : b`
// selects lane by lane. EACH(f) lists f(lane, index) of every lane with commas between, as the
// elements of a vector; EVERY(f) puts them one after the other, as statements. The lane is what
// follows a vector's name: v lane.

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

// Of floats and of whole numbers:
// - gather: the elements of an array at an index a lane;
// - load, store: LANES elements from p on, of which `count` exist; the last one stands in for the
//   others.
#define AT_INDEX(lane, i) p[index lane]
#define AT_OR_LAST(lane, i) p[min(i, count - 1)]
#define TO_EXISTING(lane, i) \
  if (i < count) p[i] = v lane;
#define MEMORY_OF(Lanes, element, elements)                                \
  INLINE Lanes gather_##elements(global const element* p, Ints index) {    \
    return (Lanes)(EACH(AT_INDEX));                                        \
  }                                                                        \
  INLINE Lanes load_##elements(global const element* p, int count) {       \
    if (count >= LANES) return LOAD(p);                                    \
    return (Lanes)(EACH(AT_OR_LAST));                                      \
  }                                                                        \
  INLINE void store_##elements(Lanes v, global element* p, int count) {    \
    if (count >= LANES) {                                                  \
      STORE(v, p);                                                         \
      return;                                                              \
    }                                                                      \
    EVERY(TO_EXISTING)                                                     \
  }
MEMORY_OF(Floats, float, floats)
MEMORY_OF(Ints, int, ints)
#undef MEMORY_OF
#undef TO_EXISTING
#undef AT_OR_LAST
#undef AT_INDEX

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
