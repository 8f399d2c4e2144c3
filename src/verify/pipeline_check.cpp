// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "slam/kinect_fusion.h"
#include "verify/checks.h"
#include "verify/trial.h"

namespace slambench {
namespace {

using Track = std::tuple<std::vector<Pose>, std::vector<int>>;

Track run_pipeline(Workbench& bench, const Recording& recording, bool fused) {
  KinectFusionParameters parameters = recording.parameters;
  parameters.map = name(bench.map());
  parameters.fused = fused;
  KinectFusion system(bench.backend(), parameters, recording.frames[0].depth.size(),
                      recording.camera, recording.units_per_m, nullptr);
  Track track;
  for (const Frame& frame : recording.frames) {
    const FrameResult result = system.process(frame);
    system.render();
    std::get<0>(track).push_back(result.T_start_camera);
    std::get<1>(track).push_back(result.tracked ? 1 : 0);
  }
  return track;
}

constexpr std::size_t lost_frame = 8;  // it is due to be integrated

/// Where tracking is lost and found again: too few pixels of the lost frame lie where the map
/// has a surface. The others are so near to one that fusing them would move it, and the frames
/// behind would be tracked to other poses.
Recording with_a_lost_frame(Recording recording) {
  recording.name += " with a lost frame";
  KinectFusionParameters& p = recording.parameters;
  p.tracked_fraction = 0.7;
  p.icp_distance_threshold_m = 0.4 * p.mu_m;
  const auto nearer = static_cast<int>(0.75 * p.mu_m * recording.units_per_m);
  Image<std::uint16_t>& depth = recording.frames[lost_frame].depth;
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 0; x < depth.width() / 2; ++x) {
      depth(x, y) = static_cast<std::uint16_t>(std::max(0, depth(x, y) - nearer));
    }
  }
  return recording;
}

void compare_tracks(Trial& trial, const Track& expected, const Track& found) {
  const auto& [poses, tracked] = expected;
  const auto& [found_poses, found_tracked] = found;
  int differ = 0;
  double translation_m = 0, rotation_rad = 0;
  std::string translation_where, rotation_where;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (tracked[i] != found_tracked[i]) ++differ;
    const Pose difference = poses[i].inverse() * found_poses[i];
    const double t = difference.translation().norm();
    const double r = Eigen::AngleAxisd(difference.linear()).angle();
    if (!(t <= translation_m)) {
      translation_m = t;
      translation_where = fmt::format("frame {}", i);
    }
    if (!(r <= rotation_rad)) {
      rotation_rad = r;
      rotation_where = fmt::format("frame {}", i);
    }
  }
  trial.at_most("tracked frames that differ", differ);
  trial.at_most("translation, m", translation_m, translation_where);
  trial.at_most("rotation, rad", rotation_rad, rotation_where);
}

}  // namespace

void check_pipeline(Trial& trial) {
  const auto add = [&](const Recording& recording, bool fused, bool loses) {
    trial.add(
        fmt::format("{}, {} frames{}", recording.name, recording.frames.size(),
                    fused ? ", fused" : ""),
        [&, fused](Workbench& bench) { return run_pipeline(bench, recording, fused); },
        [&, loses](const Track& expected, const Track& found) {
          compare_tracks(trial, expected, found);
          if (loses) trial.at_most("lost frames that are not", std::get<1>(expected)[lost_frame]);
        });
  };
  const Recording room = synthetic_recording({160, 120}, 12);
  add(room, false, false);
  add(with_a_lost_frame(room), true, true);
  for (const Recording& recording : trial.recordings()) {
    for (const bool fused : {false, true}) add(recording, fused, false);
  }
}

}  // namespace slambench
