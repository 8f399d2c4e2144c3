// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "scene/noise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "core/statistics.h"

namespace slambench {
namespace {

constexpr Size size{640, 480};

Image<float> noisy(const Image<float>& depth_m, float incidence = 1, std::uint64_t seed = 0,
                   int frame = 0) {
  Image<float> out;
  add_kinect_noise(depth_m, Image<float>(depth_m.size(), incidence), seed, frame, out);
  return out;
}

/// The chance that round(35130 / cm + N(0, 1/6) + 0.5) is `disparity`.
double chance(double cm, int disparity) {
  const auto below = [&](double edge) {
    const double z = (edge - (35130 / cm + 0.5)) * 6;
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
  };
  return below(disparity + 0.5) - below(disparity - 0.5);
}

TEST(NoiseGenerator, MakesNormalNumbers) {
  NoiseGenerator generator(3);
  std::vector<double> values;
  double cubes = 0;
  for (int i = 0; i < 200000; ++i) {
    values.push_back(generator.normal());
    cubes += values.back() * values.back() * values.back();
  }
  const Statistics s = summarize(values);
  EXPECT_NEAR(s.mean, 0, 0.01);
  EXPECT_NEAR(s.std, 1, 0.01);
  EXPECT_NEAR(s.p95, 1.645, 0.02);
  EXPECT_NEAR(s.p99, 2.326, 0.04);
  EXPECT_NEAR(cubes / 200000, 0, 0.03);
}

TEST(NoiseGenerator, MakesTheSameNumbersOnEveryMachine) {
  // SplitMix64 seeded with 1234567: the published first outputs.
  NoiseGenerator generator(1234567);
  EXPECT_EQ(generator.bits(), 6457827717110365317ULL);
  EXPECT_EQ(generator.bits(), 3203168211198807973ULL);
  EXPECT_EQ(generator.bits(), 9817491932198370423ULL);
}

TEST(NoiseGenerator, MakesUniformNumbers) {
  NoiseGenerator generator(5);
  std::vector<double> values;
  for (int i = 0; i < 100000; ++i) values.push_back(generator.uniform());
  const Statistics s = summarize(values);
  EXPECT_NEAR(s.mean, 0.5, 0.005);
  EXPECT_NEAR(s.std, std::sqrt(1.0 / 12), 0.003);
  EXPECT_GE(s.min, 0);
  EXPECT_LT(s.max, 1);
}

TEST(KinectNoise, OfAFlatWallFollowsTheFormula) {
  for (const float depth_m : {0.8f, 1.53f, 2.0f, 3.7f}) {
    std::map<int, double> share;
    for (const float z : noisy(Image<float>(size, depth_m))) {
      const double disparity = 35130 / (100 * static_cast<double>(z));
      ASSERT_NEAR(disparity, std::round(disparity), 0.01) << "not a whole disparity";
      share[static_cast<int>(std::lround(disparity))] += 1.0 / static_cast<double>(size.count());
    }
    const double cm = std::round(100 * static_cast<double>(depth_m));
    const int middle = static_cast<int>(std::lround(35130 / cm + 0.5));
    for (int d = middle - 3; d <= middle + 3; ++d) {
      EXPECT_NEAR(share[d], chance(cm, d), 0.005) << depth_m << " m, disparity " << d;
    }
  }
}

TEST(KinectNoise, ShiftsPixelsByHalfAPixel) {
  // A step between columns 319 and 320: a pixel k columns from it shows the other side when its
  // shift, N(0, 1/2) rounded, reaches across.
  Image<float> step(size, 1.0f);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 320; x < size.width; ++x) step(x, y) = 3.0f;
  }
  constexpr int images = 20;
  std::array<double, 3> crossed = {};
  for (int i = 0; i < images; ++i) {
    const Image<float> out = noisy(step, 1, 0, i);
    for (int k = 0; k < 3; ++k) {
      for (int y = 0; y < size.height; ++y) {
        crossed[static_cast<std::size_t>(k)] += out(319 - k, y) > 2 ? 1 : 0;
      }
    }
  }
  for (int k = 0; k < 3; ++k) {
    const double expected = 0.5 * std::erfc((k + 0.5) / 0.5 / std::sqrt(2.0));
    EXPECT_NEAR(crossed[static_cast<std::size_t>(k)] / (images * size.height), expected, 0.012)
        << k;
  }
}

TEST(KinectNoise, DropsOutAtGrazingAnglesOnly) {
  const Image<float> wall(size, 2.0f);
  const auto lost = [&](float incidence) {
    const Image<float> out = noisy(wall, incidence);
    return static_cast<double>(std::count(out.begin(), out.end(), 0.0f)) /
           static_cast<double>(out.count());
  };
  EXPECT_EQ(lost(1.0f), 0);
  EXPECT_EQ(lost(0.21f), 0);
  EXPECT_NEAR(lost(0.15f), 0.5, 0.01);
  EXPECT_EQ(lost(0.09f), 1);
}

TEST(KinectNoise, LeavesNothingWhereNothingWas) {
  EXPECT_THAT(noisy(Image<float>(size, 0.0f)), ::testing::Each(0.0f));
}

TEST(KinectNoise, DependsOnSeedAndFrameAlone) {
  const Image<float> wall(size, 2.2f);
  const Image<float> first = noisy(wall, 1, 5, 7);
  EXPECT_EQ(first, noisy(wall, 1, 5, 7));
  EXPECT_NE(first, noisy(wall, 1, 5, 8));
  EXPECT_NE(first, noisy(wall, 1, 6, 7));
  EXPECT_NE(noisy(wall, 1, 5, 6), noisy(wall, 1, 6, 5)) << "streams overlap";
}

}  // namespace
}  // namespace slambench
