// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// Whose the results are that lie in the folder of a suite.
#include "suite/suite_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "runner/runner.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using Json = nlohmann::json;

class SuiteFolderTest : public ::testing::Test {
 protected:
  static Configuration configuration(const std::string& sequence, const std::string& frames) {
    Configuration c;
    c.folder = c.sequence_name = "a";
    c.variant = "all settings";
    c.sequence = sequence;
    c.assignments = {{"frames", frames}};
    return c;
  }
  static SuiteBuild build(const std::string& commit, const std::string& executable) {
    SuiteBuild build;
    build.provenance.commit = commit;
    build.executable = executable;
    return build;
  }
  void write_result(const std::string& place, const std::string& commit) {
    const Json record = {{"format", "slambench-record"},
                         {"schema_version", Record::schema_version},
                         {"complete", true},
                         {"valid", true},
                         {"provenance", {{"commit", commit}, {"cores", 0}}},
                         {"parameters", {{"run", {{"frames", {{"value", "30"}}}}}}}};
    folder_.write("out/" + place + "/record.json", record.dump());
  }
  SuiteResults find(const std::vector<Configuration>& configurations, const SuiteBuild& build) {
    return find_results(out_, configurations, build, lists_);
  }

  testing::TemporaryFolder folder_;
  const std::string out_ = folder_.path("out");
  RunParameters run_;
  const std::vector<ParameterList> lists_ = {run_.describe()};
};

TEST_F(SuiteFolderTest, BuildsOfOneCommitDifferInTheirProgramsUnlessTheCommitSaysAll) {
  const std::vector<Configuration> all = {configuration("/data/a", "30")};
  for (const std::string commit : {"abc", "abc-dirty", "unknown"}) {
    write_result("a/1", commit);
    write_suite(out_, "title", all, build(commit, "11"));
    EXPECT_THAT(find(all, build(commit, "11")).done, SizeIs(1)) << commit;
    const SuiteResults other = find(all, build(commit, "22"));
    EXPECT_THAT(other.foreign, SizeIs(commit == "abc" ? 0 : 1));
    if (other.foreign.empty()) continue;
    EXPECT_EQ(other.foreign[0].reason,
              fmt::format("was made by another build of commit {}: the hash of the program was "
                          "'11', is '22' here",
                          commit));
  }
}

TEST_F(SuiteFolderTest, ASequenceWhosePathIsNotKnownTodayKeepsItsResults) {
  write_result("a/1", "abc");
  write_suite(out_, "title", {configuration("/data/a", "30")}, build("abc", ""));
  std::vector<Configuration> today = {configuration("", "30")};
  today[0].folder = "b";
  keep_folders(out_, &today);
  EXPECT_EQ(today[0].folder, "a");
  EXPECT_EQ(today[0].sequence, "/data/a") << "for a day when it is known";
  const SuiteResults results = find(today, build("abc", ""));
  EXPECT_THAT(results.foreign, IsEmpty());
  EXPECT_THAT(results.done, SizeIs(1));

  write_suite(out_, "title", {configuration("", "30")}, build("abc", ""));
  std::vector<Configuration> known = {configuration("/data/a", "30")};
  known[0].folder = "b";
  keep_folders(out_, &known);
  EXPECT_EQ(known[0].folder, "a");
}

TEST_F(SuiteFolderTest, ResultsOfOtherSettingsNameThem) {
  write_result("a/1", "abc");
  write_result("c/1", "abc");
  write_suite(out_, "title", {configuration("/data/a", "30")}, build("abc", ""));
  std::vector<Configuration> today = {configuration("/data/a", "20")};
  today[0].assignments.push_back({"mu", "0.2"});
  today.push_back(configuration("/data/a", "20"));
  keep_folders(out_, &today);
  const auto foreign = find(today, build("abc", "")).foreign;
  ASSERT_THAT(foreign, SizeIs(2));
  EXPECT_EQ(foreign[0].reason, "is of other settings: frames 30, expected 20");
  EXPECT_EQ(foreign[1].reason, "is of no configuration of the suite");
}

TEST_F(SuiteFolderTest, OnlyCompleteResultsThatDoNotCountAreKept) {
  write_result("a/1", "abc");
  folder_.write("out/a/2/record.json", "{\"format\": \"slamb");
  folder_.write("out/a/3", "a file");
  namespace fs = std::filesystem;
  const std::string kept = discard_results(out_, out_ + "/a/1");
  EXPECT_TRUE(fs::exists(kept + "/record.json")) << kept;
  for (const char* place : {"a/2", "a/3", "a/4"}) {
    EXPECT_EQ(discard_results(out_, out_ + "/" + place), "") << place;
  }
  EXPECT_FALSE(fs::exists(out_ + "/a/1"));
  EXPECT_FALSE(fs::exists(out_ + "/a/2"));
  EXPECT_TRUE(fs::exists(out_ + "/a/3")) << "not what a run leaves";
  EXPECT_EQ(std::distance(fs::directory_iterator(out_ + "/.failed"), {}), 1);
}

}  // namespace
}  // namespace slambench
