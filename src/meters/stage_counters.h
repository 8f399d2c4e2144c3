// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>

#include "kernels/observer.h"
#include "meters/measurements.h"
#include "meters/perf_events.h"

namespace slambench {

/// Counts what the processor did in each stage: reads counters where a stage begins and ends, and
/// nowhere else. Counts the threads that are started after it and the one that made it. What the
/// processor does of a frame in one go is no stage's: as soon as there is one, take() has nothing
/// of preprocess to raycast, and what was counted in these stages of other frames is thrown away.
class StageCounters final : public Observer {
 public:
  /// Throws MeterError when none of the events can be counted.
  explicit StageCounters(const PerfEvents& events);

  void stage_begin(Stage stage) override;
  void stage_end(Stage stage) override;
  void in_one_go_begin() override { in_one_go_ = true; }
  void in_one_go_end() override {}
  void kernel_begin(Kernel) override {}
  void kernel_end(Kernel) override {}
  void kernel_measured(Kernel, double) override {}
  void transfer_measured(Transfer, std::size_t, double) override {}

  /// The counts since the last call; starts anew. Events that cannot be counted are explained in
  /// `absent`.
  CounterMeasurement take(int frames, std::map<std::string, std::string>* absent);

 private:
  static constexpr std::size_t event_count = 4;
  using Counts = std::array<std::uint64_t, event_count>;
  Counts read();

  std::array<std::unique_ptr<PerfCount>, event_count> events_;
  std::array<std::string, event_count> reasons_;
  Counts begin_{};
  std::array<Counts, stage_count> counted_{};
  bool in_one_go_ = false;  ///< some frame was
};

}  // namespace slambench
