// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include "results/record.h"

namespace slambench::testing {

inline double& seconds(FrameTimes& times, Stage stage) {
  times.stage_calls[static_cast<std::size_t>(stage)] = 1;
  return times.stage_s[static_cast<std::size_t>(stage)];
}
inline void called(FrameTimes& times, Kernel kernel, double seconds, int calls) {
  times.kernel_s[static_cast<std::size_t>(kernel)] = seconds;
  times.kernel_calls[static_cast<std::size_t>(kernel)] = calls;
}

/// Times that are `scale` x (1, 2, 4, 8, 16, 32) binary fractions of a second a stage.
inline FrameTimes sample_times(double scale) {
  FrameTimes times;
  seconds(times, Stage::acquire) = scale / 64;
  seconds(times, Stage::preprocess) = scale / 32;
  seconds(times, Stage::track) = scale / 16;
  seconds(times, Stage::integrate) = scale / 8;
  seconds(times, Stage::raycast) = scale / 4;
  seconds(times, Stage::render) = scale / 2;
  times.read_s = scale / 128;
  called(times, Kernel::acquire, scale / 64, 1);
  called(times, Kernel::mm2meters, scale / 32, 1);
  called(times, Kernel::track, scale / 16, 4);
  called(times, Kernel::integrate, scale / 8, 1);
  return times;
}

/// An upload of 1 KiB in each frame, three downloads of 128 bytes in odd ones.
inline void add_sample_transfers(Record& record) {
  for (FrameRecord& frame : record.frames) {
    if (frame.dropped) continue;
    frame.times.transfers[0] = {frame.index / 64.0, 1024, 1};
    if (frame.index % 2 == 1) frame.times.transfers[1] = {frame.index / 32.0, 384, 3};
  }
}

inline Statistics sample_statistics(double mean) {
  Statistics s;
  s.count = 2;
  s.mean = s.median = s.p95 = s.p99 = s.min = s.max = s.rmse = mean;
  return s;
}

/// One rail, an idle baseline, and a sensor that went away.
inline Measurements sample_measurements() {
  Measurements m;
  m.sampling = {.interval_s = 0.0625,
                .samples = 257,
                .cpu_s = 0.5,
                .share_of_run = 0.03125,
                .series = {{"package-0", "W", {{0.0625, 2}, {0.125, 8}}}}};
  const EnergyFigures figures{.joules = 64,
                              .joules_per_frame = 16,
                              .mean_w = 4,
                              .peak_w = 8,
                              .idle_w = 1,
                              .joules_above_idle = 48,
                              .energy_delay_js = 64,
                              .frames_per_joule = 0.0625};
  const RailEnergy rail{.name = "package-0",
                        .sensor = "powercap intel-rapl:0",
                        .reads = "energy",
                        .within = "",
                        .in_total = true,
                        .resolution = 1e-6,
                        .updates = 256,
                        .figures = figures};
  m.energy = {.seconds = 16, .frames = 4, .idle_seconds = 8, .rails = {rail}, .total = figures};
  m.memory = {.peak_resident_bytes = 512 << 20, .resident_bytes = 256 << 20, .device_bytes = {}};
  m.conditions.others_load = 0.25;
  m.conditions.governor = "powersave";
  m.conditions.cpu_frequency_hz = sample_statistics(2e9);
  m.conditions.temperature_c = {{"Tctl", sample_statistics(60)}};
  m.conditions.throttled = 0;
  m.conditions.noise = {"the governor is powersave"};
  m.absent = {{"energy.rails.dram", "No such file or directory"},
              {"memory.device_bytes", "computes in host memory"},
              {"counters", "no permission"}};
  return m;
}

/// Three runs, of which the third went another way.
inline Repetition sample_repetition() {
  Repetition r;
  r.runs = 3;
  r.warmup_runs = 1;
  r.shown_run = 2;
  r.figures["time.computation_s.mean"] = {.unit = "s",
                                          .values = {1, 1.25, 2},
                                          .median = 1.25,
                                          .low = 1,
                                          .high = 2,
                                          .run_spread = 0.5,
                                          .frame_spread = 0.25};
  r.lacking = {"time.kernels.reduce.seconds_per_frame"};
  r.other_trajectory = {3};
  return r;
}

/// Five frames of a y-up sequence: a warm-up frame untracked, one tracked, one dropped, one lost,
/// one tracked. Complete and valid.
inline Record sample_record() {
  Record r;
  r.provenance = {.version = "1.2.3",
                  .commit = "0123456789abcdef-dirty",
                  .compiler = "GNU 12.2.0",
                  .flags = "-O3",
                  .build_type = "Release",
                  .cpu = "A CPU",
                  .os = "Linux 6.1 x86_64",
                  .backend = "serial",
                  .device = "A CPU",
                  .driver = "",
                  .instruction_set = "AVX2",
                  .cores = 2,
                  .threads = 3,
                  .host_memory_bytes = 1024,
                  .load_average_start = 0.25,
                  .load_average_end = 1.5,
                  .command = "slambench run kt3",
                  .started_at = "2015-05-26T09:30:00Z"};
  r.parameters = {
      {"kinectfusion", "volume-resolution", "voxels", "256,256,256", "default"},
      {"kinectfusion", "volume-size", "m", "5,5,5", "command line"},
  };
  r.sequence = "kt3";
  r.layout = "icl-nuim";
  r.path = "/data/kt3";
  r.ground_truth_file = "/data/kt3/gt.freiburg";
  r.axes = "x right, y up, z forward";
  r.sequence_frames = 400;
  r.input_size = {640, 480};
  r.computation_size = {320, 240};
  r.camera = {481.5f, 480, 319.5f, 239.5f};
  r.units_per_m = 1000;
  r.own_from_camera = Eigen::Vector3d(1, -1, 1).asDiagonal();
  r.input_hash = "00112233445566778899aabbccddeeff";
  r.ground_truth = {{0.5, Pose::Identity()}, {1, Pose(Eigen::Translation3d(1, 0, 0.5))}};
  r.ground_truth_hash = "ffeeddccbbaa99887766554433221100";

  for (int i = 0; i < 5; ++i) {
    FrameRecord frame;
    frame.index = i;
    frame.time_s = 0.5 * i;
    if (i == 2) {
      frame.dropped = true;
    } else {
      frame.tracked = i == 1 || i == 4;
      frame.integrated = i < 2;
      frame.T_start_camera.translation() = Eigen::Vector3d(i, 0.25 * i, 0.5 * i);
      if (i > 0) {
        frame.iterations = {4, 2 + i};
        frame.inliers = 1000;
        frame.inlier_fraction = 0.5;
        frame.residual_m = 0.001;
        frame.error_se3_m = 0.125;
      }
      if (i == 1) frame.error_first_pose_m = 0.0625;
      frame.times = sample_times(i == 0 ? 1000 : i);
      frame.start_s = i == 0 ? 0 : 1000 + 4 * i;
    }
    r.frames.push_back(frame);
  }
  called(r.init, Kernel::init_volume, 0.25, 1);
  seconds(r.init, Stage::init) = 0.5;
  r.wall_s = 16;
  r.warmup_frames = 1;
  r.map = "bricks";
  r.map_bytes = 64 << 20;
  r.measurements = sample_measurements();
  r.repetition = sample_repetition();

  TrajectoryFigures figures;
  figures.association = "tum";
  figures.limit_s = 0.02;
  figures.estimate_poses = 4;
  figures.ground_truth_poses = 400;
  figures.matched = 3;
  figures.ate_m = {{"first_pose", sample_statistics(0.004)}, {"se3", sample_statistics(0.001)}};
  figures.rpe_translation_m = sample_statistics(0.012);
  figures.rpe_rotation_deg = sample_statistics(0.25);
  r.over_processed = figures;
  r.over_all = figures;
  r.slambench1_ate_m = sample_statistics(0.0207);
  return r;
}

}  // namespace slambench::testing
