// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// The two maps as rays read them, and src/kernels/volume_maths.h for lanes.

#define EDGE 8            // voxels along a brick
#define BRICK_VOXELS 512  // x fastest

// Where the brick of this index lies, in bricks.
INLINE Int3 brick_position(int brick, Int3 bricks) {
  Int3 at;
  at.x = brick % bricks.x;
  at.y = brick / bricks.x % bricks.y;
  at.z = brick / bricks.x / bricks.y;
  return at;
}

// BRICKS: planes of 512 distances, a table with the plane of each brick (0: all +1), and a byte a
// brick that is not 0 where a sample whose lower corner lies in it can be other than +1.
// Otherwise: a flat array of pairs of distance and weight.
typedef struct {
  Int3 n;  // voxels
  Float3 size_m;
  Int3 bricks;
  global const short* values;
  global const int* planes;
  global const uchar* occupied;
} Map;

// The lower corner of each lane's cell, unclamped.
typedef struct {
  Ints x, y, z;
  Vec3 fraction;
} Cell;

INLINE Ints cell_axis(Floats p, int count, float size_m, Floats* fraction) {
  const Floats position = p * (float)(count) / size_m - 0.5f;
  // As the floor, which drivers for processors write out for all floats there are.
  const Ints truncated = TO_INTS(position);
  const Ints base = TO_FLOATS(truncated) > position ? truncated - 1 : truncated;
  *fraction = position - TO_FLOATS(base);
  return base;
}

INLINE Cell cell_of(const Map* map, Vec3 p) {
  Cell cell;
  cell.x = cell_axis(p.x, map->n.x, map->size_m.x, &cell.fraction.x);
  cell.y = cell_axis(p.y, map->n.y, map->size_m.y, &cell.fraction.y);
  cell.z = cell_axis(p.z, map->n.z, map->size_m.z, &cell.fraction.z);
  return cell;
}

INLINE Ints clamp_index(Ints i, int count) { return clamp(i, (Ints)(0), (Ints)(count - 1)); }

INLINE Floats lerp(Floats a, Floats b, Floats t) { return a * (1.0f - t) + b * t; }

// Pairs of neighbouring 16-bit values, the first in the lower half.
INLINE Ints low_half(Ints pair) { return (pair << 16) >> 16; }
INLINE Ints gather_pairs(global const short* values, Ints index) {
#define AT(lane, i) as_int(vload2(0, values + index lane))
  return (Ints)(EACH(AT));
#undef AT
}

#if BRICKS

INLINE Ints brick_index(const Map* map, Ints bx, Ints by, Ints bz) {
  return (bz * map->bricks.y + by) * map->bricks.x + bx;
}

INLINE Ints occupied(const Map* map, Cell cell) {
  const Ints brick =
      brick_index(map, clamp_index(cell.x, map->n.x) >> 3, clamp_index(cell.y, map->n.y) >> 3,
                  clamp_index(cell.z, map->n.z) >> 3);
  if (all_lanes(brick == FIRST(brick))) return (Ints)(map->occupied[FIRST(brick)]);
#define AT(lane, i) map->occupied[brick lane]
  return (Ints)(EACH(AT));
#undef AT
}

// The plane of a brick a lane; neighbouring rays mostly are in the same brick.
INLINE Ints plane_of(const Map* map, Ints bx, Ints by, Ints bz) {
  const Ints brick = brick_index(map, bx, by, bz);
  if (all_lanes(brick == FIRST(brick))) return (Ints)(map->planes[FIRST(brick)]);
  return gather_ints(map->planes, brick);
}

INLINE Ints row_in(Ints y, Ints z) { return (z & 7) << 6 | (y & 7) << 3; }
INLINE Ints value_at(Ints plane, Ints x, Ints row) { return plane << 9 | row | (x & 7); }

// The planes of the bricks at one x around a cell, [z][y]; equal ones are read once.
INLINE void planes_around(const Map* map, Ints bx, const Ints* by, const Ints* bz, int across_y,
                          int across_z, Ints (*plane)[2]) {
  plane[0][0] = plane_of(map, bx, by[0], bz[0]);
  plane[0][1] = across_y ? plane_of(map, bx, by[1], bz[0]) : plane[0][0];
  plane[1][0] = across_z ? plane_of(map, bx, by[0], bz[1]) : plane[0][0];
  plane[1][1] = across_y ? (across_z ? plane_of(map, bx, by[1], bz[1]) : plane[0][1]) : plane[1][0];
}

// The stored distances at the corners between positions x[0..1], y[0..1], z[0..1]: [z][y][x].
INLINE void corners(const Map* map, const Ints* x, const Ints* y, const Ints* z,
                    Floats (*value)[2][2]) {
  const Ints bx[2] = {x[0] >> 3, x[1] >> 3};
  const Ints by[2] = {y[0] >> 3, y[1] >> 3};
  const Ints bz[2] = {z[0] >> 3, z[1] >> 3};
  const int across_x = any_lane(bx[0] != bx[1]);
  const int across_y = any_lane(by[0] != by[1]);
  const int across_z = any_lane(bz[0] != bz[1]);
  const Ints apart = x[0] != x[1];  // else the upper x is clamped to the lower
  Ints plane[2][2], other[2][2];
  planes_around(map, bx[0], by, bz, across_y, across_z, plane);
  if (across_x) planes_around(map, bx[1], by, bz, across_y, across_z, other);
  UNROLL
  for (int k = 0; k < 2; ++k) {
    UNROLL
    for (int j = 0; j < 2; ++j) {
      const Ints row = row_in(y[j], z[k]);
      const Ints pair = gather_pairs(map->values, value_at(plane[k][j], x[0], row));
      const Ints lower = low_half(pair);
      Ints upper;
      if (across_x) {
        upper = low_half(gather_pairs(map->values, value_at(other[k][j], x[1], row)));
      } else {
        upper = apart ? pair >> 16 : lower;
      }
      value[k][j][0] = TO_FLOATS(lower);
      value[k][j][1] = TO_FLOATS(upper);
    }
  }
}

// The distances at voxels of four neighbouring positions along each axis that central differences
// at the inner 2^3 read: [z][y][x]. They lie in at most two bricks along each axis.
INLINE void around(const Map* map, const Ints* x, const Ints* y, const Ints* z,
                   Floats (*value)[4][4]) {
  const Ints bx[2] = {x[0] >> 3, x[3] >> 3};
  const Ints by[2] = {y[0] >> 3, y[3] >> 3};
  const Ints bz[2] = {z[0] >> 3, z[3] >> 3};
  const int across_y = any_lane(by[0] != by[1]), across_z = any_lane(bz[0] != bz[1]);
  Ints plane[2][2], other[2][2];
  planes_around(map, bx[0], by, bz, across_y, across_z, plane);
  planes_around(map, bx[1], by, bz, across_y, across_z, other);
  UNROLL
  for (int k = 0; k < 4; ++k) {
    const Ints in_lower_z = (z[k] >> 3) == bz[0];
    UNROLL
    for (int j = 0; j < 4; ++j) {
      const int outer = (k == 0 || k == 3) + (j == 0 || j == 3);
      if (outer == 2) continue;
      const Ints in_lower_y = (y[j] >> 3) == by[0];
      const Ints lower = in_lower_z ? (in_lower_y ? plane[0][0] : plane[0][1])
                                    : (in_lower_y ? plane[1][0] : plane[1][1]);
      const Ints upper = in_lower_z ? (in_lower_y ? other[0][0] : other[0][1])
                                    : (in_lower_y ? other[1][0] : other[1][1]);
      const Ints row = row_in(y[j], z[k]);
      UNROLL
      for (int i = outer; i < 4 - outer; ++i) {
        const Ints here = (x[i] >> 3) == bx[0];
        const Ints index = value_at(here ? lower : upper, x[i], row);
        value[k][j][i] = TO_FLOATS(low_half(gather_pairs(map->values, index)));
      }
    }
  }
}

#else

// WIDE: there are more voxels than a lane can count. ALWAYS_WIDE: as if there were, for tests.
INLINE Floats tsdf_at(const Map* map, Ints x, Ints y, Ints z) {
  global const int* pairs = (global const int*)map->values;
  const Ints row = z * map->n.y + y;
#if WIDE || defined(ALWAYS_WIDE)
#define AT(lane, i) pairs[(size_t)(row lane) * map->n.x + x lane]
  const Ints pair = (Ints)(EACH(AT));
#undef AT
#else
  const Ints pair = gather_ints(pairs, row * map->n.x + x);
#endif
  return TO_FLOATS(low_half(pair));
}

INLINE void corners(const Map* map, const Ints* x, const Ints* y, const Ints* z,
                    Floats (*value)[2][2]) {
  UNROLL
  for (int k = 0; k < 2; ++k) {
    UNROLL
    for (int j = 0; j < 2; ++j) {
      UNROLL
      for (int i = 0; i < 2; ++i) value[k][j][i] = tsdf_at(map, x[i], y[j], z[k]);
    }
  }
}

INLINE void around(const Map* map, const Ints* x, const Ints* y, const Ints* z,
                   Floats (*value)[4][4]) {
  UNROLL
  for (int k = 0; k < 4; ++k) {
    UNROLL
    for (int j = 0; j < 4; ++j) {
      const int outer = (k == 0 || k == 3) + (j == 0 || j == 3);
      if (outer == 2) continue;
      UNROLL
      for (int i = outer; i < 4 - outer; ++i) value[k][j][i] = tsdf_at(map, x[i], y[j], z[k]);
    }
  }
}

#endif

INLINE Floats interpolate(const Map* map, Cell cell) {
  const Ints x[2] = {clamp_index(cell.x, map->n.x), clamp_index(cell.x + 1, map->n.x)};
  const Ints y[2] = {clamp_index(cell.y, map->n.y), clamp_index(cell.y + 1, map->n.y)};
  const Ints z[2] = {clamp_index(cell.z, map->n.z), clamp_index(cell.z + 1, map->n.z)};
  Floats v[2][2][2];
  corners(map, x, y, z, v);
  const Vec3 f = cell.fraction;
  const Floats front = lerp(lerp(v[0][0][0], v[0][0][1], f.x), lerp(v[0][1][0], v[0][1][1], f.x), f.y);
  const Floats back = lerp(lerp(v[1][0][0], v[1][0][1], f.x), lerp(v[1][1][0], v[1][1][1], f.x), f.y);
  return lerp(front, back, f.z) * (1.0f / TSDF_SCALE);
}

INLINE Vec3 gradient(const Map* map, Vec3 p) {
  const Cell cell = cell_of(map, p);
  Ints x[4], y[4], z[4];
  UNROLL
  for (int i = 0; i < 4; ++i) {
    x[i] = clamp_index(cell.x + (i - 1), map->n.x);
    y[i] = clamp_index(cell.y + (i - 1), map->n.y);
    z[i] = clamp_index(cell.z + (i - 1), map->n.z);
  }
  Floats v[4][4][4];
  around(map, x, y, z, v);
  const Vec3 f = cell.fraction;
  Vec3 sum = vec3((Floats)(0.0f), (Floats)(0.0f), (Floats)(0.0f));
  UNROLL
  for (int corner = 0; corner < 8; ++corner) {
    const int i = (corner & 1) + 1, j = ((corner >> 1) & 1) + 1, k = (corner >> 2) + 1;
    const Floats weight =
        (i == 2 ? f.x : 1.0f - f.x) * (j == 2 ? f.y : 1.0f - f.y) * (k == 2 ? f.z : 1.0f - f.z);
    sum.x += weight * (v[k][j][i + 1] - v[k][j][i - 1]);
    sum.y += weight * (v[k][j + 1][i] - v[k][j - 1][i]);
    sum.z += weight * (v[k + 1][j][i] - v[k - 1][j][i]);
  }
  const float scale = 0.5f / TSDF_SCALE;
  return vec3(sum.x * scale / (map->size_m.x / (float)(map->n.x)),
              sum.y * scale / (map->size_m.y / (float)(map->n.y)),
              sum.z * scale / (map->size_m.z / (float)(map->n.z)));
}
