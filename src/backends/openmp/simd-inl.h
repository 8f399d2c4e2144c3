// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// Shared by the kernels of this folder and compiled once per instruction set: hence a guard that
// toggles. Every operation but the exponential is rounded as in the per-element functions of
// kernels/, in the same order and never fused, so that results do not depend on the number of lanes
// and equal theirs.

#if defined(SLAMBENCH_OPENMP_SIMD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SLAMBENCH_OPENMP_SIMD_INL_H_
#undef SLAMBENCH_OPENMP_SIMD_INL_H_
#else
#define SLAMBENCH_OPENMP_SIMD_INL_H_
#endif

#include "hwy/highway.h"
#include "kernels/pixel.h"
#include "kernels/types.h"

HWY_BEFORE_NAMESPACE();
namespace slambench {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Reductions are cut into 16 virtual lanes on every machine.
inline constexpr int virtual_lanes = 16;

using FloatTag = hn::CappedTag<float, virtual_lanes>;
using IntTag = hn::RebindToSigned<FloatTag>;
using Floats = hn::Vec<FloatTag>;
using Ints = hn::Vec<IntTag>;
using FloatMask = hn::Mask<FloatTag>;
inline constexpr FloatTag f32{};
inline constexpr IntTag i32{};

HWY_INLINE Floats set(float value) { return hn::Set(f32, value); }
HWY_INLINE Ints set_int(int value) { return hn::Set(i32, value); }

/// Three floats a lane.
struct Vec3 {
  Floats x, y, z;
};

HWY_INLINE Vec3 set(Float3 v) { return {set(v.x), set(v.y), set(v.z)}; }
HWY_INLINE Vec3 add(Vec3 a, Vec3 b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Vec3 sub(Vec3 a, Vec3 b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vec3 mul(Vec3 a, Floats s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}
HWY_INLINE Floats dot(Vec3 a, Vec3 b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE Vec3 cross(Vec3 a, Vec3 b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
          hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE Floats length(Vec3 a) { return hn::Sqrt(dot(a, a)); }
HWY_INLINE Vec3 select(FloatMask mask, Vec3 yes, Vec3 no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}
HWY_INLINE Vec3 rotate(const Rigid3f& t, Vec3 v) {
  return {dot(set(t.row0), v), dot(set(t.row1), v), dot(set(t.row2), v)};
}
HWY_INLINE Vec3 apply(const Rigid3f& t, Vec3 v) { return add(rotate(t, v), set(t.translation)); }

HWY_INLINE Vec3 load(const Float3* p) {
  Vec3 v;
  hn::LoadInterleaved3(f32, &p->x, v.x, v.y, v.z);
  return v;
}
HWY_INLINE void store(Vec3 v, Float3* p) { hn::StoreInterleaved3(v.x, v.y, v.z, f32, &p->x); }
/// The elements at an index a lane.
HWY_INLINE Vec3 gather(const Float3* p, Ints index) {
  const Ints first = hn::Add(hn::Add(index, index), index);
  return {hn::GatherIndex(f32, &p->x, first), hn::GatherIndex(f32, &p->y, first),
          hn::GatherIndex(f32, &p->z, first)};
}

/// first, first + 1, ... as floats: exact, like the conversion of an int below 2^24.
HWY_INLINE Floats iota(int first) {
  return hn::ConvertTo(f32, hn::Add(hn::Iota(i32, 0), set_int(first)));
}

HWY_INLINE Ints clamp(Ints i, Ints last) { return hn::Min(hn::Max(i, hn::Zero(i32)), last); }

/// Truncates values that an int can hold; what becomes of others and of NaN depends on the
/// processor. Highway's conversion makes them the same everywhere, which costs more than the
/// conversion itself.
HWY_INLINE Ints truncated(Floats v) {
#if HWY_TARGET <= HWY_AVX3
  return Ints{_mm512_cvttps_epi32(v.raw)};
#else
  return hn::ConvertTo(i32, v);
#endif
}

/// Lanes that fall into the image, as slambench::project; the others' coordinates are 0.
HWY_INLINE FloatMask project(Vec3 point, Intrinsics camera, Size size, float min_depth, Ints* x,
                             Ints* y) {
  const Floats half = set(0.5f);
  const Floats u =
      hn::Add(hn::Add(hn::Div(hn::Mul(set(camera.fx), point.x), point.z), set(camera.cx)), half);
  const Floats v =
      hn::Add(hn::Add(hn::Div(hn::Mul(set(camera.fy), point.y), point.z), set(camera.cy)), half);
  const Floats zero = hn::Zero(f32);
  const FloatMask inside = hn::And(
      hn::And(hn::And(hn::Ge(u, zero), hn::Le(u, set(static_cast<float>(size.width - 1)))),
              hn::And(hn::Ge(v, zero), hn::Le(v, set(static_cast<float>(size.height - 1))))),
      hn::Ge(point.z, set(min_depth)));
  *x = truncated(hn::IfThenElseZero(inside, u));
  *y = truncated(hn::IfThenElseZero(inside, v));
  return inside;
}

/// exp(x) for x <= 0 to 4 units in the last place; 0 below -87 (where the true value is below the
/// smallest normal number), NaN for NaN. 2^n exp(r) with n = round(x / ln 2), |r| <= ln 2 / 2 and
/// the polynomial of degree 5 through exp at six Chebyshev nodes. Multiply-adds are fused where the
/// processor has them.
HWY_INLINE Floats exp_nonpositive(Floats x) {
  const Floats n = hn::Round(hn::Mul(x, set(1.44269504f)));
  // ln 2 in two parts: the first has few bits, so that n times it is exact.
  Floats r = hn::NegMulAdd(n, set(0.693359375f), x);
  r = hn::NegMulAdd(n, set(-2.12194440e-4f), r);
  Floats sum = set(0.00836922042f);
  for (const float c : {0.0419180095f, 0.166665047f, 0.499988645f, 1.0f, 1.00000012f}) {
    sum = hn::MulAdd(sum, r, set(c));
  }
  const FloatMask vanishes = hn::Lt(x, set(-87.0f));  // whatever the exponent is then
  const Ints exponent = hn::Add(truncated(n), set_int(127));
  const Floats power = hn::BitCast(f32, hn::ShiftLeft<23>(exponent));
  return hn::IfThenZeroElse(vanishes, hn::Mul(sum, power));
}

}  // namespace HWY_NAMESPACE
}  // namespace slambench
HWY_AFTER_NAMESPACE();

#endif
