// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/stage_counters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/perf_event.h>

#include <thread>

#include "fakes.h"
#include "meters/frame_timer.h"
#include "support/fake_clock.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

using ::testing::HasSubstr;

constexpr std::uint32_t hardware = PERF_TYPE_HARDWARE;

class StageCountersTest : public ::testing::Test {
 protected:
  StageCountersTest() { count(0); }
  void count(std::uint64_t by) {
    perf_.values[{hardware, PERF_COUNT_HW_CPU_CYCLES, -1}] += by;
    perf_.values[{hardware, PERF_COUNT_HW_INSTRUCTIONS, -1}] += 2 * by;
    perf_.values[{hardware, PERF_COUNT_HW_BRANCH_MISSES, -1}] += 3 * by;
  }

  testing::FakePerfEvents perf_;
  std::map<std::string, std::string> absent_;
};

TEST_F(StageCountersTest, CountsWhatPassesWithinEachStage) {
  StageCounters counters(perf_);
  testing::FakeClock clock;
  FrameTimer timer(clock, &counters);
  for (int frame = 0; frame < 2; ++frame) {
    count(1000);
    {
      const StageScope stage(&timer, Stage::track);
      count(10);
    }
    count(1000);
    const StageScope stage(&timer, Stage::raycast);
    count(7);
  }
  const CounterMeasurement counted = counters.take(2, &absent_);
  const CounterValues& track = counted.stages[static_cast<std::size_t>(Stage::track)];
  EXPECT_EQ(counted.frames, 2);
  EXPECT_EQ(track.cycles, 20u);
  EXPECT_EQ(track.instructions, 40u);
  EXPECT_EQ(track.branch_misses, 60u);
  EXPECT_EQ(track.cache_misses, std::nullopt) << "this processor does not count them";
  EXPECT_EQ(absent_["counters.cache_misses"], "no such counter");
  EXPECT_EQ(counted.stages[static_cast<std::size_t>(Stage::raycast)].cycles, 14u);
  EXPECT_EQ(counted.stages[static_cast<std::size_t>(Stage::integrate)].cycles, 0u);
  EXPECT_EQ(counters.take(0, &absent_).stages[static_cast<std::size_t>(Stage::track)].cycles, 0u);
}

/// Where the device goes from stage to stage by itself, the processor is in none of them.
TEST_F(StageCountersTest, SayThatStagesInOneGoAreNotCounted) {
  StageCounters counters(perf_);
  testing::FakeClock clock;
  FrameTimer timer(clock, &counters);
  {
    const StageScope stage(&timer, Stage::track);  // of a first frame that is not in one go
    count(10);
  }
  {
    const InOneGoScope scope(&timer);
    count(1000);
  }
  {
    const StageScope stage(&timer, Stage::render);
    count(7);
  }
  const CounterMeasurement counted = counters.take(1, &absent_);
  for (const Stage stage : {Stage::preprocess, Stage::track, Stage::integrate, Stage::raycast}) {
    EXPECT_EQ(counted.stages[static_cast<std::size_t>(stage)].cycles, std::nullopt);
    EXPECT_THAT(absent_["counters.stages." + std::string(name(stage))], HasSubstr("in one go"));
  }
  EXPECT_EQ(counted.stages[static_cast<std::size_t>(Stage::render)].cycles, 7u);
  absent_.clear();
  const CounterMeasurement next = counters.take(0, &absent_);
  EXPECT_EQ(next.stages[static_cast<std::size_t>(Stage::track)].cycles, 0u);
  EXPECT_FALSE(absent_.contains("counters.stages.track"));
}

TEST_F(StageCountersTest, AreRefusedWhereNothingCanBeCounted) {
  perf_.refusal = "not permitted";
  EXPECT_THROW(StageCounters{perf_}, MeterError);
}

/// The system's counters themselves, by an event that every kernel has.
TEST(SystemPerfEvents, CountThreadsThatAreStartedLater) {
  std::unique_ptr<PerfCount> count;
  try {
    count = system_perf_events().open({PERF_TYPE_SOFTWARE, PERF_COUNT_SW_TASK_CLOCK, -1});
  } catch (const MeterError& error) {
    GTEST_SKIP() << error.what();
  }
  const auto burn = [] {
    const double begin_s = thread_cpu_s();
    while (thread_cpu_s() - begin_s < 0.02) {
    }
  };
  const std::uint64_t begin_ns = count->read();
  burn();
  const std::uint64_t middle_ns = count->read();
  EXPECT_GE(middle_ns - begin_ns, 15'000'000u);
  std::thread(burn).join();
  EXPECT_GE(count->read() - middle_ns, 15'000'000u);
}

TEST(SystemPerfEvents, SayWhatIsMissing) {
  const std::string message = testing::message_of<MeterError>([] {
    system_perf_events().open({PERF_TYPE_HARDWARE, 0xffffff, -1});
  });
  EXPECT_THAT(message, HasSubstr("performance counter: "));
}

}  // namespace
}  // namespace slambench
