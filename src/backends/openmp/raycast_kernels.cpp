// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/openmp/raycast_kernels.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "backends/openmp/raycast_kernels.cpp"
#include "hwy/foreach_target.h"
// Included once per target.
#include "backends/openmp/simd-inl.h"

// Whether a vector can hold a table of eight entries.
#undef SLAMBENCH_EIGHT_LANES
#define SLAMBENCH_EIGHT_LANES (HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3)

HWY_BEFORE_NAMESPACE();
namespace slambench {
namespace HWY_NAMESPACE {
namespace {

constexpr int lanes() { return static_cast<int>(hn::MaxLanes(f32)); }

HWY_INLINE Ints low_half(Ints packed) { return hn::ShiftRight<16>(hn::ShiftLeft<16>(packed)); }

/// Positions of voxels along the axes; the pairs are clamped to the volume.
struct CellLanes {
  Ints x[2], y[2], z[2];
  Vec3 fraction;
};

/// One axis of slambench::cell_of: `base` may be -1 or the last index.
HWY_INLINE Ints cell_axis(Floats p, int count, float size_m, Floats* fraction) {
  const Floats position =
      hn::Sub(hn::Div(hn::Mul(p, set(static_cast<float>(count))), set(size_m)), set(0.5f));
  const Floats base = hn::Floor(position);
  *fraction = hn::Sub(position, base);
  return hn::ConvertTo(i32, base);
}

/// The lower corner of each lane's cell, unclamped.
struct CellBase {
  Ints x, y, z;
  Vec3 fraction;
};

HWY_INLINE CellBase cell_base(Int3 resolution, Float3 size_m, Vec3 p) {
  CellBase base;
  base.x = cell_axis(p.x, resolution.x, size_m.x, &base.fraction.x);
  base.y = cell_axis(p.y, resolution.y, size_m.y, &base.fraction.y);
  base.z = cell_axis(p.z, resolution.z, size_m.z, &base.fraction.z);
  return base;
}

/// The eight stored distances around a point: [z][y][x].
struct CornerValues {
  Floats v[2][2][2];
};

HWY_INLINE Floats lerp(Floats a, Floats b, Floats t) {
  return hn::Add(hn::Mul(a, hn::Sub(set(1.0f), t)), hn::Mul(b, t));
}

/// Calls f(x, y, z) for the positions of a 4^3 cube that central differences at its inner 2^3 read.
template <class F>
HWY_INLINE void for_gradient(const F& f) {
  for (int z = 0; z < 4; ++z) {
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 4; ++x) {
        const int outer = (x == 0 || x == 3) + (y == 0 || y == 3) + (z == 0 || z == 3);
        if (outer <= 1) f(x, y, z);
      }
    }
  }
}

/// The flat volume for lanes.
class GridLanes {
 public:
  static constexpr bool skips = false;

  explicit GridLanes(const GridView& view)
      : voxels_(reinterpret_cast<const std::int32_t*>(view.voxels)),
        n_(view.resolution),
        size_m_(view.size_m) {}

  Int3 resolution() const { return n_; }
  Float3 size_m() const { return size_m_; }

  /// The values at voxels of four positions along each axis, but for the corners and edges of that
  /// cube.
  HWY_INLINE void around(const Ints* x, const Ints* y, const Ints* z, Floats (*value)[4][4]) const {
    for_gradient([&](int i, int j, int k) { value[k][j][i] = tsdf(x[i], y[j], z[k]); });
  }

  HWY_INLINE Floats tsdf(Ints x, Ints y, Ints z) const {
    const Ints row = hn::Add(hn::Mul(z, set_int(n_.y)), y);
    return at(hn::Add(hn::Mul(row, set_int(n_.x)), x));
  }

  HWY_INLINE CornerValues corners(const CellLanes& cell) const {
    CornerValues values;
    for (int z = 0; z < 2; ++z) {
      const Ints slice = hn::Mul(cell.z[z], set_int(n_.y));
      for (int y = 0; y < 2; ++y) {
        const Ints row = hn::Mul(hn::Add(slice, cell.y[y]), set_int(n_.x));
        for (int x = 0; x < 2; ++x) values.v[z][y][x] = at(hn::Add(row, cell.x[x]));
      }
    }
    return values;
  }

 private:
  HWY_INLINE Floats at(Ints index) const {
    return hn::ConvertTo(f32, low_half(hn::GatherIndex(i32, voxels_, index)));
  }

  const std::int32_t* voxels_;
  Int3 n_;
  Float3 size_m_;
};

/// The bricks for lanes.
class BrickLanes {
 public:
  static constexpr bool skips = true;

  explicit BrickLanes(const BrickView& view)
      : planes_(view.volume->plane_table()),
        values_(view.volume->planes()),
        occupancy_(view.volume->occupancy()),
        bricks_(view.volume->bricks()),
        n_(view.resolution),
        size_m_(view.size_m) {}

  Int3 resolution() const { return n_; }
  Float3 size_m() const { return size_m_; }

  /// Not 0 where a sample in the cell can be other than +1.
  HWY_INLINE Ints occupied(const CellBase& cell) const {
    const Ints brick = brick_index(hn::ShiftRight<3>(clamp(cell.x, set_int(n_.x - 1))),
                                   hn::ShiftRight<3>(clamp(cell.y, set_int(n_.y - 1))),
                                   hn::ShiftRight<3>(clamp(cell.z, set_int(n_.z - 1))));
    const Ints bytes =
        hn::GatherOffset(i32, reinterpret_cast<const std::int32_t*>(occupancy_), brick);
    return hn::And(bytes, set_int(0xff));
  }

  /// The planes of 2^3 bricks, in the lanes of one vector: where all lanes lie in them, as those
  /// of neighbouring rays do, eight reads take the place of many gathers.
  struct NearPlanes {
    Int3 first;
    Ints table;

    HWY_INLINE Ints at(Ints bx, Ints by, Ints bz) const {
#if SLAMBENCH_EIGHT_LANES
      const Ints x = hn::Sub(bx, set_int(first.x));
      const Ints y = hn::Sub(by, set_int(first.y)), z = hn::Sub(bz, set_int(first.z));
      const Ints entry = hn::Add(hn::Add(x, hn::ShiftLeft<1>(y)), hn::ShiftLeft<2>(z));
      return hn::TableLookupLanes(table, hn::IndicesFromVec(i32, entry));
#else
      (void)bx, (void)by, (void)bz;
      return table;
#endif
    }
  };

  /// Fills `near` when all bricks between the lower and the upper ones are within 2^3.
  HWY_INLINE bool find_near(Ints low_x, Ints low_y, Ints low_z, Ints high_x, Ints high_y,
                            Ints high_z, NearPlanes* near) const {
#if SLAMBENCH_EIGHT_LANES
    const Int3 first = {hn::GetLane(hn::MinOfLanes(i32, low_x)),
                        hn::GetLane(hn::MinOfLanes(i32, low_y)),
                        hn::GetLane(hn::MinOfLanes(i32, low_z))};
    const Ints farthest =
        hn::Max(hn::Max(hn::Sub(high_x, set_int(first.x)), hn::Sub(high_y, set_int(first.y))),
                hn::Sub(high_z, set_int(first.z)));
    if (!hn::AllTrue(i32, hn::Lt(farthest, set_int(2)))) return false;
    const int step_x = first.x + 1 < bricks_.x ? 1 : 0;
    const int step_y = first.y + 1 < bricks_.y ? bricks_.x : 0;
    const int step_z = first.z + 1 < bricks_.z ? bricks_.x * bricks_.y : 0;
    const std::int32_t* corner =
        planes_ + (static_cast<std::ptrdiff_t>(first.z) * bricks_.y + first.y) * bricks_.x +
        first.x;
    alignas(64) std::int32_t around[virtual_lanes] = {};
    for (int i = 0; i < 8; ++i) {
      around[i] = corner[(i & 1) * step_x + ((i >> 1) & 1) * step_y + (i >> 2) * step_z];
    }
    near->first = first;
    near->table = hn::Load(i32, around);
    return true;
#else
    (void)low_x, (void)low_y, (void)low_z, (void)high_x, (void)high_y, (void)high_z, (void)near;
    return false;
#endif
  }

  /// The values at voxels of four positions along each axis, but for the corners and edges of that
  /// cube.
  HWY_INLINE void around(const Ints* x, const Ints* y, const Ints* z, Floats (*value)[4][4]) const {
    Ints bx[4], by[4], bz[4];
    for (int i = 0; i < 4; ++i) {
      bx[i] = hn::ShiftRight<3>(x[i]);
      by[i] = hn::ShiftRight<3>(y[i]);
      bz[i] = hn::ShiftRight<3>(z[i]);
    }
    NearPlanes near;
    const bool is_near = find_near(bx[0], by[0], bz[0], bx[3], by[3], bz[3], &near);
    for_gradient([&](int i, int j, int k) {
      const Ints plane = is_near ? near.at(bx[i], by[j], bz[k]) : plane_of(bx[i], by[j], bz[k]);
      value[k][j][i] = hn::ConvertTo(f32, low_half(pair_at(plane, x[i], row_in(y[j], z[k]))));
    });
  }

  HWY_INLINE CornerValues corners(const CellLanes& cell) const {
    const Ints bx[2] = {hn::ShiftRight<3>(cell.x[0]), hn::ShiftRight<3>(cell.x[1])};
    const Ints by[2] = {hn::ShiftRight<3>(cell.y[0]), hn::ShiftRight<3>(cell.y[1])};
    const Ints bz[2] = {hn::ShiftRight<3>(cell.z[0]), hn::ShiftRight<3>(cell.z[1])};
    const bool across_x = !hn::AllTrue(i32, hn::Eq(bx[0], bx[1]));
    const bool across_y = !hn::AllTrue(i32, hn::Eq(by[0], by[1]));
    const bool across_z = !hn::AllTrue(i32, hn::Eq(bz[0], bz[1]));
    // Where the upper x is clamped to the lower one, both values of the pair are the lower.
    const auto apart = hn::Ne(cell.x[0], cell.x[1]);

    CornerValues values;
    Ints plane[2][2], other[2][2];
    if (!near_planes(bx, by, bz, across_x, plane, other)) {
      planes_around(bx[0], by, bz, across_y, across_z, plane);
      planes_around(bx[1], by, bz, across_y && across_x, across_z && across_x, other);
    }
    for (int z = 0; z < 2; ++z) {
      for (int y = 0; y < 2; ++y) {
        const Ints row = row_in(cell.y[y], cell.z[z]);
        const Ints pair = pair_at(plane[z][y], cell.x[0], row);
        const Ints lower = low_half(pair);
        const Ints upper = across_x ? low_half(pair_at(other[z][y], cell.x[1], row))
                                    : hn::IfThenElse(apart, hn::ShiftRight<16>(pair), lower);
        values.v[z][y][0] = hn::ConvertTo(f32, lower);
        values.v[z][y][1] = hn::ConvertTo(f32, upper);
      }
    }
    return values;
  }

 private:
  /// The planes of the bricks of the cell's corners, [z][y], at the lower and upper x, where all
  /// lanes lie within two bricks along each axis. False where they do not.
  HWY_INLINE bool near_planes(const Ints* bx, const Ints* by, const Ints* bz, bool across_x,
                              Ints (*plane)[2], Ints (*other)[2]) const {
    NearPlanes near;
    if (!find_near(bx[0], by[0], bz[0], bx[1], by[1], bz[1], &near)) return false;
    for (int k = 0; k < 2; ++k) {
      for (int j = 0; j < 2; ++j) {
        plane[k][j] = near.at(bx[0], by[j], bz[k]);
        if (across_x) other[k][j] = near.at(bx[1], by[j], bz[k]);
      }
    }
    return true;
  }
  /// The planes of the bricks of the cell's corners, [z][y], at one x; equal ones are read once.
  HWY_INLINE void planes_around(Ints bx, const Ints* by, const Ints* bz, bool across_y,
                                bool across_z, Ints (*plane)[2]) const {
    plane[0][0] = plane_of(bx, by[0], bz[0]);
    plane[0][1] = across_y ? plane_of(bx, by[1], bz[0]) : plane[0][0];
    plane[1][0] = across_z ? plane_of(bx, by[0], bz[1]) : plane[0][0];
    plane[1][1] = plane[1][0];
    if (across_y) plane[1][1] = across_z ? plane_of(bx, by[1], bz[1]) : plane[0][1];
  }
  HWY_INLINE Ints brick_index(Ints bx, Ints by, Ints bz) const {
    const Ints row = hn::Add(hn::Mul(bz, set_int(bricks_.y)), by);
    return hn::Add(hn::Mul(row, set_int(bricks_.x)), bx);
  }
  HWY_INLINE Ints plane_of(Ints bx, Ints by, Ints bz) const {
    return hn::GatherIndex(i32, planes_, brick_index(bx, by, bz));
  }
  static HWY_INLINE Ints row_in(Ints y, Ints z) {
    const Ints low = set_int(BrickVolume::edge - 1);
    return hn::Or(hn::ShiftLeft<6>(hn::And(z, low)), hn::ShiftLeft<3>(hn::And(y, low)));
  }
  /// The value at x of a plane's row, and above it the next one.
  HWY_INLINE Ints pair_at(Ints plane, Ints x, Ints row) const {
    const Ints in_plane = hn::Or(row, hn::And(x, set_int(BrickVolume::edge - 1)));
    const Ints value = hn::Add(hn::ShiftLeft<9>(plane), in_plane);
    return hn::GatherOffset(i32, reinterpret_cast<const std::int32_t*>(values_),
                            hn::Add(value, value));
  }

  const std::int32_t* planes_;
  const std::int16_t* values_;
  const std::uint8_t* occupancy_;
  Int3 bricks_, n_;
  Float3 size_m_;
};

/// slambench::interpolate at the cell.
template <class Map>
HWY_INLINE Floats interpolate(const Map& map, const CellBase& base) {
  const Int3 n = map.resolution();
  const Ints one = set_int(1);
  const auto pair = [&](Ints i, int count, Ints* out) {
    out[0] = clamp(i, set_int(count - 1));
    out[1] = clamp(hn::Add(i, one), set_int(count - 1));
  };
  CellLanes cell;
  pair(base.x, n.x, cell.x);
  pair(base.y, n.y, cell.y);
  pair(base.z, n.z, cell.z);
  const CornerValues c = map.corners(cell);
  const Vec3 f = base.fraction;
  const Floats front =
      lerp(lerp(c.v[0][0][0], c.v[0][0][1], f.x), lerp(c.v[0][1][0], c.v[0][1][1], f.x), f.y);
  const Floats back =
      lerp(lerp(c.v[1][0][0], c.v[1][0][1], f.x), lerp(c.v[1][1][0], c.v[1][1][1], f.x), f.y);
  return hn::Mul(lerp(front, back, f.z), set(1.0f / tsdf_scale));
}

/// slambench::gradient.
template <class Map>
HWY_NOINLINE Vec3 gradient(const Map& map, Vec3 p) {
  const Int3 n = map.resolution();
  const CellBase base = cell_base(n, map.size_m(), p);
  // The four voxels along each axis, clamped.
  Ints x[4], y[4], z[4];
  for (int i = 0; i < 4; ++i) {
    x[i] = clamp(hn::Add(base.x, set_int(i - 1)), set_int(n.x - 1));
    y[i] = clamp(hn::Add(base.y, set_int(i - 1)), set_int(n.y - 1));
    z[i] = clamp(hn::Add(base.z, set_int(i - 1)), set_int(n.z - 1));
  }
  Floats value[4][4][4];
  map.around(x, y, z, value);
  const Floats one = set(1.0f);
  Vec3 sum = {hn::Zero(f32), hn::Zero(f32), hn::Zero(f32)};
  for (int corner = 0; corner < 8; ++corner) {
    const int i = (corner & 1) + 1, j = ((corner >> 1) & 1) + 1, k = (corner >> 2) + 1;
    const Vec3 f = base.fraction;
    const Floats weight =
        hn::Mul(hn::Mul(i == 2 ? f.x : hn::Sub(one, f.x), j == 2 ? f.y : hn::Sub(one, f.y)),
                k == 2 ? f.z : hn::Sub(one, f.z));
    sum.x = hn::Add(sum.x, hn::Mul(weight, hn::Sub(value[k][j][i + 1], value[k][j][i - 1])));
    sum.y = hn::Add(sum.y, hn::Mul(weight, hn::Sub(value[k][j + 1][i], value[k][j - 1][i])));
    sum.z = hn::Add(sum.z, hn::Mul(weight, hn::Sub(value[k + 1][j][i], value[k - 1][j][i])));
  }
  const Float3 voxel_m = voxel_size(n, map.size_m());
  const Floats scale = set(0.5f / tsdf_scale);
  return {hn::Div(hn::Mul(sum.x, scale), set(voxel_m.x)),
          hn::Div(hn::Mul(sum.y, scale), set(voxel_m.y)),
          hn::Div(hn::Mul(sum.z, scale), set(voxel_m.z))};
}

/// slambench::clip_axis.
HWY_INLINE void clip_axis(float origin, Floats direction, float size, Floats* near_t,
                          Floats* far_t) {
  const Floats a = hn::Div(set(0.0f - origin), direction);
  const Floats b = hn::Div(set(size - origin), direction);
  const FloatMask along = hn::Eq(direction, hn::Zero(f32));
  const Floats nearer = hn::Max(*near_t, hn::Min(a, b)), farther = hn::Min(*far_t, hn::Max(a, b));
  const bool outside = origin < 0.0f || origin > size;
  *far_t = hn::IfThenElse(along, outside ? *near_t : *far_t, farther);
  *near_t = hn::IfThenElse(along, *near_t, nearer);
}

/// Whether the sample of any active lane can be other than +1.
template <class Map>
HWY_INLINE bool can_be_other(const Map& map, const CellBase& cell, FloatMask active) {
  const auto occupied = hn::Ne(map.occupied(cell), hn::Zero(i32));
  return !hn::AllFalse(i32, hn::And(occupied, hn::RebindMask(i32, active)));
}

/// slambench::find_surface of the active lanes; the hits' lanes of `hit` are set.
template <class Map>
HWY_INLINE FloatMask find_surface(const Map& map, Float3 origin, Vec3 direction,
                                  const RaycastParameters& p, float start_m, FloatMask active,
                                  Vec3* hit) {
  const Int3 n = map.resolution();
  const Float3 size_m = map.size_m();
  Floats t = set(p.near_m), far_t = set(p.far_m);
  clip_axis(origin.x, direction.x, size_m.x, &t, &far_t);
  clip_axis(origin.y, direction.y, size_m.y, &t, &far_t);
  clip_axis(origin.z, direction.z, size_m.z, &t, &far_t);
  active = hn::And(active, hn::Lt(t, far_t));

  const Vec3 start = set(origin);
  const Floats zero = hn::Zero(f32);
  const Floats slow_below = set(p.slow_below), small_step = set(p.small_step_m);
  Floats step = set(p.large_step_m), previous = set(1.0f), previous_t = t, hit_t = zero;
  FloatMask hits = hn::Lt(zero, zero);
  bool first = true, skipped = false;
  if constexpr (Map::skips) {
    // No sample before the start depth but +1: the march adds up the same depths without them.
    while (!hn::AllFalse(f32, active) &&
           hn::AllTrue(f32, hn::Or(hn::Not(active), hn::Lt(hn::Add(t, step), set(start_m))))) {
      skipped = true;
      previous_t = t;
      t = hn::Add(t, step);
      active = hn::And(active, hn::Lt(t, far_t));
    }
    first = !skipped;
  }
  while (!hn::AllFalse(f32, active)) {
    CellBase cell = cell_base(n, size_m, add(start, mul(direction, t)));
    if constexpr (Map::skips) {
      // In the band there is nothing to skip.
      const bool in_band = !hn::AllFalse(f32, hn::And(active, hn::Lt(previous, set(0.99f))));
      if (!in_band && !can_be_other(map, cell, active)) {
        // Every sample here is +1: the march goes on as if each had been taken.
        first = false;
        skipped = true;
        previous_t = t;
        t = hn::Add(t, step);
        active = hn::And(active, hn::Lt(t, far_t));
        continue;
      }
    }
    const Floats value = interpolate(map, cell);
    if (first) {
      active = hn::And(active, hn::Gt(value, zero));  // else the ray starts behind a surface
      previous = value;
      first = false;
    }
    const FloatMask crossing = hn::And(active, hn::Lt(value, zero));
    if (!hn::AllFalse(f32, crossing)) {
      if (skipped) {
        previous = interpolate(map, cell_base(n, size_m, add(start, mul(direction, previous_t))));
      }
      const Floats back = hn::Div(hn::Mul(step, value), hn::Sub(previous, value));
      hit_t = hn::IfThenElse(crossing, hn::Add(t, back), hit_t);
      hits = hn::Or(hits, crossing);
      active = hn::AndNot(crossing, active);
    }
    step = hn::IfThenElse(hn::Lt(value, slow_below), small_step, step);
    skipped = false;
    previous = value;
    t = hn::IfThenElse(active, hn::Add(t, step), t);  // lanes that are done stay near the others
    active = hn::And(active, hn::Lt(t, far_t));
  }
  *hit = add(start, mul(direction, hit_t));
  return hits;
}

/// A packet of rays: columns x columns' worth of lanes, from pixel (x, y) on.
constexpr int packet_width() { return lanes() < 4 ? lanes() : 4; }
constexpr int packet_height() { return lanes() / packet_width(); }

template <class Map>
HWY_INLINE void raycast_packet(const Map& map, const RaycastParameters& p, const RaycastOutput& out,
                               int x0, int y0, int y_end) {
  const Ints lane = hn::Iota(i32, 0);
  const Ints column = hn::And(lane, set_int(packet_width() - 1));
  const Ints row = hn::ShiftRight < packet_width() == 4 ? 2 : packet_width() == 2 ? 1 : 0 > (lane);
  const Ints x = hn::Add(column, set_int(x0)), y = hn::Add(row, set_int(y0));
  FloatMask active =
      hn::RebindMask(f32, hn::And(hn::Lt(x, set_int(out.size.width)), hn::Lt(y, set_int(y_end))));
  const Vec3 ray = {hn::Div(hn::Sub(hn::ConvertTo(f32, x), set(p.camera.cx)), set(p.camera.fx)),
                    hn::Div(hn::Sub(hn::ConvertTo(f32, y), set(p.camera.cy)), set(p.camera.fy)),
                    set(1.0f)};
  const int width = std::min(packet_width(), out.size.width - x0);
  const int height = std::min(packet_height(), y_end - y0);
  const auto pixel = [&](int dx, int dy) {
    return static_cast<std::size_t>(y0 + dy) * static_cast<std::size_t>(out.size.width) +
           static_cast<std::size_t>(x0 + dx);
  };
  alignas(64) std::int32_t wanted[virtual_lanes] = {};
  for (int dy = 0; dy < height; ++dy) {
    for (int dx = 0; dx < width; ++dx) {
      wanted[dy * packet_width() + dx] =
          !out.only_misses || out.normals[pixel(dx, dy)].x == invalid_normal ? 1 : 0;
    }
  }
  active = hn::And(active, hn::RebindMask(f32, hn::Ne(hn::Load(i32, wanted), hn::Zero(i32))));
  if (hn::AllFalse(f32, active)) return;

  const Vec3 none = {hn::Zero(f32), hn::Zero(f32), hn::Zero(f32)};
  Vec3 vertex = none, normal = set(Float3{invalid_normal, 0.0f, 0.0f});
  Vec3 hit;
  const FloatMask hits =
      find_surface(map, p.T_volume_camera.translation, rotate(p.T_volume_camera, ray), p,
                   out.start != nullptr ? out.start->at(x0, y0) : 0, active, &hit);
  if (!hn::AllFalse(f32, hits)) {
    vertex = select(hits, hit, none);
    const Vec3 slope = gradient(map, vertex);
    const Floats norm = length(slope);
    const FloatMask sloped = hn::And(hits, hn::Gt(norm, hn::Zero(f32)));
    normal = select(sloped, mul(slope, hn::Div(set(1.0f), norm)), normal);
  }
  Float3 vertices[virtual_lanes], normals[virtual_lanes];
  store(vertex, vertices);
  store(normal, normals);
  for (int dy = 0; dy < height; ++dy) {
    for (int dx = 0; dx < width; ++dx) {
      const int i = dy * packet_width() + dx;
      if (wanted[i] == 0) continue;
      out.vertices[pixel(dx, dy)] = vertices[i];
      out.normals[pixel(dx, dy)] = normals[i];
    }
  }
}

template <class Map>
void raycast(const Map& map, const RaycastParameters& p, const RaycastOutput& out, Rows rows) {
  for (int y = rows.begin; y < rows.end; y += packet_height()) {
    for (int x = 0; x < out.size.width; x += packet_width()) {
      raycast_packet(map, p, out, x, y, rows.end);
    }
  }
}

void raycast_grid(const GridView& map, const RaycastParameters& p, const RaycastOutput& out,
                  Rows rows) {
  raycast(GridLanes(map), p, out, rows);
}

void raycast_bricks(const BrickView& map, const RaycastParameters& p, const RaycastOutput& out,
                    Rows rows) {
  raycast(BrickLanes(map), p, out, rows);
}

/// slambench::shade.
void shade_lanes(Rgba8* image, const Float3* vertices, const Float3* normals,
                 const ShadeParameters& p) {
  const Vec3 normal = load(normals), to_light = sub(set(p.light_m), load(vertices));
  const Vec3 direction = mul(to_light, hn::Div(set(1.0f), length(to_light)));
  const Floats zero = hn::Zero(f32);
  const Floats lambert = hn::Max(dot(normal, direction), zero);
  const Floats bright = hn::Max(zero, hn::Min(set(1.0f), hn::Add(lambert, set(p.ambient))));
  const auto lit = hn::RebindMask(i32, hn::Ne(normal.x, set(invalid_normal)));
  const Ints grey = hn::IfThenElseZero(lit, hn::ConvertTo(i32, hn::Mul(bright, set(255.0f))));
  alignas(64) std::int32_t greys[virtual_lanes];
  hn::Store(grey, i32, greys);
  for (int i = 0; i < lanes(); ++i) {
    const auto g = static_cast<std::uint8_t>(greys[i]);
    image[i] = {g, g, g, 255};
  }
}

void shade_pixels(Rgba8* image, const Float3* vertices, const Float3* normals, Size size,
                  const ShadeParameters& p, Rows rows) {
  const auto width = static_cast<std::size_t>(size.width);
  std::size_t i = static_cast<std::size_t>(rows.begin) * width;
  const std::size_t end = static_cast<std::size_t>(rows.end) * width;
  for (; i + static_cast<std::size_t>(lanes()) <= end; i += static_cast<std::size_t>(lanes())) {
    shade_lanes(image + i, vertices + i, normals + i, p);
  }
  for (; i < end; ++i) image[i] = shade(vertices[i], normals[i], p);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace slambench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace slambench {

HWY_EXPORT(raycast_grid);
HWY_EXPORT(raycast_bricks);
HWY_EXPORT(shade_pixels);

void raycast_rows(const RaycastOutput& output, const GridView& map,
                  const RaycastParameters& parameters, Rows rows) {
  HWY_DYNAMIC_DISPATCH(raycast_grid)(map, parameters, output, rows);
}

void raycast_rows(const RaycastOutput& output, const BrickView& map,
                  const RaycastParameters& parameters, Rows rows) {
  HWY_DYNAMIC_DISPATCH(raycast_bricks)(map, parameters, output, rows);
}

void shade_rows(Rgba8* image, const Float3* vertices, const Float3* normals, Size size,
                const ShadeParameters& parameters, Rows rows) {
  HWY_DYNAMIC_DISPATCH(shade_pixels)(image, vertices, normals, size, parameters, rows);
}

bool raycast_reaches(const GridView& map) {
  const double voxels = 1.0 * map.resolution.x * map.resolution.y * map.resolution.z;
  return voxels <= std::numeric_limits<std::int32_t>::max();
}

bool raycast_reaches(const BrickView& map) {
  const std::size_t most = std::numeric_limits<std::int32_t>::max();
  return map.volume->planes_used() <= most / PlanePool::plane_bytes && map.volume->count() <= most;
}

}  // namespace slambench
#endif
