// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/openmp/integrate_kernels.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "backends/openmp/integrate_kernels.cpp"
#include "hwy/foreach_target.h"
// Included once per target.
#include "backends/openmp/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace slambench {
namespace HWY_NAMESPACE {
namespace {

constexpr int lanes() { return static_cast<int>(hn::MaxLanes(f32)); }

/// The end of slambench::integrate_voxel: the voxels' average with a truncated distance, where
/// `measured`.
HWY_INLINE void average_lanes(FloatMask measured, Floats sdf, float max_weight, Ints* tsdf,
                              Ints* weight) {
  const Floats one = set(1.0f);
  const auto changes = hn::RebindMask(i32, measured);
  const Floats count = hn::ConvertTo(f32, *weight), more = hn::Add(count, one);
  *weight = hn::IfThenElse(changes, truncated(hn::Min(more, set(max_weight))), *weight);
  // Free space that is seen free stays as it is, whatever the weight.
  const auto same = hn::And(hn::Eq(*tsdf, set_int(BrickVolume::free_space)),
                            hn::RebindMask(i32, hn::Eq(sdf, one)));
  if (hn::AllTrue(i32, hn::Or(same, hn::Not(changes)))) return;
  const Floats old = hn::Mul(hn::ConvertTo(f32, *tsdf), set(1.0f / tsdf_scale));
  const Floats mean = hn::Div(hn::Add(hn::Mul(count, old), sdf), more);
  const Floats stored = hn::Mul(hn::Max(set(-1.0f), hn::Min(one, mean)), set(tsdf_scale));
  *tsdf = hn::IfThenElse(changes, truncated(stored), *tsdf);
}

/// slambench::integrate_voxel: what distance and weight of the voxels become.
HWY_INLINE void integrate_lanes(Vec3 center, const IntegrateInput& in, Ints* tsdf, Ints* weight) {
  const IntegrateParameters& p = in.parameters;
  const Floats one = set(1.0f);
  Ints x, y;
  const FloatMask inside = project(center, p.camera, in.size, p.min_depth_m, &x, &y);
  if (hn::AllFalse(f32, inside)) return;
  const Floats depth =
      hn::GatherIndex(f32, in.depth_m, hn::Add(hn::Mul(y, set_int(in.size.width)), x));

  // The distance along a ray is never nearer to 0 than the one along the axis, which often decides.
  const Floats along_axis = hn::Sub(depth, center.z);
  FloatMask measured =
      hn::And(inside, hn::And(hn::Gt(depth, hn::Zero(f32)), hn::Gt(along_axis, set(-p.mu_m))));
  if (hn::AllFalse(f32, measured)) return;
  if (hn::AllTrue(f32, hn::Or(hn::Ge(along_axis, set(p.mu_m)), hn::Not(measured)))) {
    return average_lanes(measured, one, p.max_weight, tsdf, weight);
  }
  const Floats slope_x = hn::Div(center.x, center.z), slope_y = hn::Div(center.y, center.z);
  const Floats stretch =
      hn::Sqrt(hn::Add(hn::Add(one, hn::Mul(slope_x, slope_x)), hn::Mul(slope_y, slope_y)));
  const Floats distance = hn::Mul(along_axis, stretch);
  measured = hn::And(measured, hn::Gt(distance, set(-p.mu_m)));
  const Floats sdf = hn::Min(one, hn::Div(distance, set(p.mu_m)));
  average_lanes(measured, sdf, p.max_weight, tsdf, weight);
}

/// The voxels [first, last) along x of a line `start` + x `step` (camera frame) that can be
/// measured: in front of the camera, inside the image and not farther than its greatest depth.
struct Span {
  int first = 0, last = 0;
};

Span visible_span(Float3 start, Float3 step, const IntegrateInput& in, double margin_m,
                  double margin_steps, int count) {
  const Intrinsics& k = in.parameters.camera;
  double low = 0, high = count;
  // Keeps x where value + x slope >= 0.
  const auto clip = [&](double value, double slope) {
    if (slope > 0) {
      low = std::max(low, -value / slope);
    } else if (slope < 0) {
      high = std::min(high, -value / slope);
    } else if (value < 0) {
      high = low;
    }
  };
  const auto clip_side = [&](double f, double c, double s_start, double s_step) {
    const double norm = margin_m * (std::abs(f) + std::abs(c));
    clip(f * s_start + c * start.z + norm, f * s_step + c * step.z);
  };
  const double left = static_cast<double>(k.cx) + 0.5, top = static_cast<double>(k.cy) + 0.5;
  clip(start.z + margin_m, step.z);
  clip(in.greatest_depth_m + in.parameters.mu_m + margin_m - start.z, -step.z);
  clip_side(k.fx, left, start.x, step.x);
  clip_side(-k.fx, in.size.width - 1 - left, start.x, step.x);
  clip_side(k.fy, top, start.y, step.y);
  clip_side(-k.fy, in.size.height - 1 - top, start.y, step.y);
  if (!(low <= high)) return {};
  return {std::max(0, static_cast<int>(std::floor(low - margin_steps))),
          std::min(count, static_cast<int>(std::ceil(high + margin_steps)) + 1)};
}

Float3 column(const Rigid3f& t, float scale) {
  return {t.row0.x * scale, t.row1.x * scale, t.row2.x * scale};
}

void integrate_row(Voxel* row, const IntegrateInput& in, int y, int z) {
  const IntegrateParameters& p = in.parameters;
  const Float3 first = voxel_center(0, y, z, in.voxel_m);
  // A voxel more on either side makes up for the rounding of the ends.
  const Span span =
      visible_span(p.T_camera_volume.apply(first), column(p.T_camera_volume, in.voxel_m.x), in,
                   in.tolerance_m, 1, in.resolution.x);
  int x = span.first;
  for (; x < span.last && x + lanes() <= in.resolution.x; x += lanes()) {
    auto* packed = reinterpret_cast<std::int32_t*>(row + x);
    const Ints voxel = hn::LoadU(i32, packed);
    Ints tsdf = hn::ShiftRight<16>(hn::ShiftLeft<16>(voxel)), weight = hn::ShiftRight<16>(voxel);
    const Floats center_x = hn::Mul(hn::Add(iota(x), set(0.5f)), set(in.voxel_m.x));
    integrate_lanes(apply(p.T_camera_volume, {center_x, set(first.y), set(first.z)}), in, &tsdf,
                    &weight);
    hn::StoreU(hn::Or(hn::And(tsdf, set_int(0xffff)), hn::ShiftLeft<16>(weight)), i32, packed);
  }
  for (; x < span.last; ++x) {
    const Float3 center = p.T_camera_volume.apply(voxel_center(x, y, z, in.voxel_m));
    integrate_voxel(row + x, center, in.depth_m, in.size, p);
  }
}

void integrate_flat(Voxel* voxels, const IntegrateInput& in, int begin, int end) {
  for (int row = begin; row < end; ++row) {
    integrate_row(
        voxels + static_cast<std::size_t>(row) * static_cast<std::size_t>(in.resolution.x), in,
        row % in.resolution.y, row / in.resolution.y);
  }
}

/// Where the centres of the voxels at a brick's eight corners are in the camera frame.
struct Corners {
  float x[8], y[8], z[8];
};

/// What the measurement does to a brick, from its corners: between them the projection is convex.
/// Tolerances make up for the rounding of single voxels.
BrickChange change_of(const Corners& c, const IntegrateInput& in, const DepthPyramid& depth) {
  const IntegrateParameters& p = in.parameters;
  const float tolerance_m = in.tolerance_m;
  const auto [near_m, far_m] = std::minmax_element(c.z, c.z + 8);
  if (*far_m < p.min_depth_m - tolerance_m) return BrickChange::none;
  if (*near_m < p.min_depth_m + tolerance_m) return BrickChange::varied;

  float u[8], v[8];
  for (int i = 0; i < 8; ++i) {
    u[i] = p.camera.fx * c.x[i] / c.z[i] + p.camera.cx + 0.5f;
    v[i] = p.camera.fy * c.y[i] / c.z[i] + p.camera.cy + 0.5f;
  }
  float u0 = u[0], u1 = u[0], v0 = v[0], v1 = v[0];
  for (int i = 1; i < 8; ++i) {
    u0 = std::min(u0, u[i]), u1 = std::max(u1, u[i]);
    v0 = std::min(v0, v[i]), v1 = std::max(v1, v[i]);
  }
  const float tolerance_px =
      1e-3f + std::max(std::abs(p.camera.fx), std::abs(p.camera.fy)) * tolerance_m / *near_m;
  u0 -= tolerance_px, v0 -= tolerance_px, u1 += tolerance_px, v1 += tolerance_px;
  const auto last_x = static_cast<float>(in.size.width - 1);
  const auto last_y = static_cast<float>(in.size.height - 1);
  if (!(u1 >= 0 && v1 >= 0 && u0 <= last_x && v0 <= last_y)) return BrickChange::none;
  const bool whole = u0 >= 0 && v0 >= 0 && u1 <= last_x && v1 <= last_y;
  const auto range =
      depth.range(static_cast<int>(std::max(0.0f, u0)), static_cast<int>(std::max(0.0f, v0)),
                  static_cast<int>(std::min(last_x, u1)), static_cast<int>(std::min(last_y, v1)));
  // A distance along the ray is at least the one along the axis, which these compare.
  if (range.greatest - *near_m < -p.mu_m - tolerance_m) return BrickChange::none;
  if (whole && range.least - *far_m > p.mu_m + tolerance_m) return BrickChange::free;
  return BrickChange::varied;
}

Corners corners_of(Float3 first, Float3 along_x, Float3 along_y, Float3 along_z) {
  Corners c;
  for (int i = 0; i < 8; ++i) {
    const auto x = static_cast<float>(i & 1), y = static_cast<float>((i >> 1) & 1);
    const auto z = static_cast<float>(i >> 2);
    c.x[i] = first.x + x * along_x.x + y * along_y.x + z * along_z.x;
    c.y[i] = first.y + x * along_x.y + y * along_y.y + z * along_z.y;
    c.z[i] = first.z + x * along_x.z + y * along_y.z + z * along_z.z;
  }
  return c;
}

void classify(BrickVolume& volume, const IntegrateInput& in, const DepthPyramid& depth, int by,
              int bz, std::vector<BrickWork>* work) {
  constexpr int edge = BrickVolume::edge;
  const Rigid3f& t = in.parameters.T_camera_volume;
  const Float3 first = t.apply(voxel_center(0, by * edge, bz * edge, in.voxel_m));
  const Float3 step = column(t, in.voxel_m.x * edge);
  const Float3 diagonal = in.voxel_m * static_cast<float>(edge);
  const Span span =
      visible_span(first, step, in, static_cast<double>(length(diagonal)), 1, volume.bricks().x);

  constexpr auto last = static_cast<float>(edge - 1);
  const Float3 along_x = t.rotate({in.voxel_m.x * last, 0, 0});
  const Float3 along_y = t.rotate({0, in.voxel_m.y * last, 0});
  const Float3 along_z = t.rotate({0, 0, in.voxel_m.z * last});
  for (int bx = span.first; bx < span.last; ++bx) {
    const Corners corners =
        corners_of(first + step * static_cast<float>(bx), along_x, along_y, along_z);
    const BrickChange change = change_of(corners, in, depth);
    if (change == BrickChange::none) continue;
    const std::size_t brick = volume.index(bx, by, bz);
    if (change == BrickChange::free && volume.is_free(brick) && volume.uniform(brick)) {
      const auto weight = static_cast<float>(volume.uniform_weight(brick));
      volume.set_uniform_weight(
          brick, static_cast<std::int16_t>(std::min(weight + 1.0f, in.parameters.max_weight)));
    } else {
      work->push_back({static_cast<std::int32_t>(brick), change});
    }
  }
}

/// Calls update(i, &tsdf, &weight) for all of a brick's voxels, lanes from the i-th on.
template <class F>
HWY_INLINE void update_brick(BrickVolume& volume, std::size_t brick, const F& update) {
  const hn::Rebind<std::int16_t, IntTag> i16;
  alignas(64) std::int16_t tsdf[BrickVolume::voxels], weights[BrickVolume::voxels];
  volume.load(brick, tsdf, weights);
  Ints changed = hn::Zero(i32);
  for (int i = 0; i < BrickVolume::voxels; i += lanes()) {
    const Ints old_tsdf = hn::PromoteTo(i32, hn::Load(i16, tsdf + i));
    const Ints old_weight = hn::PromoteTo(i32, hn::Load(i16, weights + i));
    Ints new_tsdf = old_tsdf, new_weight = old_weight;
    update(i, &new_tsdf, &new_weight);
    changed = hn::Or(changed, hn::Or(hn::Xor(old_tsdf, new_tsdf), hn::Xor(old_weight, new_weight)));
    hn::Store(hn::DemoteTo(i16, new_tsdf), i16, tsdf + i);
    hn::Store(hn::DemoteTo(i16, new_weight), i16, weights + i);
  }
  if (hn::AllTrue(i32, hn::Eq(changed, hn::Zero(i32)))) return;
  volume.store(brick, tsdf, weights);
}

void integrate_one_brick(BrickVolume& volume, const IntegrateInput& in, BrickWork work) {
  const auto brick = static_cast<std::size_t>(work.brick);
  if (work.change == BrickChange::free) {
    const FloatMask all = hn::Eq(hn::Zero(f32), hn::Zero(f32));
    return update_brick(volume, brick, [&](int, Ints* tsdf, Ints* weight) {
      average_lanes(all, set(1.0f), in.parameters.max_weight, tsdf, weight);
    });
  }
  const Int3 corner = volume.voxel_at(brick, 0);
  const Rigid3f& t = in.parameters.T_camera_volume;
  const auto coordinate = [](Ints i, int first, float voxel_m) {
    const Floats index = hn::ConvertTo(f32, hn::Add(i, set_int(first)));
    return hn::Mul(hn::Add(index, set(0.5f)), set(voxel_m));
  };
  const Ints low = set_int(BrickVolume::edge - 1);
  update_brick(volume, brick, [&](int i, Ints* tsdf, Ints* weight) {
    const Ints linear = hn::Add(hn::Iota(i32, 0), set_int(i));
    const Vec3 center = {
        coordinate(hn::And(linear, low), corner.x, in.voxel_m.x),
        coordinate(hn::And(hn::ShiftRight<3>(linear), low), corner.y, in.voxel_m.y),
        coordinate(hn::ShiftRight<6>(linear), corner.z, in.voxel_m.z)};
    integrate_lanes(apply(t, center), in, tsdf, weight);
  });
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace slambench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace slambench {

HWY_EXPORT(integrate_flat);
HWY_EXPORT(classify);
HWY_EXPORT(integrate_one_brick);

void integrate_rows(Voxel* voxels, const IntegrateInput& input, int begin, int end) {
  HWY_DYNAMIC_DISPATCH(integrate_flat)(voxels, input, begin, end);
}

void classify_bricks(BrickVolume& volume, const IntegrateInput& input, const DepthPyramid& depth,
                     int by, int bz, std::vector<BrickWork>* work) {
  HWY_DYNAMIC_DISPATCH(classify)(volume, input, depth, by, bz, work);
}

void integrate_brick(BrickVolume& volume, const IntegrateInput& input, BrickWork work) {
  HWY_DYNAMIC_DISPATCH(integrate_one_brick)(volume, input, work);
}

}  // namespace slambench
#endif
