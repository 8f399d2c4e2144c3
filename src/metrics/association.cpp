// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <tuple>

#include "core/error.h"
#include "metrics/trajectory_metrics.h"

namespace slambench {
namespace {

/// Positions in a trajectory, in order of time.
std::vector<std::size_t> order_by_time(const Trajectory& trajectory) {
  std::vector<std::size_t> order(trajectory.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return trajectory[a].time_s < trajectory[b].time_s;
  });
  return order;
}

/// A sorted list from which entries are taken, that finds the next one left in either direction.
class Remaining {
 public:
  explicit Remaining(std::size_t count) : left_(count + 1), right_(count + 1) {
    std::iota(left_.begin(), left_.end(), std::size_t{0});
    std::iota(right_.begin(), right_.end(), std::size_t{0});
  }
  void take(std::size_t i) {
    left_[i + 1] = i;
    right_[i] = i + 1;
  }
  /// The last one left before `end`, plus 1; 0 when there is none.
  std::size_t before(std::size_t end) { return root(left_, end); }
  /// The first one left from `begin` on; the count when there is none.
  std::size_t from(std::size_t begin) { return root(right_, begin); }

 private:
  static std::size_t root(std::vector<std::size_t>& parent, std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  std::vector<std::size_t> left_, right_;
};

/// Greedy matching of sorted trajectories, smallest difference first; of equal differences first
/// the earlier ground truth, then the earlier estimate.
PosePairs greedy_pairs(const Trajectory& estimate, const Trajectory& ground_truth, double limit_s) {
  using Candidate = std::tuple<double, std::size_t, std::size_t>;  // difference, truth, estimate
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> candidates;
  Remaining remaining(ground_truth.size());
  std::vector<bool> taken(ground_truth.size(), false);

  const auto propose = [&](std::size_t e) {
    const double time_s = estimate[e].time_s;
    const auto split = std::upper_bound(ground_truth.begin(), ground_truth.end(), time_s,
                                        [](double t, const auto& pose) { return t < pose.time_s; });
    const auto middle = static_cast<std::size_t>(split - ground_truth.begin());
    const auto offer = [&](std::size_t g) {
      return Candidate{std::abs(ground_truth[g].time_s - time_s), g, e};
    };
    std::optional<Candidate> best;
    if (const std::size_t end = remaining.before(middle); end > 0) best = offer(end - 1);
    if (const std::size_t g = remaining.from(middle); g < ground_truth.size()) {
      best = best ? std::min(*best, offer(g)) : offer(g);
    }
    if (best && std::get<0>(*best) < limit_s) candidates.push(*best);
  };

  for (std::size_t e = 0; e < estimate.size(); ++e) propose(e);
  PosePairs pairs;
  while (!candidates.empty()) {
    const auto [difference, g, e] = candidates.top();
    candidates.pop();
    if (taken[g]) {
      propose(e);
      continue;
    }
    taken[g] = true;
    remaining.take(g);
    pairs.emplace_back(e, g);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

PosePairs nearest_pairs(const Trajectory& estimate, const Trajectory& ground_truth,
                        double limit_s) {
  PosePairs pairs;
  const bool truth_is_shorter = ground_truth.size() < estimate.size();
  const Trajectory& shorter = truth_is_shorter ? ground_truth : estimate;
  const Trajectory& longer = truth_is_shorter ? estimate : ground_truth;
  for (std::size_t i = 0; i < shorter.size(); ++i) {
    const auto j = nearest_pose(longer, shorter[i].time_s, limit_s);
    if (!j) continue;
    pairs.emplace_back(truth_is_shorter ? *j : i, truth_is_shorter ? i : *j);
  }
  return pairs;
}

}  // namespace

Trajectory sorted_by_time(Trajectory trajectory) {
  std::stable_sort(trajectory.begin(), trajectory.end(),
                   [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  return trajectory;
}

std::optional<std::size_t> nearest_pose(const Trajectory& sorted, double time_s, double limit_s) {
  const auto later = std::upper_bound(sorted.begin(), sorted.end(), time_s,
                                      [](double t, const auto& pose) { return t < pose.time_s; });
  std::optional<std::size_t> best;
  double best_s = limit_s;
  const auto consider = [&](Trajectory::const_iterator pose) {
    const double difference_s = std::abs(pose->time_s - time_s);
    if (best ? difference_s >= best_s : difference_s > best_s) return;
    best = static_cast<std::size_t>(pose - sorted.begin());
    best_s = difference_s;
  };
  if (later != sorted.begin()) consider(later - 1);
  if (later != sorted.end()) consider(later);
  return best;
}

double default_limit_s(Association rule) { return rule == Association::tum ? 0.02 : 0.01; }

std::string_view name(Association rule) { return rule == Association::tum ? "tum" : "evo"; }

PosePairs associate(const Trajectory& estimate, const Trajectory& ground_truth, Association rule,
                    double limit_s) {
  if (!std::isfinite(limit_s) || limit_s < 0) {
    throw UsageError(fmt::format(
        "largest time difference of a pair: found {} s, expected a number from 0 on", limit_s));
  }
  const auto estimate_order = order_by_time(estimate);
  const auto truth_order = order_by_time(ground_truth);
  const Trajectory sorted_estimate = sorted_by_time(estimate);
  const Trajectory sorted_truth = sorted_by_time(ground_truth);
  PosePairs pairs = rule == Association::tum
                        ? greedy_pairs(sorted_estimate, sorted_truth, limit_s)
                        : nearest_pairs(sorted_estimate, sorted_truth, limit_s);
  for (auto& [e, g] : pairs) {
    e = estimate_order[e];
    g = truth_order[g];
  }
  return pairs;
}

PairedTrajectories select(const Trajectory& estimate, const Trajectory& ground_truth,
                          const PosePairs& pairs) {
  PairedTrajectories paired;
  paired.estimate.reserve(pairs.size());
  paired.ground_truth.reserve(pairs.size());
  for (const auto& [e, g] : pairs) {
    paired.estimate.push_back(estimate.at(e));
    paired.ground_truth.push_back(ground_truth.at(g));
  }
  return paired;
}

}  // namespace slambench
