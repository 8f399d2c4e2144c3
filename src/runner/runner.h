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
  int warmup_frames = 5;   ///< processed first and left out of the time statistics; fewer when that
                           ///< would leave none
  int repeat = 1;          ///< runs that are measured
  int warmup = 0;          ///< runs before them that are not
  std::string prefetch = "auto";  ///< whether frames are read ahead on a thread: also "on", "off"

  ParameterList describe();
};

/// How many of the sequence's frames the parameters ask for.
int frames_to_run(const SequenceInfo& info, const RunParameters& parameters);

/// Whether frames are read ahead: as asked for, but not in real time; `auto` is where computing
/// leaves a processor over, as a thread that takes turns with it would slow it down.
bool reads_ahead(const RunParameters& parameters, int busy_processors, int usable_processors);

/// What a run tells while it goes on.
struct Progress {
  int done = 0, total = 0;
  const FrameRecord* frame = nullptr;
};

struct RunHooks {
  std::function<void()> begin;                    ///< just before the first frame
  std::function<void(const Progress&)> progress;  ///< after each frame
  /// After each rendered frame, untimed. No frame is being read then: the source may be used.
  std::function<void(const FrameRecord&, System&)> images;
  const std::atomic<bool>* stop = nullptr;  ///< set: end after this frame
};

/// Throws InputError when no frame of the run has a pose in the ground truth at its time stamp: for
/// a ground truth that the user chose. A sequence without ground truth passes.
void check_ground_truth(Source& source, const RunParameters& parameters);

/// Runs the system over the source and fills all of the record that this decides: the sequence,
/// `frames`, `init`, `wall_s`, `input_hash`, `map_bytes`, `complete`, `incomplete_reason` and
/// `warmup_frames`. The timer must be the system's observer; what it saw before is start-up.
///
/// The next frame may be read while one is processed (RunParameters::prefetch). The loop then waits
/// for it before hashing and hooks, whose time is nobody's: reading gets none of it for free.
///
/// Every frame in order; or in real time: the frame that is due is floor(elapsed * fps), the ones
/// before it that were not processed are dropped and recorded as such, and where none is due yet
/// the run waits; no frame is read before it is due. Only acquiring, processing and rendering make
/// time pass in this sense: waiting, hashing and the hooks are in no stage, and hashing and the
/// hooks are neither in `wall_s` nor do they make frames late. Throws UsageError when real time is
/// asked for and no rate is known, and what the source and the system throw.
void run_frames(Source& source, System& system, FrameTimer& timer, const Clock& clock,
                const RunParameters& parameters, const RunHooks& hooks, Record* record);

/// Fills the record's accuracy from its frames and the ground truth, each frame's errors included,
/// and says whether the record is valid. Poses are paired by evo's rule at its limit, so that evo
/// on trajectory.tum and the ground truth gives the same figures.
///
/// - over_processed: the estimated trajectory as it is written.
/// - over_all: every frame; dropped ones, and those whose pose is not finite, hold the last pose.
/// - the relative error is over one second of the sequence at its nominal rate, also where the
///   stamps count frames (ICL-NUIM).
/// - slambench1_ate_m: see slambench1_ate(). As the published script does it, a dropped frame
/// repeats
///   the row before it, and the ground truth's rows count from its first one, whatever frames they
///   belong to. Absent when rows belong to no frame, so that pairing by row means nothing, and when
///   the ground truth does not start in the camera's own axes, as the script only shifts.
void judge(const SequenceInfo& sequence, Record* record);

}  // namespace slambench
