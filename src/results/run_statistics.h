// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "results/record.h"

namespace slambench {

/// Why a figure is missing that nobody tried to measure.
inline constexpr std::string_view not_metered = "not metered";

/// Seconds a frame of what need not run in every frame. Where it did not run it took no time: that
/// belongs into what a frame costs on average, but not into what is usual when it runs.
struct FrameSeconds {
  double per_frame = 0;    ///< the sum over all measured frames / their number
  Statistics when_it_ran;  ///< over the frames in which it ran, `count` of them; maybe none
};

struct StageFigures {
  Stage stage = Stage::acquire;
  FrameSeconds seconds;
  std::optional<double> share;  ///< per frame / mean computation; none outside computation
};

/// All calls in a frame together.
struct KernelFigures {
  Kernel kernel = Kernel::acquire;
  FrameSeconds seconds;
  std::optional<double> share;  ///< as of a stage
  long calls = 0;               ///< in all measured frames
  double calls_per_frame = 0;
  double seconds_per_call = 0;
};

/// What went one way between host and device. Its time is part of the stages' or of
/// `between_stages`.
struct TransferFigures {
  Transfer direction = Transfer::to_device;
  FrameSeconds seconds;
  double count_per_frame = 0, bytes_per_frame = 0;  ///< in all measured frames / their number
};

/// The times of a run. Measured are processed frames without the first, warm-up ones.
struct TimeFigures {
  std::vector<int> warmup;  ///< indices of the frames left out
  std::size_t measured_frames = 0;
  Statistics computation_s, total_s;  ///< as the paper defines them (meters/frame_timer.h)
  Statistics read_s;                  ///< reading a frame, on whichever thread
  std::vector<StageFigures> stages;   ///< in pipeline order, without start-up
  /// Of the computation, in no stage (FrameTimes::between_stages_s); none where stages are all.
  std::optional<FrameSeconds> between_stages;
  std::vector<KernelFigures> kernels;      ///< those called in a measured frame, in pipeline order
  std::vector<TransferFigures> transfers;  ///< by direction; none where none was measured
  std::optional<double> fps_computation;   ///< 1 / mean computation
  std::optional<double> fps_wall;          ///< processed frames / duration of the frame loop
};

TimeFigures time_figures(const Record& record);

/// What became of the frames; the lists hold frame indices in order.
struct FrameCounts {
  std::size_t processed = 0, tracked = 0, integrated = 0;
  std::vector<int> untracked;  ///< processed, and the pose was not updated
  std::vector<int> lost;       ///< of these: alignment was tried and failed
  std::vector<int> dropped;    ///< never processed
};

FrameCounts frame_counts(const Record& record);

/// Runs of consecutive numbers (first, last) of an ascending list.
std::vector<std::pair<int, int>> ranges(const std::vector<int>& ascending);

/// "0-3, 17": frame numbers as runs of consecutive ones; after eight runs the rest is counted.
std::string frame_list_text(const std::vector<int>& ascending);

/// Why the record must not count as a success: the run's own reasons, or else what is not a number;
/// then what is not told of build, machine, input and parameters. Empty for a valid record.
std::vector<std::string> reasons_invalid(const Record& record);

}  // namespace slambench
