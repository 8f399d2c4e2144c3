// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/openmp/track_kernels.h"

#include <algorithm>
#include <cstring>

#include "backends/host/host_backend.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "backends/openmp/track_kernels.cpp"
#include "hwy/foreach_target.h"
// Included once per target.
#include "backends/openmp/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace slambench {
namespace HWY_NAMESPACE {
namespace {

constexpr int lanes() { return static_cast<int>(hn::MaxLanes(f32)); }

std::size_t index(Size size, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
         static_cast<std::size_t>(x);
}

/// TrackData a lane; error and jacobian are zero where the outcome is not ok.
struct TrackLanes {
  Ints outcome;
  Floats error;
  Vec3 normal, moment;
};

HWY_INLINE Ints outcome_where(FloatMask mask, TrackOutcome yes, Ints no) {
  return hn::IfThenElse(hn::RebindMask(i32, mask), set_int(static_cast<int>(yes)), no);
}

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE Vec3 read(const Float3* points, Ints index) { return gather(points, index); }
#else
/// A vector of blocks of 16 bytes: those that start at the 0th, 4th, 8th... of the points.
template <class D>
HWY_INLINE hn::Vec<D> load_blocks(D d, const Float3* points, const std::int32_t* index) {
  if constexpr (hn::MaxLanes(d) <= 4) {
    return hn::LoadU(d, &points[index[0]].x);
  } else {
    const hn::Half<D> part;
    return hn::Combine(d, load_blocks(part, points, index + hn::MaxLanes(part)),
                       load_blocks(part, points, index));
  }
}

/// The points at an index a lane, read as blocks of 16 bytes: quicker than gathers.
HWY_INLINE Vec3 read(const Float3* points, Ints index_lanes) {
  static_assert(sizeof(Float3) == 12 && HostStorage::slack >= 4);
  alignas(64) std::int32_t index[virtual_lanes];
  hn::Store(index_lanes, i32, index);
  const hn::RepartitionToWide<hn::RebindToUnsigned<FloatTag> > u64;
  const auto wide = [&](Floats v) { return hn::BitCast(u64, v); };
  const Floats a = load_blocks(f32, points, index), b = load_blocks(f32, points, index + 1);
  const Floats c = load_blocks(f32, points, index + 2), d = load_blocks(f32, points, index + 3);
  const auto ab = wide(hn::InterleaveLower(f32, a, b)), cd = wide(hn::InterleaveLower(f32, c, d));
  const auto ab2 = wide(hn::InterleaveUpper(f32, a, b)), cd2 = wide(hn::InterleaveUpper(f32, c, d));
  return {hn::BitCast(f32, hn::InterleaveLower(u64, ab, cd)),
          hn::BitCast(f32, hn::InterleaveUpper(u64, ab, cd)),
          hn::BitCast(f32, hn::InterleaveLower(u64, ab2, cd2))};
}
#endif

/// A step of the alignment is taken for so many vectors before the next step: within a vector each
/// step waits for the one before, but the processor works on several vectors at once.
constexpr int batch = 32;

/// A live point in the volume's frame and the pixel that shows it in the model, negative where none
/// does.
struct Associated {
  Vec3 point;
  Ints pixel;
};

HWY_INLINE Associated associate(Vec3 vertex, const TrackInput& in) {
  const TrackParameters& p = in.parameters;
  const Vec3 point = apply(p.T_volume_camera, vertex);
  Ints x, y;
  const FloatMask inside = project(apply(p.T_model_volume, point), p.model_camera, in.model_size,
                                   min_projection_depth_m, &x, &y);
  const Ints pixel = hn::Add(hn::Mul(y, set_int(in.model_size.width)), x);
  return {point, hn::IfThenElse(hn::RebindMask(i32, inside), pixel, set_int(-1))};
}

/// The end of slambench::track_point.
HWY_INLINE TrackLanes compare(const Associated& live, Vec3 normal, const TrackInput& in) {
  const TrackParameters& p = in.parameters;
  const Vec3 point = live.point;
  const Ints pixel = hn::Max(live.pixel, hn::Zero(i32));
  const Vec3 model_vertex = read(in.model_vertices, pixel);
  const Vec3 model_normal = read(in.model_normals, pixel);
  const Vec3 difference = sub(model_vertex, point);
  const FloatMask valid = hn::Ne(normal.x, set(invalid_normal));
  const FloatMask inside = hn::RebindMask(f32, hn::Gt(live.pixel, set_int(-1)));
  const FloatMask modelled = hn::Ne(model_normal.x, set(invalid_normal));
  const FloatMask near = hn::Le(length(difference), set(p.distance_threshold_m));
  const FloatMask parallel =
      hn::Ge(dot(rotate(p.T_volume_camera, normal), model_normal), set(p.normal_threshold));
  const FloatMask ok = hn::And(hn::And(hn::And(valid, inside), hn::And(modelled, near)), parallel);

  Ints outcome = set_int(static_cast<int>(TrackOutcome::wrong_normal));
  outcome = outcome_where(parallel, TrackOutcome::ok, outcome);
  outcome = outcome_where(hn::Not(near), TrackOutcome::too_far, outcome);
  outcome = outcome_where(hn::Not(modelled), TrackOutcome::invalid_model, outcome);
  outcome = outcome_where(hn::Not(inside), TrackOutcome::outside_model, outcome);
  outcome = outcome_where(hn::Not(valid), TrackOutcome::invalid_input, outcome);

  const Floats zero = hn::Zero(f32);
  const Vec3 none = {zero, zero, zero};
  return {outcome, hn::IfThenElseZero(ok, dot(model_normal, difference)),
          select(ok, model_normal, none), select(ok, cross(point, model_normal), none)};
}

/// The first `count` of a vector; `other` in its other lanes.
HWY_INLINE Vec3 load_first(const Float3* points, int count, Float3 other) {
  if (count >= lanes()) return load(points);
  Float3 padded[virtual_lanes];
  std::fill_n(padded, lanes(), other);
  std::copy_n(points, count, padded);
  return load(padded);
}

/// slambench::track_point for at most a batch of vectors `stride` pixels apart along row y, from x
/// on; returns how many there are. Lanes beyond the row have no input.
HWY_INLINE int track_vectors(const TrackInput& in, int x, int y, int stride, TrackLanes* tracked) {
  const int count = std::min(batch, (in.size.width - x + stride - 1) / stride);
  const Float3* vertices = in.vertices + index(in.size, x, y);
  const Float3* normals = in.normals + index(in.size, x, y);
  Associated associated[batch];
  for (int i = 0; i < count; ++i) {
    const int at = i * stride;
    associated[i] = associate(load_first(vertices + at, in.size.width - x - at, {}), in);
  }
  for (int i = 0; i < count; ++i) {
    const int at = i * stride;
    const Vec3 normal =
        load_first(normals + at, in.size.width - x - at, {invalid_normal, 0.0f, 0.0f});
    tracked[i] = compare(associated[i], normal, in);
  }
  return count;
}

void store_lanes(const TrackLanes& row, int count, TrackData* out) {
  alignas(64) float first[4 * virtual_lanes], second[4 * virtual_lanes];
  hn::StoreInterleaved4(hn::BitCast(f32, row.outcome), row.error, row.normal.x, row.normal.y, f32,
                        first);
  hn::StoreInterleaved4(row.normal.z, row.moment.x, row.moment.y, row.moment.z, f32, second);
  for (int i = 0; i < count; ++i) {
    auto* bytes = reinterpret_cast<unsigned char*>(out + i);
    std::memcpy(bytes, first + static_cast<std::ptrdiff_t>(4) * i, 16);
    std::memcpy(bytes + 16, second + static_cast<std::ptrdiff_t>(4) * i, 16);
  }
}

/// The eight 32-bit fields of one TrackData a lane.
HWY_INLINE void load_fields(const float* rows, Floats* field) {
#if HWY_TARGET == HWY_SCALAR
  for (int i = 0; i < 8; ++i) field[i] = hn::LoadU(f32, rows + i);
#else
  // Halves of a row alternate in each vector: even lanes hold fields 0 to 3, odd ones 4 to 7.
  Floats low[4], high[4];
  hn::LoadInterleaved4(f32, rows, low[0], low[1], low[2], low[3]);
  hn::LoadInterleaved4(f32, rows + static_cast<std::ptrdiff_t>(4) * lanes(), high[0], high[1],
                       high[2], high[3]);
  for (int i = 0; i < 4; ++i) {
    field[i] = hn::ConcatEven(f32, high[i], low[i]);
    field[i + 4] = hn::ConcatOdd(f32, high[i], low[i]);
  }
#endif
}

TrackLanes load_lanes(const TrackData* rows, int count) {
  TrackData tail[virtual_lanes];
  if (count < lanes()) {
    std::copy_n(rows, count, tail);
    rows = tail;
  }
  Floats field[8];
  load_fields(reinterpret_cast<const float*>(rows), field);
  const Ints outcome = hn::BitCast(i32, field[0]);
  const FloatMask ok =
      hn::RebindMask(f32, hn::Eq(outcome, set_int(static_cast<int>(TrackOutcome::ok))));
  const auto valid = [&](Floats v) { return hn::IfThenElseZero(ok, v); };
  return {outcome,
          valid(field[1]),
          {valid(field[2]), valid(field[3]), valid(field[4])},
          {valid(field[5]), valid(field[6]), valid(field[7])}};
}

/// The sums of a band, a lane each.
struct Sums {
  Floats squared_error, jt_error[6], jt_j[6][6];  ///< of the latter the upper triangle
  std::int64_t inliers = 0, too_far = 0, wrong_normal = 0;

  Sums() : squared_error(hn::Zero(f32)) {
    for (Floats& sum : jt_error) sum = hn::Zero(f32);
    for (auto& row : jt_j) {
      for (Floats& sum : row) sum = hn::Zero(f32);
    }
  }

  void add(const TrackLanes* rows, int n) {
    add_row<0>(rows, n), add_row<1>(rows, n), add_row<2>(rows, n);
    add_row<3>(rows, n), add_row<4>(rows, n), add_row<5>(rows, n);
    for (int i = 0; i < n; ++i) {
      squared_error = hn::MulAdd(rows[i].error, rows[i].error, squared_error);
      inliers += count(rows[i].outcome, TrackOutcome::ok);
      too_far += count(rows[i].outcome, TrackOutcome::too_far);
      wrong_normal += count(rows[i].outcome, TrackOutcome::wrong_normal);
    }
  }

  /// A row of the matrix at a time, so that its sums stay in registers.
  template <int a>
  HWY_INLINE void add_row(const TrackLanes* rows, int n) {
    Floats error = jt_error[a], sums[6 - a];
    std::copy(jt_j[a] + a, jt_j[a] + 6, sums);
    for (int i = 0; i < n; ++i) {
      const TrackLanes& row = rows[i];
      const Floats j[6] = {row.normal.x, row.normal.y, row.normal.z,
                           row.moment.x, row.moment.y, row.moment.z};
      error = hn::MulAdd(row.error, j[a], error);
      for (int b = a; b < 6; ++b) sums[b - a] = hn::MulAdd(j[a], j[b], sums[b - a]);
    }
    jt_error[a] = error;
    std::copy(sums, sums + 6 - a, jt_j[a] + a);
  }

  static HWY_INLINE std::int64_t count(Ints outcome, TrackOutcome which) {
    return static_cast<std::int64_t>(
        hn::CountTrue(i32, hn::Eq(outcome, set_int(static_cast<int>(which)))));
  }

  /// Adds all but `others`; lanes in order.
  void add_to(Reduction* sum) const {
    add_lanes(squared_error, &sum->squared_error);
    for (int i = 0; i < 6; ++i) add_lanes(jt_error[i], &sum->jt_error[i]);
    double* entry = sum->jt_j;
    for (int a = 0; a < 6; ++a) {
      for (int b = a; b < 6; ++b) add_lanes(jt_j[a][b], entry++);
    }
    sum->inliers += inliers;
    sum->too_far += too_far;
    sum->wrong_normal += wrong_normal;
  }

  static void add_lanes(Floats lane_sums, double* sum) {
    alignas(64) float lane[virtual_lanes];
    hn::Store(lane_sums, f32, lane);
    for (int i = 0; i < lanes(); ++i) *sum += static_cast<double>(lane[i]);
  }
};

/// Sums the band's pixels: virtual lane i takes those with x = i modulo virtual_lanes. `fill(x, y,
/// rows)` gives the vectors of every virtual_lanes-th x from x on, at most a batch, and how many.
template <class F>
HWY_INLINE Reduction sum_band(Size size, Rows rows, const F& fill) {
  Reduction sum;
  TrackLanes vectors[batch];
  for (int first = 0; first < virtual_lanes; first += lanes()) {
    Sums sums;
    for (int y = rows.begin; y < rows.end; ++y) {
      for (int x = first; x < size.width;) {
        const int count = fill(x, y, vectors);
        sums.add(vectors, count);
        x += count * virtual_lanes;
      }
    }
    sums.add_to(&sum);
  }
  const std::int64_t pixels = static_cast<std::int64_t>(rows.end - rows.begin) * size.width;
  sum.others = pixels - sum.inliers - sum.too_far - sum.wrong_normal;
  return sum;
}

void track(TrackData* track, const TrackInput& in, Rows rows) {
  TrackLanes vectors[batch];
  for (int y = rows.begin; y < rows.end; ++y) {
    for (int x = 0; x < in.size.width;) {
      const int count = track_vectors(in, x, y, lanes(), vectors);
      for (int i = 0; i < count; ++i, x += lanes()) {
        store_lanes(vectors[i], std::min(lanes(), in.size.width - x), track + index(in.size, x, y));
      }
    }
  }
}

Reduction reduce(const TrackData* track, Size size, Rows rows) {
  return sum_band(size, rows, [&](int x, int y, TrackLanes* vectors) {
    int count = 0;
    for (int at = x; at < size.width && count < batch; at += virtual_lanes) {
      vectors[count++] = load_lanes(track + index(size, at, y), size.width - at);
    }
    return count;
  });
}

Reduction track_reduce(const TrackInput& in, Rows rows) {
  return sum_band(in.size, rows, [&](int x, int y, TrackLanes* vectors) {
    return track_vectors(in, x, y, virtual_lanes, vectors);
  });
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace slambench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace slambench {

HWY_EXPORT(track);
HWY_EXPORT(reduce);
HWY_EXPORT(track_reduce);

void track_rows(TrackData* track, const TrackInput& input, Rows rows) {
  HWY_DYNAMIC_DISPATCH(track)(track, input, rows);
}

Reduction reduce_band(const TrackData* track, Size size, Rows rows) {
  return HWY_DYNAMIC_DISPATCH(reduce)(track, size, rows);
}

Reduction track_reduce_band(const TrackInput& input, Rows rows) {
  return HWY_DYNAMIC_DISPATCH(track_reduce)(input, rows);
}

void add(const Reduction& band, Reduction* sum) {
  sum->squared_error += band.squared_error;
  for (int i = 0; i < 6; ++i) sum->jt_error[i] += band.jt_error[i];
  for (int i = 0; i < 21; ++i) sum->jt_j[i] += band.jt_j[i];
  sum->inliers += band.inliers;
  sum->too_far += band.too_far;
  sum->wrong_normal += band.wrong_normal;
  sum->others += band.others;
}

}  // namespace slambench
#endif
