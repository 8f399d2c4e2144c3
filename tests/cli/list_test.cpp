// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// `slambench list` and the help as their user meets them.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "datasets/source.h"
#include "kernels/kernel.h"
#include "slam/kinect_fusion.h"
#include "support/program.h"

namespace slambench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Json = nlohmann::json;

class ListTest : public ::testing::Test {
 protected:
  std::string output(const std::vector<std::string>& arguments) {
    const testing::Outcome outcome = program_.run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return outcome.out;
  }
  /// The help has one entry of the family's name, and says what makes the parameter's name of it.
  static void expect_in_entry_of_family(const std::string& help, const Json& parameter) {
    const std::string family = parameter.at("family"), name = parameter.at("name");
    const std::string word = "KERNEL";
    const std::size_t at = family.find(word), tail = family.size() - at - word.size();
    ASSERT_NE(at, std::string::npos) << family;
    const std::string own = name.substr(at, name.size() - at - tail);
    EXPECT_EQ(family.substr(0, at) + own + family.substr(at + word.size()), name);
    const std::size_t entry = help.find("--" + family + " ");
    ASSERT_NE(entry, std::string::npos) << family;
    EXPECT_EQ(help.find("--" + family + " ", entry + 1), std::string::npos) << family;
    const std::size_t members = help.find("KERNEL: ");
    ASSERT_NE(members, std::string::npos);
    EXPECT_THAT(help.substr(members), HasSubstr(own));
    EXPECT_THAT(help, Not(HasSubstr("--" + name)));
  }
  static void expect_80_columns(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
  }

  testing::Program program_{SLAMBENCH_PROGRAM};
};

TEST_F(ListTest, TellsEverythingThereIs) {
  const std::string text = output({"list"});
  expect_80_columns(text);
  for (const KernelInfo& info : kernel_table()) {
    EXPECT_THAT(text,
                AllOf(HasSubstr(std::string(info.name)), HasSubstr(std::string(info.paper_name))));
  }
  for (const SourceEntry& entry : source_table()) {
    EXPECT_THAT(text, HasSubstr(std::string(entry.layout)));
  }
  for (const char* word : {"serial", "grid", "slambench1", "fast"}) {
    EXPECT_THAT(text, HasSubstr(word));
  }
}

TEST_F(ListTest, TheSameAsJson) {
  const Json json = Json::parse(output({"list", "--json"}));
  EXPECT_EQ(json.at("kernels").size(), kernel_count);
  EXPECT_EQ(json.at("layouts").size(), source_table().size());
  EXPECT_EQ(json.at("backends").at(0).at("name"), "serial");
  EXPECT_EQ(json.at("backends").at(0).at("available"), true);
  EXPECT_EQ(json.at("parameters").at("kinectfusion").size(),
            KinectFusionParameters().describe().parameters.size());
}

TEST_F(ListTest, EveryParameterIsAnOptionWithItsDefault) {
  const std::string help = output({"run", "--help"});
  const std::string list = output({"list", "--parameters"});
  expect_80_columns(help);
  expect_80_columns(list);
  const Json json = Json::parse(output({"list", "--json"}));
  std::set<std::string> letters;
  for (const auto& group : json.at("parameters")) {
    for (const auto& parameter : group) {
      const std::string option = "--" + parameter.at("name").get<std::string>();
      EXPECT_THAT(list, HasSubstr(option));
      if (parameter.contains("family")) {
        expect_in_entry_of_family(help, parameter);
      } else {
        EXPECT_THAT(help, HasSubstr(option));
      }
      if (parameter.contains("letter")) letters.insert(parameter.at("letter"));
    }
  }
  EXPECT_EQ(letters, (std::set<std::string>{"c", "d", "f", "k", "l", "m", "o", "p", "q", "r", "s",
                                            "t", "v", "y", "z"}));
  EXPECT_THAT(help, HasSubstr("-i, --input-file"));
}

TEST_F(ListTest, TheDocumentOfParametersIsUpToDate) {
  EXPECT_EQ(output({"list", "--parameters", "--markdown"}),
            testing::Program::contents(SLAMBENCH_SOURCE_DIR "/docs/parameters.md"))
      << "renew it: slambench list --parameters --markdown > docs/parameters.md";
}

TEST_F(ListTest, MeasuresTheMachine) {
  const std::string text = output({"list", "--machine", "--threads", "1"});
  expect_80_columns(text);
  EXPECT_THAT(text, AllOf(HasSubstr("copy bandwidth"), HasSubstr("GB/s"), HasSubstr("GFLOP/s")));
  const Json json = Json::parse(output({"list", "--machine", "--json"}));
  EXPECT_GE(json.at("threads"), 1);
  EXPECT_GT(json.at("copy_bytes_per_s"), 1e8);
  EXPECT_GT(json.at("fma_flops_per_s"), 1e8);
  EXPECT_EQ(program_.run({"list", "--threads", "2"}).status, 2);
  EXPECT_EQ(program_.run({"list", "--machine", "--parameters"}).status, 2);
}

TEST_F(ListTest, HelpAndVersionGoToStandardOutput) {
  EXPECT_THAT(output({"--help"}), StartsWith("Usage: slambench COMMAND"));
  EXPECT_THAT(output({"run", "-h"}), StartsWith("Usage: slambench run [SEQUENCE] [OPTIONS]"));
  EXPECT_THAT(output({"--version"}), HasSubstr("0.1.0"));
}

TEST_F(ListTest, NothingIsPrintedToNowhere) {
  program_.set_output("/dev/full");
  const testing::Outcome outcome = program_.run({"list"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err, "slambench: standard output: No space left on device\n");
}

}  // namespace
}  // namespace slambench
