// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "runner/runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/processors.h"
#include "io/trajectory_file.h"
#include "metrics/trajectory_metrics.h"
#include "runner/frame_reader.h"
#include "runner/input_hash.h"

namespace slambench {

int frames_to_run(const SequenceInfo& info, const RunParameters& parameters) {
  return parameters.frames > 0 ? std::min(parameters.frames, info.frame_count) : info.frame_count;
}

namespace {

/// While waiting for a frame the run looks this often whether it is to end.
constexpr double stop_interval_s = 0.05;

/// The time of a run, that can be held.
class RunTime {
 public:
  explicit RunTime(const Clock& clock) : clock_(clock), start_s_(clock.now_s()) {}
  double elapsed_s() const { return clock_.now_s() - start_s_ - held_s_; }
  void wait_until(double elapsed_s) const { clock_.sleep_until(start_s_ + held_s_ + elapsed_s); }
  template <class Action>
  void hold_during(const Action& action) {
    const double from_s = clock_.now_s();
    action();
    held_s_ += clock_.now_s() - from_s;
  }

 private:
  const Clock& clock_;
  double start_s_, held_s_ = 0;
};

/// The position error of each frame as it comes, the first pair of poses made equal.
class LiveError {
 public:
  explicit LiveError(const Trajectory& ground_truth)
      : ground_truth_(sorted_by_time(ground_truth)) {}

  std::optional<double> of(const StampedPose& estimate) {
    const auto match =
        nearest_pose(ground_truth_, estimate.time_s, default_limit_s(Association::evo));
    if (!match || !estimate.T_world_camera.matrix().allFinite()) return std::nullopt;
    const Pose& truth = ground_truth_[*match].T_world_camera;
    if (!T_truth_estimate_) T_truth_estimate_ = truth * estimate.T_world_camera.inverse();
    return (*T_truth_estimate_ * estimate.T_world_camera.translation() - truth.translation())
        .norm();
  }

 private:
  Trajectory ground_truth_;
  std::optional<Pose> T_truth_estimate_;
};

void describe_sequence(const SequenceInfo& info, Record* record) {
  record->sequence = info.name;
  record->layout = info.layout;
  record->path = info.path;
  record->ground_truth_file = info.ground_truth_file;
  record->ground_truth = info.ground_truth;
  if (!info.ground_truth.empty()) {
    record->ground_truth_hash = hash_text(trajectory_text(info.ground_truth));
  }
  record->axes = info.axes;
  record->sequence_frames = info.frame_count;
  record->input_size = info.depth_size;
  record->camera = info.camera;
  record->units_per_m = info.units_per_m;
  record->own_from_camera = info.own_from_camera;
}

/// Frames a second in real time; none: every frame is processed.
std::optional<double> rate(const SequenceInfo& info, const RunParameters& parameters) {
  if (parameters.fps > 0) return parameters.fps;
  if (!parameters.real_time) return std::nullopt;
  if (!(info.fps > 0)) {
    throw UsageError(
        fmt::format("--real-time: the rate of {} is unknown, expected --fps", info.name));
  }
  return info.fps;
}

void acquire(int index, FrameReader& reader, FrameTimer& timer, ReadFrame* frame) {
  const StageScope stage(&timer, Stage::acquire);
  const KernelScope kernel(&timer, Kernel::acquire);
  reader.finish(index, frame);
}

FrameRecord process(int index, const ReadFrame& read, System& system, FrameTimer& timer) {
  if (read.error) std::rethrow_exception(read.error);
  const Frame& frame = read.frame;
  FrameResult result = system.process(frame);
  system.render();

  FrameRecord record;
  record.index = index;
  record.time_s = frame.time_s;
  record.tracked = result.tracked;
  record.integrated = result.integrated;
  record.T_start_camera = result.T_start_camera;
  record.iterations = std::move(result.iterations);
  record.inliers = result.inliers;
  record.inlier_fraction = result.inlier_fraction;
  record.residual_m = result.residual_m;
  record.times = timer.take();
  record.times.read_s = read.read_s;
  return record;
}

bool stopped(const RunHooks& hooks) { return hooks.stop != nullptr && hooks.stop->load(); }

/// Waits until that time of the run; false when the run is to end instead.
bool wait_until(double elapsed_s, const RunTime& time, const RunHooks& hooks) {
  while (!stopped(hooks)) {
    const double now_s = time.elapsed_s();
    if (now_s >= elapsed_s) return true;
    time.wait_until(std::min(elapsed_s, now_s + stop_interval_s));
  }
  return false;
}

/// The frame that is due, of those from `earliest` to `total`.
int due_frame(double elapsed_s, double fps, int earliest, int total) {
  const double due = std::floor(elapsed_s * fps);
  if (due >= total) return total;
  return std::max(earliest, static_cast<int>(due));
}

void drop(int begin, int end, Record* record) {
  for (int index = begin; index < end; ++index) {
    FrameRecord frame;
    frame.index = index;
    frame.dropped = true;
    record->frames.push_back(std::move(frame));
  }
}

std::ptrdiff_t processed_frames(const Record& record) {
  return std::count_if(record.frames.begin(), record.frames.end(),
                       [](const FrameRecord& frame) { return !frame.dropped; });
}

}  // namespace

ParameterList RunParameters::describe() {
  constexpr double most = std::numeric_limits<int>::max();
  return {"run",
          {{"frames", 0, "frames", &frames, 0, most, "at most so many first frames; 0: all"},
           {"real-time", 0, "", &real_time, 0, 0,
            "feed frames at the sequence's own rate and drop those that come too late"},
           {"fps", 'f', "frames/s", &fps, 0, 1e6,
            "feed frames at this rate and drop those that come too late; 0: process every frame"},
           {"warmup-frames", 0, "frames", &warmup_frames, 0, most,
            "first processed frames that the time statistics leave out"},
           {"repeat",
            0,
            "runs",
            &repeat,
            1,
            1000,
            "measure so many runs, and give each figure's median with a 95 % confidence interval",
            {},
            ParameterRole::bookkeeping},
           {"warmup",
            0,
            "runs",
            &warmup,
            0,
            1000,
            "run so often before that without measuring",
            {},
            ParameterRole::bookkeeping},
           {"prefetch",
            0,
            "",
            &prefetch,
            0,
            0,
            "read the next frame on a thread of its own while one is processed; auto: where the "
            "kernels leave a processor over. Never in real time",
            {"auto", "on", "off"},
            ParameterRole::implementation}}};
}

bool reads_ahead(const RunParameters& parameters, int busy_processors, int usable_processors) {
  if (parameters.real_time || parameters.fps > 0 || parameters.prefetch == "off") return false;
  return parameters.prefetch == "on" || busy_processors < usable_processors;
}

void check_ground_truth(Source& source, const RunParameters& parameters) {
  const SequenceInfo& info = source.info();
  if (info.ground_truth.empty()) return;
  const Trajectory truth = sorted_by_time(info.ground_truth);
  const int total = frames_to_run(info, parameters);
  const double limit_s = default_limit_s(Association::evo);
  for (int index = 0; index < total; ++index) {
    if (nearest_pose(truth, source.time_s(index), limit_s)) return;
  }
  throw InputError(info.ground_truth_file, "time stamps",
                   fmt::format("{} to {}", truth.front().time_s, truth.back().time_s),
                   total == 0 ? std::string("those of frames, and there are none")
                              : fmt::format("one within {} s of a frame between {} and {}", limit_s,
                                            source.time_s(0), source.time_s(total - 1)));
}

void run_frames(Source& source, System& system, FrameTimer& timer, const Clock& clock,
                const RunParameters& parameters, const RunHooks& hooks, Record* record) {
  const SequenceInfo& info = source.info();
  const int total = frames_to_run(info, parameters);
  const auto fps = rate(info, parameters);
  describe_sequence(info, record);
  record->init = timer.take();
  InputHash hash;
  LiveError live_error(info.ground_truth);
  const bool ahead = reads_ahead(parameters, system.busy_processors(), usable_processors());
  FrameReader reader(source, clock, ahead);
  record->read_ahead = reader.ahead();
  if (ahead && !reader.ahead() && parameters.prefetch == "on") {
    throw UnavailableError("--prefetch on: the system grants no thread to read frames on");
  }
  ReadFrame frame, next;
  bool acquired = false;  // `next` is the frame to process

  if (hooks.begin) hooks.begin();
  RunTime time(clock);
  const double first_s = clock.now_s();
  double next_start_s = 0;
  const auto acquire_next = [&](int index) {
    next_start_s = clock.now_s() - first_s;
    acquire(index, reader, timer, &next);
  };
  int index = 0;
  while (index < total && !stopped(hooks)) {
    if (fps && !wait_until(index / *fps, time, hooks)) break;
    if (!acquired) acquire_next(index);
    std::swap(frame, next);
    const double start_s = next_start_s;
    acquired = reader.ahead() && index + 1 < total;
    if (acquired) {  // where the woken thread takes this one's turn, that is acquiring
      const StageScope stage(&timer, Stage::acquire);
      reader.begin(index + 1);
    }
    const double process_start_s = clock.now_s() - first_s;
    record->frames.push_back(process(index, frame, system, timer));
    record->frames.back().start_s = start_s;
    record->frames.back().process_start_s = process_start_s;
    if (acquired) acquire_next(index + 1);
    time.hold_during([&] {
      FrameRecord& done = record->frames.back();
      hash.add(frame.frame);
      done.error_first_pose_m =
          live_error.of({done.time_s, in_own_axes(*record, done.T_start_camera)});
      if (hooks.images) hooks.images(done, system);
      if (hooks.progress) hooks.progress({index + 1, total, &done});
    });
    ++index;
    if (!fps || stopped(hooks)) continue;
    const int due = due_frame(time.elapsed_s(), *fps, index, total);
    drop(index, due, record);
    index = due;
  }
  record->wall_s = time.elapsed_s();

  for (FrameRecord& dropped : record->frames) {
    if (dropped.dropped) dropped.time_s = source.time_s(dropped.index);
  }
  record->input_hash = hash.text();
  record->map = system.map();
  record->map_bytes = system.map_bytes();
  const auto most_warmup = std::max<std::ptrdiff_t>(0, processed_frames(*record) - 1);
  record->warmup_frames =
      static_cast<int>(std::min<std::ptrdiff_t>(parameters.warmup_frames, most_warmup));
  record->complete = index >= total;
  if (!record->complete) {
    record->incomplete_reason = fmt::format("interrupted after {} of {} frames", index, total);
  }
}

}  // namespace slambench
