// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/error.h"
#include "metrics/trajectory_metrics.h"
#include "runner/runner.h"

namespace slambench {
namespace {

constexpr Association rule = Association::evo;
constexpr double rpe_delta_s = 1;

/// A ground truth turned by less than this starts in the camera's own axes, rad.
constexpr double own_axes_tolerance = 1e-3;

bool finite(const FrameRecord& frame) { return frame.T_start_camera.matrix().allFinite(); }

bool usable(const FrameRecord& frame) { return !frame.dropped && finite(frame); }

/// The first frames are fused where the camera starts, so that there is a model to track the next
/// one against: whoever gives no more of them is told so. "" when there were more.
std::string too_few_to_track(const Record& record, long processed) {
  for (const UsedParameter& p : record.parameters) {
    if (p.name != "bootstrap-frames" || processed > std::atol(p.value.c_str())) continue;
    return fmt::format(": {} were processed, and the first {} (--bootstrap-frames) never are",
                       processed, p.value);
  }
  return "";
}

void judge_validity(Record* record) {
  const auto count = [&](auto&& which) {
    return std::count_if(record->frames.begin(), record->frames.end(), which);
  };
  const auto processed = count([](const auto& f) { return !f.dropped; });
  const auto tracked = count([](const auto& f) { return !f.dropped && f.tracked; });
  const auto broken = count([](const auto& f) { return !f.dropped && !finite(f); });
  auto& reasons = record->invalid_reasons;
  if (processed == 0) {
    reasons.emplace_back("no frame was processed");
  } else if (tracked == 0) {
    reasons.push_back("no frame was tracked" + too_few_to_track(*record, processed));
  }
  if (broken > 0) {
    const auto first = std::find_if(record->frames.begin(), record->frames.end(),
                                    [](const auto& f) { return !f.dropped && !finite(f); });
    reasons.push_back(
        fmt::format("the pose of frame {} is not finite ({} such frames)", first->index, broken));
  }
  record->valid = reasons.empty();
}

/// One pose for every frame: dropped and broken frames hold the last one.
Trajectory trajectory_over_all(const Record& record) {
  const Trajectory estimate = estimated_trajectory(record);
  Trajectory all;
  auto next = estimate.begin();
  for (const FrameRecord& frame : record.frames) {
    if (usable(frame)) {
      all.push_back(*next++);
    } else if (!all.empty()) {
      all.push_back({frame.time_s, all.back().T_world_camera});
    }
  }
  return all;
}

double median_interval(const std::vector<FrameRecord>& frames) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    intervals.push_back(std::abs(frames[i].time_s - frames[i - 1].time_s));
  }
  return summarize(intervals).median;
}

/// How far the stamps advance in a second of the sequence: 1, unless they count something else.
double stamps_per_second(const SequenceInfo& sequence, const Record& record) {
  const double found = median_interval(record.frames) * sequence.fps;
  return found > 0.5 && found < 2 ? 1 : (found > 0 ? found : 1);
}

struct Judged {
  TrajectoryFigures figures;
  PosePairs pairs;
  std::map<std::string, std::vector<double>> errors_m;  ///< by alignment, per pair
};

Judged judge_trajectory(const Trajectory& estimate, const SequenceInfo& sequence,
                        const std::string& place, Record* record) {
  Judged judged;
  TrajectoryFigures& figures = judged.figures;
  figures.association = name(rule);
  figures.limit_s = default_limit_s(rule);
  figures.estimate_poses = estimate.size();
  figures.ground_truth_poses = sequence.ground_truth.size();
  figures.rpe_delta_s = rpe_delta_s;
  judged.pairs = associate(estimate, sequence.ground_truth, rule, figures.limit_s);
  figures.matched = judged.pairs.size();

  const auto paired = select(estimate, sequence.ground_truth, judged.pairs);
  for (const auto alignment :
       {Alignment::none, Alignment::first_pose, Alignment::se3, Alignment::sim3}) {
    const std::string key(name(alignment));
    try {
      AteResult ate = absolute_trajectory_error(paired.estimate, paired.ground_truth, alignment);
      figures.ate_m[key] = ate.statistics;
      judged.errors_m[key] = std::move(ate.errors_m);
    } catch (const InputError& error) {
      record->absent[fmt::format("{}.ate_m.{}", place, key)] = error.what();
    }
  }
  std::string no_rpe = fmt::format("no two matched poses are {} s apart", rpe_delta_s);
  try {
    const RpeResult rpe =
        relative_pose_error(paired.estimate, paired.ground_truth,
                            rpe_delta_s * stamps_per_second(sequence, *record), DeltaUnit::seconds);
    figures.rpe_translation_m = rpe.translation_m;
    figures.rpe_rotation_deg = rpe.rotation_deg;
  } catch (const InputError& error) {
    no_rpe = error.what();
  }
  if (figures.rpe_translation_m.count == 0) {
    record->absent[place + ".rpe_translation_m"] = no_rpe;
    record->absent[place + ".rpe_rotation_deg"] = no_rpe;
  }
  return judged;
}

/// Where a pose of the ground truth belongs to a frame, its error.
void set_frame_errors(const Judged& judged, Record* record) {
  std::vector<FrameRecord*> frames;  // by pose of the estimate
  for (FrameRecord& frame : record->frames) {
    frame.error_first_pose_m.reset();
    frame.error_se3_m.reset();
    if (usable(frame)) frames.push_back(&frame);
  }
  const auto set = [&](Alignment alignment, std::optional<double> FrameRecord::*error) {
    const auto errors = judged.errors_m.find(std::string(name(alignment)));
    if (errors == judged.errors_m.end()) return;
    for (std::size_t i = judged.pairs.size(); i-- > 0;) {  // of several the first one counts
      frames[judged.pairs[i].first]->*error = errors->second[i];
    }
  };
  set(Alignment::first_pose, &FrameRecord::error_first_pose_m);
  set(Alignment::se3, &FrameRecord::error_se3_m);
}

/// Row p: the position before frame p is processed. A dropped frame repeats the row before it.
std::vector<Eigen::Vector3d> positions_before_frames(const Record& record) {
  std::vector<Eigen::Vector3d> rows;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (const FrameRecord& frame : record.frames) {
    if (frame.dropped) {
      if (!rows.empty()) rows.push_back(rows.back());
      continue;
    }
    rows.push_back(position);
    position = frame.T_start_camera.translation();
  }
  return rows;
}

/// Why pairing by row means nothing for this ground truth; empty where it does. Frames without a
/// row are no reason: the script moves up then, and so do its figures.
std::string rows_without_frames(const Trajectory& truth, const Record& record) {
  Trajectory frames;
  for (const FrameRecord& frame : record.frames) frames.push_back({frame.time_s, Pose::Identity()});
  frames = sorted_by_time(std::move(frames));
  const double limit_s = default_limit_s(rule);
  for (const StampedPose& row : truth) {
    if (row.time_s > frames.back().time_s + limit_s) continue;  // of frames that were not run
    if (nearest_pose(frames, row.time_s, limit_s)) continue;
    return fmt::format(
        "the ground truth has rows of no frame (time stamp {}), and the published convention pairs "
        "by row",
        row.time_s);
  }
  return "";
}

/// Why there is no figure of the published convention; empty when there is.
std::string judge_as_slambench1(const SequenceInfo& sequence, Record* record) {
  const Trajectory& truth = sequence.ground_truth;
  if (Eigen::AngleAxisd(truth.front().T_world_camera.linear()).angle() > own_axes_tolerance) {
    return "the ground truth does not start in the camera's own axes, and the published convention "
           "only shifts";
  }
  if (!std::all_of(record->frames.begin(), record->frames.end(),
                   [](const auto& frame) { return frame.dropped || finite(frame); })) {
    return "a pose is not finite";
  }
  if (auto reason = rows_without_frames(truth, *record); !reason.empty()) return reason;
  std::vector<Eigen::Vector3d> rows;
  for (const auto& pose : truth) rows.push_back(pose.T_world_camera.translation());
  const Statistics errors_m =
      slambench1_ate(positions_before_frames(*record), rows, sequence.own_from_camera);
  if (errors_m.count < 2) return "the first row, which has no error by definition, is the only one";
  record->slambench1_ate_m = errors_m;
  return "";
}

}  // namespace

void judge(const SequenceInfo& sequence, Record* record) {
  judge_validity(record);
  record->own_from_camera = sequence.own_from_camera;
  const Trajectory estimate = estimated_trajectory(*record);
  const auto no_accuracy = [&](const char* reason) {
    for (const char* figure : {"over_processed", "over_all", "slambench1_ate_m"}) {
      record->absent[fmt::format("accuracy.{}", figure)] = reason;
    }
  };
  if (sequence.ground_truth.empty()) return no_accuracy("the sequence has no ground truth");
  if (estimate.empty()) return no_accuracy("no frame has a pose");
  const Trajectory all = trajectory_over_all(*record);
  if (associate(all, sequence.ground_truth, rule, default_limit_s(rule)).empty()) {
    return no_accuracy("no pose of the ground truth has the time stamp of a frame");
  }
  const Judged judged = judge_trajectory(estimate, sequence, "accuracy.over_processed", record);
  record->over_processed = judged.figures;
  set_frame_errors(judged, record);
  record->over_all = judge_trajectory(all, sequence, "accuracy.over_all", record).figures;
  const std::string no_figure = judge_as_slambench1(sequence, record);
  if (!no_figure.empty()) record->absent["accuracy.slambench1_ate_m"] = no_figure;
}

}  // namespace slambench
