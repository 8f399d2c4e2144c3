// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/frame_timer.h"

#include <gtest/gtest.h>

#include <numeric>

#include "support/fake_clock.h"

namespace slambench {
namespace {

double kernel_s(const FrameTimes& times, Kernel kernel) {
  return times.kernel_s[static_cast<std::size_t>(kernel)];
}

int calls(const FrameTimes& times, Kernel kernel) {
  return times.kernel_calls[static_cast<std::size_t>(kernel)];
}

class FrameTimerTest : public ::testing::Test {
 protected:
  void kernel(Kernel which, double seconds) {
    const KernelScope scope(&timer_, which);
    clock_.advance(seconds);
  }

  testing::FakeClock clock_;
  FrameTimer timer_{clock_};
};

TEST_F(FrameTimerTest, StagesHoldTheirKernelsAndWhatLiesBetween) {
  {
    const StageScope stage(&timer_, Stage::track);
    clock_.advance(0.5);
    kernel(Kernel::track, 1);
    clock_.advance(0.25);
    kernel(Kernel::reduce, 2);
  }
  const FrameTimes times = timer_.take();
  EXPECT_DOUBLE_EQ(times.stage(Stage::track), 3.75);
  EXPECT_DOUBLE_EQ(kernel_s(times, Kernel::track), 1);
  EXPECT_DOUBLE_EQ(kernel_s(times, Kernel::reduce), 2);
  EXPECT_DOUBLE_EQ(std::accumulate(times.stage_s.begin(), times.stage_s.end(), 0.0), 3.75);
  EXPECT_DOUBLE_EQ(std::accumulate(times.kernel_s.begin(), times.kernel_s.end(), 0.0), 3);
}

TEST_F(FrameTimerTest, AddsUpRepeatedCalls) {
  for (const double seconds : {1.0, 2.0, 4.0}) {
    const StageScope stage(&timer_, Stage::preprocess);
    kernel(Kernel::half_sample, seconds);
  }
  const FrameTimes times = timer_.take();
  EXPECT_DOUBLE_EQ(kernel_s(times, Kernel::half_sample), 7);
  EXPECT_EQ(calls(times, Kernel::half_sample), 3);
  EXPECT_EQ(calls(times, Kernel::track), 0);
  EXPECT_DOUBLE_EQ(times.stage(Stage::preprocess), 7);
  EXPECT_EQ(times.stage_calls[static_cast<std::size_t>(Stage::preprocess)], 3);
  EXPECT_EQ(times.stage_calls[static_cast<std::size_t>(Stage::track)], 0);
}

TEST_F(FrameTimerTest, AStageThatTakesNoTimeHasRunAllTheSame) {
  { const StageScope stage(&timer_, Stage::integrate); }
  const FrameTimes times = timer_.take();
  EXPECT_EQ(times.stage_calls[static_cast<std::size_t>(Stage::integrate)], 1);
  EXPECT_EQ(times.stage(Stage::integrate), 0);
}

TEST_F(FrameTimerTest, TakeStartsAnew) {
  kernel(Kernel::integrate, 1);
  timer_.take();
  const FrameTimes times = timer_.take();
  EXPECT_EQ(kernel_s(times, Kernel::integrate), 0);
  EXPECT_EQ(calls(times, Kernel::integrate), 0);
  EXPECT_EQ(times.total_s(), 0);
}

TEST_F(FrameTimerTest, KernelsMeasuredElsewhereLeaveTheStageItsWallTime) {
  {
    const StageScope stage(&timer_, Stage::raycast);
    clock_.advance(0.001);
  }
  timer_.kernel_measured(Kernel::raycast, 5);
  timer_.kernel_measured(Kernel::raycast, 6);
  const FrameTimes times = timer_.take();
  EXPECT_NEAR(times.stage(Stage::raycast), 0.001, 1e-9);
  EXPECT_DOUBLE_EQ(kernel_s(times, Kernel::raycast), 11);
  EXPECT_EQ(calls(times, Kernel::raycast), 2);
}

/// Nobody waits between the stages of such a frame: a stage is its kernels, and the wall time of
/// all of it is the computation's.
TEST_F(FrameTimerTest, StagesOfAFrameInOneGoAreTheirKernels) {
  {
    const InOneGoScope scope(&timer_);
    clock_.advance(10);
    timer_.kernel_measured(Kernel::bilateral_filter, 1);
    timer_.kernel_measured(Kernel::vertex2normal, 2);
    timer_.kernel_measured(Kernel::align, 0.5);
    timer_.kernel_measured(Kernel::raycast, 4);
    timer_.transfer_measured(Transfer::to_device, 1000, 0.25);
  }
  clock_.advance(100);
  timer_.kernel_measured(Kernel::raycast, 50);  // of nobody's computation
  const FrameTimes times = timer_.take();
  EXPECT_DOUBLE_EQ(times.stage(Stage::preprocess), 1);
  EXPECT_DOUBLE_EQ(times.stage(Stage::track), 2.5);
  EXPECT_DOUBLE_EQ(times.stage(Stage::raycast), 4);
  EXPECT_EQ(times.stage_calls[static_cast<std::size_t>(Stage::track)], 1);
  EXPECT_EQ(times.stage_calls[static_cast<std::size_t>(Stage::integrate)], 0);
  EXPECT_EQ(calls(times, Kernel::raycast), 2);
  EXPECT_DOUBLE_EQ(times.between_stages_s.value(), 2.5);
  EXPECT_DOUBLE_EQ(times.computation_s(), 10);
  EXPECT_EQ(times.transfers[0].bytes, 1000u);
  EXPECT_EQ(timer_.take().computation_s(), 0);
}

/// Two clocks need not agree: what they make of nothing is not a negative time.
TEST_F(FrameTimerTest, KernelsLongerThanTheWallClockLeaveNothingBetweenStages) {
  {
    const InOneGoScope scope(&timer_);
    clock_.advance(1);
    timer_.kernel_measured(Kernel::raycast, 1.5);
  }
  const FrameTimes times = timer_.take();
  EXPECT_EQ(times.between_stages_s, 0.0);
  EXPECT_DOUBLE_EQ(times.computation_s(), 1.5);
}

TEST_F(FrameTimerTest, NothingIsBetweenTheStagesOfOtherFrames) {
  { const StageScope stage(&timer_, Stage::track); }
  EXPECT_EQ(timer_.take().between_stages_s, std::nullopt);
}

TEST_F(FrameTimerTest, TransfersAddUpByDirectionAndAreInNoOtherTime) {
  {
    const StageScope stage(&timer_, Stage::track);
    clock_.advance(0.001);
    timer_.transfer_measured(Transfer::to_host, 128, 0.25);
    timer_.transfer_measured(Transfer::to_host, 64, 0.5);
    timer_.transfer_measured(Transfer::to_device, 1000, 2);
  }
  timer_.transfer_measured(Transfer::to_host, 1, 1);  // of nobody's stage
  const FrameTimes times = timer_.take();
  const auto& [to_device, to_host] = times.transfers;
  EXPECT_DOUBLE_EQ(to_host.seconds, 0.75);
  EXPECT_EQ(to_host.bytes, 192u);
  EXPECT_EQ(to_host.count, 2);
  EXPECT_DOUBLE_EQ(to_device.seconds, 2);
  EXPECT_EQ(to_device.bytes, 1000u);
  EXPECT_EQ(to_device.count, 1);
  EXPECT_NEAR(times.computation_s(), 0.001, 1e-9);
  EXPECT_NEAR(times.total_s(), 0.001, 1e-9);
  EXPECT_EQ(timer_.take().transfers[0].count, 0);
}

TEST_F(FrameTimerTest, ComputationAndTotalAreThePapers) {
  double seconds = 1;
  for (const Stage stage : {Stage::acquire, Stage::preprocess, Stage::track, Stage::integrate,
                            Stage::raycast, Stage::render, Stage::init}) {
    const StageScope scope(&timer_, stage);
    clock_.advance(seconds);
    seconds *= 2;
  }
  const FrameTimes times = timer_.take();
  EXPECT_DOUBLE_EQ(times.computation_s(), 2 + 4 + 8 + 16);
  EXPECT_DOUBLE_EQ(times.total_s(), 1 + 2 + 4 + 8 + 16 + 32);
}

TEST(SteadyClock, DoesNotGoBackAndSleepsLongEnough) {
  const Clock& clock = steady_clock();
  const double before_s = clock.now_s();
  const double until_s = before_s + 0.02;
  clock.sleep_until(until_s);
  EXPECT_GE(clock.now_s(), until_s);
  clock.sleep_until(before_s);  // long past: returns at once
  EXPECT_LT(clock.now_s(), before_s + 10);
}

}  // namespace
}  // namespace slambench
