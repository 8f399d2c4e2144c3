// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/fma.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "meters/fma.cpp"
#include "hwy/foreach_target.h"
// Highway requires this order.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace slambench {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Twelve sums hide the latency of two units with up to six cycles and fit 16 registers together
/// with the two factors.
double multiply_add(std::int64_t rounds, float* sink) {
  const hn::ScalableTag<float> lanes;
  // Tends to 1: neither overflows nor becomes denormal.
  const auto factor = hn::Set(lanes, 0.5f), term = hn::Set(lanes, 0.5f);
  auto s0 = hn::Zero(lanes), s1 = s0, s2 = s0, s3 = s0, s4 = s0, s5 = s0;
  auto s6 = s0, s7 = s0, s8 = s0, s9 = s0, s10 = s0, s11 = s0;
  for (std::int64_t i = 0; i < rounds; ++i) {
    s0 = hn::MulAdd(s0, factor, term);
    s1 = hn::MulAdd(s1, factor, term);
    s2 = hn::MulAdd(s2, factor, term);
    s3 = hn::MulAdd(s3, factor, term);
    s4 = hn::MulAdd(s4, factor, term);
    s5 = hn::MulAdd(s5, factor, term);
    s6 = hn::MulAdd(s6, factor, term);
    s7 = hn::MulAdd(s7, factor, term);
    s8 = hn::MulAdd(s8, factor, term);
    s9 = hn::MulAdd(s9, factor, term);
    s10 = hn::MulAdd(s10, factor, term);
    s11 = hn::MulAdd(s11, factor, term);
  }
  const auto a = hn::Add(hn::Add(s0, s1), hn::Add(s2, s3));
  const auto b = hn::Add(hn::Add(s4, s5), hn::Add(s6, s7));
  const auto c = hn::Add(hn::Add(s8, s9), hn::Add(s10, s11));
  *sink = hn::GetLane(hn::SumOfLanes(lanes, hn::Add(hn::Add(a, b), c)));
  return static_cast<double>(rounds) * 12 * 2 * static_cast<double>(hn::Lanes(lanes));
}

const char* instruction_set() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace slambench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace slambench {

HWY_EXPORT(multiply_add);
HWY_EXPORT(instruction_set);

double multiply_add(std::int64_t rounds, float* sink) {
  return HWY_DYNAMIC_DISPATCH(multiply_add)(rounds, sink);
}

std::string multiply_add_instruction_set() { return HWY_DYNAMIC_DISPATCH(instruction_set)(); }

}  // namespace slambench
#endif
