// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>
#include <vector>

#include "core/error.h"
#include "metrics/trajectory_metrics.h"

namespace slambench {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

Trajectory at_times(std::initializer_list<double> times) {
  Trajectory trajectory;
  for (const double t : times) trajectory.push_back({t, Pose::Identity()});
  return trajectory;
}

/// The rule in its obvious form: all candidates, sorted.
PosePairs all_candidates(const Trajectory& estimate, const Trajectory& truth, double limit_s) {
  std::vector<std::tuple<double, double, double, std::size_t, std::size_t>> candidates;
  for (std::size_t e = 0; e < estimate.size(); ++e) {
    for (std::size_t g = 0; g < truth.size(); ++g) {
      const double difference = std::abs(truth[g].time_s - estimate[e].time_s);
      if (difference < limit_s) {
        candidates.emplace_back(difference, truth[g].time_s, estimate[e].time_s, e, g);
      }
    }
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<bool> used_e(estimate.size()), used_g(truth.size());
  PosePairs pairs;
  for (const auto& [difference, tg, te, e, g] : candidates) {
    if (used_e[e] || used_g[g]) continue;
    used_e[e] = used_g[g] = true;
    pairs.emplace_back(e, g);
  }
  std::sort(pairs.begin(), pairs.end(), [&](const auto& a, const auto& b) {
    return estimate[a.first].time_s < estimate[b.first].time_s;
  });
  return pairs;
}

TEST(TumAssociation, TakesTheSmallestDifferenceFirstAndEachPoseOnce) {
  const auto estimate = at_times({1.000, 1.012});
  const auto truth = at_times({1.010});
  EXPECT_THAT(associate(estimate, truth, Association::tum, 0.02), ElementsAre(Pair(1, 0)));
}

TEST(TumAssociation, GivesThePoseThatLostItsNearestTheNextOne) {
  const auto estimate = at_times({1.000, 1.009});
  const auto truth = at_times({0.985, 1.008});
  EXPECT_THAT(associate(estimate, truth, Association::tum, 0.02),
              ElementsAre(Pair(0, 0), Pair(1, 1)));
}

TEST(TumAssociation, LimitIsExclusive) {
  EXPECT_THAT(associate(at_times({0}), at_times({0.5}), Association::tum, 0.5), IsEmpty());
  EXPECT_THAT(associate(at_times({0}), at_times({0.5}), Association::tum, 0.51),
              ElementsAre(Pair(0, 0)));
}

TEST(TumAssociation, EqualsTheSortedListOfAllCandidates) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> milliseconds(0, 400);
  for (int round = 0; round < 50; ++round) {
    Trajectory estimate, truth;
    std::vector<int> times(401);
    for (int i = 0; i <= 400; ++i) times[static_cast<std::size_t>(i)] = i;
    std::shuffle(times.begin(), times.end(), random);
    for (std::size_t i = 0; i < 40; ++i) estimate.push_back({times[i] / 1024.0, Pose::Identity()});
    std::shuffle(times.begin(), times.end(), random);
    for (std::size_t i = 0; i < 60; ++i) truth.push_back({times[i] / 1024.0, Pose::Identity()});
    EXPECT_EQ(associate(estimate, truth, Association::tum, 0.02),
              all_candidates(estimate, truth, 0.02));
  }
}

TEST(TumAssociation, OfManyEqualStampsStaysOneToOne) {
  const Trajectory same(3000, {1.0, Pose::Identity()});
  const auto pairs = associate(same, same, Association::tum, 0.02);
  EXPECT_EQ(pairs.size(), 3000u);
}

TEST(EvoAssociation, LimitIsInclusive) {
  EXPECT_THAT(associate(at_times({0}), at_times({0.5}), Association::evo, 0.5),
              ElementsAre(Pair(0, 0)));
  EXPECT_THAT(associate(at_times({0}), at_times({0.5}), Association::evo, 0.49), IsEmpty());
}

TEST(EvoAssociation, UsesAPoseOfTheLongerMoreThanOnce) {
  const auto estimate = at_times({1.000, 1.004});
  const auto truth = at_times({0.5, 1.002, 1.5});
  EXPECT_THAT(associate(estimate, truth, Association::evo, 0.01),
              ElementsAre(Pair(0, 1), Pair(1, 1)));
}

TEST(EvoAssociation, StartsFromTheShorterOne) {
  const auto estimate = at_times({1.000, 1.004, 1.5});
  const auto truth = at_times({1.003, 7});
  EXPECT_THAT(associate(estimate, truth, Association::evo, 0.01), ElementsAre(Pair(1, 0)));
}

TEST(EvoAssociation, OfTwoAsLongStartsFromTheEstimate) {
  const auto estimate = at_times({1.000, 1.004});
  const auto truth = at_times({1.003, 7});
  EXPECT_THAT(associate(estimate, truth, Association::evo, 0.01),
              ElementsAre(Pair(0, 0), Pair(1, 0)));
}

TEST(EvoAssociation, OfTwoAsNearTakesTheEarlier) {
  EXPECT_THAT(associate(at_times({1}), at_times({0.5, 1.5}), Association::evo, 1),
              ElementsAre(Pair(0, 0)));
}

TEST(Association, OfUnsortedTrajectoriesIsThatOfTheSortedOnes) {
  const auto estimate = at_times({3, 1, 2});
  const auto truth = at_times({2.001, 9, 3.001, 1.001});
  for (const auto rule : {Association::tum, Association::evo}) {
    EXPECT_THAT(associate(estimate, truth, rule, 0.01),
                ElementsAre(Pair(1, 3), Pair(2, 0), Pair(0, 2)));
  }
}

TEST(Association, OfNothingIsNothing) {
  for (const auto rule : {Association::tum, Association::evo}) {
    EXPECT_THAT(associate({}, at_times({1}), rule, 0.01), IsEmpty());
    EXPECT_THAT(associate(at_times({1}), {}, rule, 0.01), IsEmpty());
    EXPECT_THAT(associate({}, {}, rule, 0.01), IsEmpty());
  }
}

TEST(Association, RejectsALimitThatIsNone) {
  const auto one = at_times({1});
  EXPECT_THROW(associate(one, one, Association::evo, -0.01), UsageError);
  EXPECT_THROW(associate(one, one, Association::tum, std::nan("")), UsageError);
  EXPECT_THROW(associate(one, one, Association::tum, std::numeric_limits<double>::infinity()),
               UsageError);
}

TEST(Association, DefaultLimitsAreThePublishedOnes) {
  EXPECT_EQ(default_limit_s(Association::tum), 0.02);
  EXPECT_EQ(default_limit_s(Association::evo), 0.01);
}

TEST(NearestPose, LooksToBothSides) {
  const auto poses = at_times({1, 2, 4});
  EXPECT_EQ(nearest_pose(poses, 0.5, 1), 0u);
  EXPECT_EQ(nearest_pose(poses, 1.6, 1), 1u);
  EXPECT_EQ(nearest_pose(poses, 3.1, 1), 2u);
  EXPECT_EQ(nearest_pose(poses, 4.9, 1), 2u);
  EXPECT_EQ(nearest_pose(poses, 5.1, 1), std::nullopt);
  EXPECT_EQ(nearest_pose({}, 0, 1), std::nullopt);
}

}  // namespace
}  // namespace slambench
