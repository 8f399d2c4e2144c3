// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/align.h"

namespace slambench {

AlignResult iterate_align(const AlignInput& input, const MatchLevel& match,
                          const SolveMotion& solve) {
  AlignResult result;
  result.T_volume_camera = input.T_volume_camera;
  result.iterations.assign(input.iterations.size(), 0);
  TrackParameters parameters = input.parameters;
  for (std::size_t level = input.iterations.size(); level-- > 0;) {
    for (int i = 0; i < input.iterations[level]; ++i) {
      parameters.T_volume_camera = to_rigid3f(result.T_volume_camera);
      result.last = match(level, parameters);
      result.last_level = static_cast<int>(level);
      ++result.iterations[level];
      const Twist twist = solve(result.last);
      result.T_volume_camera = moved(result.T_volume_camera, twist);
      if (norm(twist) < input.convergence) break;
    }
  }
  return result;
}

}  // namespace slambench
