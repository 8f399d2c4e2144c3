// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include "backends/cuda/device_maths.h"
#include "kernels/types.h"

/// The sums of the reduction, in an order that only the number of blocks decides.
///
/// A thread adds up its pixels in single precision, the pixels i, i + threads of the grid, ...; its
/// block adds up the threads' sums in double precision, in groups of neighbouring threads and then
/// group after group; the blocks' sums are added up in the same way. All of them are arrays of
/// `sum_count` numbers, so that thread i of a group of as many can take care of number i.
namespace slambench::cuda {

/// squared_error, jt_error[6], jt_j[21], and the four counts of a Reduction.
inline constexpr int sum_count = 32;
inline constexpr int sum_threads = 256;                     ///< of a block
inline constexpr int sum_groups = sum_threads / sum_count;  ///< of threads in a block
inline constexpr int first_jt_error = 1, first_jt_j = 7, first_count = 28;

/// One thread's sums; counts are exact up to 2^24 pixels a thread.
struct ThreadSums {
  float value[sum_count] = {};

  SLAMBENCH_HD void add(const TrackData& row) {
    switch (row.outcome) {
      case TrackOutcome::ok:
        break;
      case TrackOutcome::too_far:
        value[first_count + 1] += 1.0f;
        return;
      case TrackOutcome::wrong_normal:
        value[first_count + 2] += 1.0f;
        return;
      default:
        value[first_count + 3] += 1.0f;
        return;
    }
    value[first_count] += 1.0f;
    value[0] += row.error * row.error;
    int entry = first_jt_j;
    for (int i = 0; i < 6; ++i) {
      value[first_jt_error + i] += row.error * row.jacobian[i];
      for (int j = i; j < 6; ++j) value[entry++] += row.jacobian[i] * row.jacobian[j];
    }
  }
};

/// What a block needs to add up its threads' sums. Rows are padded by one, so that neither threads
/// that write their rows nor threads that read a column meet in a bank.
struct BlockSums {
  float of_thread[sum_threads][sum_count + 1];
  double of_group[sum_groups][sum_count];
  double total[sum_count];
};

/// Adds up shared.of_thread into shared.total.
template <class Block>
SLAMBENCH_HD inline void add_up_threads(const Block& block, BlockSums& shared) {
  block.each([&](int thread) {
    const int number = thread % sum_count, group = thread / sum_count;
    double sum = 0;
    for (int i = 0; i < sum_count; ++i) {
      sum += static_cast<double>(shared.of_thread[group * sum_count + i][number]);
    }
    shared.of_group[group][number] = sum;
  });
  block.each([&](int thread) {
    if (thread >= sum_count) return;
    double sum = 0;
    for (int group = 0; group < sum_groups; ++group) sum += shared.of_group[group][thread];
    shared.total[thread] = sum;
  });
}

/// Adds up the sums of all blocks (an array of sum_count a block) into shared.total.
template <class Block>
SLAMBENCH_HD inline void add_up_blocks(const Block& block, const double* of_blocks, int blocks,
                                       BlockSums& shared) {
  block.each([&](int thread) {
    const int number = thread % sum_count, group = thread / sum_count;
    double sum = 0;
    for (int i = group; i < blocks; i += sum_groups) sum += of_blocks[i * sum_count + number];
    shared.of_group[group][number] = sum;
  });
  block.each([&](int thread) {
    if (thread >= sum_count) return;
    double sum = 0;
    for (int group = 0; group < sum_groups; ++group) sum += shared.of_group[group][thread];
    shared.total[thread] = sum;
  });
}

SLAMBENCH_HD inline Reduction reduction_of(const double* sums) {
  Reduction r;
  r.squared_error = sums[0];
  for (int i = 0; i < 6; ++i) r.jt_error[i] = sums[first_jt_error + i];
  for (int i = 0; i < 21; ++i) r.jt_j[i] = sums[first_jt_j + i];
  r.inliers = static_cast<std::int64_t>(sums[first_count]);
  r.too_far = static_cast<std::int64_t>(sums[first_count + 1]);
  r.wrong_normal = static_cast<std::int64_t>(sums[first_count + 2]);
  r.others = static_cast<std::int64_t>(sums[first_count + 3]);
  return r;
}

/// The first half of reduce: each block's sums of the rows that fall to it.
struct ReduceRows {
  static constexpr int threads = sum_threads;
  using Shared = BlockSums;

  const TrackData* rows;
  int count;
  double* of_blocks;

  template <class Block>
  SLAMBENCH_HD void operator()(const Block& block, Shared& shared) const {
    block.each([&](int thread) {
      ThreadSums sums;
      for (int i = block.index() * threads + thread; i < count; i += block.count() * threads) {
        sums.add(rows[i]);
      }
      for (int i = 0; i < sum_count; ++i) shared.of_thread[thread][i] = sums.value[i];
    });
    add_up_threads(block, shared);
    block.each([&](int thread) {
      if (thread < sum_count) of_blocks[block.index() * sum_count + thread] = shared.total[thread];
    });
  }
};

/// The second half, by one block.
struct ReduceBlocks {
  static constexpr int threads = sum_threads;
  using Shared = BlockSums;

  const double* of_blocks;
  int blocks;
  Reduction* result;

  template <class Block>
  SLAMBENCH_HD void operator()(const Block& block, Shared& shared) const {
    add_up_blocks(block, of_blocks, blocks, shared);
    block.each([&](int thread) {
      if (thread == 0) *result = reduction_of(shared.total);
    });
  }
};

}  // namespace slambench::cuda
