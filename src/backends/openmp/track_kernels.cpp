// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/openmp/track_kernels.h"

#include <algorithm>
#include <cstring>

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

#if HWY_TARGET != HWY_SCALAR
/// A vector of blocks of 16 bytes: half of the points with the 0th, 4th, 8th... index.
template <class D>
HWY_INLINE hn::Vec<D> load_blocks(D d, const float* half, const std::int32_t* index) {
  if constexpr (hn::MaxLanes(d) <= 4) {
    return hn::LoadU(d, half + static_cast<std::ptrdiff_t>(8) * index[0]);
  } else {
    const hn::Half<D> part;
    return hn::Combine(d, load_blocks(part, half, index + hn::MaxLanes(part)),
                       load_blocks(part, half, index));
  }
}

/// Four fields of the points, a vector each: `half` points to the first of them in the first point.
HWY_INLINE void read_fields(const float* half, const std::int32_t* index, Floats (*field)[4]) {
  const hn::RepartitionToWide<hn::RebindToUnsigned<FloatTag>> u64;
  const auto wide = [&](Floats v) { return hn::BitCast(u64, v); };
  const Floats a = load_blocks(f32, half, index), b = load_blocks(f32, half, index + 1);
  const Floats c = load_blocks(f32, half, index + 2), d = load_blocks(f32, half, index + 3);
  const auto ab = wide(hn::InterleaveLower(f32, a, b)), cd = wide(hn::InterleaveLower(f32, c, d));
  (*field)[0] = hn::BitCast(f32, hn::InterleaveLower(u64, ab, cd));
  (*field)[1] = hn::BitCast(f32, hn::InterleaveUpper(u64, ab, cd));
  const auto ab2 = wide(hn::InterleaveUpper(f32, a, b)), cd2 = wide(hn::InterleaveUpper(f32, c, d));
  (*field)[2] = hn::BitCast(f32, hn::InterleaveLower(u64, ab2, cd2));
  (*field)[3] = hn::BitCast(f32, hn::InterleaveUpper(u64, ab2, cd2));
}

#endif

/// The model's points and normals at a pixel a lane.
HWY_INLINE void read_model(const TrackInput& in, Ints pixel, Vec3* vertex, Vec3* normal) {
#if HWY_TARGET != HWY_SCALAR
  if (in.model != nullptr) {
    alignas(64) std::int32_t index[virtual_lanes];
    hn::Store(pixel, i32, index);
    const auto* points = reinterpret_cast<const float*>(in.model);
    Floats field[4];
    read_fields(points, index, &field);
    *vertex = {field[0], field[1], field[2]};
    normal->x = field[3];
    read_fields(points + 4, index, &field);
    normal->y = field[0], normal->z = field[1];
    return;
  }
#endif
  *vertex = gather(in.model_vertices, pixel);
  *normal = gather(in.model_normals, pixel);
}

/// slambench::track_point.
HWY_INLINE TrackLanes track_lanes(Vec3 vertex, Vec3 normal, const TrackInput& in) {
  const TrackParameters& p = in.parameters;
  const FloatMask valid = hn::Ne(normal.x, set(invalid_normal));
  const Vec3 point = apply(p.T_volume_camera, vertex);
  Ints x, y;
  const FloatMask inside = project(apply(p.T_model_volume, point), p.model_camera, in.model_size,
                                   min_projection_depth_m, &x, &y);
  const Ints pixel = hn::Add(hn::Mul(y, set_int(in.model_size.width)), x);
  Vec3 model_vertex, model_normal;
  read_model(in, pixel, &model_vertex, &model_normal);
  const Vec3 difference = sub(model_vertex, point);
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

/// Lanes of a row that starts at `vertices` and has `count` pixels left.
HWY_INLINE TrackLanes track_row_lanes(const Float3* vertices, const Float3* normals, int count,
                                      const TrackInput& in) {
  if (count >= lanes()) return track_lanes(load(vertices), load(normals), in);
  Float3 vertex[virtual_lanes], normal[virtual_lanes];
  std::fill_n(normal, lanes(), Float3{invalid_normal, 0.0f, 0.0f});
  std::copy_n(vertices, count, vertex);
  std::copy_n(normals, count, normal);
  return track_lanes(load(vertex), load(normal), in);
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
  Floats squared_error, jt_error[6], jt_j[21];
  std::int64_t inliers = 0, too_far = 0, wrong_normal = 0;

  Sums() : squared_error(hn::Zero(f32)) {
    for (Floats& sum : jt_error) sum = hn::Zero(f32);
    for (Floats& sum : jt_j) sum = hn::Zero(f32);
  }

  HWY_INLINE void add(const TrackLanes& row) {
    const Floats j[6] = {row.normal.x, row.normal.y, row.normal.z,
                         row.moment.x, row.moment.y, row.moment.z};
    squared_error = hn::MulAdd(row.error, row.error, squared_error);
    Floats* entry = jt_j;
    for (int a = 0; a < 6; ++a) {
      jt_error[a] = hn::MulAdd(row.error, j[a], jt_error[a]);
      for (int b = a; b < 6; ++b, ++entry) *entry = hn::MulAdd(j[a], j[b], *entry);
    }
    inliers += count(row.outcome, TrackOutcome::ok);
    too_far += count(row.outcome, TrackOutcome::too_far);
    wrong_normal += count(row.outcome, TrackOutcome::wrong_normal);
  }

  static HWY_INLINE std::int64_t count(Ints outcome, TrackOutcome which) {
    return static_cast<std::int64_t>(
        hn::CountTrue(i32, hn::Eq(outcome, set_int(static_cast<int>(which)))));
  }

  /// Adds all but `others`; lanes in order.
  void add_to(Reduction* sum) const {
    add_lanes(squared_error, &sum->squared_error);
    for (int i = 0; i < 6; ++i) add_lanes(jt_error[i], &sum->jt_error[i]);
    for (int i = 0; i < 21; ++i) add_lanes(jt_j[i], &sum->jt_j[i]);
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

/// Sums the band's pixels: virtual lane i takes those with x = i modulo virtual_lanes. `row_lanes`
/// gives the lanes from (x, y) on, of which `count` exist.
template <class F>
HWY_INLINE Reduction sum_band(Size size, Rows rows, const F& row_lanes) {
  Reduction sum;
  for (int first = 0; first < virtual_lanes; first += lanes()) {
    Sums sums;
    for (int y = rows.begin; y < rows.end; ++y) {
      for (int x = first; x < size.width; x += virtual_lanes) {
        sums.add(row_lanes(x, y, size.width - x));
      }
    }
    sums.add_to(&sum);
  }
  const std::int64_t pixels = static_cast<std::int64_t>(rows.end - rows.begin) * size.width;
  sum.others = pixels - sum.inliers - sum.too_far - sum.wrong_normal;
  return sum;
}

void track(TrackData* track, const TrackInput& in, Rows rows) {
  for (int y = rows.begin; y < rows.end; ++y) {
    for (int x = 0; x < in.size.width; x += lanes()) {
      const std::size_t i = index(in.size, x, y);
      const int count = std::min(lanes(), in.size.width - x);
      store_lanes(track_row_lanes(in.vertices + i, in.normals + i, count, in), count, track + i);
    }
  }
}

Reduction reduce(const TrackData* track, Size size, Rows rows) {
  return sum_band(size, rows, [&](int x, int y, int count) {
    return load_lanes(track + index(size, x, y), count);
  });
}

Reduction track_reduce(const TrackInput& in, Rows rows) {
  return sum_band(in.size, rows, [&](int x, int y, int count) {
    const std::size_t i = index(in.size, x, y);
    return track_row_lanes(in.vertices + i, in.normals + i, count, in);
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

void pack_model_rows(ModelPoint* model, const Float3* vertices, const Float3* normals, Size size,
                     Rows rows) {
  const auto width = static_cast<std::size_t>(size.width);
  const std::size_t end = static_cast<std::size_t>(rows.end) * width;
  for (std::size_t i = static_cast<std::size_t>(rows.begin) * width; i < end; ++i) {
    model[i] = {vertices[i], normals[i].x, normals[i].y, normals[i].z, {}};
  }
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
