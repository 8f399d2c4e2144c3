// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "runner/runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <thread>

#include "core/error.h"
#include "io/trajectory_file.h"
#include "runner/fakes.h"
#include "runner/input_hash.h"

namespace slambench {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double frame_s = testing::read_s + testing::track_s + testing::draw_s;  // 0.21875

class RunnerTest : public ::testing::Test {
 protected:
  Record run(int frames) {
    testing::FakeSource source(frames, clock_);
    return run(source);
  }
  Record run(testing::FakeSource& source) {
    Record record;
    run_frames(source, system_, timer_, clock_, parameters_, hooks_, &record);
    return record;
  }
  static std::vector<int> indices(const Record& record, bool dropped) {
    std::vector<int> found;
    for (const auto& frame : record.frames) {
      if (frame.dropped == dropped) found.push_back(frame.index);
    }
    return found;
  }

  testing::FakeClock clock_;
  FrameTimer timer_{clock_};
  testing::FakeSystem system_{clock_, &timer_};
  RunParameters parameters_ = one_thread();  // the clock is no other thread's
  RunHooks hooks_;

 private:
  static RunParameters one_thread() {
    RunParameters parameters;
    parameters.prefetch = "off";
    return parameters;
  }
};

TEST_F(RunnerTest, ProcessesEveryFrameInOrder) {
  testing::FakeSource source(3, clock_);
  const Record record = run(source);
  EXPECT_THAT(source.reads(), ElementsAre(0, 1, 2));
  EXPECT_THAT(system_.calls,
              ElementsAre("process 0", "render", "process 1", "render", "process 2", "render"));
  EXPECT_THAT(indices(record, false), ElementsAre(0, 1, 2));
  EXPECT_TRUE(record.complete);
  EXPECT_EQ(record.incomplete_reason, "");
  EXPECT_DOUBLE_EQ(record.wall_s, 3 * frame_s);
  EXPECT_EQ(clock_.slept_s(), 0);
  EXPECT_EQ(record.map_bytes, 1234u);
}

TEST_F(RunnerTest, CopiesWhatTheSystemReports) {
  system_.pose = [](int i) { return testing::pose_at(i, 0, 0); };
  const Record record = run(2);
  const FrameRecord& frame = record.frames.at(1);
  EXPECT_TRUE(frame.tracked);
  EXPECT_TRUE(frame.integrated);
  EXPECT_FALSE(record.frames[0].tracked);
  EXPECT_THAT(frame.iterations, ElementsAre(1, 2));
  EXPECT_EQ(frame.inliers, 7u);
  EXPECT_EQ(frame.inlier_fraction, 0.5);
  EXPECT_EQ(frame.residual_m, 0.25);
  EXPECT_EQ(frame.time_s, 100.25);
  EXPECT_EQ(frame.T_start_camera.translation().x(), 1);
}

TEST_F(RunnerTest, CopiesWhatTheSequenceIs) {
  testing::FakeSource source(2, clock_);
  auto& info = source.edit();
  info.layout = "tum-rgbd";
  info.path = "/somewhere";
  info.ground_truth_file = "truth.txt";
  info.axes = "x right";
  info.units_per_m = 5000;
  info.camera = {1, 2, 3, 4};
  info.own_from_camera(1, 1) = -1;
  const Record record = run(source);
  EXPECT_EQ(record.sequence, "fake");
  EXPECT_EQ(record.layout, "tum-rgbd");
  EXPECT_EQ(record.path, "/somewhere");
  EXPECT_EQ(record.ground_truth_file, "truth.txt");
  EXPECT_EQ(record.axes, "x right");
  EXPECT_EQ(record.units_per_m, 5000);
  EXPECT_EQ(record.camera, (Intrinsics{1, 2, 3, 4}));
  EXPECT_EQ(record.own_from_camera(1, 1), -1);
  EXPECT_EQ(record.sequence_frames, 2);
  EXPECT_EQ(record.input_size, (Size{4, 2}));
}

TEST_F(RunnerTest, AttributesTimeToTheFrameItWasSpentIn) {
  {
    const StageScope stage(&timer_, Stage::init);
    clock_.advance(2);
  }
  hooks_.begin = [&] { clock_.advance(5); };
  hooks_.images = [&](const FrameRecord&, System&) { clock_.advance(10); };
  hooks_.progress = [&](const Progress&) { clock_.advance(20); };
  const Record record = run(2);
  EXPECT_EQ(record.init.stage(Stage::init), 2);
  for (const auto& frame : record.frames) {
    EXPECT_EQ(frame.times.stage(Stage::acquire), testing::read_s);
    EXPECT_EQ(frame.times.kernel_s[static_cast<std::size_t>(Kernel::acquire)], testing::read_s);
    EXPECT_EQ(frame.times.kernel_calls[static_cast<std::size_t>(Kernel::acquire)], 1);
    EXPECT_EQ(frame.times.stage(Stage::track), testing::track_s);
    EXPECT_EQ(frame.times.stage(Stage::render), testing::draw_s);
    EXPECT_EQ(frame.times.stage(Stage::init), 0);
    EXPECT_DOUBLE_EQ(frame.times.total_s(), frame_s);
  }
  EXPECT_EQ(record.frames[0].start_s, 0);
  EXPECT_EQ(record.frames[0].process_start_s, testing::read_s);
  EXPECT_DOUBLE_EQ(record.frames[1].start_s, frame_s + 10 + 20) << "but the clock goes on";
  EXPECT_DOUBLE_EQ(record.wall_s, 2 * frame_s) << "hooks do not count";
}

/// What reading ahead must not change, and what it changes.
class ReadAheadTest : public ::testing::Test {
 protected:
  /// Hands frames out, and waits in `block_at` until the frame before is being processed.
  class SlowSource final : public Source {
   public:
    SlowSource() {
      info_.frame_count = 6;
      info_.depth_size = {4, 2};
    }
    const SequenceInfo& info() const override { return info_; }
    void read(int index, Frame& frame) override {
      if (index == broken) throw InputError("frame " + std::to_string(index));
      if (index > 0 && wait_for_processing) {
        while (processing < index) std::this_thread::yield();
      }
      on_other_thread += std::this_thread::get_id() == main_thread ? 0 : 1;
      frame.index = index;
      frame.depth = Image<std::uint16_t>(info_.depth_size, static_cast<std::uint16_t>(index));
    }
    int broken = -1;
    bool wait_for_processing = false;
    std::atomic<int> processing = 0;  ///< frames that the system was given
    std::atomic<int> on_other_thread = 0;
    const std::thread::id main_thread = std::this_thread::get_id();

   private:
    SequenceInfo info_;
  };

  Record run(const std::string& prefetch) {
    testing::FakeSystem system(fake_clock_, nullptr);
    system.pose = [&](int i) {
      source_.processing = i + 1;
      return testing::pose_at(i, 0, 0);
    };
    FrameTimer timer(steady_clock());
    RunParameters parameters;
    parameters.prefetch = prefetch;
    Record record;
    run_frames(source_, system, timer, steady_clock(), parameters, hooks_, &record);
    calls_ = system.calls;
    return record;
  }

  SlowSource source_;
  testing::FakeClock fake_clock_;
  RunHooks hooks_;
  std::vector<std::string> calls_;
};

TEST_F(ReadAheadTest, GivesTheSystemTheSameFrames) {
  const Record plain = run("off");
  const std::vector<std::string> calls = calls_;
  EXPECT_FALSE(plain.read_ahead);
  EXPECT_EQ(source_.on_other_thread, 0);
  const Record ahead = run("on");
  EXPECT_TRUE(ahead.read_ahead);
  EXPECT_EQ(source_.on_other_thread, 5) << "nothing is ahead of the first";
  EXPECT_EQ(calls_, calls);
  EXPECT_EQ(ahead.input_hash, plain.input_hash);
  EXPECT_EQ(ahead.frames.size(), plain.frames.size());
  for (const FrameRecord& frame : ahead.frames) {
    EXPECT_EQ(frame.times.kernel_calls[static_cast<std::size_t>(Kernel::acquire)], 1);
    EXPECT_GT(frame.times.read_s, 0);
  }
}

TEST_F(ReadAheadTest, ReadsWhileTheFrameBeforeIsProcessed) {
  source_.wait_for_processing = true;  // would never end if frames were read one after the other
  EXPECT_EQ(run("on").frames.size(), 6u);
}

TEST_F(ReadAheadTest, TellsOfAnErrorWhenItIsThatFramesTurn) {
  source_.broken = 3;
  for (const std::string prefetch : {"on", "off"}) {
    std::vector<int> done;
    hooks_.progress = [&](const Progress& p) { done.push_back(p.frame->index); };
    EXPECT_THROW(run(prefetch), InputError);
    EXPECT_THAT(done, ElementsAre(0, 1, 2)) << prefetch;
  }
}

TEST_F(ReadAheadTest, ARunThatIsStoppedDoesNotMindTheNextFrame) {
  source_.broken = 3;
  std::atomic<bool> stop = false;
  hooks_.stop = &stop;
  hooks_.progress = [&](const Progress& p) { stop = p.done == 3; };
  const Record record = run("on");
  EXPECT_EQ(record.frames.size(), 3u);
  EXPECT_EQ(record.incomplete_reason, "interrupted after 3 of 6 frames");
}

TEST(ReadsAhead, WhereAProcessorIsLeftAndNotInRealTime) {
  RunParameters parameters;
  EXPECT_TRUE(reads_ahead(parameters, 1, 2));
  EXPECT_FALSE(reads_ahead(parameters, 2, 2));
  EXPECT_FALSE(reads_ahead(parameters, 1, 1));
  parameters.prefetch = "on";
  EXPECT_TRUE(reads_ahead(parameters, 2, 2));
  parameters.fps = 30;
  EXPECT_FALSE(reads_ahead(parameters, 1, 2)) << "no frame is read before it is due";
  parameters.fps = 0;
  parameters.real_time = true;
  EXPECT_FALSE(reads_ahead(parameters, 1, 2));
  parameters = {};
  parameters.prefetch = "off";
  EXPECT_FALSE(reads_ahead(parameters, 1, 2));
}

TEST_F(RunnerTest, TellsProgressAfterTheImages) {
  std::vector<std::string> told;
  hooks_.images = [&](const FrameRecord& frame, System&) {
    told.push_back("images " + std::to_string(frame.index));
  };
  hooks_.progress = [&](const Progress& p) {
    told.push_back(std::to_string(p.done) + "/" + std::to_string(p.total) + " " +
                   std::to_string(p.frame->index));
  };
  run(2);
  EXPECT_THAT(told, ElementsAre("images 0", "1/2 0", "images 1", "2/2 1"));
}

TEST_F(RunnerTest, EndsAfterTheFramesAskedFor) {
  parameters_.frames = 2;
  EXPECT_THAT(indices(run(5), false), ElementsAre(0, 1));
  EXPECT_TRUE(run(5).complete);
  parameters_.frames = 9;
  EXPECT_EQ(run(5).frames.size(), 5u);
}

TEST_F(RunnerTest, InRealTimeWaitsForFramesThatAreNotDue) {
  parameters_.fps = 2;
  const Record record = run(3);
  EXPECT_THAT(indices(record, false), ElementsAre(0, 1, 2));
  EXPECT_THAT(indices(record, true), IsEmpty());
  EXPECT_DOUBLE_EQ(record.wall_s, 1 + frame_s);
  EXPECT_DOUBLE_EQ(clock_.slept_s(), 1 - 2 * frame_s);
  for (const auto& frame : record.frames) {
    EXPECT_EQ(frame.times.stage(Stage::acquire), testing::read_s) << "waiting is not acquiring";
  }
}

TEST_F(RunnerTest, InRealTimeDropsFramesThatPassedMeanwhile) {
  parameters_.fps = 8;
  // Frame 0 ends at 0.21875: 1 is due. It ends at 0.4375: 3 is due, and
  // so on: at 0.65625 5, at 0.875 7.
  testing::FakeSource source(8, clock_);
  const Record record = run(source);
  EXPECT_THAT(indices(record, false), ElementsAre(0, 1, 3, 5, 7));
  EXPECT_THAT(indices(record, true), ElementsAre(2, 4, 6));
  ASSERT_EQ(record.frames.size(), 8u);
  for (int i = 0; i < 8; ++i) {
    const FrameRecord& frame = record.frames[static_cast<std::size_t>(i)];
    EXPECT_EQ(frame.index, i);
    EXPECT_EQ(frame.time_s, source.stamp(i)) << "dropped frames have a time stamp too";
  }
  EXPECT_FALSE(record.frames[2].integrated);
  EXPECT_EQ(record.frames[2].times.total_s(), 0);
  EXPECT_TRUE(record.complete);
}

TEST_F(RunnerTest, InRealTimeDropsTheRestWhenTheSequenceIsOver) {
  parameters_.real_time = true;  // 4 frames a second
  system_.extra_s = 100;
  const Record record = run(5);
  EXPECT_THAT(indices(record, false), ElementsAre(0));
  EXPECT_THAT(indices(record, true), ElementsAre(1, 2, 3, 4));
  EXPECT_TRUE(record.complete);
}

TEST_F(RunnerTest, InRealTimeHooksMakeNoFrameLate) {
  parameters_.fps = 2;
  hooks_.images = [&](const FrameRecord&, System&) { clock_.advance(60); };
  const Record record = run(3);
  EXPECT_THAT(indices(record, true), IsEmpty());
  EXPECT_DOUBLE_EQ(record.wall_s, 1 + frame_s);
}

TEST_F(RunnerTest, InRealTimeNeedsARate) {
  testing::FakeSource source(3, clock_);
  source.edit().fps = 0;
  parameters_.real_time = true;
  EXPECT_THROW(run(source), UsageError);
  parameters_.fps = 4;
  EXPECT_NO_THROW(run(3));
}

TEST_F(RunnerTest, StopsAfterTheFrameInWhichItIsTold) {
  std::atomic<bool> stop = false;
  hooks_.stop = &stop;
  hooks_.progress = [&](const Progress& p) { stop = p.done == 2; };
  for (const double fps : {0.0, 8.0}) {
    parameters_.fps = fps;
    stop = false;
    const Record record = run(5);
    EXPECT_THAT(indices(record, false), ElementsAre(0, 1));
    EXPECT_THAT(indices(record, true), IsEmpty());
    EXPECT_FALSE(record.complete);
    EXPECT_EQ(record.incomplete_reason, "interrupted after 2 of 5 frames");
  }
}

TEST_F(RunnerTest, StoppedInTheLastFrameIsComplete) {
  std::atomic<bool> stop = false;
  hooks_.stop = &stop;
  hooks_.progress = [&](const Progress& p) { stop = p.done == 3; };
  EXPECT_TRUE(run(3).complete);
}

TEST_F(RunnerTest, StopsBeforeTheFirstFrameAndWhileItWaits) {
  std::atomic<bool> stop = true;
  hooks_.stop = &stop;
  const Record none = run(3);
  EXPECT_THAT(none.frames, IsEmpty());
  EXPECT_FALSE(none.complete);

  /// Raises the flag when it is asked to sleep.
  class StoppingClock final : public Clock {
   public:
    StoppingClock(const testing::FakeClock& clock, std::atomic<bool>& stop)
        : clock_(clock), stop_(stop) {}
    double now_s() const override { return clock_.now_s(); }
    void sleep_until(double time_s) const override {
      EXPECT_LE(time_s, now_s() + 0.1) << "a long sleep cannot be interrupted";
      clock_.sleep_until(time_s);
      stop_ = true;
    }

   private:
    const testing::FakeClock& clock_;
    std::atomic<bool>& stop_;
  };
  stop = false;
  parameters_.fps = 0.001;
  const StoppingClock clock(clock_, stop);
  testing::FakeSource source(3, clock_);
  Record record;
  run_frames(source, system_, timer_, clock, parameters_, hooks_, &record);
  EXPECT_THAT(indices(record, false), ElementsAre(0));
  EXPECT_LT(record.wall_s, 1);
  EXPECT_FALSE(record.complete);
}

TEST_F(RunnerTest, WarmUpLeavesAtLeastOneFrame) {
  parameters_.warmup_frames = 5;
  EXPECT_EQ(run(20).warmup_frames, 5);
  EXPECT_EQ(run(6).warmup_frames, 5);
  EXPECT_EQ(run(5).warmup_frames, 4);
  EXPECT_EQ(run(1).warmup_frames, 0);
  EXPECT_EQ(run(0).warmup_frames, 0);
}

TEST_F(RunnerTest, HashesWhatWasProcessed) {
  const std::string three = run(3).input_hash;
  EXPECT_EQ(three.size(), 32u);
  EXPECT_EQ(run(3).input_hash, three);
  EXPECT_NE(run(2).input_hash, three);
}

TEST_F(RunnerTest, KeepsTheGroundTruthAndItsHash) {
  testing::FakeSource source(2, clock_);
  EXPECT_EQ(run(source).ground_truth_hash, "");
  source.edit().ground_truth = {{source.stamp(1), testing::pose_at(1, 2, 3)}};
  const Record record = run(source);
  ASSERT_EQ(record.ground_truth.size(), 1u);
  EXPECT_EQ(record.ground_truth[0].T_world_camera.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(record.ground_truth_hash, hash_text(trajectory_text(record.ground_truth)));
  source.edit().ground_truth[0].time_s += 1e-6;
  EXPECT_NE(run(source).ground_truth_hash, record.ground_truth_hash);
}

TEST(InputHash, OfTextIsThatOfItsBytes) {
  // printf '\x01\0\0\0\x02\x01' | xxh128sum
  EXPECT_EQ(hash_text(std::string_view("\x01\0\0\0\x02\x01", 6)),
            "1db8036cdd4f92c51a06d0b66ca7c142");
}

TEST(InputHash, IsThatOfIndexAndDepthInOrder) {
  // printf '\x01\0\0\0\x02\x01' | xxh128sum
  Frame frame;
  frame.index = 1;
  frame.depth = Image<std::uint16_t>({1, 1}, 0x0102);
  InputHash hash;
  hash.add(frame);
  EXPECT_EQ(hash.text(), "1db8036cdd4f92c51a06d0b66ca7c142");
  InputHash other;
  frame.index = 2;
  other.add(frame);
  EXPECT_NE(other.text(), hash.text());
}

TEST_F(RunnerTest, ShowsTheErrorWhileItRuns) {
  testing::FakeSource source(4, clock_);
  for (int i = 1; i < 4; ++i) {  // in a world of its own, without a row for frame 0
    source.edit().ground_truth.push_back(
        {source.stamp(i), testing::turned_by(90, {0, 0, 1}) * testing::pose_at(i, 0, 5)});
  }
  system_.pose = [](int i) { return testing::pose_at(i, i == 3 ? 0.25 : 0, 0); };
  std::vector<std::optional<double>> told;
  hooks_.progress = [&](const Progress& p) { told.push_back(p.frame->error_first_pose_m); };
  run(source);
  ASSERT_EQ(told.size(), 4u);
  EXPECT_EQ(told[0], std::nullopt);
  EXPECT_NEAR(told[1].value(), 0, 1e-12);
  EXPECT_NEAR(told[2].value(), 0, 1e-12);
  EXPECT_NEAR(told[3].value(), 0.25, 1e-12);
}

TEST_F(RunnerTest, SurvivesAPoseThatIsNotANumber) {
  testing::FakeSource source(3, clock_);
  source.edit().ground_truth = {{source.stamp(1), Pose::Identity()}};
  system_.pose = [](int) {
    return testing::pose_at(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  };
  const Record record = run(source);
  EXPECT_EQ(record.frames.at(1).error_first_pose_m, std::nullopt);
}

TEST_F(RunnerTest, GroundTruthThatMeetsNoFrameIsAnError) {
  testing::FakeSource source(3, clock_);
  EXPECT_NO_THROW(check_ground_truth(source, parameters_)) << "none is not a wrong one";
  source.edit().ground_truth_file = "truth.txt";
  source.edit().ground_truth = {{source.stamp(2) + 0.005, Pose::Identity()}};
  EXPECT_NO_THROW(check_ground_truth(source, parameters_));
  parameters_.frames = 2;
  EXPECT_THROW(check_ground_truth(source, parameters_), InputError);
  parameters_.frames = 0;
  source.edit().ground_truth = {{7, Pose::Identity()}};
  try {
    check_ground_truth(source, parameters_);
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "truth.txt: time stamps: found 7 to 7, expected one within 0.01 s of a frame "
                 "between 100 and 100.5");
  }
}

TEST(RunParameters, DescribesItself) {
  RunParameters parameters;
  const std::vector<ParameterList> lists = {parameters.describe()};
  EXPECT_EQ(lists[0].group, "run");
  for (const auto& [name, text] : {std::pair{"frames", "12"}, std::pair{"real-time", "true"},
                                   std::pair{"fps", "29.5"}, std::pair{"warmup-frames", "0"}}) {
    const Parameter* parameter = find(lists, name);
    ASSERT_NE(parameter, nullptr) << name;
    set_from_text(*parameter, text);
  }
  EXPECT_EQ(find(lists, "fps")->flag, 'f');
  EXPECT_EQ(parameters.frames, 12);
  EXPECT_TRUE(parameters.real_time);
  EXPECT_EQ(parameters.fps, 29.5);
  EXPECT_EQ(parameters.warmup_frames, 0);
  EXPECT_THROW(set_from_text(*find(lists, "frames"), "-1"), UsageError);
  EXPECT_THROW(set_from_text(*find(lists, "fps"), "-1"), UsageError);
}

}  // namespace
}  // namespace slambench
