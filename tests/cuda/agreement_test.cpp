// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <gtest/gtest.h>

#include <string>

#include "cuda/host_launch.h"
#include "verify/agreement.h"

namespace slambench {
namespace {

using testing::host_cuda_backend;
using testing::Order;

std::string explained(const Agreement& result) {
  std::string text(name(result.verdict));
  for (const Deviation& failure : result.failures) {
    text += "\n" + failure.input + ": " + std::string(failure.quantity) + " found " +
            std::to_string(failure.found) + ", allowed " + std::to_string(failure.allowed) + " " +
            failure.where;
  }
  return text;
}

/// Every check of `slambench verify`, with the kernels of the CUDA backend run on the host: once
/// forwards and once backwards, which must give the same bits.
struct CudaAgreement : ::testing::TestWithParam<std::tuple<std::string, MapKind>> {};

TEST_P(CudaAgreement, KernelsOnTheHostAgreeWithTheReference) {
  const auto& [check, map] = GetParam();
  Candidate candidate{host_cuda_backend(Order::forwards), host_cuda_backend(Order::backwards)};
  const Agreement result = agreement(*find_check(check), candidate, map, {});
  EXPECT_EQ(result.verdict, Verdict::agrees) << explained(result);
  EXPECT_GT(result.cases, 0);
}

std::vector<std::string> checks() {
  std::vector<std::string> names;
  for (const Check& check : check_table()) names.emplace_back(check.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Every, CudaAgreement,
                         ::testing::Combine(::testing::ValuesIn(checks()),
                                            ::testing::Values(MapKind::grid, MapKind::bricks)),
                         [](const auto& combination) {
                           return std::get<0>(combination.param) + "_" +
                                  std::string(name(std::get<1>(combination.param)));
                         });

}  // namespace
}  // namespace slambench
