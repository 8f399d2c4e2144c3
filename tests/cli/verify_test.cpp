// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// `slambench verify` as its user meets it.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/small_recording.h"
#include "support/program.h"

namespace slambench {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

class VerifyTest : public ::testing::Test {
 protected:
  testing::Program program_{SLAMBENCH_PROGRAM};
};

TEST_F(VerifyTest, TellsWhatAgrees) {
  const auto outcome = program_.run({"verify", "--kernel", "half_sample"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("half_sample"));
  EXPECT_THAT(outcome.out, HasSubstr("ref   the reference itself"));
}

TEST_F(VerifyTest, TheReferenceAloneComparesNothing) {
  const auto outcome =
      program_.run({"verify", "--backend", "serial", "--map", "grid", "--kernel", "track"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("nothing to compare with the reference"));
}

TEST_F(VerifyTest, AsJson) {
  const auto outcome = program_.run({"verify", "--kernel", "memory", "--json", "--seed", "42"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json.at("seed"), 42);
  EXPECT_EQ(json.at("agrees"), true);
  EXPECT_EQ(json.at("results").at(0).at("verdict"), "reference");
}

TEST_F(VerifyTest, WrongWordsAreUsageErrors) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"--backend", "abacus"},
                                             {"--map", "abacus"},
                                             {"--kernel", "abacus"},
                                             {"--seed", "-1"},
                                             {"--frames", "3"},
                                             {"--json", "--markdown"}}) {
    std::vector<std::string> all = {"verify"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const auto outcome = program_.run(all);
    EXPECT_EQ(outcome.status, 2) << arguments[0];
    EXPECT_EQ(outcome.out, "") << arguments[0];
  }
}

TEST_F(VerifyTest, TakesRealFrames) {
  program_.folder().write("small.raw", testing::small_raw(2));
  const auto outcome = program_.run(
      {"verify", "--kernel", "mm2meters", "--sequence", "small.raw", "--frames", "2", "--json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out).at("recordings"), Json::array({"small"}));
}

TEST_F(VerifyTest, AMissingSequenceIsBadInput) {
  const auto outcome = program_.run({"verify", "--sequence", "/no/such/place"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("/no/such/place"));
}

}  // namespace
}  // namespace slambench
