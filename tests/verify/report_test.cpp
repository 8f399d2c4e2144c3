// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "verify/report.h"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

namespace slambench {
namespace {

using testing::HasSubstr;
using testing::Not;

/// More backends than fit beside each other, of which one disagrees and one is not there.
AgreementReport example() {
  AgreementReport report;
  report.seed = 7;
  report.backends.push_back({"none-such", "", {false, "no such device"}});
  for (const char* backend : {"serial", "openmp", "a_long_backend", "another_backend", "one_more",
                              "second_to_last", "the_last_one"}) {
    report.backends.push_back({backend, "a device", {}});
    for (const Check& check : check_table()) {
      Agreement result{check.name, backend, MapKind::grid, Verdict::agrees, 3, {}, {}};
      if (report.backends.size() == 2) result.verdict = Verdict::reference;
      if (report.backends.size() == 3 && check.name == "align") {
        result.verdict = Verdict::unsupported;
      }
      report.results.push_back(result);
    }
  }
  Agreement& wrong = report.results.back();
  wrong.verdict = Verdict::disagrees;
  wrong.failures = {{"room 3x5", "translation, m", 0.25, 0.125, "frame 3"},
                    {"room 3x5", "rotation, rad", std::numeric_limits<double>::infinity(), 1, ""}};
  wrong.closest = wrong.failures[0];
  return report;
}

TEST(ReportText, FitsTheTerminal) {
  std::istringstream lines(to_text(example(), 80));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
}

TEST(ReportText, SaysWhatIsWrongMissingAndUnsupported) {
  const std::string text = to_text(example(), 80);
  EXPECT_THAT(text, HasSubstr("FAIL"));
  EXPECT_THAT(text, HasSubstr("pipeline on the_last_one/grid: room 3x5"));
  EXPECT_THAT(text, HasSubstr("translation, m: found 0.25, allowed 0.125"));
  EXPECT_THAT(text, HasSubstr("frame 3"));
  EXPECT_THAT(text, HasSubstr("none-such: unavailable: no such device"));
  EXPECT_THAT(text, HasSubstr("none  unsupported"));
  EXPECT_THAT(text, HasSubstr("106 of 107 agree with serial/grid"));
  EXPECT_THAT(text, HasSubstr("seed 7"));
}

TEST(ReportText, AReferenceAloneIsNoSuccess) {
  AgreementReport report;
  report.results.push_back({"track", "serial", MapKind::grid, Verdict::reference, 0, {}, {}});
  EXPECT_THAT(to_text(report, 80), HasSubstr("nothing to compare with the reference"));
  EXPECT_THAT(to_text(report, 80), Not(HasSubstr("agree with")));
}

TEST(ReportJson, HoldsEveryResult) {
  const AgreementReport report = example();
  const auto json = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(json["agrees"], false);
  EXPECT_EQ(json["backends"][0]["reason"], "no such device");
  ASSERT_EQ(json["results"].size(), report.results.size());
  const auto& last = json["results"].back();
  EXPECT_EQ(last["verdict"], "disagrees");
  EXPECT_EQ(last["failures"][0]["found"], 0.25);
  EXPECT_FALSE(last["failures"][1].contains("found"));  // infinite
}

TEST(ReportMarkdown, HoldsTolerancesAndVerdicts) {
  const std::string text = to_markdown(example());
  EXPECT_THAT(text, HasSubstr(tolerances_markdown()));
  EXPECT_THAT(text, HasSubstr("| kernel | serial/grid | openmp/grid |"));
  EXPECT_THAT(text, HasSubstr("| align | reference | unsupported | agrees |"));
  EXPECT_THAT(text, HasSubstr("`none-such` was not run, as it was not available"));
}

TEST(AgreementPage, HasTheTolerancesInForce) {
  std::ifstream file(SLAMBENCH_SOURCE_DIR "/docs/agreement.md", std::ios::binary);
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(page, HasSubstr(tolerances_markdown()))
      << "run: slambench verify --markdown > docs/agreement.md";
}

}  // namespace
}  // namespace slambench
