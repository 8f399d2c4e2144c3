// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "runner/repeat.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "meters/conditions.h"
#include "results/repetition.h"
#include "results/run_statistics.h"

namespace slambench {
namespace {

constexpr const char* order = "time.computation_s.mean";

bool same_trajectory(const Record& a, const Record& b) {
  return std::equal(a.frames.begin(), a.frames.end(), b.frames.begin(), b.frames.end(),
                    [](const FrameRecord& x, const FrameRecord& y) {
                      return x.index == y.index && x.dropped == y.dropped &&
                             x.T_start_camera.matrix() == y.T_start_camera.matrix();
                    });
}

struct AllRuns {
  std::vector<Record> runs;  ///< that count, and one that was interrupted
  int warmups = 0;           ///< complete ones
};

/// The runs that were asked for, up to one that was interrupted.
AllRuns all_runs(const RunParameters& parameters,
                 const std::function<Record(const RunNumber&)>& one_run) {
  AllRuns all;
  const int total = parameters.warmup + parameters.repeat;
  for (int i = 0; i < total; ++i) {
    const bool warmup = i < parameters.warmup;
    const RunNumber number{warmup ? i + 1 : i + 1 - parameters.warmup,
                           warmup ? parameters.warmup : parameters.repeat, warmup, i + 1 == total};
    Record record = one_run(number);
    const bool complete = record.complete;
    if (!complete && total > 1) {
      record.incomplete_reason += fmt::format(" of {}", to_text(number));
    }
    if (warmup && complete) {
      ++all.warmups;
    } else {
      all.runs.push_back(std::move(record));
    }
    if (!complete) break;
  }
  return all;
}

/// What the record of one run says of the others.
void tell_of_others(const std::vector<Record>& runs, std::size_t shown, Record* record) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!same_trajectory(runs[i], runs.front())) {
      record->repetition.other_trajectory.push_back(static_cast<int>(i) + 1);
    }
    if (i == shown) continue;
    for (const std::string& reason : reasons_invalid(runs[i])) {
      record->valid = false;
      record->invalid_reasons.push_back(fmt::format("run {}: {}", i + 1, reason));
    }
  }
}

}  // namespace

std::string to_text(const RunNumber& run) {
  return fmt::format("{}run {} of {}", run.warmup ? "warm-up " : "", run.number, run.of);
}

Record repeat_runs(const RunParameters& parameters,
                   const std::function<Record(const RunNumber&)>& one_run) {
  auto [runs, warmups] = all_runs(parameters, one_run);
  std::string interrupted;
  if (!runs.back().complete) {
    interrupted = runs.back().incomplete_reason;
    if (runs.size() > 1) runs.pop_back();
  }
  std::vector<std::map<std::string, Figure>> figures;
  figures.reserve(runs.size());
  for (const Record& run : runs) figures.push_back(run_figures(run));
  const std::size_t shown = median_run(figures, order);

  Record record = runs[shown];
  record.complete = interrupted.empty();
  record.incomplete_reason = interrupted;
  record.repetition = repetition_of(figures);
  record.repetition.warmup_runs = warmups;
  record.repetition.shown_run = static_cast<int>(shown) + 1;
  tell_of_others(runs, shown, &record);
  const auto computation = record.repetition.figures.find(order);
  if (computation != record.repetition.figures.end() && computation->second.run_spread) {
    const std::string noise =
        noise_of_runs(computation->second.median, *computation->second.run_spread);
    if (!noise.empty()) record.measurements.conditions.noise.push_back(noise);
  }
  return record;
}

}  // namespace slambench
