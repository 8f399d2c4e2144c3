// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "report/report_run.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "io/files.h"
#include "report/sample_results.h"

namespace slambench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::message_of;

class ReportRunTest : public ::testing::Test {
 protected:
  std::string read_error(const std::string& path) {
    return message_of<InputError>([&] { read_report_run(path); });
  }
  void replace(const std::string& file, const std::string& what, const std::string& with) {
    std::string text = read_file(file);
    const auto at = text.find(what);
    ASSERT_NE(at, std::string::npos);
    write_file(file, text.replace(at, what.size(), with));
  }

  testing::TemporaryFolder folder_;
};

TEST_F(ReportRunTest, ReadsWhatARunLeaves) {
  const ReportRun run = read_report_run(testing::write_run(folder_, "a", testing::full_record()));
  EXPECT_EQ(run.name, "a");
  EXPECT_EQ(run.frames.at("index"), (std::vector<double>{0, 1, 2, 3, 4}));
  EXPECT_TRUE(std::isnan(run.frames.at("computation_s")[2])) << "dropped";
  EXPECT_EQ(run.estimate.size(), 4U);
  EXPECT_EQ(run.truth.size(), 2U);
  ASSERT_EQ(run.pictures.size(), 2U);
  EXPECT_EQ(run.pictures[1].frame, 4);
  EXPECT_EQ(run.pictures[1].kind, "depth");
}

TEST_F(ReportRunTest, TellsRunsOfOneNameApart) {
  const auto runs =
      testing::read_runs({testing::write_run(folder_, "x/run", testing::full_record()),
                          testing::write_run(folder_, "y/run", testing::full_record())});
  EXPECT_EQ(runs[0].name, "x/run");
  EXPECT_EQ(runs[1].name, "y/run");
}

TEST_F(ReportRunTest, RefusesRecordsItDoesNotUnderstand) {
  const std::string path = testing::write_run(folder_, "a", testing::full_record());
  replace(path + "/record.json", "\"schema_version\": ", "\"schema_version\": 9");
  EXPECT_THAT(read_error(path), AllOf(HasSubstr("record.json: schema_version: found 9"),
                                      HasSubstr("as this program writes")));
  write_file(path + "/record.json", "{\"format\": \"another\"}");
  EXPECT_THAT(read_error(path), HasSubstr("expected slambench-record"));
  write_file(path + "/record.json", "{");
  EXPECT_THAT(read_error(path), HasSubstr("no JSON object"));
}

TEST_F(ReportRunTest, RefusesHalfAFolder) {
  for (const char* file : {"frames.csv", "trajectory.tum"}) {
    const std::string path = testing::write_run(folder_, file, testing::full_record());
    std::filesystem::remove(path + "/" + file);
    EXPECT_THAT(read_error(path), HasSubstr(file));
  }
  const std::string path = testing::write_run(folder_, "cut", testing::full_record());
  const std::string rows = read_file(path + "/frames.csv");
  write_file(path + "/frames.csv", rows.substr(0, rows.rfind('\n', rows.size() - 2) + 1));
  EXPECT_THAT(read_error(path), HasSubstr("rows: found 4, expected 5"));
  write_file(path + "/frames.csv", rows + "1,2\r\n");
  EXPECT_THAT(read_error(path), HasSubstr("found 2 fields"));
}

}  // namespace
}  // namespace slambench
