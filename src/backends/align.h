// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstddef>
#include <functional>

#include "backends/backend.h"

namespace slambench {

/// What one iteration of the ICP loop does: match a level of the pyramid at a pose and sum up.
using MatchLevel = std::function<Reduction(std::size_t level, const TrackParameters& at)>;
/// The motion that these sums ask for.
using SolveMotion = std::function<Twist(const Reduction&)>;

/// The ICP loop, coarse to fine, for every backend whose loop runs on the host: a level ends after
/// its iterations or when the motion is below the convergence.
AlignResult iterate_align(const AlignInput& input, const MatchLevel& match,
                          const SolveMotion& solve);

/// The shortest motion that minimises the sums' error; directions that the sums tell less of than
/// the best known one by the condition do not move. Zero where the sums are not finite.
Twist solve_motion(const Reduction& sums, double condition);
/// The same but for rounding, in a fraction of the time where all directions are known.
Twist solve_motion_quickly(const Reduction& sums, double condition);

}  // namespace slambench
