// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/sampler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "fakes.h"
#include "meters/sampling_thread.h"
#include "support/fake_clock.h"

namespace slambench {
namespace {

class SamplerTest : public ::testing::Test {
 protected:
  void measure(Quantity quantity, double interval_s = 0.1) {
    std::vector<std::unique_ptr<Meter>> meters;
    meters.push_back(std::make_unique<testing::FakeMeter>(
        MeterInfo{.name = "rail", .sensor = "fake", .quantity = quantity, .within = ""},
        [this] { return value_; }));
    sampler_ = std::make_unique<Sampler>(std::move(meters), clock_, interval_s);
    sampler_->begin();
  }
  void after(double seconds, double value) {
    clock_.advance(seconds);
    value_ = value;
    sampler_->sample();
  }
  Channel channel() const { return sampler_->channels().at(0); }

  testing::FakeClock clock_;
  double value_ = 0;
  std::unique_ptr<Sampler> sampler_;
};

TEST_F(SamplerTest, ACounterTellsPowerBetweenItsUpdates) {
  value_ = 100;
  measure(Quantity::energy_j);
  after(0.05, 101);  // it is not known since when: no power
  after(0.10, 101);
  after(0.10, 103);  // 2 J in 0.2 s
  after(0.10, 103.5);
  EXPECT_DOUBLE_EQ(channel().joules, 3.5);
  EXPECT_NEAR(*channel().peak_w, 10, 1e-9);
  ASSERT_EQ(channel().samples.size(), 2u);
  EXPECT_NEAR(channel().samples[0].time_s, 0.25, 1e-9);
  EXPECT_NEAR(channel().samples[0].value, 10, 1e-9);
  EXPECT_NEAR(channel().samples[1].value, 5, 1e-9);
  EXPECT_EQ(channel().updates, 3);
}

TEST_F(SamplerTest, ACounterThatFallsMeasuredNothing) {
  value_ = 100;
  measure(Quantity::energy_j);
  after(0.1, 101);
  after(0.1, 3);
  after(0.1, 4);
  EXPECT_THAT(channel().failure, ::testing::HasSubstr("energy fell from 101 to 3 J"));
  EXPECT_DOUBLE_EQ(channel().joules, 1);
}

TEST_F(SamplerTest, ReadingsCloseTogetherMakeNoPeak) {
  measure(Quantity::energy_j);
  after(0.1, 1);
  after(0.1, 2);
  clock_.advance(0.001);
  value_ = 3;
  sampler_->end();
  EXPECT_NEAR(*channel().peak_w, 10, 1e-9) << "not 1 J in 1 ms";
  EXPECT_DOUBLE_EQ(channel().joules, 3) << "but it is counted";
}

TEST_F(SamplerTest, ACounterThatNeverMovedMeasuredNothing) {
  measure(Quantity::energy_j);
  after(0.01, 0);
  sampler_->end();
  EXPECT_THAT(channel().failure, ::testing::HasSubstr("did not move"));
}

TEST_F(SamplerTest, PowerThatNeverMovedIsAMeasurement) {
  value_ = 2;
  measure(Quantity::power_w);
  clock_.advance(3);
  sampler_->end();
  EXPECT_EQ(channel().failure, "");
  EXPECT_DOUBLE_EQ(channel().joules, 6);
  EXPECT_EQ(channel().updates, 0);
  EXPECT_DOUBLE_EQ(sampler_->seconds(), 3);
  EXPECT_EQ(sampler_->samples(), 2);
}

TEST_F(SamplerTest, FrequenciesAreReadOnceASecond) {
  measure(Quantity::frequency_hz);
  for (int i = 0; i < 40; ++i) after(0.125, i);
  sampler_->end();
  EXPECT_EQ(channel().readings, 1 + 5 + 1);
}

TEST_F(SamplerTest, BeginForgetsWhatWasBefore) {
  measure(Quantity::power_w);
  after(1, std::nan(""));
  EXPECT_EQ(channel().failure, "it went away");
  value_ = 4;
  sampler_->begin();
  after(2, 4);
  EXPECT_EQ(channel().failure, "");
  EXPECT_DOUBLE_EQ(channel().joules, 8);
}

TEST(SamplingThread, ReadsUntilItIsStoppedAndTellsItsTime) {
  std::atomic<int> reads{0};
  std::vector<std::unique_ptr<Meter>> meters;
  meters.push_back(std::make_unique<testing::FakeMeter>(
      MeterInfo{.name = "rail", .sensor = "fake", .within = ""}, [&] { return double(++reads); }));
  Sampler sampler(std::move(meters), steady_clock(), 0.001);
  sampler.begin();
  SamplingThread thread(sampler);
  while (reads < 10) steady_clock().sleep_until(steady_clock().now_s() + 0.001);
  EXPECT_GT(thread.stop(), 0);
  const int at_the_end = reads;
  steady_clock().sleep_until(steady_clock().now_s() + 0.01);
  EXPECT_EQ(reads, at_the_end);
}

TEST(SamplingThread, StopsAtOnceWhateverItsInterval) {
  Sampler sampler({}, steady_clock(), 3600);
  sampler.begin();
  const double begin_s = steady_clock().now_s();
  { const SamplingThread thread(sampler); }
  EXPECT_LT(steady_clock().now_s() - begin_s, 60);
}

}  // namespace
}  // namespace slambench
