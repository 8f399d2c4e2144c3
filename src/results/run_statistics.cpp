// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/run_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

namespace slambench {
namespace {

bool in_computation(Stage stage) {
  return stage == Stage::preprocess || stage == Stage::track || stage == Stage::integrate ||
         stage == Stage::raycast;
}

/// Statistics of figure(times) over the frames.
template <class Figure>
Statistics over(const std::vector<const FrameTimes*>& frames, Figure figure) {
  std::vector<double> values;
  values.reserve(frames.size());
  for (const FrameTimes* times : frames) values.push_back(figure(*times));
  return summarize(values);
}

/// Of the seconds of those frames, among so many, in which something ran.
FrameSeconds frame_seconds(const std::vector<double>& values, std::size_t frames) {
  return {std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(frames),
          summarize(values)};
}

/// Of stage or kernel `i`, whose seconds and calls stand in these arrays.
template <std::size_t N>
FrameSeconds frame_seconds(const std::vector<const FrameTimes*>& frames, std::size_t i,
                           std::array<double, N> FrameTimes::*seconds,
                           std::array<int, N> FrameTimes::*calls) {
  std::vector<double> values;
  for (const FrameTimes* times : frames) {
    if ((times->*calls)[i] > 0) values.push_back((times->*seconds)[i]);
  }
  return frame_seconds(values, frames.size());
}

/// Only of frames that were computed in one go.
std::optional<FrameSeconds> between_stages(const std::vector<const FrameTimes*>& frames) {
  std::vector<double> values;
  for (const FrameTimes* times : frames) {
    if (times->between_stages_s) values.push_back(*times->between_stages_s);
  }
  if (values.empty()) return std::nullopt;
  return frame_seconds(values, frames.size());
}

std::optional<double> share_of(Stage stage, const FrameSeconds& seconds,
                               const Statistics& computation) {
  if (!in_computation(stage) || !(computation.mean > 0)) return std::nullopt;
  return seconds.per_frame / computation.mean;
}

std::optional<KernelFigures> kernel_figures(const KernelInfo& kernel,
                                            const std::vector<const FrameTimes*>& frames,
                                            const Statistics& computation) {
  const auto i = static_cast<std::size_t>(kernel.kernel);
  KernelFigures figures;
  figures.kernel = kernel.kernel;
  for (const FrameTimes* times : frames) figures.calls += times->kernel_calls[i];
  if (figures.calls == 0) return std::nullopt;
  figures.seconds = frame_seconds(frames, i, &FrameTimes::kernel_s, &FrameTimes::kernel_calls);
  figures.share = share_of(kernel.stage, figures.seconds, computation);
  const auto calls = static_cast<double>(figures.calls);
  const auto count = static_cast<double>(frames.size());
  figures.calls_per_frame = calls / count;
  figures.seconds_per_call = figures.seconds.per_frame * count / calls;
  return figures;
}

std::optional<TransferFigures> transfer_figures(Transfer direction,
                                                const std::vector<const FrameTimes*>& frames) {
  TransferFigures figures;
  figures.direction = direction;
  std::vector<double> values;
  for (const FrameTimes* times : frames) {
    const TransferTimes& one = times->transfers[static_cast<std::size_t>(direction)];
    if (one.count == 0) continue;
    values.push_back(one.seconds);
    figures.count_per_frame += one.count;
    figures.bytes_per_frame += static_cast<double>(one.bytes);
  }
  if (values.empty()) return std::nullopt;
  const auto count = static_cast<double>(frames.size());
  figures.seconds = frame_seconds(values, frames.size());
  figures.count_per_frame /= count;
  figures.bytes_per_frame /= count;
  return figures;
}

bool all_finite(const FrameTimes& times) {
  const auto finite = [](double s) { return std::isfinite(s); };
  return finite(times.between_stages_s.value_or(0)) &&
         std::all_of(times.stage_s.begin(), times.stage_s.end(), finite) &&
         std::all_of(times.kernel_s.begin(), times.kernel_s.end(), finite) &&
         std::all_of(times.transfers.begin(), times.transfers.end(),
                     [&](const TransferTimes& t) { return finite(t.seconds); });
}

/// What a run that nobody judged would hide.
std::vector<std::string> broken_figures(const Record& record) {
  std::vector<std::string> reasons;
  std::vector<int> bad_poses, bad_times;
  for (const FrameRecord& frame : record.frames) {
    if (frame.dropped) continue;
    if (!frame.T_start_camera.matrix().allFinite()) bad_poses.push_back(frame.index);
    if (!all_finite(frame.times)) bad_times.push_back(frame.index);
  }
  for (const auto& [what, frames] : {std::pair{"pose", &bad_poses}, {"time", &bad_times}}) {
    if (frames->empty()) continue;
    reasons.push_back(fmt::format("{} not finite in frames {}", what, frame_list_text(*frames)));
  }
  if (frame_counts(record).processed == 0) reasons.emplace_back("no frame was processed");
  return reasons;
}

}  // namespace

TimeFigures time_figures(const Record& record) {
  TimeFigures figures;
  std::vector<const FrameTimes*> measured;
  std::size_t processed = 0;
  for (const FrameRecord& frame : record.frames) {
    if (frame.dropped) continue;
    if (++processed <= static_cast<std::size_t>(std::max(0, record.warmup_frames))) {
      figures.warmup.push_back(frame.index);
    } else {
      measured.push_back(&frame.times);
    }
  }
  if (record.wall_s > 0) figures.fps_wall = static_cast<double>(processed) / record.wall_s;
  figures.measured_frames = measured.size();
  if (measured.empty()) return figures;

  figures.computation_s = over(measured, [](const FrameTimes& t) { return t.computation_s(); });
  figures.total_s = over(measured, [](const FrameTimes& t) { return t.total_s(); });
  figures.read_s = over(measured, [](const FrameTimes& t) { return t.read_s; });
  if (figures.computation_s.mean > 0) figures.fps_computation = 1 / figures.computation_s.mean;
  for (std::size_t i = 0; i < stage_count; ++i) {
    const auto stage = static_cast<Stage>(i);
    if (stage == Stage::init) continue;
    const FrameSeconds seconds =
        frame_seconds(measured, i, &FrameTimes::stage_s, &FrameTimes::stage_calls);
    figures.stages.push_back({stage, seconds, share_of(stage, seconds, figures.computation_s)});
  }
  figures.between_stages = between_stages(measured);
  for (const KernelInfo& kernel : kernel_table()) {
    if (auto k = kernel_figures(kernel, measured, figures.computation_s)) {
      figures.kernels.push_back(*k);
    }
  }
  for (const Transfer direction : {Transfer::to_device, Transfer::to_host}) {
    if (auto t = transfer_figures(direction, measured)) figures.transfers.push_back(*t);
  }
  return figures;
}

FrameCounts frame_counts(const Record& record) {
  FrameCounts counts;
  for (const FrameRecord& frame : record.frames) {
    if (frame.dropped) {
      counts.dropped.push_back(frame.index);
      continue;
    }
    ++counts.processed;
    if (frame.integrated) ++counts.integrated;
    if (frame.tracked) {
      ++counts.tracked;
      continue;
    }
    counts.untracked.push_back(frame.index);
    const bool tried = std::accumulate(frame.iterations.begin(), frame.iterations.end(), 0) > 0;
    if (tried) counts.lost.push_back(frame.index);
  }
  return counts;
}

std::vector<std::pair<int, int>> ranges(const std::vector<int>& ascending) {
  std::vector<std::pair<int, int>> runs;
  for (const int number : ascending) {
    if (!runs.empty() && runs.back().second + 1 == number) {
      runs.back().second = number;
    } else {
      runs.emplace_back(number, number);
    }
  }
  return runs;
}

std::string frame_list_text(const std::vector<int>& ascending) {
  constexpr std::size_t most = 8;
  const auto runs = ranges(ascending);
  std::string text;
  for (std::size_t i = 0; i < std::min(runs.size(), most); ++i) {
    const auto& [first, last] = runs[i];
    if (i > 0) text += ", ";
    text += first == last ? fmt::format("{}", first) : fmt::format("{}-{}", first, last);
  }
  if (runs.size() > most) {
    const auto shown = static_cast<std::size_t>(
        std::find(ascending.begin(), ascending.end(), runs[most].first) - ascending.begin());
    text += fmt::format(" and {} more", ascending.size() - shown);
  }
  return text;
}

std::vector<std::string> reasons_invalid(const Record& record) {
  std::vector<std::string> reasons = record.invalid_reasons;
  if (!record.valid && reasons.empty()) reasons.emplace_back("the run was judged invalid");
  if (reasons.empty()) reasons = broken_figures(record);

  const Provenance& p = record.provenance;
  const std::pair<std::string_view, const std::string*> told[] = {
      {"version", &p.version},
      {"commit", &p.commit},
      {"compiler", &p.compiler},
      {"cpu", &p.cpu},
      {"os", &p.os},
      {"backend", &p.backend},
      {"device", &p.device},
      {"command", &p.command},
      {"started_at", &p.started_at},
      {"sequence", &record.sequence},
      {"input_hash", &record.input_hash},
  };
  for (const auto& [name, value] : told) {
    if (value->empty()) reasons.push_back(fmt::format("{} is not known", name));
  }
  if (record.parameters.empty()) reasons.emplace_back("the parameters are not known");
  return reasons;
}

}  // namespace slambench
