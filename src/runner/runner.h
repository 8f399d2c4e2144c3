// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "datasets/source.h"
#include "meters/clock.h"
#include "meters/frame_timer.h"
#include "results/record.h"
#include "slam/system.h"

namespace slambench {

/// How frames are fed.
struct RunParameters {
  int frames = 0;          ///< at most so many first frames; 0: all
  bool real_time = false;  ///< at the sequence's own rate: late frames are dropped
  double fps = 0;          ///< > 0: real time at this rate
  int warmup_frames = 5;   ///< processed first and left out of the time statistics

  ParameterList describe();
};

/// What a run tells while it goes on.
struct Progress {
  int done = 0, total = 0;
  const FrameRecord* frame = nullptr;
};

struct RunHooks {
  std::function<void(const Progress&)> progress;            ///< after each frame
  std::function<void(const FrameRecord&, System&)> images;  ///< after each rendered frame, untimed
  const std::atomic<bool>* stop = nullptr;                  ///< set: end after this frame
};

/// Runs the system over the source and fills the record's `frames`, `wall_s`, `input_hash`,
/// `complete` and `warmup_frames`. The timer must be the system's observer.
void run_frames(Source& source, System& system, FrameTimer& timer, const Clock& clock,
                const RunParameters& parameters, const RunHooks& hooks, Record* record);

/// Fills the record's accuracy from its frames and the ground truth.
void judge(const SequenceInfo& sequence, Record* record);

}  // namespace slambench
