// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "datasets/source.h"
#include "kernels/observer.h"
#include "slam/system.h"
#include "support/fake_clock.h"
#include "support/trajectories.h"

namespace slambench::testing {

inline constexpr double read_s = 0.0625, track_s = 0.125, draw_s = 0.03125;

/// Frames that hold their own number; reading takes read_s.
class FakeSource final : public Source {
 public:
  FakeSource(int frames, FakeClock& clock) : clock_(clock) {
    info_.name = "fake";
    info_.frame_count = frames;
    info_.depth_size = {4, 2};
    info_.fps = 4;
  }
  const SequenceInfo& info() const override { return info_; }
  SequenceInfo& edit() { return info_; }
  void read(int index, Frame& frame) override {
    clock_.advance(read_s);
    reads_.push_back(index);
    frame.index = index;
    frame.time_s = stamp(index);
    frame.depth = Image<std::uint16_t>(info_.depth_size, static_cast<std::uint16_t>(index));
  }
  double stamp(int index) const { return 100 + index / info_.fps; }
  const std::vector<int>& reads() const { return reads_; }

 private:
  FakeClock& clock_;
  SequenceInfo info_;
  std::vector<int> reads_;
};

/// Says what it is told to; tracking takes track_s, drawing draw_s.
class FakeSystem final : public System {
 public:
  FakeSystem(FakeClock& clock, Observer* observer) : clock_(clock), observer_(observer) {}

  FrameResult process(const Frame& frame) override {
    calls.push_back("process " + std::to_string(frame.index));
    const StageScope stage(observer_, Stage::track);
    const KernelScope kernel(observer_, Kernel::track);
    clock_.advance(track_s + extra_s);
    FrameResult result;
    result.tracked = frame.index > 0;
    result.integrated = true;
    result.iterations = {1, 2};
    result.inliers = 7;
    result.inlier_fraction = 0.5;
    result.residual_m = 0.25;
    result.T_start_camera = pose(frame.index);
    return result;
  }
  void render() override {
    calls.emplace_back("render");
    const StageScope stage(observer_, Stage::render);
    clock_.advance(draw_s);
  }
  Pictures pictures() override { return {}; }
  std::string map() const override { return "grid"; }
  int busy_processors() const override { return 1; }
  std::size_t map_bytes() const override { return 1234; }
  void dump_volume(const std::string&) override {}

  std::function<Pose(int)> pose = [](int) { return Pose::Identity(); };
  double extra_s = 0;
  std::vector<std::string> calls;

 private:
  FakeClock& clock_;
  Observer* observer_;
};

}  // namespace slambench::testing
