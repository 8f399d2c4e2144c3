// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "analysis/limit.h"

#include <gmock/gmock.h>

#include <tuple>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Relation = Limit::Relation;

StoredRun stored(const std::string& members) {
  return parse_stored_run(R"({"format": "slambench-record", )" + members + "}", "record.json");
}

TEST(ParseLimit, ReadsEveryRelation) {
  const std::tuple<const char*, Relation, bool, bool, bool> known[] = {
      {"fps<30", Relation::less, true, false, false},
      {"fps<=30", Relation::at_most, true, true, false},
      {"fps>30", Relation::more, false, false, true},
      {"fps>=30", Relation::at_least, false, true, true},
      {"fps==30", Relation::equal, false, true, false},
      {"fps!=30", Relation::unequal, true, false, true}};
  for (const auto& [text, relation, below, at, above] : known) {
    SCOPED_TRACE(text);
    const Limit limit = parse_limit(text, false);
    EXPECT_EQ(limit.relation, relation);
    EXPECT_EQ(limit.figure, "fps");
    EXPECT_EQ(limit.place, "time.fps_computation");
    EXPECT_EQ(limit.bound, 30);
    EXPECT_EQ(limit.violated_by(29), below);
    EXPECT_EQ(limit.violated_by(30), at);
    EXPECT_EQ(limit.violated_by(31), above);
  }
}

TEST(ParseLimit, ReadsBlanksExponentsAndPlaces) {
  const Limit limit = parse_limit("  ate_rmse_m >\t5e-2 ", false);
  EXPECT_EQ(limit.figure, "ate_rmse_m");
  EXPECT_EQ(limit.bound, 0.05);
  EXPECT_EQ(limit.text, "ate_rmse_m >\t5e-2");
  const Limit negative = parse_limit("time.stages.track.seconds.p99>=-1", false);
  EXPECT_EQ(negative.place, "time.stages.track.seconds.p99");
  EXPECT_EQ(negative.bound, -1);
}

TEST(ParseLimit, ReadsRatiosWhereThereAreTwoRuns) {
  const Limit limit = parse_limit("ratio( fps ) < 0.9", true);
  EXPECT_TRUE(limit.of_ratio);
  EXPECT_EQ(limit.figure, "fps");
  EXPECT_THAT(testing::message_of<UsageError>([] { parse_limit("ratio(fps)<0.9", false); }),
              HasSubstr("slambench compare only"));
}

TEST(ParseLimit, SaysWhatIsWrong) {
  const auto message = [](const char* text) {
    return testing::message_of<UsageError>([&] { parse_limit(text, true); });
  };
  EXPECT_THAT(message(""), HasSubstr("expected FIGURE, one of"));
  EXPECT_THAT(message("fps"), HasSubstr("expected FIGURE, one of"));
  EXPECT_THAT(message("fps=30"), HasSubstr("expected FIGURE, one of"));
  EXPECT_THAT(message("fps<"), HasSubstr("found '' after <, expected a number"));
  EXPECT_THAT(message("fps<30fps"), HasSubstr("found '30fps' after <, expected a number"));
  EXPECT_THAT(message("fps<<30"), HasSubstr("found '<30' after <"));
  EXPECT_THAT(message("fps<nan"), HasSubstr("found 'nan'"));
  EXPECT_THAT(message("fps<inf"), HasSubstr("found 'inf'"));
  EXPECT_THAT(message("<30"), HasSubstr("unknown figure ''"));
  EXPECT_THAT(message("ate>1"), AllOf(HasSubstr("unknown figure 'ate'"), HasSubstr("ate_rmse_m"),
                                      HasSubstr("kernel_raycast_s")));
  EXPECT_THAT(message("ratio(fps<1"), HasSubstr("unknown figure 'ratio(fps'"));
  EXPECT_THAT(message("ratio()<1"), HasSubstr("unknown figure ''"));
}

TEST(Violations, NameFigureValueAndLimit) {
  const StoredRun run = stored(R"("time": {"fps_computation": 25, "wall_s": 3})");
  EXPECT_THAT(violations({parse_limit("fps<30", false), parse_limit("fps>30", false),
                          parse_limit("time.wall_s > 2", false)},
                         run),
              ElementsAre("fps is 25, not wanted: fps<30",
                          "time.wall_s is 3, not wanted: time.wall_s > 2"));
}

TEST(Violations, AreNotDecidedByWhatWasNotMeasured) {
  const StoredRun run =
      stored(R"("time": {"fps_computation": 25}, "absent": {"energy": "no sensor"})");
  const Limit energy = parse_limit("energy_j>1", false);
  EXPECT_THAT(testing::message_of<UnavailableError>([&] { violations({energy}, run); }),
              AllOf(HasSubstr("energy_j was not measured: no sensor")));
  EXPECT_THAT(violations({energy, parse_limit("fps<30", false)}, run), ::testing::SizeIs(1));
  EXPECT_THAT(violations({parse_limit("ratio(energy_j)>1", true)}, run), IsEmpty());
}

TEST(Violations, TakeTheMedianOfRepeats) {
  const StoredRun run = stored(
      R"("time": {"fps_computation": 10}, "repetition": {"figures":
         {"time.fps_computation": {"values": [10, 40, 20]}}})");
  EXPECT_THAT(violations({parse_limit("fps<15", false)}, run), IsEmpty());
  EXPECT_THAT(violations({parse_limit("fps<30", false)}, run), ::testing::SizeIs(1));
}

}  // namespace
}  // namespace slambench
