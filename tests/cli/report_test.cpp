// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// `slambench report` as its user meets it.
#include <gmock/gmock.h>

#include "cli/small_result_test.h"

namespace slambench {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class ReportTest : public testing::SmallResultTest {
 protected:
  /// Whether a report can be made here; without plotly.js the program must say so.
  bool available() {
    const auto outcome = program_.run({"report", "out", "-o", "try.html"});
    if (outcome.status == 4) {
      EXPECT_THAT(outcome.err, HasSubstr("unavailable: "));
      EXPECT_THAT(outcome.err, HasSubstr("python3-plotly"));
    }
    return outcome.status != 4;
  }
};

TEST_F(ReportTest, WritesAPage) {
  if (!available()) GTEST_SKIP() << "built without plotly.js";
  for (int again = 0; again < 2; ++again) {
    const auto outcome = program_.run({"report", "out", "-o", "page.html", "--title", "A & B"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, StartsWith("page.html: 1 run, "));
  }
  EXPECT_THAT(file("page.html"), HasSubstr("<title>A &amp; B</title>"));
}

TEST_F(ReportTest, LeavesOtherFilesAlone) {
  if (!available()) GTEST_SKIP() << "built without plotly.js";
  const auto outcome = program_.run({"report", "out", "-o", "small.raw"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--force replaces it"));
  EXPECT_EQ(file("small.raw"), testing::small_raw(8));
  EXPECT_EQ(program_.run({"report", "out", "-o", "small.raw", "--force"}).status, 0);
}

TEST_F(ReportTest, RefusesWhatIsNoRun) {
  const auto outcome = program_.run({"report", "small.raw"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("small.raw: found a file, expected a result folder"));
  EXPECT_EQ(program_.run({"report"}).status, 2);
  EXPECT_EQ(program_.run({"report", "out", "--detail", "-1"}).status, 2);
  EXPECT_EQ(program_.run({"report", "out", "--pictures", "60"}).status, 2) << "has no pictures";
}

}  // namespace
}  // namespace slambench
