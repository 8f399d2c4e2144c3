// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/stage_counters.h"

#include <fmt/format.h>
#include <linux/perf_event.h>

#include <algorithm>

#include "meters/meter.h"

namespace slambench {
namespace {

struct CountedEvent {
  const char* name;
  std::uint64_t config;
  std::optional<std::uint64_t> CounterValues::*member;
};
constexpr CountedEvent counted_events[] = {
    {"cycles", PERF_COUNT_HW_CPU_CYCLES, &CounterValues::cycles},
    {"instructions", PERF_COUNT_HW_INSTRUCTIONS, &CounterValues::instructions},
    {"cache_misses", PERF_COUNT_HW_CACHE_MISSES, &CounterValues::cache_misses},
    {"branch_misses", PERF_COUNT_HW_BRANCH_MISSES, &CounterValues::branch_misses},
};

constexpr Stage computed_stages[] = {Stage::preprocess, Stage::track, Stage::integrate,
                                     Stage::raycast};

}  // namespace

StageCounters::StageCounters(const PerfEvents& events) {
  for (std::size_t i = 0; i < event_count; ++i) {
    try {
      events_[i] = events.open({PERF_TYPE_HARDWARE, counted_events[i].config, -1});
    } catch (const MeterError& error) {
      reasons_[i] = error.what();
    }
  }
  if (std::none_of(events_.begin(), events_.end(), [](const auto& e) { return e != nullptr; })) {
    throw MeterError(reasons_.front());
  }
}

StageCounters::Counts StageCounters::read() {
  Counts counts{};
  for (std::size_t i = 0; i < event_count; ++i) {
    if (events_[i] == nullptr) continue;
    try {
      counts[i] = events_[i]->read();
    } catch (const MeterError& error) {
      reasons_[i] = error.what();
      events_[i].reset();
    }
  }
  return counts;
}

void StageCounters::stage_begin(Stage) { begin_ = read(); }

void StageCounters::stage_end(Stage stage) {
  const Counts now = read();
  Counts& counted = counted_[static_cast<std::size_t>(stage)];
  // Scaled counts are estimates, which may fall a little.
  for (std::size_t i = 0; i < event_count; ++i) counted[i] += now[i] - std::min(now[i], begin_[i]);
}

CounterMeasurement StageCounters::take(int frames, std::map<std::string, std::string>* absent) {
  CounterMeasurement taken;
  taken.frames = frames;
  for (std::size_t i = 0; i < event_count; ++i) {
    if (events_[i] == nullptr) {
      (*absent)[fmt::format("counters.{}", counted_events[i].name)] = reasons_[i];
      continue;
    }
    for (std::size_t stage = 0; stage < stage_count; ++stage) {
      taken.stages[stage].*counted_events[i].member = counted_[stage][i];
    }
  }
  if (in_one_go_) {
    for (const Stage stage : computed_stages) {
      taken.stages[static_cast<std::size_t>(stage)] = {};
      (*absent)[fmt::format("counters.stages.{}", name(stage))] =
          "the backend computes these stages in one go";
    }
  }
  counted_ = {};
  in_one_go_ = false;
  return taken;
}

FoundMeters find_counters(const MeterContext& context) {
  FoundMeters found;
  try {
    const StageCounters counters(*context.perf);
  } catch (const MeterError& error) {
    found.unavailable = error.what();
  }
  return found;
}

}  // namespace slambench
