// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/run_statistics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sample_record.h"

namespace slambench {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;
using testing::sample_record;

// The measured frames 1, 3 and 4 of the sample take 1, 3 and 4 times its unit.
TEST(TimeFigures, LeaveOutWarmUpAndDroppedFrames) {
  const TimeFigures figures = time_figures(sample_record());
  EXPECT_THAT(figures.warmup, ElementsAre(0));
  EXPECT_EQ(figures.measured_frames, 3u);
  EXPECT_DOUBLE_EQ(figures.computation_s.max, 4 * 15 / 32.0);
  EXPECT_DOUBLE_EQ(figures.computation_s.mean, 8 / 3.0 * 15 / 32);
  EXPECT_DOUBLE_EQ(figures.total_s.min, 63 / 64.0);
}

TEST(TimeFigures, WarmUpCountsProcessedFramesOnly) {
  Record record = sample_record();
  record.warmup_frames = 3;
  const TimeFigures figures = time_figures(record);
  EXPECT_THAT(figures.warmup, ElementsAre(0, 1, 3));
  EXPECT_EQ(figures.measured_frames, 1u);
  EXPECT_DOUBLE_EQ(figures.computation_s.mean, 4 * 15 / 32.0);
}

TEST(TimeFigures, OfStagesCoverAllButStartUp) {
  const TimeFigures figures = time_figures(sample_record());
  ASSERT_EQ(figures.stages.size(), stage_count - 1);
  const StageFigures& raycast = figures.stages[4];
  EXPECT_EQ(raycast.stage, Stage::raycast);
  EXPECT_DOUBLE_EQ(raycast.seconds.when_it_ran.median, 0.75);
  EXPECT_DOUBLE_EQ(raycast.share.value(), 8 / 15.0);
  EXPECT_FALSE(figures.stages[0].share.has_value()) << "acquire is no computation";
  EXPECT_FALSE(figures.stages[5].share.has_value()) << "render is no computation";
}

TEST(TimeFigures, OfKernelsHoldThoseThatWereCalled) {
  Record record = sample_record();
  testing::called(record.frames[0].times, Kernel::raycast, 1, 1);  // a warm-up frame
  testing::called(record.frames[4].times, Kernel::render_volume, 3, 1);
  const TimeFigures figures = time_figures(record);
  std::vector<Kernel> kernels;
  for (const auto& kernel : figures.kernels) kernels.push_back(kernel.kernel);
  EXPECT_THAT(kernels, ElementsAre(Kernel::acquire, Kernel::mm2meters, Kernel::track,
                                   Kernel::integrate, Kernel::render_volume));
  const KernelFigures& track = figures.kernels[2];
  EXPECT_EQ(track.calls, 12);
  EXPECT_DOUBLE_EQ(track.calls_per_frame, 4);
  EXPECT_DOUBLE_EQ(track.seconds.per_frame, 8 / 3.0 / 16);
  EXPECT_DOUBLE_EQ(track.seconds_per_call, 8.0 / 12 / 16);
  EXPECT_DOUBLE_EQ(track.share.value(), 2 / 15.0);
  const KernelFigures& render = figures.kernels[4];
  EXPECT_DOUBLE_EQ(render.seconds.per_frame, 1) << "3 s in one of three frames";
  EXPECT_EQ(render.seconds.when_it_ran.count, 1u);
  EXPECT_DOUBLE_EQ(render.seconds.when_it_ran.median, 3) << "what it takes when it runs";
  EXPECT_DOUBLE_EQ(render.seconds_per_call, 3);
  EXPECT_FALSE(render.share.has_value());
}

TEST(TimeFigures, FramesInWhichAStageDidNotRunCountInItsMeanAlone) {
  Record record = sample_record();
  const auto integrate = static_cast<std::size_t>(Stage::integrate);
  for (const std::size_t frame : {1u, 3u}) {
    record.frames[frame].times.stage_s[integrate] = 0;
    record.frames[frame].times.stage_calls[integrate] = 0;
    testing::called(record.frames[frame].times, Kernel::integrate, 0, 0);
  }
  const TimeFigures figures = time_figures(record);
  const StageFigures& stage = figures.stages[3];
  ASSERT_EQ(stage.stage, Stage::integrate);
  EXPECT_EQ(stage.seconds.when_it_ran.count, 1u);
  EXPECT_DOUBLE_EQ(stage.seconds.when_it_ran.median, 0.5);
  EXPECT_DOUBLE_EQ(stage.seconds.when_it_ran.min, 0.5);
  EXPECT_DOUBLE_EQ(stage.seconds.per_frame, 0.5 / 3);
  EXPECT_DOUBLE_EQ(stage.share.value(), 0.5 / 3 / figures.computation_s.mean);
  double of_stages = 0, of_shares = 0;
  for (const StageFigures& s : figures.stages) of_stages += s.seconds.per_frame;
  for (const StageFigures& s : figures.stages) of_shares += s.share.value_or(0);
  EXPECT_DOUBLE_EQ(of_stages, figures.total_s.mean) << "the means add up";
  EXPECT_DOUBLE_EQ(of_shares, 1);
}

TEST(TimeFigures, OfAStageThatNeverRanHaveNoStatistics) {
  Record record = sample_record();
  for (FrameRecord& frame : record.frames) {
    frame.times.stage_s[static_cast<std::size_t>(Stage::render)] = 0;
    frame.times.stage_calls[static_cast<std::size_t>(Stage::render)] = 0;
  }
  const StageFigures render = time_figures(record).stages[5];
  EXPECT_EQ(render.seconds.when_it_ran.count, 0u);
  EXPECT_EQ(render.seconds.per_frame, 0);
}

TEST(TimeFigures, RatesAreOfComputationAndOfTheWholeLoop) {
  const TimeFigures figures = time_figures(sample_record());
  EXPECT_DOUBLE_EQ(figures.fps_computation.value(), 0.8);
  EXPECT_DOUBLE_EQ(figures.fps_wall.value(), 0.25) << "four processed frames in 16 s";
}

TEST(TimeFigures, AreAbsentWhenNothingWasMeasured) {
  Record record = sample_record();
  record.warmup_frames = 4;
  record.wall_s = 0;
  const TimeFigures figures = time_figures(record);
  EXPECT_EQ(figures.measured_frames, 0u);
  EXPECT_FALSE(figures.fps_computation.has_value());
  EXPECT_FALSE(figures.fps_wall.has_value());
  EXPECT_THAT(figures.kernels, IsEmpty());
}

TEST(FrameCounts, TellLostFromNeverTried) {
  const FrameCounts counts = frame_counts(sample_record());
  EXPECT_EQ(counts.processed, 4u);
  EXPECT_EQ(counts.tracked, 2u);
  EXPECT_EQ(counts.integrated, 2u);
  EXPECT_THAT(counts.untracked, ElementsAre(0, 3));
  EXPECT_THAT(counts.lost, ElementsAre(3));
  EXPECT_THAT(counts.dropped, ElementsAre(2));
}

TEST(Ranges, JoinConsecutiveNumbers) {
  EXPECT_THAT(ranges({0, 1, 2, 5, 7, 8}), ElementsAre(Pair(0, 2), Pair(5, 5), Pair(7, 8)));
  EXPECT_THAT(ranges({}), IsEmpty());
}

TEST(ReasonsInvalid, AreNoneForAWholeRecord) {
  EXPECT_THAT(reasons_invalid(sample_record()), IsEmpty());
}

TEST(ReasonsInvalid, NameWhatIsNotFiniteOrNotTold) {
  Record record = sample_record();
  record.frames[3].T_start_camera(0, 3) = std::nan("");
  record.frames[4].T_start_camera(0, 3) = std::nan("");
  record.frames[4].times.kernel_s[0] = std::numeric_limits<double>::infinity();
  record.provenance.commit.clear();
  record.input_hash.clear();
  record.parameters.clear();
  EXPECT_THAT(reasons_invalid(record),
              ElementsAre("pose not finite in frames 3-4", "time not finite in frames 4",
                          "commit is not known", "input_hash is not known",
                          "the parameters are not known"));
}

TEST(ReasonsInvalid, IncludeARunWithoutFrames) {
  Record record = sample_record();
  record.frames.resize(3);
  record.frames.erase(record.frames.begin(), record.frames.begin() + 2);  // leaves the dropped one
  EXPECT_THAT(reasons_invalid(record), ElementsAre("no frame was processed"));
}

TEST(ReasonsInvalid, AreTheRunsOwnWhenItWasJudged) {
  Record record = sample_record();
  record.frames[3].T_start_camera(0, 3) = std::nan("");
  record.valid = false;
  EXPECT_THAT(reasons_invalid(record), ElementsAre("the run was judged invalid"));
  record.invalid_reasons = {"the trajectory jumps"};
  EXPECT_THAT(reasons_invalid(record), ElementsAre("the trajectory jumps"));
}

}  // namespace
}  // namespace slambench
