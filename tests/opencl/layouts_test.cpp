// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// The design space of the kernels: every layout gives what the reference gives.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "backends/opencl/opencl.h"
#include "core/error.h"
#include "support/temporary_folder.h"
#include "verify/agreement.h"

namespace slambench {
namespace {

struct LayoutCase {
  const char* name;
  KernelLayout layout;
};

/// As on a GPU; vectors of either width, in groups of one and of several work-items.
constexpr LayoutCase cases[] = {{"groups_of_64", {64, 1, 1}},
                                {"groups_of_32_in_turns", {32, 1, 3}},
                                {"eight_lanes", {1, 8, 5}},
                                {"groups_of_4_with_8_lanes", {4, 8, 1}},
                                {"sixteen_lanes", {1, 16, 2}}};

/// Parameters of kernels whose number of lanes, of packets is 1.
constexpr std::string_view without_lanes[] = {"opencl-generate-gaussian", "opencl-sum-groups",
                                              "opencl-depth-tiles", "opencl-classify-bricks",
                                              "opencl-start-depths"};
constexpr std::string_view without_packets[] = {"opencl-sum-groups", "opencl-integrate-bricks"};

bool is_in(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

/// The parameters of the layouts of all kernels.
std::vector<Parameter> layout_parameters(OpenclParameters* parameters) {
  std::vector<Parameter> layouts;
  for (const Parameter& parameter : parameters->describe().parameters) {
    if (!parameter.parts.empty()) layouts.push_back(parameter);
  }
  return layouts;
}

/// This layout for all kernels, as far as they can have it.
BackendOptions with(const KernelLayout& layout) {
  BackendOptions options;
  for (const Parameter& parameter : layout_parameters(&options.opencl)) {
    const int lanes = is_in(without_lanes, parameter.name) ? 1 : layout.lanes;
    const int packets = is_in(without_packets, parameter.name) ? 1 : layout.packets;
    set_from_text(parameter, fmt::format("{},{},{}", layout.group, lanes, packets));
  }
  return options;
}

class Layouts : public ::testing::TestWithParam<LayoutCase> {
 protected:
  void SetUp() override {
    const std::string reason = opencl_obstacle();
    if (!reason.empty()) GTEST_SKIP() << reason;
  }
};

TEST_P(Layouts, AgreeWithTheReference) {
  Candidate candidate = make_candidate("opencl", with(GetParam().layout));
  for (const MapInfo& map : map_table()) {
    for (const Check& check : check_table()) {
      const bool needs_map = !check.kernel || (info(*check.kernel).stage != Stage::preprocess &&
                                               info(*check.kernel).stage != Stage::track);
      if (!needs_map && map.map == MapKind::bricks) continue;
      const Agreement result = agreement(check, candidate, map.map, {});
      EXPECT_EQ(result.verdict, Verdict::agrees)
          << check.name << " on " << map.name << ": "
          << (result.failures.empty() ? "" : result.failures.front().where);
    }
  }
}

/// As in a grid of more voxels than 32 bits count, with lanes and without.
TEST_P(Layouts, AgreeOnTheGridInWideIndices) {
  BackendOptions options = with(GetParam().layout);
  options.opencl.build_options = "-DALWAYS_WIDE";
  Candidate candidate = make_candidate("opencl", options);
  for (const Check& check : check_table()) {
    const bool reads_the_volume =
        check.kernel == Kernel::raycast || check.kernel == Kernel::render_volume;
    if (!reads_the_volume) continue;
    const Agreement result = agreement(check, candidate, MapKind::grid, {});
    EXPECT_EQ(result.verdict, Verdict::agrees)
        << check.name << ": " << (result.failures.empty() ? "" : result.failures.front().where);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Layouts, ::testing::ValuesIn(cases),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(OpenclParameters, FillInWhatSuitsTheKindOfDevice) {
  OpenclParameters parameters;
  EXPECT_GT(parameters.layout("raycast", true).lanes, 1);
  EXPECT_EQ(parameters.layout("raycast", false).lanes, 1);
  const std::vector<ParameterList> lists = {parameters.describe()};
  const Parameter* raycast = find(lists, "opencl-raycast");
  ASSERT_NE(raycast, nullptr);
  set_from_text(*raycast, "32,8,0");
  const KernelLayout layout = parameters.layout("raycast", true);
  EXPECT_EQ(layout.group, 32);
  EXPECT_EQ(layout.lanes, 8);
  EXPECT_EQ(layout.packets, OpenclParameters{}.layout("raycast", true).packets);
}

TEST(OpenclParameters, GiveAKernelItsOwnBuildOptionsAfterThoseOfAll) {
  OpenclParameters parameters;
  EXPECT_EQ(parameters.build_options_of("start_depths"), "");
  const std::vector<ParameterList> lists = {parameters.describe()};
  set_from_text(*find(lists, "opencl-start-depths-options"), "-DA=2");
  EXPECT_EQ(parameters.build_options_of("start_depths"), "-DA=2");
  set_from_text(*find(lists, "opencl-build-options"), "-DA=1 -w");
  EXPECT_EQ(parameters.build_options_of("start_depths"), "-DA=1 -w -DA=2");
  EXPECT_EQ(parameters.build_options_of("raycast"), "-DA=1 -w");
  EXPECT_THROW(parameters.build_options_of("start-depths"), std::invalid_argument);
}

/// What the message says of an option, with what is set for all kernels.
std::string complaint_about(const char* name, const char* options) {
  OpenclParameters parameters;
  parameters.build_options = "-w";
  const std::vector<ParameterList> lists = {parameters.describe()};
  set_from_text(*find(lists, name), options);
  return testing::message_of<UsageError>([&] { parameters.check(); });
}

TEST(OpenclParameters, RefuseBuildOptionsThatDefineTheProgramsOwnMacros) {
  const std::string expected = ", expected none of the macros that the program defines itself: ";
  for (const char* macro : {"GROUP=64", "LANES=8", "PACKETS", "BRICKS=1", "WIDE=1", "ONLY_MISSES=1",
                            "TILE=4", "MOST_TILES=1", "GROUP(x)=x"}) {
    const std::string message =
        complaint_about("opencl-mm2meters-options", (std::string("-DA=1 -D") + macro).c_str());
    EXPECT_NE(message.find(std::string("--opencl-mm2meters-options: found -D") + macro + expected),
              std::string::npos)
        << message;
  }
  for (const char* options : {"-ULANES", "-D LANES=8", "-U LANES -w"}) {
    EXPECT_NE(complaint_about("opencl-build-options", options).find(expected), std::string::npos)
        << options;
  }
}

TEST(OpenclParameters, RefuseBuildOptionsThatEndWhereANameHasToFollow) {
  for (const char* options : {"-D", "-w -U ", "-I", "-D -w"}) {
    EXPECT_NE(complaint_about("opencl-track-options", options).find(" alone, expected a name"),
              std::string::npos)
        << options;
  }
}

TEST(OpenclParameters, TakeOtherBuildOptions) {
  OpenclParameters parameters;
  parameters.build_options = " -DLANES_OF=8 -D A -IGROUP -I . -UB -cl-mad-enable ";
  EXPECT_NO_THROW(parameters.check());
}

TEST(OpenclParameters, RefuseWhatNoKernelCanHave) {
  for (const char* text : {"3,1,1", "1,4,1", "24,16,1"}) {
    OpenclParameters parameters;
    const std::vector<ParameterList> lists = {parameters.describe()};
    set_from_text(*find(lists, "opencl-align"), text);
    const std::string message =
        testing::message_of<UsageError>([&] { parameters.layout("align", true); });
    EXPECT_NE(message.find(std::string("--opencl-align: found ") + text), std::string::npos)
        << message;
  }
}

/// What is wrong with this layout of one kernel; "" for nothing.
std::string fault_of(std::string_view name, const std::string& layout) {
  OpenclParameters parameters;
  set_from_text(*find({parameters.describe()}, name), layout);
  try {
    parameters.check();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(OpenclParameters, RefuseNumbersOfALayoutWithoutEffect) {
  OpenclParameters parameters;
  const std::vector<Parameter> layouts = layout_parameters(&parameters);
  ASSERT_EQ(layouts.size(), 19U);
  for (const Parameter& parameter : layouts) {
    const std::string name(parameter.name);
    EXPECT_EQ(fault_of(name, "64,1,1"), "");
    const std::string lanes = is_in(without_lanes, name) ? "lanes of 1" : "lanes of 1, 8 or 16";
    const std::string packets = is_in(without_packets, name) ? ", packets of 1" : "";
    const auto fault = [&](const char* layout) {
      return fmt::format("--{}: found {}, expected a group of a power of two, {}{}", name, layout,
                         lanes, packets);
    };
    EXPECT_EQ(fault_of(name, "32,8,0"), is_in(without_lanes, name) ? fault("32,8,0") : "");
    EXPECT_EQ(fault_of(name, "0,0,2"), is_in(without_packets, name) ? fault("0,0,2") : "");
    const bool says_so = parameter.sentence.find(" alone") != std::string_view::npos;
    EXPECT_EQ(says_so, is_in(without_lanes, name) || is_in(without_packets, name)) << name;
  }
}

TEST(OpenclParameters, RefuseLayoutsOfLessThanThreeNumbers) {
  OpenclParameters parameters;
  const std::vector<ParameterList> lists = {parameters.describe()};
  for (const std::string text : {"64", "64,1", "64,1,1,1"}) {
    EXPECT_EQ(testing::message_of<UsageError>(
                  [&] { set_from_text(*find(lists, "opencl-raycast"), text); }),
              "--opencl-raycast: found '" + text +
                  "', expected three integers in [0, 1024]: GROUP,LANES,PACKETS");
  }
}

TEST(OpenclParameters, AreCheckedWhicheverBackendRuns) {
  BackendOptions options;
  set_from_text(*find({options.opencl.describe()}, "opencl-track"), "3,1,1");
  EXPECT_THROW(create_backend("serial", options), UsageError);
}

}  // namespace
}  // namespace slambench
