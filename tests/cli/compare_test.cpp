// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
// `slambench compare` and `slambench run --fail-if` as their user meets them.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "analysis/run_group.h"
#include "cli/small_recording.h"
#include "slambench/all_parameters.h"
#include "support/program.h"

namespace slambench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using Arguments = std::vector<std::string>;

class CompareTest : public ::testing::Test {
 protected:
  void SetUp() override { program_.folder().write("small.raw", testing::small_raw(12)); }

  testing::Outcome run(const std::string& out, const Arguments& more = {}) {
    Arguments arguments = testing::small_run();
    arguments.back() = out;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return program_.run(arguments);
  }
  testing::Outcome compare(Arguments arguments) {
    arguments.insert(arguments.begin(), "compare");
    return program_.run(arguments);
  }

  testing::Program program_{SLAMBENCH_PROGRAM};
};

TEST_F(CompareTest, ComparesBackendsAndSaysWhatSingleRunsTell) {
  ASSERT_EQ(run("a", {"--backend", "serial"}).status, 0);
  ASSERT_EQ(run("b", {"--backend", "openmp"}).status, 0);
  const testing::Outcome outcome = compare({"a", "b"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("in implementation: backend serial against openmp"),
                                 HasSubstr("One run a side"), HasSubstr("raycast")));
  const testing::Outcome to_file = compare({"a", "b", "b", "--format", "json", "-o", "c.json"});
  EXPECT_EQ(to_file.status, 0) << to_file.err;
  EXPECT_THAT(to_file.out, IsEmpty());
  const auto json =
      nlohmann::json::parse(testing::Program::contents(program_.folder().path("c.json")));
  EXPECT_EQ(json.at("comparisons").size(), 2u);
}

TEST_F(CompareTest, RefusesDifferentTasksUnlessTold) {
  ASSERT_EQ(run("a").status, 0);
  ASSERT_EQ(run("b", {"--mu", "0.2"}).status, 0);
  const testing::Outcome refused = compare({"a", "b"});
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.err, AllOf(StartsWith("slambench: a and b did not compute the same: mu (0.1 "
                                            "against 0.2)"),
                                 HasSubstr("--allow KEY")));
  EXPECT_THAT(refused.out, IsEmpty());
  EXPECT_EQ(compare({"a", "b", "--allow", "mu"}).status, 0);
  EXPECT_EQ(compare({"a", "b", "--allow-different"}).status, 0);
  EXPECT_EQ(compare({"a", "b", "--allow", "far"}).status, 3);
  EXPECT_EQ(compare({"a"}).status, 2);
  EXPECT_EQ(compare({"a", "nowhere"}).status, 3);
  EXPECT_EQ(compare({"a", "a", "--format", "xml"}).status, 2);
}

TEST_F(CompareTest, HowItIsComputedAndMeasuredIsNoOtherTask) {
  ASSERT_EQ(run("a").status, 0);
  ASSERT_EQ(run("b", {"--opencl-raycast", "64,1,1", "--meter-rate", "5"}).status, 0);
  const testing::Outcome outcome = compare({"a", "b"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("opencl-raycast 0,0,0"), HasSubstr("meter-rate 10 against 5")));
}

TEST(ParameterRoles, SayWhatDecidesTheResult) {
  const ParameterRoles roles = roles_of(AllParameters().lists());
  for (const char* task : {"kinectfusion.mu", "source.noise", "run.frames", "run.warmup-frames"}) {
    EXPECT_EQ(roles.at(task), ParameterRole::task) << task;
  }
  for (const char* how : {"backend.backend", "backend.threads", "kinectfusion.map",
                          "kinectfusion.fused", "opencl.opencl-raycast",
                          "opencl.opencl-build-options", "meters.meter-rate", "run.preset"}) {
    EXPECT_EQ(roles.at(how), ParameterRole::implementation) << how;
  }
  for (const char* where : {"output.out", "output.images", "run.repeat", "run.warmup"}) {
    EXPECT_EQ(roles.at(where), ParameterRole::bookkeeping) << where;
  }
}

TEST_F(CompareTest, EndsWithStatus5WhenALimitIsViolated) {
  ASSERT_EQ(run("a").status, 0);
  const testing::Outcome outcome = compare({"a", "a", "--fail-if", "fps>0"});
  EXPECT_EQ(outcome.status, 5);
  EXPECT_THAT(outcome.out, HasSubstr("no difference shown"));
  EXPECT_THAT(outcome.err, AllOf(StartsWith("slambench: a: fps is "), HasSubstr("fps>0")));
  EXPECT_EQ(compare({"a", "a", "--fail-if", "ratio(fps)<0.9", "--fail-if", "fps<=0"}).status, 0);
  EXPECT_EQ(compare({"a", "a", "--fail-if", "ratio(fps)"}).status, 2);
}

TEST_F(CompareTest, RunsKeepTheirResultsWhenALimitIsViolated) {
  const testing::Outcome violated =
      run("a", {"--fail-if", "fps<0", "--fail-if", "processed>=12", "--fail-if", "time.wall_s>0"});
  EXPECT_EQ(violated.status, 5);
  EXPECT_THAT(violated.err, AllOf(HasSubstr("processed is 12, not wanted: processed>=12; "
                                            "time.wall_s is ")));
  EXPECT_THAT(violated.out, HasSubstr("results"));
  EXPECT_EQ(compare({"a", "a"}).status, 0);
  EXPECT_EQ(run("b", {"--fail-if", "lost>12"}).status, 0);
  const testing::Outcome unknown = run("c", {"--fail-if", "speed<1"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("unknown figure 'speed'; known are fps"));
  const testing::Outcome absent = run("d", {"--fail-if", "ate_rmse_m>0.05"});
  EXPECT_EQ(absent.status, 4) << "the recording has no ground truth";
  EXPECT_THAT(absent.err, HasSubstr("ate_rmse_m was not measured: "));
}

}  // namespace
}  // namespace slambench
