// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "runner/repeat.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slambench {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class RepeatTest : public ::testing::Test {
 protected:
  /// A run of one frame that takes the seconds of its turn.
  Record one_run(const RunNumber& run) {
    told_.push_back(to_text(run) + (run.last ? ", the last" : ""));
    const std::size_t i = told_.size() - 1;
    Record record;
    FrameRecord frame;
    const auto track = static_cast<std::size_t>(Stage::track);
    frame.times.stage_s[track] = seconds_.at(i);
    frame.times.stage_calls[track] = 1;
    frame.T_start_camera.translation().x() = moved_ == i ? 1 : 0;
    record.frames = {frame};
    record.wall_s = seconds_.at(i);
    if (interrupted_ == i) {
      record.complete = false;
      record.incomplete_reason = "interrupted after 1 of 2 frames";
    }
    if (broken_ == i) {
      record.valid = false;
      record.invalid_reasons = {"the map is empty"};
    }
    return record;
  }
  Record repeat() {
    return repeat_runs(parameters_, [this](const RunNumber& run) { return one_run(run); });
  }

  static constexpr std::size_t never = 99;
  RunParameters parameters_;
  std::vector<double> seconds_ = {9, 8, 3, 1, 2};
  std::size_t moved_ = never, interrupted_ = never, broken_ = never;
  std::vector<std::string> told_;
};

TEST_F(RepeatTest, RunsOnceUnlessToldOtherwise) {
  const Record record = repeat();
  EXPECT_THAT(told_, ElementsAre("run 1 of 1, the last"));
  EXPECT_EQ(record.repetition.runs, 1);
  EXPECT_THAT(record.repetition.figures.at("time.computation_s.mean").values, ElementsAre(9));
}

TEST_F(RepeatTest, MeasuresAfterTheWarmUpAndShowsTheMedianRun) {
  parameters_.repeat = 3;
  parameters_.warmup = 2;
  const Record record = repeat();
  EXPECT_THAT(told_, ElementsAre("warm-up run 1 of 2", "warm-up run 2 of 2", "run 1 of 3",
                                 "run 2 of 3", "run 3 of 3, the last"));
  EXPECT_EQ(record.wall_s, 2);
  EXPECT_EQ(record.repetition.runs, 3);
  EXPECT_EQ(record.repetition.warmup_runs, 2);
  EXPECT_EQ(record.repetition.shown_run, 3);
  const RepeatedFigure& figure = record.repetition.figures.at("time.computation_s.mean");
  EXPECT_THAT(figure.values, ElementsAre(3, 1, 2));
  EXPECT_EQ(figure.median, 2);
  EXPECT_THAT(record.measurements.conditions.noise, Contains(HasSubstr("differ by 50.0 %")));
  EXPECT_TRUE(record.complete);
  EXPECT_THAT(record.repetition.other_trajectory, IsEmpty());
}

TEST_F(RepeatTest, RunsThatAgreeAreNoNoise) {
  parameters_.repeat = 3;
  seconds_ = {1, 1.01, 1.02};
  EXPECT_THAT(repeat().measurements.conditions.noise, IsEmpty());
}

TEST_F(RepeatTest, AnotherTrajectoryIsSaid) {
  parameters_.repeat = 3;
  moved_ = 1;
  EXPECT_THAT(repeat().repetition.other_trajectory, ElementsAre(2));
}

TEST_F(RepeatTest, AnInterruptedRunIsLeftOutWhenThereAreOthers) {
  parameters_.repeat = 4;
  interrupted_ = 2;
  const Record record = repeat();
  EXPECT_EQ(told_.size(), 3u);
  EXPECT_FALSE(record.complete);
  EXPECT_EQ(record.incomplete_reason, "interrupted after 1 of 2 frames of run 3 of 4");
  EXPECT_THAT(record.repetition.figures.at("time.computation_s.mean").values, ElementsAre(9, 8));
}

TEST_F(RepeatTest, AnInterruptInTheWarmUpLeavesItsRun) {
  parameters_.warmup = 1;
  interrupted_ = 0;
  const Record record = repeat();
  EXPECT_EQ(told_.size(), 1u);
  EXPECT_FALSE(record.complete);
  EXPECT_EQ(record.wall_s, 9);
  EXPECT_EQ(record.repetition.warmup_runs, 0);
}

TEST_F(RepeatTest, OneInvalidRunMakesAllInvalid) {
  parameters_.repeat = 3;
  broken_ = 0;
  const Record record = repeat();
  EXPECT_FALSE(record.valid);
  EXPECT_THAT(record.invalid_reasons, Contains("run 1: the map is empty"));
}

}  // namespace
}  // namespace slambench
