// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/statistics.h"
#include "core/trajectory.h"

namespace slambench {

/// The poses in order of time; those of equal stamps keep their order.
Trajectory sorted_by_time(Trajectory trajectory);

/// The pose of `sorted` whose stamp is nearest to `time_s` (the earlier of two as near); none
/// when it is farther than `limit_s`.
std::optional<std::size_t> nearest_pose(const Trajectory& sorted, double time_s, double limit_s);

/// How estimate and ground truth are paired by time stamp.
enum class Association {
  tum,  ///< greedy one-to-one, smallest difference first, strictly below the limit (0.02 s)
  evo,  ///< for each pose of the shorter trajectory (the estimate, when both are as long) the
        ///< nearest of the other, not one-to-one, at most the limit (0.01 s)
};
double default_limit_s(Association rule);

/// Indices of paired poses: (estimate, ground truth).
using PosePairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// The pairs in order of time, the estimate's first. Neither trajectory need be sorted. Throws
/// UsageError when the limit is negative or not finite.
PosePairs associate(const Trajectory& estimate, const Trajectory& ground_truth, Association rule,
                    double limit_s);

/// Two trajectories of equal length, paired by index.
struct PairedTrajectories {
  Trajectory estimate, ground_truth;
};
PairedTrajectories select(const Trajectory& estimate, const Trajectory& ground_truth,
                          const PosePairs& pairs);

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

/// `estimate` and `ground_truth` are paired by index. The rotation is proper (determinant +1).
/// Throws InputError when the pairs do not determine the alignment: none at all; for
/// first_pose fewer than 2, as one always fits; for se3 and sim3 fewer than 3, or positions all on
/// one line or in one point; or numbers too large for it.
Similarity align(const Trajectory& estimate, const Trajectory& ground_truth, Alignment alignment);

/// Absolute trajectory error (Sturm et al., IROS 2012): distances of aligned positions, m.
/// Throws InputError as align() does.
struct AteResult {
  Similarity alignment;
  std::vector<double> errors_m;  ///< per pair
  Statistics statistics;
};
AteResult absolute_trajectory_error(const Trajectory& estimate, const Trajectory& ground_truth,
                                    Alignment alignment);

enum class DeltaUnit { frames, seconds, meters };

/// Relative pose error (Sturm et al. 2012, eq. 1): the motion (G_i^-1 G_j)^-1 (E_i^-1 E_j) between
/// true and estimated motion over pairs (i, j) delta apart. Needs no alignment.
struct RpeResult {
  std::vector<double> translations_m, rotations_deg;
  Statistics translation_m, rotation_deg;
};

/// Over poses paired by index and in order of time. From every pose i: in frames, j = i + delta;
/// in seconds and metres, j is the later pose whose time since i, or length of the estimate's path
/// since i, is nearest to delta, unless it misses it by more than a tenth. No pairs: count is 0.
/// Throws UsageError when delta is not positive, or not whole in frames.
RpeResult relative_pose_error(const Trajectory& estimate, const Trajectory& ground_truth,
                              double delta, DeltaUnit unit);

/// As the TUM benchmark's script with a fixed delta does it, from trajectories that are not yet
/// associated: j is the pose of the estimate nearest to i's time (path length, index) + delta;
/// pairs that end in the last pose are left out, and so are those where either end has no ground
/// truth within twice the median interval of the ground truth's stamps. The script looks from j
/// back to i, (G_j^-1 G_i)^-1 (E_j^-1 E_i), which gives slightly other translations than looking
/// forward when rotations are wrong, and so does this. The script's random choice of 10,000 pairs
/// when there are more is not made: all count. Throws UsageError as above.
RpeResult tum_relative_pose_error(const Trajectory& estimate, const Trajectory& ground_truth,
                                  double delta, DeltaUnit unit);

/// The absolute trajectory error as SLAMBench 1 published it: row p of its log, the position
/// relative to the start BEFORE frame p is processed, against row p of the ground-truth file,
/// whatever its time stamp. In ICL-NUIM's files that row belongs to frame p + 1, so that the figure
/// is two frames late; in a file with a row for frame 0 it is one. The positions are turned to the
/// ground truth's axes (the published script flips Y) and shifted by the first row; there is no
/// other alignment. Rows that only one side has do not count.
Statistics slambench1_ate(std::span<const Eigen::Vector3d> positions_before_frame,
                          std::span<const Eigen::Vector3d> ground_truth_rows,
                          const Eigen::Matrix3d& own_from_camera);

}  // namespace slambench
