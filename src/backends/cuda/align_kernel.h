// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include "backends/cuda/found_pose.h"
#include "backends/cuda/solver.h"
#include "backends/cuda/sums.h"
#include "kernels/pixel.h"
#include "kernels/tracking.h"

/// The whole ICP loop in one kernel of blocks that run at the same time.
namespace slambench::cuda {

inline constexpr int most_levels = 16;  ///< enough for images of 32768 pixels

/// The live maps of one level of the pyramid.
struct AlignLevel {
  const Float3* vertices = nullptr;
  const Float3* normals = nullptr;
  TrackData* rows = nullptr;
  int pixels = 0, iterations = 0;
};

/// Where the loop ended.
struct AlignOutcome {
  PoseD pose;
  Reduction last;
  int last_level = 0;
  int iterations[most_levels] = {};
};

/// What stays on the device for the kernels that follow, and comes back to the host.
struct AlignMessage {
  AlignOutcome outcome;
  FoundPose found;
};

/// What each block keeps while the kernel runs. All blocks compute the same.
struct AlignState {
  BlockSums sums;
  Equations equations;
  AlignOutcome outcome;
  Rigid3f used;  ///< the pose of the last iteration's rows
  int converged;
};

struct Align {
  static constexpr int threads = sum_threads;
  using Shared = AlignState;

  AlignLevel levels[most_levels];
  int level_count;
  const Float3* model_vertices;
  const Float3* model_normals;
  Size model_size;
  TrackParameters parameters;
  PoseD start;
  double convergence, condition;
  TrackingLimits limits;
  bool keep_rows;
  /// Twice sum_count for each block: one is read while the other is written.
  double* of_blocks;
  AlignMessage* message;

  template <class Grid>
  SLAMBENCH_HD void operator()(const Grid& grid) const {
    grid.each_block([&](const auto& block, AlignState& state) { begin(block, state); });
    int turn = 0;
    for (int level = level_count - 1; level >= 0; --level) {
      for (int i = 0; i < levels[level].iterations; ++i, turn ^= 1) {
        double* sums = of_blocks + turn * grid.count() * sum_count;
        grid.each_block([&](const auto& block, AlignState& state) {
          add_up_rows(block, state, levels[level], sums);
        });
        grid.sync();
        grid.each_block([&](const auto& block, AlignState& state) {
          step(block, state, level, sums, grid.count());
        });
        if (grid.shared().converged != 0) break;
      }
    }
    grid.each_block([&](const auto& block, AlignState& state) { end(block, state); });
  }

 private:
  template <class Block>
  SLAMBENCH_HD void begin(const Block& block, AlignState& state) const {
    block.each([&](int thread) {
      if (thread != 0) return;
      state.outcome = {};
      state.outcome.pose = start;
      state.used = cuda::to_rigid3f(start);
      state.converged = 0;
    });
  }

  SLAMBENCH_HD TrackData row(const AlignLevel& level, int i, const Rigid3f& pose) const {
    TrackParameters p = parameters;
    p.T_volume_camera = pose;
    return track_point(level.vertices[i], level.normals[i], model_vertices, model_normals,
                       model_size, p);
  }

  /// track and the first half of reduce; no row is stored.
  template <class Block>
  SLAMBENCH_HD void add_up_rows(const Block& block, AlignState& state, const AlignLevel& level,
                                double* sums) const {
    block.each([&](int thread) {
      if (thread == 0) state.used = cuda::to_rigid3f(state.outcome.pose);
    });
    block.each([&](int thread) {
      ThreadSums own;
      const int stride = block.count() * threads;
      for (int i = block.index() * threads + thread; i < level.pixels; i += stride) {
        own.add(row(level, i, state.used));
      }
      for (int i = 0; i < sum_count; ++i) state.sums.of_thread[thread][i] = own.value[i];
    });
    add_up_threads(block, state.sums);
    block.each([&](int thread) {
      if (thread < sum_count) sums[block.index() * sum_count + thread] = state.sums.total[thread];
    });
  }

  /// The second half of reduce, solve, and the move; in every block, which is quicker than one
  /// block's work and another wait of all for it.
  template <class Block>
  SLAMBENCH_HD void step(const Block& block, AlignState& state, int level, const double* sums,
                         int blocks) const {
    add_up_blocks(block, sums, blocks, state.sums);
    block.each([&](int thread) {
      if (thread != 0) return;
      const double* total = state.sums.total;
      set_up(total + first_jt_j, total + first_jt_error, &state.equations);
      factor(&state.equations);
    });
    block.each([&](int thread) {
      if (thread <= 6) solve_column(&state.equations, thread);
    });
    block.each([&](int thread) {
      if (thread != 0) return;
      const Twist twist = solution(&state.equations, condition);
      AlignOutcome& outcome = state.outcome;
      outcome.pose = cuda::moved(outcome.pose, twist);
      outcome.last = reduction_of(state.sums.total);
      outcome.last_level = level;
      ++outcome.iterations[level];
      state.converged = cuda::norm(twist) < convergence ? 1 : 0;
    });
  }

  SLAMBENCH_HD FoundPose found(const AlignOutcome& outcome) const {
    const bool tracked = is_believed(is_finite(outcome.pose), outcome.last,
                                     levels[outcome.last_level].pixels, limits);
    const PoseD pose = tracked ? outcome.pose : start;
    return {tracked ? 1 : 0, cuda::to_rigid3f(pose), cuda::to_rigid3f(inverse(pose))};
  }

  template <class Block>
  SLAMBENCH_HD void end(const Block& block, AlignState& state) const {
    const AlignOutcome& outcome = state.outcome;
    const AlignLevel& level = levels[outcome.last_level];
    const bool rows = keep_rows && outcome.iterations[outcome.last_level] > 0;
    block.each([&](int thread) {
      if (block.index() == 0 && thread == 0) *message = {outcome, found(outcome)};
      const int stride = block.count() * threads;
      for (int i = block.index() * threads + thread; rows && i < level.pixels; i += stride) {
        level.rows[i] = row(level, i, state.used);
      }
    });
  }
};

}  // namespace slambench::cuda
