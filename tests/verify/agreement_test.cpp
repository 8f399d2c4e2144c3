// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <set>

#include "backends/registry.h"
#include "core/error.h"
#include "verify/agreement.h"
#include "verify/broken_backend.h"
#include "verify/report.h"

namespace slambench {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;

// ---------------------------------------------------------------- every backend that there is

struct Combination {
  std::string backend;
  MapKind map;
  std::string check;
};

std::vector<Combination> combinations() {
  std::vector<Combination> all;
  for (const BackendEntry& entry : backend_table()) {
    for (const MapInfo& map : map_table()) {
      // The reference held against itself would test nothing.
      if (entry.name == reference_backend && map.map == reference_map) continue;
      for (const Check& check : check_table()) {
        all.push_back({std::string(entry.name), map.map, std::string(check.name)});
      }
    }
  }
  return all;
}

std::string test_name(const testing::TestParamInfo<Combination>& info) {
  const Combination& c = info.param;
  return fmt::format("{}_{}_{}", c.backend, name(c.map), c.check);
}

std::string text(const Agreement& result) {
  std::string all;
  for (const Deviation& failure : result.failures) {
    all += fmt::format("{}: {}: found {}, allowed {}; {}\n", failure.input, failure.quantity,
                       failure.found, failure.allowed, failure.where);
  }
  return all;
}

class Agrees : public testing::TestWithParam<Combination> {};

TEST_P(Agrees, WithTheReference) {
  const auto& [backend, map, check] = GetParam();
  for (const BackendEntry& entry : backend_table()) {
    if (entry.name != backend) continue;
    const Availability availability = entry.availability();
    if (!availability.available) GTEST_SKIP() << "unavailable: " << availability.reason;
  }
  Candidate candidate = make_candidate(backend, {});
  const Agreement result = agreement(*find_check(check), candidate, map, {});
  if (result.verdict == Verdict::unsupported) GTEST_SKIP() << "unsupported";
  EXPECT_EQ(result.verdict, Verdict::agrees) << text(result);
  EXPECT_GT(result.cases, 0);
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Agrees);
INSTANTIATE_TEST_SUITE_P(All, Agrees, testing::ValuesIn(combinations()), test_name);

// ---------------------------------------------------------------- the program itself

Candidate broken(std::optional<Kernel> kernel, Defect defect) {
  return {std::make_unique<BrokenBackend>(kernel, defect),
          std::make_unique<BrokenBackend>(kernel, defect)};
}

class FindsWhatIsWrong : public testing::TestWithParam<Kernel> {
 protected:
  Agreement with(Defect defect) {
    Candidate candidate = broken(GetParam(), defect);
    AgreementOptions options;
    options.fail_fast = true;
    return agreement(*find_check(name(GetParam())), candidate, MapKind::grid, options);
  }
  static bool writes_image(Kernel kernel) {
    static const std::set<Kernel> others = {Kernel::reduce, Kernel::solve, Kernel::align,
                                            Kernel::integrate, Kernel::init_volume};
    return !others.contains(kernel);
  }
  static auto has(std::string_view quantity) {
    return Contains(Field(&Deviation::quantity, quantity));
  }
};

TEST_P(FindsWhatIsWrong, NothingInACorrectKernel) {
  Candidate candidate = broken(std::nullopt, Defect::none);
  const Agreement result = agreement(*find_check(name(GetParam())), candidate, MapKind::grid, {});
  EXPECT_EQ(result.verdict, Verdict::agrees) << text(result);
  EXPECT_GT(result.cases, 1);
}

TEST_P(FindsWhatIsWrong, AWrongValue) {
  const Agreement result = with(Defect::value);
  EXPECT_EQ(result.verdict, Verdict::disagrees);
  ASSERT_FALSE(result.failures.empty());
  EXPECT_GT(result.failures.front().found, result.failures.front().allowed);
  EXPECT_FALSE(result.failures.front().input.empty());
}

TEST_P(FindsWhatIsWrong, AResultThatIsNotWritten) {
  static const std::set<Kernel> not_apart = {Kernel::solve, Kernel::init_volume};
  if (not_apart.contains(GetParam())) GTEST_SKIP() << "writes one thing";
  const Agreement result = with(Defect::unwritten);
  EXPECT_EQ(result.verdict, Verdict::disagrees);
  if (writes_image(GetParam())) {
    EXPECT_THAT(result.failures, has("output pixels not written"));
  }
}

TEST_P(FindsWhatIsWrong, AWriteBehindTheOutput) {
  if (!writes_image(GetParam())) GTEST_SKIP() << "writes no image";
  EXPECT_THAT(with(Defect::overrun).failures, has("pixels written past the end"));
}

TEST_P(FindsWhatIsWrong, AChangedInput) {
  static const std::set<Kernel> without = {Kernel::solve, Kernel::init_volume,
                                           Kernel::generate_gaussian};
  if (without.contains(GetParam())) GTEST_SKIP() << "has no input in the backend's memory";
  static const std::set<Kernel> of_volume = {Kernel::raycast, Kernel::render_volume};
  EXPECT_THAT(
      with(Defect::input).failures,
      has(of_volume.contains(GetParam()) ? "input voxels modified" : "input pixels modified"));
}

TEST_P(FindsWhatIsWrong, AResultThatIsAnotherEveryTime) {
  static const std::set<Kernel> steady = {Kernel::render_depth, Kernel::render_track,
                                          Kernel::render_volume, Kernel::init_volume};
  if (steady.contains(GetParam())) GTEST_SKIP() << "no difference would be within tolerance";
  EXPECT_THAT(with(Defect::unsteady).failures, has("differs when repeated"));
}

TEST_P(FindsWhatIsWrong, AnException) {
  const Agreement result = with(Defect::throws);
  EXPECT_THAT(result.failures, has("exception"));
  EXPECT_THAT(result.failures.front().where, HasSubstr("the device is lost"));
}

/// Where the room's walls are farther than what was seen.
TEST(RenderVolume, ShowsRaysThatGoNoFartherThanWhatWasSeen) {
  Candidate candidate = broken(Kernel::render_volume, Defect::seen);
  const Agreement result = agreement(*find_check("render_volume"), candidate, MapKind::grid, {});
  const std::string quantity = "pixels apart by more, of pixels";
  const auto apart = [&](const char* input, const char* look) {
    return Contains(testing::AllOf(Field(&Deviation::input, input),
                                   Field(&Deviation::quantity, quantity),
                                   Field(&Deviation::where, HasSubstr(look))));
  };
  EXPECT_THAT(result.failures,
              apart("room written 64x64x64", "from inside 97x41, farther than seen"))
      << text(result);
}

std::vector<Kernel> checked_kernels() {
  std::vector<Kernel> kernels;
  for (const Check& check : check_table()) {
    if (check.kernel) kernels.push_back(*check.kernel);
  }
  return kernels;
}

INSTANTIATE_TEST_SUITE_P(Kernels, FindsWhatIsWrong, testing::ValuesIn(checked_kernels()),
                         [](const auto& test) { return std::string(name(test.param)); });

TEST(Pipeline, AgreesForACorrectBackend) {
  Candidate candidate = broken(std::nullopt, Defect::none);
  const Agreement result = agreement(*find_check("pipeline"), candidate, MapKind::grid, {});
  EXPECT_EQ(result.verdict, Verdict::agrees) << text(result);
}

TEST(Pipeline, ShowsAWrongTracker) {
  Candidate candidate = broken(Kernel::align, Defect::value);
  const Agreement result = agreement(*find_check("pipeline"), candidate, MapKind::grid, {});
  EXPECT_EQ(result.verdict, Verdict::disagrees);
}

TEST(Memory, ShowsNothingInACorrectBackend) {
  Candidate candidate = broken(std::nullopt, Defect::none);
  const Agreement result = agreement(*find_check("memory"), candidate, MapKind::grid, {});
  EXPECT_EQ(result.verdict, Verdict::agrees) << text(result);
}

TEST(CheckTable, HasEveryKernelThatBackendsCompute) {
  std::set<std::string_view> checks;
  for (const Check& check : check_table()) checks.insert(check.name);
  for (const KernelInfo& row : kernel_table()) {
    EXPECT_EQ(checks.contains(row.name), row.kernel != Kernel::acquire) << row.name;
  }
}

TEST(CheckTable, HasAToleranceWithAReasonForEach) {
  ASSERT_EQ(tolerance_table().size(), check_table().size());
  for (std::size_t i = 0; i < check_table().size(); ++i) {
    EXPECT_EQ(tolerance_table()[i].check, check_table()[i].name);
    EXPECT_FALSE(tolerance_table()[i].limits.empty());
    EXPECT_FALSE(tolerance_table()[i].reason.empty());
  }
}

TEST(Verify, TheReferenceIsNotHeldAgainstItself) {
  AgreementSelection selection;
  selection.backend = "serial";
  selection.map = MapKind::grid;
  const AgreementReport report = verify(selection, {}, {});
  for (const Agreement& result : report.results) {
    EXPECT_EQ(result.verdict, result.check == "align" ? Verdict::unsupported : Verdict::reference);
    EXPECT_EQ(result.cases, 0);
  }
  EXPECT_EQ(report.results.size(), check_table().size());
  EXPECT_TRUE(report.agrees());
}

TEST(Verify, UnknownNamesAreUsageErrors) {
  AgreementSelection unknown_backend;
  unknown_backend.backend = "abacus";
  EXPECT_THROW(verify(unknown_backend, {}, {}), UsageError);
  AgreementSelection unknown_check;
  unknown_check.check = "abacus";
  EXPECT_THROW(verify(unknown_check, {}, {}), UsageError);
}

}  // namespace
}  // namespace slambench
