// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// `slambench evaluate` as its user meets it: arguments in, text and status out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "support/temporary_folder.h"

namespace slambench {
namespace {

using ::testing::HasSubstr;

struct Outcome {
  int status = -1;
  std::string output;  ///< standard output and error together
};

class EvaluateTest : public ::testing::Test {
 protected:
  Outcome evaluate(const std::string& arguments) const {
    const std::string command =
        std::string("'") + SLAMBENCH_PROGRAM + "' evaluate " + arguments + " 2>&1";
    Outcome outcome;
    FILE* pipe = ::popen(command.c_str(), "r");
    if (pipe == nullptr) return outcome;
    std::array<char, 4096> buffer;
    while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
      outcome.output.append(buffer.data(), n);
    }
    const int ended = ::pclose(pipe);
    outcome.status = WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
    return outcome;
  }

  /// A square of 1 m, one pose a second from `start` on, shifted along x.
  std::string write_square(const char* name, double start, double shift) const {
    std::ostringstream text;
    const double corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (int i = 0; i < 8; ++i) {
      text << start + i << ' ' << corners[i % 4][0] + shift << ' ' << corners[i % 4][1]
           << " 0 0 0 0 1\n";
    }
    return folder_.write(name, text.str());
  }

  testing::TemporaryFolder folder_;
  const std::string truth_ = write_square("truth.txt", 0, 0);
  const std::string estimate_ = write_square("estimate.txt", 0, 0.5);
};

TEST_F(EvaluateTest, PrintsATableOf80Columns) {
  const Outcome outcome = evaluate(estimate_ + " " + truth_ + " --alignment all");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.output, HasSubstr("8 pairs by the rule of evo, within 0.01 s\n"));
  EXPECT_THAT(outcome.output, HasSubstr("0 of 8 poses of the estimate\n"));
  EXPECT_THAT(outcome.output, HasSubstr("none             0.500000   0.500000   0.500000   "
                                        "0.000000   0.500000   0.500000\n"));
  EXPECT_THAT(outcome.output, HasSubstr("Relative pose error over 1 s, 7 pairs\n"));
  std::istringstream lines(outcome.output);
  for (std::string line; std::getline(lines, line);) {
    if (line.find(folder_.path()) != std::string::npos) continue;
    EXPECT_LE(line.size(), 80u) << line;
  }
}

TEST_F(EvaluateTest, DefaultsToTheRigidAlignment) {
  const auto json = nlohmann::json::parse(evaluate(estimate_ + " " + truth_ + " --json").output);
  EXPECT_EQ(json.at("association").at("rule"), "evo");
  EXPECT_EQ(json.at("matched"), 8);
  EXPECT_EQ(json.at("total"), 8);
  EXPECT_EQ(json.at("lost"), 0);
  EXPECT_EQ(json.at("ate_m").size(), 1u);
  const auto& se3 = json.at("ate_m").at("se3");
  EXPECT_NEAR(se3.at("rmse").get<double>(), 0, 1e-12);
  EXPECT_NEAR(se3.at("alignment").at("translation_m").at(0).get<double>(), -0.5, 1e-12);
  EXPECT_EQ(json.at("rpe").at("unit"), "seconds");
  EXPECT_EQ(json.at("rpe").at("translation_m").at("count"), 7);
}

TEST_F(EvaluateTest, FollowsTheRulesOfTumWhenAsked) {
  const auto json = nlohmann::json::parse(
      evaluate(estimate_ + " " + truth_ + " --json --association tum --alignment none").output);
  EXPECT_EQ(json.at("association").at("max_difference_s"), 0.02);
  EXPECT_NEAR(json.at("ate_m").at("none").at("max").get<double>(), 0.5, 1e-12);
  EXPECT_EQ(json.at("rpe").at("translation_m").at("count"), 6) << "not the pair of the last pose";
}

TEST_F(EvaluateTest, CountsLostPoses) {
  const std::string late = write_square("late.txt", 3, 0);
  const auto json = nlohmann::json::parse(evaluate(late + " " + truth_ + " --json").output);
  EXPECT_EQ(json.at("matched"), 5);
  EXPECT_EQ(json.at("lost"), 3);
}

TEST_F(EvaluateTest, TakesAWiderLimit) {
  const std::string off = write_square("off.txt", 0.25, 0);
  EXPECT_EQ(evaluate(off + " " + truth_).status, 3);
  EXPECT_EQ(evaluate(off + " " + truth_ + " --max-difference 0.3").status, 0);
}

TEST_F(EvaluateTest, CountsDeltaInFramesAndMeters) {
  for (const char* unit : {"frames", "meters"}) {
    const auto json = nlohmann::json::parse(
        evaluate(estimate_ + " " + truth_ + " --json --rpe-delta 2 --rpe-unit " + unit).output);
    EXPECT_EQ(json.at("rpe").at("translation_m").at("count"), 6) << unit;
  }
}

TEST_F(EvaluateTest, WhatIsNotMeasuredHasAReason) {
  const Outcome outcome = evaluate(estimate_ + " " + truth_ + " --rpe-delta 100");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.output, HasSubstr("rpe: no two matched poses are 100 s apart"));
  const std::string line = folder_.write("line.txt",
                                         "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n"
                                         "2 2 0 0 0 0 0 1\n");
  const auto json =
      nlohmann::json::parse(evaluate(line + " " + line + " --alignment all --json").output);
  EXPECT_EQ(json.at("ate_m").size(), 2u);
  EXPECT_THAT(json.at("absent").at("ate_m.se3").get<std::string>(), HasSubstr("on one line"));
  EXPECT_EQ(evaluate(line + " " + line).status, 3) << "asked for alone it is an error";
}

TEST_F(EvaluateTest, BadFilesAreStatus3) {
  const std::string none = folder_.path("none.txt");
  const std::string garbage = folder_.write("garbage.txt", "0 1 2 nan 0 0 0 1\n");
  const std::string elsewhere = write_square("elsewhere.txt", 1e6, 0);
  for (const std::string& bad : {none, garbage, elsewhere, folder_.path()}) {
    for (const std::string& arguments : {bad + " " + truth_, truth_ + " " + bad}) {
      const Outcome outcome = evaluate(arguments + " --json");
      EXPECT_EQ(outcome.status, 3) << arguments;
      EXPECT_THAT(outcome.output, HasSubstr(bad));
      EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1);
    }
  }
}

TEST_F(EvaluateTest, BadArgumentsAreStatus2) {
  const std::string files = estimate_ + " " + truth_;
  for (const std::string& arguments :
       {std::string(), estimate_, files + " third", files + " --alignment se4",
        files + " --association best", files + " --max-difference -1",
        files + " --max-difference nan", files + " --max-difference 0.01s",
        files + " --rpe-delta 0", files + " --rpe-delta 0.5 --rpe-unit frames",
        files + " --rpe-unit km", files + " --unknown"}) {
    EXPECT_EQ(evaluate(arguments).status, 2) << arguments;
  }
}

}  // namespace
}  // namespace slambench
