// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/intrinsics.h"
#include "core/parameter.h"
#include "core/statistics.h"
#include "core/trajectory.h"
#include "meters/frame_timer.h"
#include "meters/measurements.h"

namespace slambench {

/// A parameter as it was used, and who set it.
struct UsedParameter {
  std::string group, name, unit, value;
  /// "default", "sequence", "sequence file PATH", "preset slambench1", "file PATH", "command line".
  std::string set_by;
};

/// One processed or dropped frame.
struct FrameRecord {
  int index = 0;
  double time_s = 0;           ///< the sequence's time stamp
  bool dropped = false;        ///< real-time mode: never processed; all below is empty then
  double start_s = 0;          ///< when it began to be acquired, since the first did
  double process_start_s = 0;  ///< when it began to be processed, on the same clock
  bool tracked = false;
  bool integrated = false;
  Pose T_start_camera = Pose::Identity();  ///< estimate in y-down axes, start camera = identity
  std::vector<int> iterations;
  std::size_t inliers = 0;
  double inlier_fraction = 0, residual_m = 0;
  std::optional<double> error_first_pose_m;  ///< against ground truth, where a pose has the stamp
  std::optional<double> error_se3_m;
  FrameTimes times;
};

/// Where and from what a record was made.
struct Provenance {
  std::string version, commit;  ///< of this program; commit ends in "-dirty" when it was
  std::string compiler, flags, build_type;
  std::string cpu, os, backend, device, driver;
  std::string instruction_set;  ///< that SIMD kernels were chosen for; empty: none were
  int cores = 0;                ///< logical processors that the process may use
  int threads = 0;              ///< that the kernels ran on; 0: on a device of its own
  std::size_t host_memory_bytes = 0;
  /// Of the last minute, before and after the frames: how many processes wanted a processor.
  std::optional<double> load_average_start, load_average_end;
  std::string command;     ///< the command line as given
  std::string started_at;  ///< UTC, ISO 8601
};

/// What was judged, against what. Absent parts have a reason in Record::absent.
struct TrajectoryFigures {
  std::string association;
  double limit_s = 0;
  std::size_t estimate_poses = 0, ground_truth_poses = 0, matched = 0;
  std::map<std::string, Statistics> ate_m;  ///< by alignment: "none", "first_pose", "se3", "sim3"
  Statistics rpe_translation_m, rpe_rotation_deg;
  double rpe_delta_s = 1;
};

/// A figure over repeated runs.
struct RepeatedFigure {
  std::string unit;
  std::vector<double> values;  ///< of each measured run, in order
  double median = 0;
  std::optional<double> low, high;     ///< interval that holds the median; none for a single run
  std::optional<double> run_spread;    ///< standard deviation of the values (n - 1)
  std::optional<double> frame_spread;  ///< median of the runs' standard deviations over frames
};

/// How often the run was done, and how its figures varied.
struct Repetition {
  int runs = 0;         ///< measured
  int warmup_runs = 0;  ///< before them, in no figure
  int shown_run = 1;    ///< the run that all else in the record tells of, counted from 1
  std::map<std::string, RepeatedFigure> figures;  ///< by place in record.json
  std::vector<std::string> lacking;   ///< places of figures that only some of the runs have
  std::vector<int> other_trajectory;  ///< runs whose trajectory is not that of the first
};

/// Everything that happened in one run: plain data. Writers and reports only read it.
struct Record {
  static constexpr int schema_version = 2;

  Provenance provenance;
  std::vector<UsedParameter> parameters;

  // The sequence.
  std::string sequence, layout, path, ground_truth_file, axes;
  int sequence_frames = 0;
  Size input_size, computation_size;
  Intrinsics camera;
  float units_per_m = 0;
  Eigen::Matrix3d own_from_camera = Eigen::Matrix3d::Identity();
  std::string input_hash;   ///< XXH3-128 over index and depth of every processed frame, in order
  Trajectory ground_truth;  ///< in the sequence's own axes and stamps; may be empty
  std::string ground_truth_hash;  ///< XXH3-128 over trajectory_text() of it; empty when it is

  // What happened.
  std::vector<FrameRecord> frames;
  FrameTimes init;          ///< of start-up
  double wall_s = 0;        ///< of the frame loop
  bool read_ahead = false;  ///< frames were read by a thread while others were processed
  int warmup_frames = 0;    ///< first processed frames left out of the time statistics
  std::string map;          ///< how the map was stored: what `auto` chose
  std::size_t map_bytes = 0;
  bool complete = true;  ///< false: interrupted
  std::string incomplete_reason;
  Measurements measurements;
  Repetition repetition;

  // How good it was.
  std::optional<TrajectoryFigures> over_processed;  ///< poses of processed frames
  std::optional<TrajectoryFigures> over_all;        ///< dropped frames hold the last pose
  std::optional<Statistics> slambench1_ate_m;       ///< the published convention, by row
  bool valid = true;
  std::vector<std::string> invalid_reasons;
  /// Why a figure could not be measured, by its place in record.json
  /// ("accuracy.over_processed", "accuracy.slambench1_ate_m").
  std::map<std::string, std::string> absent;
};

/// A pose relative to the start camera, turned into the sequence's own axes.
Pose in_own_axes(const Record& record, const Pose& T_start_camera);

/// The estimate in the sequence's own axes and stamps, one pose a processed frame: a frame that was
/// not tracked has the pose the system held. Left out are dropped frames and poses that are not
/// finite numbers.
Trajectory estimated_trajectory(const Record& record);

}  // namespace slambench
