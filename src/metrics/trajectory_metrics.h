// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "core/statistics.h"
#include "core/trajectory.h"

namespace slambench {

/// How estimate and ground truth are paired by time stamp.
enum class Association {
  tum,  ///< greedy one-to-one, smallest difference first, strictly below the limit (0.02 s)
  evo,  ///< for each pose of the shorter trajectory the nearest of the other, not one-to-one,
        ///< at most the limit (0.01 s)
};
double default_limit_s(Association rule);

/// Indices (estimate, ground truth) of paired poses, in order of the estimate's time.
std::vector<std::pair<std::size_t, std::size_t>> associate(const Trajectory& estimate,
                                                           const Trajectory& ground_truth,
                                                           Association rule, double limit_s);

enum class Alignment {
  none,
  first_pose,  ///< the first pair's full poses are made equal
  se3,         ///< rigid, least squares over positions (Horn 1987, Umeyama 1991 without scale)
  sim3,        ///< with scale (Umeyama 1991)
};
std::string_view name(Association rule);
std::string_view name(Alignment alignment);

/// x -> scale * rotation * x + translation, from the estimate's world to the ground truth's.
struct Similarity {
  double scale = 1;
  Pose rigid = Pose::Identity();
};

/// `estimate` and `ground_truth` are paired by index. Throws InputError when there are too few
/// or degenerate pairs for the alignment.
Similarity align(const Trajectory& estimate, const Trajectory& ground_truth, Alignment alignment);

/// Absolute trajectory error (Sturm et al., IROS 2012): distances of aligned positions, m.
struct AteResult {
  Similarity alignment;
  std::vector<double> errors_m;  ///< per pair
  Statistics statistics;
};
AteResult absolute_trajectory_error(const Trajectory& estimate, const Trajectory& ground_truth,
                                    Alignment alignment);

enum class DeltaUnit { frames, seconds, meters };

/// Relative pose error (Sturm et al. 2012): (G_i^-1 G_j)^-1 (E_i^-1 E_j) over pairs (i, j) delta
/// apart. Needs no alignment.
struct RpeResult {
  std::vector<double> translations_m, rotations_deg;
  Statistics translation_m, rotation_deg;
};
RpeResult relative_pose_error(const Trajectory& estimate, const Trajectory& ground_truth,
                              double delta, DeltaUnit unit);

}  // namespace slambench
