// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/repetition.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/statistics.h"
#include "sample_record.h"

namespace slambench {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Key;
using ::testing::Not;
using testing::sample_record;

std::map<std::string, Figure> one(double value) {
  return {{"time.computation_s.mean", {"s", value, 0.5}}};
}

TEST(RunFigures, StandUnderTheirPlacesInTheRecord) {
  const auto figures = run_figures(sample_record());
  EXPECT_DOUBLE_EQ(figures.at("time.fps_computation").value, 0.8);
  EXPECT_EQ(figures.at("time.fps_computation").unit, "frames/s");
  EXPECT_FALSE(figures.at("time.fps_computation").frame_spread);
  EXPECT_DOUBLE_EQ(figures.at("time.computation_s.mean").value, 1.25);
  EXPECT_NEAR(*figures.at("time.computation_s.mean").frame_spread, 0.585, 0.001);
  EXPECT_DOUBLE_EQ(figures.at("time.stages.raycast.seconds_per_frame").value, 2. / 3);
  EXPECT_DOUBLE_EQ(figures.at("time.kernels.track.seconds_per_frame").value, 1. / 6);
  EXPECT_DOUBLE_EQ(figures.at("energy.rails.package-0.joules").value, 64);
  EXPECT_DOUBLE_EQ(figures.at("energy.total.joules_per_frame").value, 16);
  EXPECT_DOUBLE_EQ(figures.at("energy.total.joules_above_idle").value, 48);
  EXPECT_DOUBLE_EQ(figures.at("memory.map_bytes").value, 64 << 20);
  EXPECT_DOUBLE_EQ(figures.at("memory.peak_resident_bytes").value, 512 << 20);
  EXPECT_DOUBLE_EQ(figures.at("accuracy.over_processed.ate_m.se3.rmse").value, 0.001);
  EXPECT_DOUBLE_EQ(figures.at("accuracy.slambench1_ate_m.max").value, 0.0207);
  EXPECT_DOUBLE_EQ(figures.at("time.read_s.mean").value, 8. / 3 / 128);
  EXPECT_EQ(figures.at("frames.tracked").value, 2);
  EXPECT_THAT(figures, Not(Contains(Key("memory.device_bytes")))) << "not measured";
  EXPECT_THAT(figures, Not(Contains(Key("time.kernels.solve.seconds_per_frame"))))
      << "never called";
}

TEST(RunFigures, AreOnlyThoseThatAreFinite) {
  Record record = sample_record();
  record.measurements.energy->rails[0].figures.joules = std::nan("");
  EXPECT_THAT(run_figures(record), Not(Contains(Key("energy.rails.package-0.joules"))));
}

TEST(RepetitionOf, OneRunHasNoSpreadAndNoInterval) {
  const Repetition r = repetition_of({one(3)});
  EXPECT_EQ(r.runs, 1);
  const RepeatedFigure& figure = r.figures.at("time.computation_s.mean");
  EXPECT_THAT(figure.values, ElementsAre(3));
  EXPECT_EQ(figure.median, 3);
  EXPECT_EQ(figure.frame_spread, 0.5);
  EXPECT_FALSE(figure.low || figure.high || figure.run_spread);
}

TEST(RepetitionOf, KeepsRunToRunAndFrameToFrameSpreadApart) {
  const Repetition r = repetition_of({one(1), one(4), one(7)});
  const RepeatedFigure& figure = r.figures.at("time.computation_s.mean");
  EXPECT_THAT(figure.values, ElementsAre(1, 4, 7));
  EXPECT_EQ(figure.unit, "s");
  EXPECT_EQ(figure.median, 4);
  EXPECT_DOUBLE_EQ(*figure.run_spread, 3);
  EXPECT_EQ(*figure.frame_spread, 0.5);
  EXPECT_EQ(*figure.low, 1);
  EXPECT_EQ(*figure.high, 7);
}

TEST(RepetitionOf, NamesFiguresThatARunLacks) {
  auto more = one(2);
  more["energy.total.joules"] = {"J", 1, {}};
  const Repetition r = repetition_of({one(1), more});
  EXPECT_THAT(r.lacking, ElementsAre("energy.total.joules"));
  EXPECT_EQ(r.figures.size(), 1u);
}

TEST(MedianRun, IsTheLowerMiddleOfThoseThatHaveTheFigure) {
  EXPECT_EQ(median_run({one(5), one(1), one(3)}, "time.computation_s.mean"), 2u);
  EXPECT_EQ(median_run({one(5), one(1), one(3), one(4)}, "time.computation_s.mean"), 2u);
  EXPECT_EQ(median_run({{}, one(1)}, "time.computation_s.mean"), 1u);
  EXPECT_EQ(median_run({one(5)}, "other"), 0u);
}

std::vector<double> normal_sample(std::size_t count, std::mt19937_64* random) {
  std::vector<double> values(count);
  for (double& value : values) {
    // Box and Muller: the same on every library.
    const double u = (static_cast<double>((*random)() >> 11) + 0.5) * 0x1p-53;
    const double v = static_cast<double>((*random)() >> 11) * 0x1p-53;
    value = 10 + std::sqrt(-2 * std::log(u)) * std::cos(2 * 3.14159265358979 * v);
  }
  return values;
}

TEST(BootstrapMedian, HoldsTheTrueMedianAboutAsOftenAsItSays) {
  std::mt19937_64 random(7);
  constexpr int tries = 400;
  for (const std::size_t count : {9u, 15u, 31u}) {
    int held = 0;
    for (int i = 0; i < tries; ++i) {
      const Interval interval = bootstrap_median(normal_sample(count, &random), 0.95, 400);
      if (interval.low <= 10 && 10 <= interval.high) ++held;
    }
    EXPECT_GE(held, tries * 0.91) << count;
    EXPECT_LE(held, tries * 0.99) << count;
  }
}

TEST(BootstrapMedian, LiesWithinTheValuesAroundTheirMedian) {
  std::mt19937_64 random(3);
  for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 8u, 20u}) {
    const auto values = normal_sample(count, &random);
    const Interval interval = bootstrap_median(values);
    const Statistics s = summarize(values);
    EXPECT_LE(s.min, interval.low);
    EXPECT_LE(interval.low, s.median);
    EXPECT_LE(s.median, interval.high);
    EXPECT_LE(interval.high, s.max);
  }
}

TEST(BootstrapMedian, MovesAndScalesWithTheValues) {
  std::mt19937_64 random(5);
  auto values = normal_sample(11, &random);
  const Interval before = bootstrap_median(values);
  for (double& value : values) value = 4 * value + 1024;
  const Interval after = bootstrap_median(values);
  EXPECT_NEAR(after.low, 4 * before.low + 1024, 1e-9);
  EXPECT_NEAR(after.high, 4 * before.high + 1024, 1e-9);
}

TEST(BootstrapMedian, NarrowsWithMoreRuns) {
  std::mt19937_64 random(11);
  const Interval few = bootstrap_median(normal_sample(8, &random));
  const Interval many = bootstrap_median(normal_sample(200, &random));
  EXPECT_LT(many.high - many.low, (few.high - few.low) / 2);
}

TEST(BootstrapMedian, OfEqualValuesIsThatValue) {
  const std::vector<double> values(5, 2.5);
  const Interval interval = bootstrap_median(values);
  EXPECT_EQ(interval.low, 2.5);
  EXPECT_EQ(interval.high, 2.5);
}

TEST(BootstrapMedian, IsTheSameEveryTime) {
  std::mt19937_64 random(2);
  const auto values = normal_sample(7, &random);
  const Interval a = bootstrap_median(values), b = bootstrap_median(values);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
}

}  // namespace
}  // namespace slambench
