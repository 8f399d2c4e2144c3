// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// `slambench export` as its user meets it.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/small_result_test.h"

namespace slambench {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class ExportTest : public testing::SmallResultTest {};

TEST_F(ExportTest, WritesEveryFormat) {
  const auto csv = program_.run({"export", "out", "--format", "csv"});
  EXPECT_EQ(csv.status, 0) << csv.err;
  EXPECT_THAT(csv.out, StartsWith("run,repeats,sequence,backend,"));
  EXPECT_THAT(program_.run({"export", "out", "--format", "csv-long"}).out,
              HasSubstr(",processed,,1,8,\r\n"));
  for (const char* format : {"google-benchmark", "trace"}) {
    const auto outcome = program_.run({"export", "out", "--format", format, "-o", format});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_TRUE(nlohmann::json::accept(file(format))) << format;
  }
  const auto trace = nlohmann::json::parse(file("trace"));
  double last = -1;
  for (const auto& event : trace.at("traceEvents")) {
    if (event.at("ph") != "X" || event.at("cat") != "frame") continue;
    EXPECT_GE(event.at("ts").get<double>(), last) << "frames overlap";
    last = event.at("ts").get<double>() + event.at("dur").get<double>();
  }
  EXPECT_GT(last, 0);
}

TEST_F(ExportTest, LeavesFilesAlone) {
  const auto outcome = program_.run({"export", "out", "--format", "csv", "-o", "small.raw"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--out small.raw: is there already; --force replaces it"));
  EXPECT_EQ(file("small.raw"), testing::small_raw(8));
  EXPECT_EQ(program_.run({"export", "out", "--format", "csv", "-o", "small.raw", "--force"}).status,
            0);
  EXPECT_THAT(file("small.raw"), StartsWith("run,"));
  EXPECT_EQ(program_.run({"export", "out", "--format", "csv", "-o", "out", "--force"}).status, 2);
}

TEST_F(ExportTest, RefusesWhatItCannotDo) {
  EXPECT_EQ(program_.run({"export", "out"}).status, 2) << "no format";
  EXPECT_EQ(program_.run({"export", "out", "--format", "xml"}).status, 2);
  EXPECT_EQ(program_.run({"export", "--format", "csv"}).status, 2);
  EXPECT_EQ(program_.run({"export", "small.raw", "--format", "csv"}).status, 3);
}

}  // namespace
}  // namespace slambench
