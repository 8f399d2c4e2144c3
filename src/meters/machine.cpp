// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/machine.h"

#include <algorithm>
#include <barrier>
#include <cstring>
#include <functional>
#include <memory>
#include <new>
#include <thread>
#include <vector>

#include "core/error.h"
#include "core/processors.h"
#include "meters/fma.h"

namespace slambench {
namespace {

constexpr double measured_s = 0.4;                          ///< per figure
constexpr std::size_t copy_bytes = std::size_t{256} << 20;  ///< source and destination each
constexpr std::size_t copy_pieces = 16;
constexpr std::int64_t fma_rounds = 1 << 18;  ///< below a millisecond

/// The best rate of `work(thread)`, which returns how much it did, done by all threads at once.
double best_rate(const Clock& clock, int threads, const std::function<double(int)>& work) {
  std::vector<double> amounts(static_cast<std::size_t>(threads));
  double best = 0, round_begin_s = 0;
  double begin_s = 0;
  bool done = false;
  int rounds = 0;
  // Runs between rounds, when all threads have arrived. The first round warms up.
  const auto between = [&]() noexcept {
    const double now_s = clock.now_s();
    if (rounds >= 2 && now_s > round_begin_s) {
      double amount = 0;
      for (const double a : amounts) amount += a;
      best = std::max(best, amount / (now_s - round_begin_s));
    }
    if (rounds == 1) begin_s = now_s;
    done = rounds >= 2 && now_s - begin_s > measured_s;
    ++rounds;
    round_begin_s = clock.now_s();
  };
  std::barrier round(threads, between);
  const auto run = [&](int thread) {
    round.arrive_and_wait();
    while (!done) {
      amounts[static_cast<std::size_t>(thread)] = work(thread);
      round.arrive_and_wait();
    }
  };
  {
    std::vector<std::jthread> others;
    for (int i = 1; i < threads; ++i) others.emplace_back(run, i);
    run(0);
  }
  return best;
}

/// Each round copies the next piece of arrays that are much larger than any cache, so that rounds
/// are short (what disturbs hits few of them) and nothing is left in the caches when a piece's turn
/// comes again.
double copy_rate(const Clock& clock, int threads) {
  const std::size_t share = copy_bytes / static_cast<std::size_t>(threads);
  const std::size_t piece = share / copy_pieces;
  struct Arrays {
    std::unique_ptr<char[]> from, to;
    std::size_t next = 0;
    bool touched = false;
  };
  std::vector<Arrays> arrays(static_cast<std::size_t>(threads));
  try {
    for (Arrays& a : arrays) {
      a.from = std::make_unique_for_overwrite<char[]>(share);
      a.to = std::make_unique_for_overwrite<char[]>(share);
    }
  } catch (const std::bad_alloc&) {
    throw UnavailableError("measuring copy bandwidth: expected 512 MiB of free memory");
  }
  const auto copy = [&](int thread) {
    Arrays& a = arrays[static_cast<std::size_t>(thread)];
    if (!a.touched) {  // memory near the thread that uses it
      std::memset(a.from.get(), 1, share);
      std::memset(a.to.get(), 2, share);
      a.touched = true;
    }
    std::memcpy(a.to.get() + a.next * piece, a.from.get() + a.next * piece, piece);
    a.next = (a.next + 1) % copy_pieces;
    return 2.0 * static_cast<double>(piece);
  };
  return best_rate(clock, threads, copy);
}

double fma_rate(const Clock& clock, int threads) {
  std::vector<float> sinks(static_cast<std::size_t>(threads));
  return best_rate(clock, threads, [&](int thread) {
    return multiply_add(fma_rounds, &sinks[static_cast<std::size_t>(thread)]);
  });
}

}  // namespace

MachineCeiling measure_machine(const Clock& clock, int threads) {
  if (threads <= 0) threads = usable_processors();
  return {threads, copy_rate(clock, threads), fma_rate(clock, threads),
          multiply_add_instruction_set()};
}

}  // namespace slambench
