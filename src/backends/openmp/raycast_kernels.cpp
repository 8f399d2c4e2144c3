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

// Whether a vector can hold a table of eight entries, and of sixteen: Highway numbers the better
// targets of x86 lower, and those of others higher.
#undef SLAMBENCH_EIGHT_LANES
#undef SLAMBENCH_SIXTEEN_LANES
#define SLAMBENCH_EIGHT_LANES (HWY_TARGET <= HWY_AVX2)
#define SLAMBENCH_SIXTEEN_LANES (HWY_TARGET <= HWY_AVX3)

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
  return truncated(base);
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
  static HWY_INLINE bool near_corners(const CellBase&, FloatMask, CornerValues*) { return false; }

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

  BrickLanes(const BrickView& view, int skip_level)
      : planes_(view.volume->plane_table()),
        values_(view.volume->planes()),
        levels_(view.volume->sample_levels()),
        skip_level_(skip_level),
        bricks_(view.volume->bricks()),
        parts_(view.volume->parts()),
        n_(view.resolution),
        size_m_(view.size_m) {
    const int row = bricks_.x, slice = bricks_.x * bricks_.y;
    for (int i = 0; i < 8; ++i) {
      around_[i] = (i & 1) + ((i >> 1) & 1) * row + (i >> 2) * slice;
    }
  }

  Int3 resolution() const { return n_; }
  Float3 size_m() const { return size_m_; }

  /// Where a sample in the cell need not be taken.
  HWY_INLINE hn::Mask<IntTag> skippable(const CellBase& cell) const {
    static_assert(BrickVolume::part_edge == 4);
    const Ints part = index_in(parts_, hn::ShiftRight<2>(clamp(cell.x, set_int(n_.x - 1))),
                               hn::ShiftRight<2>(clamp(cell.y, set_int(n_.y - 1))),
                               hn::ShiftRight<2>(clamp(cell.z, set_int(n_.z - 1))));
    const Ints bytes = hn::GatherOffset(i32, reinterpret_cast<const std::int32_t*>(levels_), part);
    return hn::Gt(hn::And(bytes, set_int(0xff)), set_int(skip_level_ - 1));
  }

  /// The values at voxels of four positions along each axis, but for the corners and edges of that
  /// cube.
  HWY_INLINE void around(const Ints* x, const Ints* y, const Ints* z, Floats (*value)[4][4]) const {
    Ints by[4], bz[4];
    for (int i = 0; i < 4; ++i) by[i] = hn::ShiftRight<3>(y[i]), bz[i] = hn::ShiftRight<3>(z[i]);
    const Ints bx[3] = {hn::ShiftRight<3>(x[0]), hn::ShiftRight<3>(x[1]), hn::ShiftRight<3>(x[2])};
    const NearPlanes near = find_near(bx[0], by[0], bz[0], hn::ShiftRight<3>(x[3]), by[3], bz[3]);
    const auto pair = [&](int i, int j, int k) {
      const Ints plane = near.found ? near.at(bx[i], by[j], bz[k]) : plane_of(bx[i], by[j], bz[k]);
      pair_at(plane, x[i], x[i + 1], row_in(y[j], z[k]), &value[k][j][i], &value[k][j][i + 1]);
    };
    for (int inner = 0; inner < 4; ++inner) {
      const int a = 1 + (inner & 1), b = 1 + (inner >> 1);
      pair(0, a, b);
      pair(2, a, b);
      pair(1, 3 * (inner & 1), b);
      pair(1, a, 3 * (inner >> 1));
    }
  }

  HWY_INLINE CornerValues corners(const CellLanes& cell) const {
    const Ints bx = hn::ShiftRight<3>(cell.x[0]);
    const Ints by[2] = {hn::ShiftRight<3>(cell.y[0]), hn::ShiftRight<3>(cell.y[1])};
    const Ints bz[2] = {hn::ShiftRight<3>(cell.z[0]), hn::ShiftRight<3>(cell.z[1])};
    const NearPlanes near = find_near(bx, by[0], bz[0], bx, by[1], bz[1]);
    CornerValues values;
    for (int k = 0; k < 2; ++k) {
      for (int j = 0; j < 2; ++j) {
        const Ints plane = near.found ? near.at(bx, by[j], bz[k]) : plane_of(bx, by[j], bz[k]);
        pair_at(plane, cell.x[0], cell.x[1], row_in(cell.y[j], cell.z[k]), &values.v[k][j][0],
                &values.v[k][j][1]);
      }
    }
    return values;
  }

  /// The corners for the lanes `wanted`, where all their cells lie within 3^3, as those of
  /// neighbouring rays do, and not at the volume's border along x: 4^3 voxels are read once for all
  /// lanes instead of eight for each. False where they do not.
  HWY_INLINE bool near_corners(const CellBase& cell, FloatMask wanted, CornerValues* values) const {
#if SLAMBENCH_SIXTEEN_LANES
    const CellOffsets offset(cell, hn::RebindMask(i32, wanted));
    const int first_x = offset.within ? hn::GetLane(offset.first.x) : -1;
    if (first_x < 0 || first_x + 3 >= n_.x) return false;
    const VoxelBlock block = read_block(offset.first, first_x);
    const Ints first =
        hn::Add(offset.x, hn::Add(hn::ShiftLeft<2>(offset.y), hn::ShiftLeft<4>(offset.z)));
    for (int k = 0; k < 2; ++k) {
      for (int j = 0; j < 2; ++j) {
        const Ints pair = block.pair(hn::Add(first, set_int(16 * k + 4 * j)));
        values->v[k][j][0] = hn::ConvertTo(f32, low_half(pair));
        values->v[k][j][1] = hn::ConvertTo(f32, hn::ShiftRight<16>(pair));
      }
    }
    return true;
#else
    (void)cell, (void)wanted, (void)values;
    return false;
#endif
  }

 private:
  /// The planes of 2^3 bricks, in the lanes of one vector: where all lanes lie in them, as those
  /// of neighbouring rays do, one small gather takes the place of many large ones.
  struct NearPlanes {
    bool found = false;
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

#if SLAMBENCH_SIXTEEN_LANES
  /// From a voxel, the same in all lanes, on: x, y and z are within [0, 2] in the lanes of interest
  /// if they can be.
  struct CellOffsets {
    bool within = false;
    struct {
      Ints x, y, z;
    } first;
    Ints x, y, z;

    HWY_INLINE CellOffsets(const CellBase& cell, hn::Mask<IntTag> of_interest) {
      const auto none = [&](hn::Mask<IntTag> mask) {
        return hn::AllFalse(i32, hn::And(of_interest, mask));
      };
      // From two before one of the lanes on, an axis a byte.
      const auto one =
          hn::IndicesFromVec(i32, set_int(static_cast<int>(hn::FindFirstTrue(i32, of_interest))));
      const auto before = [&](Ints i) { return hn::Sub(hn::TableLookupLanes(i, one), set_int(2)); };
      const Ints x0 = before(cell.x), y0 = before(cell.y), z0 = before(cell.z);
      const Ints dx = hn::Sub(cell.x, x0), dy = hn::Sub(cell.y, y0), dz = hn::Sub(cell.z, z0);
      const Ints three_bits = set_int(7);
      if (!none(hn::Ne(hn::AndNot(three_bits, hn::Or(hn::Or(dx, dy), dz)), hn::Zero(i32)))) return;
      const Ints bytes = hn::Or(hn::Or(dx, hn::ShiftLeft<8>(dy)), hn::ShiftLeft<16>(dz));
      const Ints least =
          least_bytes_everywhere(hn::IfThenElse(of_interest, bytes, set_int(0x070707)));
      const Ints offset = hn::Sub(bytes, least);
      // 0 to 2 become 1 to 3.
      const Ints more = hn::AndNot(set_int(0x030303), hn::Add(offset, set_int(0x010101)));
      within = none(hn::Ne(more, hn::Zero(i32)));
      const Ints byte = set_int(0xff);
      first = {hn::Add(x0, hn::And(least, byte)),
               hn::Add(y0, hn::And(hn::ShiftRight<8>(least), byte)),
               hn::Add(z0, hn::ShiftRight<16>(least))};
      x = hn::And(offset, byte), y = hn::And(hn::ShiftRight<8>(offset), byte);
      z = hn::ShiftRight<16>(offset);
    }

    /// The least of all lanes for each of their four bytes, in all lanes.
    static HWY_INLINE Ints least_bytes_everywhere(Ints v) {
      const hn::Repartition<std::uint8_t, IntTag> u8;
      const auto least = [&](Ints a, Ints b) {
        return hn::BitCast(i32, hn::Min(hn::BitCast(u8, a), hn::BitCast(u8, b)));
      };
      v = least(v, hn::ReverseBlocks(i32, v));
      v = least(v, hn::SwapAdjacentBlocks(v));
      v = least(v, hn::Shuffle1032(v));
      return least(v, hn::Shuffle2301(v));
    }
  };

  /// 4^3 voxels, x fastest, in 16 bits each.
  struct VoxelBlock {
    Ints low, high;

    /// Of the `first`-th voxel and the next one.
    HWY_INLINE Ints pair(Ints first) const {
      const Ints both = hn::Add(hn::Or(first, hn::ShiftLeft<16>(first)), set_int(1 << 16));
      return Ints{_mm512_permutex2var_epi16(low.raw, both.raw, high.raw)};
    }
  };

  /// The voxels from `first` on, whose x is `first_x`; y and z are clamped to the volume.
  template <class First>
  HWY_INLINE VoxelBlock read_block(const First& first, int first_x) const {
    // A row of four voxels a lane.
    const Ints row = hn::Iota(i32, 0);
    const Ints y = clamp(hn::Add(first.y, hn::And(row, set_int(3))), set_int(n_.y - 1));
    const Ints z = clamp(hn::Add(first.z, hn::ShiftRight<2>(row)), set_int(n_.z - 1));
    const Ints by = hn::ShiftRight<3>(y), bz = hn::ShiftRight<3>(z);
    // The rows' bricks are those of the first and last along y and z: lanes 0, 3, 12 and 15.
    const Ints brick = index_in(bricks_, set_int(first_x >> 3), by, bz);
    const __m128i corners = _mm512_castsi512_si128(_mm512_maskz_compress_epi32(0x9009, brick.raw));
    const auto others = [&](Ints b) {
      return hn::Sub(b, Ints{_mm512_broadcastd_epi32(_mm512_castsi512_si128(b.raw))});
    };
    const Ints which = hn::Add(others(by), hn::ShiftLeft<1>(others(bz)));
    const auto starts = [&](int next) {
      const __m128i plane = _mm_i32gather_epi32(planes_ + next, corners, 4);
      const Ints planes =
          hn::TableLookupLanes(Ints{_mm512_castsi128_si512(plane)}, hn::IndicesFromVec(i32, which));
      return hn::Add(hn::Add(hn::ShiftLeft<9>(planes), hn::ShiftLeft<6>(planes)), row_in(y, z));
    };
    const int in_row = first_x & (BrickVolume::edge - 1);
    const Ints start = hn::Add(starts(0), set_int(in_row));
    if (in_row + 3 < BrickVolume::row_values) {
      const __m256i lower = _mm512_castsi512_si256(start.raw);
      const __m256i upper = _mm512_extracti64x4_epi64(start.raw, 1);
      return {Ints{_mm512_i32gather_epi64(lower, values_, 2)},
              Ints{_mm512_i32gather_epi64(upper, values_, 2)}};
    }
    const Ints next = hn::Add(starts(1), set_int(in_row + 2 - BrickVolume::edge));
    const Ints pairs = Ints{_mm512_i32gather_epi32(start.raw, values_, 2)};
    const Ints next_pairs = Ints{_mm512_i32gather_epi32(next.raw, values_, 2)};
    const auto interleaved = [&](int from) {
      const Ints index =
          hn::Add(hn::ShiftRight<1>(row), hn::ShiftLeft<4>(hn::And(row, set_int(1))));
      return Ints{
          _mm512_permutex2var_epi32(pairs.raw, hn::Add(index, set_int(from)).raw, next_pairs.raw)};
    };
    return {interleaved(0), interleaved(8)};
  }
#endif

  /// Found when all bricks between the lower and the upper ones are within 2^3.
  HWY_INLINE NearPlanes find_near(Ints low_x, Ints low_y, Ints low_z, Ints high_x, Ints high_y,
                                  Ints high_z) const {
    NearPlanes near;
#if SLAMBENCH_EIGHT_LANES
    const int most = std::max({bricks_.x, bricks_.y, bricks_.z});
    if (most > 256 || std::min({bricks_.x, bricks_.y, bricks_.z}) < 2) return near;
    // Bytes of a lane hold the bricks along the axes: all axes are reduced at once.
    const auto pack = [](Ints x, Ints y, Ints z) {
      return hn::Or(hn::Or(x, hn::ShiftLeft<8>(y)), hn::ShiftLeft<16>(z));
    };
    const std::uint32_t low = least_bytes(pack(low_x, low_y, low_z));
    const std::uint32_t high = ~least_bytes(hn::Not(pack(high_x, high_y, high_z)));
    near.first = {std::min<int>(low & 0xff, bricks_.x - 2),
                  std::min<int>(low >> 8 & 0xff, bricks_.y - 2),
                  std::min<int>(low >> 16 & 0xff, bricks_.z - 2)};
    // No byte is less than that of `low`: nothing is borrowed.
    near.found = ((high - low) & 0xfefefe) == 0;
    const std::int32_t* corner =
        planes_ +
        (static_cast<std::ptrdiff_t>(near.first.z) * bricks_.y + near.first.y) * bricks_.x +
        near.first.x;
    const hn::CappedTag<std::int32_t, 8> eight;
    const auto planes = hn::GatherIndex(eight, corner, hn::Load(eight, around_));
#if SLAMBENCH_SIXTEEN_LANES
    near.table = hn::ZeroExtendVector(i32, planes);
#else
    near.table = planes;
#endif
#else
    (void)low_x, (void)low_y, (void)low_z, (void)high_x, (void)high_y, (void)high_z;
#endif
    return near;
  }

#if SLAMBENCH_EIGHT_LANES
  /// The least of all lanes for each of their four bytes.
  static HWY_INLINE std::uint32_t least_bytes(Ints packed) {
    const hn::CappedTag<std::uint8_t, 16> u8;
    const hn::CappedTag<std::uint32_t, 4> u32;
    const auto lower = [](auto tag, auto v) {
      const hn::Half<decltype(tag)> half;
      return hn::Min(hn::LowerHalf(half, v), hn::UpperHalf(half, v));
    };
    const hn::Repartition<std::uint8_t, IntTag> all;
#if SLAMBENCH_SIXTEEN_LANES
    const auto half = lower(all, hn::BitCast(all, packed));
    auto least = lower(hn::Half<decltype(all)>(), half);
#else
    auto least = lower(all, hn::BitCast(all, packed));
#endif
    least = hn::Min(least, hn::BitCast(u8, hn::Shuffle1032(hn::BitCast(u32, least))));
    least = hn::Min(least, hn::BitCast(u8, hn::Shuffle2301(hn::BitCast(u32, least))));
    return hn::GetLane(hn::BitCast(u32, least));
  }
#endif

  static HWY_INLINE Ints index_in(Int3 count, Ints x, Ints y, Ints z) {
    const Ints row = hn::Add(hn::Mul(z, set_int(count.y)), y);
    return hn::Add(hn::Mul(row, set_int(count.x)), x);
  }
  HWY_INLINE Ints plane_of(Ints bx, Ints by, Ints bz) const {
    return hn::GatherIndex(i32, planes_, index_in(bricks_, bx, by, bz));
  }
  /// Where a row starts in its plane.
  static HWY_INLINE Ints row_in(Ints y, Ints z) {
    const Ints low = set_int(BrickVolume::edge - 1);
    const Ints row = hn::Or(hn::ShiftLeft<3>(hn::And(z, low)), hn::And(y, low));
    return hn::Add(row, hn::ShiftLeft<3>(row));
  }
  /// The values at x and at the next x, which is the same at the volume's border.
  HWY_INLINE void pair_at(Ints plane, Ints x, Ints next, Ints row, Floats* first,
                          Floats* second) const {
    static_assert(BrickVolume::plane_values == 512 + 64 && BrickVolume::row_values == 9);
    const Ints start = hn::Add(hn::ShiftLeft<9>(plane), hn::ShiftLeft<6>(plane));
    const Ints in_plane = hn::Add(row, hn::And(x, set_int(BrickVolume::edge - 1)));
    const Ints value = hn::Add(start, in_plane);
    const Ints pair = hn::GatherOffset(i32, reinterpret_cast<const std::int32_t*>(values_),
                                       hn::Add(value, value));
    const Ints lower = low_half(pair);
    *first = hn::ConvertTo(f32, lower);
    *second = hn::ConvertTo(f32, hn::IfThenElse(hn::Ne(x, next), hn::ShiftRight<16>(pair), lower));
  }

  const std::int32_t* planes_;
  const std::int16_t* values_;
  const std::uint8_t* levels_;
  int skip_level_;
  Int3 bricks_, parts_, n_;
  Float3 size_m_;
  alignas(32) std::int32_t around_[8];  ///< from a brick to those of the 2^3 above it
};

/// The corners of each lane's cell, clamped to the volume.
template <class Map>
HWY_NOINLINE CornerValues corners_of(const Map& map, const CellBase& base) {
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
  return map.corners(cell);
}

/// slambench::interpolate at the cell in the lanes `wanted`, of which there are some.
template <class Map>
HWY_INLINE Floats interpolate(const Map& map, const CellBase& base, FloatMask wanted) {
  CornerValues c;
  if (!map.near_corners(base, wanted, &c)) c = corners_of(map, base);
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

/// slambench::find_surface of a packet of rays in progress.
struct March {
  Vec3 direction;
  Floats t, far_t, step, previous, previous_t;
  FloatMask active, hits;
  bool first = true, skipped = false;
  /// At the crossing.
  Floats hit_t, hit_step, hit_value, hit_previous;
};

template <class Map>
HWY_INLINE March start_march(const Map& map, Float3 origin, Vec3 direction,
                             const RaycastParameters& p, float start_m, FloatMask active) {
  const Float3 size_m = map.size_m();
  const Floats zero = hn::Zero(f32);
  March m;
  m.direction = direction;
  m.t = set(p.near_m), m.far_t = set(p.far_m);
  clip_axis(origin.x, direction.x, size_m.x, &m.t, &m.far_t);
  clip_axis(origin.y, direction.y, size_m.y, &m.t, &m.far_t);
  clip_axis(origin.z, direction.z, size_m.z, &m.t, &m.far_t);
  m.active = hn::And(active, hn::Lt(m.t, m.far_t));
  m.step = set(p.large_step_m), m.previous = set(1.0f), m.previous_t = m.t;
  m.hits = hn::Lt(zero, zero);
  m.hit_t = m.hit_step = m.hit_value = m.hit_previous = zero;
  if constexpr (Map::skips) {
    // No sample before the start depth is needed: the march adds up the same depths without them.
    while (
        !hn::AllFalse(f32, m.active) &&
        hn::AllTrue(f32, hn::Or(hn::Not(m.active), hn::Lt(hn::Add(m.t, m.step), set(start_m))))) {
      m.skipped = true;
      m.previous_t = m.t;
      m.t = hn::Add(m.t, m.step);
      m.active = hn::And(m.active, hn::Lt(m.t, m.far_t));
    }
    m.first = !m.skipped;
  }
  return m;
}

/// One sample of a march that has active lanes.
template <class Map>
HWY_INLINE void go_on(const Map& map, Float3 origin, const RaycastParameters& p, March* march) {
  March& m = *march;
  const auto cell_at = [&](Floats t) {
    return cell_base(map.resolution(), map.size_m(), add(set(origin), mul(m.direction, t)));
  };
  const CellBase cell = cell_at(m.t);
  const Floats slow_below = set(p.slow_below);
  if constexpr (Map::skips) {
    // In the band there is nothing to skip.
    if (hn::AllFalse(f32, hn::And(m.active, hn::Lt(m.previous, slow_below)))) {
      const auto taken = hn::AndNot(map.skippable(cell), hn::RebindMask(i32, m.active));
      if (hn::AllFalse(i32, taken)) {
        // No sample here would change the step or be a crossing.
        m.first = false;
        m.skipped = true;
        m.previous_t = m.t;
        m.t = hn::Add(m.t, m.step);
        m.active = hn::And(m.active, hn::Lt(m.t, m.far_t));
        return;
      }
    }
  }
  const Floats value = interpolate(map, cell, m.active), zero = hn::Zero(f32);
  if (m.first) {
    m.active = hn::And(m.active, hn::Gt(value, zero));  // else the ray starts behind a surface
    m.previous = value;
    m.first = false;
  }
  const FloatMask crossing = hn::And(m.active, hn::Lt(value, zero));
  if (m.skipped && !hn::AllFalse(f32, crossing))
    m.previous = interpolate(map, cell_at(m.previous_t), crossing);
  m.hit_t = hn::IfThenElse(crossing, m.t, m.hit_t);
  m.hit_step = hn::IfThenElse(crossing, m.step, m.hit_step);
  m.hit_value = hn::IfThenElse(crossing, value, m.hit_value);
  m.hit_previous = hn::IfThenElse(crossing, m.previous, m.hit_previous);
  m.hits = hn::Or(m.hits, crossing);
  m.active = hn::AndNot(crossing, m.active);
  m.step = hn::IfThenElse(hn::Lt(value, slow_below), set(p.small_step_m), m.step);
  m.skipped = false;
  m.previous = value;
  // Lanes that are done stay near the others.
  m.t = hn::IfThenElse(m.active, hn::Add(m.t, m.step), m.t);
  m.active = hn::And(m.active, hn::Lt(m.t, m.far_t));
}

HWY_INLINE Vec3 hit_of(const March& m, Float3 origin) {
  const Floats back =
      hn::Div(hn::Mul(m.hit_step, m.hit_value), hn::Sub(m.hit_previous, m.hit_value));
  return add(set(origin), mul(m.direction, hn::Add(m.hit_t, back)));
}

/// A packet of rays: columns x columns' worth of lanes.
constexpr int packet_width() { return lanes() < 4 ? lanes() : 4; }
constexpr int packet_height() { return lanes() / packet_width(); }

/// The pixels of a packet, from (x, y) on.
struct Packet {
  int x = 0, y = 0;
  int width = 0, height = 0;  ///< without what lies beyond the image: width 0 where all of it does
  alignas(64) std::int32_t wanted[virtual_lanes] = {};

  Packet(const RaycastOutput& out, int x0, int y0, int y_end)
      : x(x0),
        y(y0),
        width(std::clamp(out.size.width - x0, 0, packet_width())),
        height(std::min(packet_height(), y_end - y0)) {
    for_each([&](int lane, int dx, int dy) {
      wanted[lane] =
          !out.only_misses || out.normals[pixel(out, dx, dy)].x == invalid_normal ? 1 : 0;
    });
  }

  template <class F>
  HWY_INLINE void for_each(const F& f) const {
    for (int dy = 0; dy < height; ++dy) {
      for (int dx = 0; dx < width; ++dx) f(dy * packet_width() + dx, dx, dy);
    }
  }
  std::size_t pixel(const RaycastOutput& out, int dx, int dy) const {
    return static_cast<std::size_t>(y + dy) * static_cast<std::size_t>(out.size.width) +
           static_cast<std::size_t>(x + dx);
  }
  HWY_INLINE FloatMask active() const {
    return hn::RebindMask(f32, hn::Ne(hn::Load(i32, wanted), hn::Zero(i32)));
  }
  /// With depth 1.
  HWY_INLINE Vec3 rays(Intrinsics camera) const {
    const Ints lane = hn::Iota(i32, 0);
    constexpr int shift = packet_width() == 4 ? 2 : packet_width() == 2 ? 1 : 0;
    const Ints px = hn::Add(hn::And(lane, set_int(packet_width() - 1)), set_int(x));
    const Ints py = hn::Add(hn::ShiftRight<shift>(lane), set_int(y));
    return {hn::Div(hn::Sub(hn::ConvertTo(f32, px), set(camera.cx)), set(camera.fx)),
            hn::Div(hn::Sub(hn::ConvertTo(f32, py), set(camera.cy)), set(camera.fy)), set(1.0f)};
  }
  void write(const RaycastOutput& out, Vec3 vertex, Vec3 normal) const {
    Float3 vertices[virtual_lanes], normals[virtual_lanes];
    store(vertex, vertices);
    store(normal, normals);
    for_each([&](int lane, int dx, int dy) {
      if (wanted[lane] == 0) return;
      out.vertices[pixel(out, dx, dy)] = vertices[lane];
      out.normals[pixel(out, dx, dy)] = normals[lane];
    });
  }
};

template <class Map>
HWY_INLINE void finish_packet(const Map& map, Float3 origin, const RaycastOutput& out,
                              const Packet& packet, const March& march) {
  const Vec3 none = {hn::Zero(f32), hn::Zero(f32), hn::Zero(f32)};
  Vec3 vertex = none, normal = set(Float3{invalid_normal, 0.0f, 0.0f});
  if (!hn::AllFalse(f32, march.hits)) {
    vertex = select(march.hits, hit_of(march, origin), none);
    const Vec3 slope = gradient(map, vertex);
    const Floats norm = length(slope);
    const FloatMask sloped = hn::And(march.hits, hn::Gt(norm, hn::Zero(f32)));
    normal = select(sloped, mul(slope, hn::Div(set(1.0f), norm)), normal);
  }
  packet.write(out, vertex, normal);
}

/// Two packets side by side: a sample is a long chain of dependent steps, so that the processor
/// works on one packet's while it waits for the other's.
template <class Map>
HWY_INLINE void raycast_pair(const Map& map, const RaycastParameters& p, const RaycastOutput& out,
                             int x0, int y0, int y_end) {
  const Float3 origin = p.T_volume_camera.translation;
  const Packet packets[2] = {Packet(out, x0, y0, y_end),
                             Packet(out, x0 + packet_width(), y0, y_end)};
  const auto started = [&](const Packet& packet) {
    const bool has_tile = out.start != nullptr && packet.width > 0;
    const float start_m = has_tile ? out.start->at(packet.x, packet.y) : 0;
    return start_march(map, origin, rotate(p.T_volume_camera, packet.rays(p.camera)), p, start_m,
                       packet.active());
  };
  March first = started(packets[0]), second = started(packets[1]);
  bool going = true;
  while (going) {
    const bool first_goes = !hn::AllFalse(f32, first.active);
    const bool second_goes = !hn::AllFalse(f32, second.active);
    if (first_goes) go_on(map, origin, p, &first);
    if (second_goes) go_on(map, origin, p, &second);
    going = first_goes || second_goes;
  }
  finish_packet(map, origin, out, packets[0], first);
  finish_packet(map, origin, out, packets[1], second);
}

template <class Map>
void raycast(const Map& map, const RaycastParameters& p, const RaycastOutput& out, Rows rows) {
  for (int y = rows.begin; y < rows.end; y += packet_height()) {
    for (int x = 0; x < out.size.width; x += 2 * packet_width()) {
      raycast_pair(map, p, out, x, y, rows.end);
    }
  }
}

void raycast_grid(const GridView& map, const RaycastParameters& p, const RaycastOutput& out,
                  Rows rows) {
  raycast(GridLanes(map), p, out, rows);
}

void raycast_bricks(const BrickView& map, const RaycastParameters& p, const RaycastOutput& out,
                    Rows rows) {
  raycast(BrickLanes(map, skip_level(p)), p, out, rows);
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
  constexpr std::size_t plane_bytes = BrickVolume::plane_values * sizeof(std::int16_t);
  return map.volume->planes_used() <= most / plane_bytes && 8 * map.volume->count() <= most;
}

}  // namespace slambench
#endif
