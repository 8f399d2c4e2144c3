// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "core/error.h"
#include "slam/kinect_fusion.h"

namespace slambench {
namespace {

TEST(KinectFusionParameters, DefaultsAreThePublishedOnes) {
  KinectFusionParameters parameters;
  const std::map<std::string_view, std::string> published = {
      {"map", "grid"},
      {"compute-size-ratio", "1"},
      {"volume-resolution", "256,256,256"},
      {"volume-size", "2,2,2"},
      {"init-pose", "0.5,0.5,0"},
      {"mu", "0.1"},
      {"tracking-rate", "1"},
      {"integration-rate", "2"},
      {"rendering-rate", "4"},
      {"pyramid-levels", "10,5,4"},
      {"icp-threshold", "1e-05"},
      {"icp-distance-threshold", "0.1"},
      {"icp-normal-threshold", "0.8"},
      {"tracked-fraction", "0.15"},
      {"tracked-residual", "0.02"},
      {"solve-condition", "1000000"},
      {"bootstrap-frames", "4"},
      {"bilateral-radius", "2"},
      {"bilateral-sigma", "4"},
      {"bilateral-range-sigma", "0.1"},
      {"half-sample-range", "0.3"},
      {"near", "0.4"},
      {"far", "4"},
      {"max-weight", "100"},
      {"integrate-min-depth", "0.0001"},
      {"raycast-large-step", "0.75"},
      {"raycast-small-step", "1"},
      {"raycast-slow-below", "0.8"},
      {"render-far-factor", "2"},
      {"light", "-4,-7,-6"},  // this and the next are not the published ones
      {"light-frame", "camera"},
      {"ambient", "0.1"},
      {"fused", "false"},
  };
  std::map<std::string_view, std::string> described;
  for (const Parameter& parameter : parameters.describe().parameters) {
    EXPECT_TRUE(described.emplace(parameter.name, to_text(parameter)).second) << parameter.name;
    EXPECT_NO_THROW(check(parameter)) << parameter.name;
    EXPECT_FALSE(parameter.sentence.empty()) << parameter.name;
  }
  EXPECT_EQ(described, published);
}

TEST(KinectFusionParameters, KeepThePublishedLetters) {
  KinectFusionParameters parameters;
  std::string letters;
  for (const Parameter& parameter : parameters.describe().parameters) {
    if (parameter.flag != 0) letters += parameter.flag;
  }
  EXPECT_EQ(letters, "cvspmtrzyl");
}

TEST(KinectFusionParameters, DescriptionsAreLive) {
  KinectFusionParameters parameters;
  const auto lists = std::vector{parameters.describe()};
  set_from_text(*find(lists, "volume-size"), "4.8");
  set_from_text(*find(lists, "pyramid-levels"), "4,3");
  EXPECT_EQ(parameters.volume_size_m, (std::array<double, 3>{4.8, 4.8, 4.8}));
  EXPECT_EQ(parameters.pyramid_levels, (std::vector<int>{4, 3}));
  EXPECT_THROW(set_from_text(*find(lists, "max-weight"), "32768"), UsageError);
  EXPECT_THROW(set_from_text(*find(lists, "map"), "octree"), UsageError);
}

}  // namespace
}  // namespace slambench
