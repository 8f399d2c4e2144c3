// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <gtest/gtest.h>

#include <cctype>
#include <map>
#include <set>
#include <string>

#include "kernels/kernel.h"
#include "kernels/observer.h"

namespace slambench {
namespace {

TEST(KernelTable, NamesEachKernelOnceAndFindsItAgain) {
  std::set<std::string_view> names;
  for (const KernelInfo& row : kernel_table()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_EQ(kernel_from_name(row.name), row.kernel);
    EXPECT_EQ(info(row.kernel).name, row.name);
    EXPECT_EQ(name(row.kernel), row.name);
    EXPECT_FALSE(row.sentence.empty() || row.pattern.empty() || row.in.empty() || row.out.empty())
        << row.name;
  }
  EXPECT_EQ(names.size(), kernel_count);
  EXPECT_EQ(kernel_from_name("bilateralFilter"), std::nullopt);
  EXPECT_EQ(kernel_from_name(""), std::nullopt);
}

/// half_sample is halfSample in the paper, and so on; nothing is renamed.
TEST(KernelTable, KeepsThePapersNames) {
  for (const KernelInfo& row : kernel_table()) {
    if (row.kernel == Kernel::align) {
      EXPECT_EQ(row.paper_name, "");
      continue;
    }
    std::string camel;
    for (std::size_t i = 0; i < row.name.size(); ++i) {
      const bool starts_word = row.name[i] == '_';
      if (starts_word) ++i;
      camel += starts_word ? static_cast<char>(std::toupper(row.name[i])) : row.name[i];
    }
    EXPECT_EQ(row.paper_name, camel);
  }
}

TEST(KernelTable, PutsKernelsIntoThePublishedStages) {
  const std::map<Stage, std::set<Kernel>> expected = {
      {Stage::acquire, {Kernel::acquire}},
      {Stage::preprocess, {Kernel::mm2meters, Kernel::bilateral_filter}},
      {Stage::track,
       {Kernel::half_sample, Kernel::depth2vertex, Kernel::vertex2normal, Kernel::track,
        Kernel::reduce, Kernel::solve, Kernel::align}},
      {Stage::integrate, {Kernel::integrate}},
      {Stage::raycast, {Kernel::raycast}},
      {Stage::render, {Kernel::render_depth, Kernel::render_track, Kernel::render_volume}},
      {Stage::init, {Kernel::init_volume, Kernel::generate_gaussian}}};
  std::map<Stage, std::set<Kernel>> found;
  for (const KernelInfo& row : kernel_table()) found[row.stage].insert(row.kernel);
  EXPECT_EQ(found, expected);
}

TEST(KernelTable, NamesStagesAsTheLogDoes) {
  EXPECT_EQ(name(Stage::acquire), "acquire");
  EXPECT_EQ(name(Stage::preprocess), "preprocess");
  EXPECT_EQ(name(Stage::track), "track");
  EXPECT_EQ(name(Stage::integrate), "integrate");
  EXPECT_EQ(name(Stage::raycast), "raycast");
  EXPECT_EQ(name(Stage::render), "render");
  EXPECT_EQ(name(Stage::init), "init");
}

struct ExpectedCost {
  Kernel kernel;
  double bytes, flops;
};

class KernelCost : public ::testing::TestWithParam<ExpectedCost> {};

/// 32 input pixels, 8 pixels, 64 voxels, 5x5 neighbours; counted by hand.
TEST_P(KernelCost, IsThatOfTheArraysAndOperations) {
  const ProblemSize problem{{8, 4}, {4, 2}, {4, 4, 4}, 2};
  const Cost cost = info(GetParam().kernel).cost(problem);
  EXPECT_DOUBLE_EQ(cost.bytes, GetParam().bytes);
  EXPECT_DOUBLE_EQ(cost.flops, GetParam().flops);
}

INSTANTIATE_TEST_SUITE_P(
    Kernels, KernelCost,
    ::testing::Values(
        ExpectedCost{Kernel::acquire, 64, 0}, ExpectedCost{Kernel::mm2meters, 48, 8},
        ExpectedCost{Kernel::bilateral_filter, 64, 1808}, ExpectedCost{Kernel::half_sample, 40, 18},
        ExpectedCost{Kernel::depth2vertex, 128, 48}, ExpectedCost{Kernel::vertex2normal, 192, 200},
        ExpectedCost{Kernel::track, 640, 560}, ExpectedCost{Kernel::reduce, 256, 448},
        ExpectedCost{Kernel::solve, 224, 2160}, ExpectedCost{Kernel::align, 384, 1008},
        ExpectedCost{Kernel::integrate, 313.6, 1152}, ExpectedCost{Kernel::raycast, 448, 8568},
        ExpectedCost{Kernel::render_depth, 64, 80}, ExpectedCost{Kernel::render_track, 64, 0},
        ExpectedCost{Kernel::render_volume, 288, 8728}, ExpectedCost{Kernel::init_volume, 256, 0},
        ExpectedCost{Kernel::generate_gaussian, 20, 20}),
    [](const auto& test) { return std::string(name(test.param.kernel)); });

TEST(Scopes, AcceptThatNobodyListens) {
  EXPECT_NO_THROW({
    const StageScope stage(nullptr, Stage::track);
    const KernelScope kernel(nullptr, Kernel::track);
  });
}

}  // namespace
}  // namespace slambench
