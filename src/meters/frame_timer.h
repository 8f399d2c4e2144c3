// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <array>
#include <optional>

#include "kernels/observer.h"
#include "meters/clock.h"

namespace slambench {

/// What went one way between host and device.
struct TransferTimes {
  double seconds = 0;
  std::size_t bytes = 0;
  int count = 0;
};

/// Seconds spent in one frame, and how often each stage was entered and each kernel called.
struct FrameTimes {
  std::array<double, stage_count> stage_s{};
  std::array<int, stage_count> stage_calls{};
  std::array<double, kernel_count> kernel_s{};
  std::array<int, kernel_count> kernel_calls{};
  /// By direction. They are within the stages' times, and in no sum.
  std::array<TransferTimes, transfer_count> transfers{};
  /// Of a frame in one go (Observer::in_one_go_begin): the part of its computation that is in no
  /// stage, launching, waiting and what lies between kernels. Never negative: 0 where the device's
  /// clock makes the kernels longer than the wall clock makes them all. None of other frames.
  std::optional<double> between_stages_s;
  double read_s = 0;  ///< reading the frame, on whichever thread; within `acquire` unless ahead

  double stage(Stage s) const { return stage_s[static_cast<std::size_t>(s)]; }
  /// preprocess + track + integrate + raycast, as SLAMBench defines it, and between_stages_s: wall
  /// time, but for a frame in one go whose kernels are longer by the device's clock.
  double computation_s() const;
  /// acquire + computation + render.
  double total_s() const;
};

/// Adds up what happens between two calls of take(), by the given clock. Kernels run within
/// stages; there is one stage and one kernel at a time. A stage has the wall time between
/// its begin and its end, also where the backend measures its kernels itself (kernel_measured):
/// those times count when they arrive, and need not add up to their stage's. Only of a frame in one
/// go they do: a stage then is its kernels, and the rest of the wall time is between_stages_s.
/// Transfers count when they are told of within a stage or such a frame: what happens between
/// stages (pictures that are saved) is no frame's.
class FrameTimer final : public Observer {
 public:
  /// Tells `stages`, if any, when stages begin and end, outside of what it measures itself.
  explicit FrameTimer(const Clock& clock, Observer* stages = nullptr)
      : clock_(clock), stages_(stages) {}

  void stage_begin(Stage stage) override;
  void stage_end(Stage stage) override;
  void in_one_go_begin() override;
  void in_one_go_end() override;
  void kernel_begin(Kernel kernel) override;
  void kernel_end(Kernel kernel) override;
  void kernel_measured(Kernel kernel, double seconds) override;
  void transfer_measured(Transfer direction, std::size_t bytes, double seconds) override;

  /// The times since the last call; starts anew.
  FrameTimes take();

 private:
  const Clock& clock_;
  Observer* const stages_;
  FrameTimes times_;
  double stage_begin_s_ = 0, kernel_begin_s_ = 0, in_one_go_begin_s_ = 0;
  double in_kernels_s_ = 0;  ///< of the frame in one go
  bool in_stage_ = false, in_one_go_ = false;
};

}  // namespace slambench
