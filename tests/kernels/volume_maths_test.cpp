// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "kernels/volume_maths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "support/random_images.h"

namespace slambench {
namespace {

constexpr float nan_f = std::numeric_limits<float>::quiet_NaN();

void expect_near(Float3 found, Float3 expected, float tolerance) {
  EXPECT_NEAR(found.x, expected.x, tolerance);
  EXPECT_NEAR(found.y, expected.y, tolerance);
  EXPECT_NEAR(found.z, expected.z, tolerance);
}

TEST(VoxelGeometry, PutsCentresHalfAVoxelFromTheCorner) {
  const Float3 voxel_m = voxel_size({4, 8, 16}, {1, 4, 2});
  EXPECT_EQ(voxel_m, (Float3{0.25f, 0.5f, 0.125f}));
  EXPECT_EQ(voxel_center(0, 0, 0, voxel_m), (Float3{0.125f, 0.25f, 0.0625f}));
  EXPECT_EQ(voxel_center(1, 2, 3, voxel_m), (Float3{0.375f, 1.25f, 0.4375f}));
}

TEST(Voxel, StartsFarInFreeSpace) {
  EXPECT_EQ(Voxel{}.tsdf, 32766);
  EXPECT_EQ(Voxel{}.weight, 0);
  EXPECT_EQ(tsdf_scale, 32766.0f);
}

TEST(GridViewLayout, RunsThroughXFirstThenY) {
  std::vector<Voxel> voxels(2 * 3 * 4);
  for (std::size_t i = 0; i < voxels.size(); ++i) voxels[i].tsdf = static_cast<std::int16_t>(i);
  const GridView map{voxels.data(), {2, 3, 4}, {1, 1, 1}};
  EXPECT_EQ(map.tsdf(1, 0, 0), 1.0f);
  EXPECT_EQ(map.tsdf(0, 1, 0), 2.0f);
  EXPECT_EQ(map.tsdf(0, 0, 1), 6.0f);
  EXPECT_EQ(map.tsdf(1, 2, 3), 23.0f);
}

// --- integrate -----------------------------------------------------------------------------------

/// A camera of focal length 1 over 4x6 pixels; mu is half a metre.
class IntegrateVoxel : public ::testing::Test {
 protected:
  IntegrateVoxel() {
    parameters_.camera = {1, 1, 0, 0};
    parameters_.mu_m = 0.5f;
    parameters_.max_weight = 100;
    parameters_.min_depth_m = 0.25f;
  }
  bool integrate(Float3 center = {0, 0, 2}) {
    return integrate_voxel(&voxel_, center, depth_.data(), depth_.size(), parameters_);
  }
  bool measure(float depth_m) {
    depth_ = Image<float>({4, 6}, depth_m);
    return integrate();
  }

  Image<float> depth_;
  IntegrateParameters parameters_;
  Voxel voxel_;
};

TEST_F(IntegrateVoxel, AveragesTheMeasurements) {
  EXPECT_TRUE(measure(2.25f));  // +0.25 m: 0.5
  EXPECT_EQ(voxel_, (Voxel{16383, 1}));
  EXPECT_TRUE(measure(2.125f));  // 0.25; (0.5 + 0.25) / 2 = 0.375: 12287.25
  EXPECT_EQ(voxel_, (Voxel{12287, 2}));
  EXPECT_TRUE(measure(1.75f));  // -0.5; (2 x 12287 - 16383) / 3 = 2730.3
  EXPECT_EQ(voxel_, (Voxel{2730, 3}));
  EXPECT_TRUE(measure(1.75f));  // (3 x 2730 - 16383) / 4 = -2048.25: toward zero
  EXPECT_EQ(voxel_, (Voxel{-2048, 4}));
}

TEST_F(IntegrateVoxel, TruncatesTowardZero) {
  EXPECT_TRUE(measure(1.9f));  // -0.2: -6553.2
  EXPECT_EQ(voxel_, (Voxel{-6553, 1}));
  voxel_ = {};
  EXPECT_TRUE(measure(2.1f));
  EXPECT_EQ(voxel_, (Voxel{6553, 1}));
}

TEST_F(IntegrateVoxel, MeasuresAlongTheRay) {
  depth_ = Image<float>({4, 6}, 0.0f);
  depth_(2, 1) = 1.0625f;
  EXPECT_TRUE(integrate({2, 1, 1}));  // 0.0625 sqrt(1 + 4 + 1) / 0.5 = 0.3061862: 10032.5
  EXPECT_EQ(voxel_, (Voxel{10032, 1}));
  voxel_ = {};
  depth_(1, 1) = 2.0625f;
  EXPECT_TRUE(integrate({2, 1, 2}));  // 0.0625 sqrt(1 + 1 + 0.25) / 0.5 = 0.1875: 6143.6
  EXPECT_EQ(voxel_, (Voxel{6143, 1}));
}

TEST_F(IntegrateVoxel, TruncatesInFreeSpaceAndStopsBehindTheBand) {
  EXPECT_TRUE(measure(2.5f));
  EXPECT_EQ(voxel_, (Voxel{32766, 1}));
  voxel_ = {};
  EXPECT_TRUE(measure(60.0f));
  EXPECT_EQ(voxel_, (Voxel{32766, 1}));
  voxel_ = {};
  EXPECT_FALSE(measure(1.5f));  // exactly mu behind
  EXPECT_EQ(voxel_, Voxel{});
  EXPECT_FALSE(measure(1.0f));
  EXPECT_EQ(voxel_, Voxel{});
  EXPECT_TRUE(measure(1.501f));  // -0.998
  EXPECT_EQ(voxel_, (Voxel{-32700, 1}));
}

TEST_F(IntegrateVoxel, CountsFreeSpaceAsOneBandHoweverFar) {
  voxel_ = {-16383, 1};
  EXPECT_TRUE(measure(60.0f));  // (-0.5 + 1) / 2: 8191.5
  EXPECT_EQ(voxel_, (Voxel{8191, 2}));
}

TEST_F(IntegrateVoxel, CapsTheWeight) {
  voxel_ = {32766, 99};
  EXPECT_TRUE(measure(2.5f));
  EXPECT_EQ(voxel_, (Voxel{32766, 100}));
  EXPECT_TRUE(measure(1.75f));  // (100 - 0.5) / 101 = 0.98515: 32279.4
  EXPECT_EQ(voxel_, (Voxel{32279, 100}));
}

TEST_F(IntegrateVoxel, TakesTheNearestPixel) {
  depth_ = Image<float>({4, 6}, 0.0f);
  depth_(1, 2) = 2.25f;
  EXPECT_FALSE(integrate({0.98f, 4, 2}));  // 0.49
  EXPECT_TRUE(integrate({1, 4, 2}));       // 0.5
  EXPECT_TRUE(integrate({2.98f, 4, 2}));   // 1.49
  EXPECT_FALSE(integrate({3, 4, 2}));      // 1.5
}

TEST_F(IntegrateVoxel, LeavesWhatIsNotSeen) {
  for (const float depth_m : {0.0f, -1.0f, nan_f}) EXPECT_FALSE(measure(depth_m)) << depth_m;
  depth_ = Image<float>({4, 6}, 0.0f);
  EXPECT_FALSE(integrate({0, 0, 0.3f}));  // nearer than mu: no depth is not a surface at 0
  depth_ = Image<float>({4, 6}, 9.0f);
  EXPECT_FALSE(integrate({0, 0, 0.24f}));
  EXPECT_FALSE(integrate({0, 0, -2}));
  EXPECT_FALSE(integrate({-2, 0, 2}));
  EXPECT_FALSE(integrate({0, -2, 2}));
  EXPECT_FALSE(integrate({7, 0, 2}));
  EXPECT_FALSE(integrate({0, 11, 2}));
  EXPECT_EQ(voxel_, Voxel{});
  EXPECT_TRUE(integrate({0, 0, 0.25f}));
}

// --- trilinear interpolation and gradient --------------------------------------------------------

struct FloatMap {
  Int3 resolution;
  Float3 size_m;
  std::vector<float> values;
  float tsdf(int x, int y, int z) const {
    return values[static_cast<std::size_t>((z * resolution.y + y) * resolution.x + x)];
  }
};

FloatMap random_map() {
  FloatMap map{{4, 5, 6}, {2, 1, 3}, {}};
  testing::Random random(7);
  for (int i = 0; i < 4 * 5 * 6; ++i) {
    map.values.push_back(static_cast<float>(random.uniform(-32766, 32766)));
  }
  return map;
}

double clamped(const FloatMap& map, int x, int y, int z) {
  return static_cast<double>(map.tsdf(std::clamp(x, 0, map.resolution.x - 1),
                                      std::clamp(y, 0, map.resolution.y - 1),
                                      std::clamp(z, 0, map.resolution.z - 1)));
}

/// sum over the eight voxels around p of their trilinear weight times f(x, y, z).
template <class F>
double trilinear_by_definition(const FloatMap& map, Float3 p, F f) {
  const std::array<double, 3> u = {
      static_cast<double>(p.x) / map.size_m.x * map.resolution.x - 0.5,
      static_cast<double>(p.y) / map.size_m.y * map.resolution.y - 0.5,
      static_cast<double>(p.z) / map.size_m.z * map.resolution.z - 0.5};
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    std::array<int, 3> voxel{};
    double weight = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      voxel[axis] = static_cast<int>(std::floor(u[axis])) + ((corner >> axis) & 1);
      weight *= 1 - std::abs(u[axis] - voxel[axis]);
    }
    sum += weight * f(voxel[0], voxel[1], voxel[2]);
  }
  return sum;
}

/// Points inside, on and outside the borders, off the lattice.
std::vector<Float3> sample_points() {
  testing::Random random(11);
  std::vector<Float3> points = {{0, 0, 0}, {2, 1, 3}, {0, 0.5f, 3}, {2, 0, 1}};
  for (int i = 0; i < 300; ++i) {
    points.push_back({static_cast<float>(random.uniform(-0.2, 2.2)),
                      static_cast<float>(random.uniform(-0.1, 1.1)),
                      static_cast<float>(random.uniform(-0.3, 3.3))});
  }
  return points;
}

TEST(CellOf, IsTheVoxelBelowAndTheWayToTheNext) {
  const FloatMap map{{4, 8, 2}, {2, 2, 2}, {}};
  const Cell cell = cell_of(map, {0.875f, 0.75f, 0.75f});
  EXPECT_EQ(cell.base, (Int3{1, 2, 0}));
  EXPECT_EQ(cell.fraction, (Float3{0.25f, 0.5f, 0.25f}));
  EXPECT_EQ(cell_of(map, {0, 0, 0}).base, (Int3{-1, -1, -1}));
  EXPECT_EQ(cell_of(map, {2, 2, 2}).base, (Int3{3, 7, 1}));
}

TEST(Interpolate, IsExactAtVoxelCentres) {
  FloatMap map{{4, 2, 8}, {2, 1, 4}, {}};
  for (int i = 0; i < 4 * 2 * 8; ++i) map.values.push_back(static_cast<float>(i * 512));
  const Float3 voxel_m = voxel_size(map.resolution, map.size_m);
  for (int z = 0; z < 8; ++z) {
    for (int y = 0; y < 2; ++y) {
      for (int x = 0; x < 4; ++x) {
        EXPECT_FLOAT_EQ(interpolate(map, voxel_center(x, y, z, voxel_m)),
                        map.tsdf(x, y, z) / 32766.0f);
      }
    }
  }
}

TEST(Interpolate, IsTrilinearAndContinuesBeyondTheBorders) {
  const FloatMap map = random_map();
  for (const Float3 p : sample_points()) {
    const double expected = trilinear_by_definition(
        map, p, [&](int x, int y, int z) { return clamped(map, x, y, z) / 32766; });
    EXPECT_NEAR(interpolate(map, p), expected, 1e-5) << p.x << " " << p.y << " " << p.z;
  }
}

TEST(Gradient, IsThatOfALinearFieldPerMetre) {
  FloatMap map{{8, 16, 4}, {2, 1, 4}, {}};
  const Float3 voxel_m = voxel_size(map.resolution, map.size_m);
  for (int z = 0; z < 4; ++z) {
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 8; ++x) {
        const Float3 p = voxel_center(x, y, z, voxel_m);
        map.values.push_back(32766.0f * (0.25f * p.x - 0.5f * p.y + 0.125f * p.z));
      }
    }
  }
  expect_near(gradient(map, {1.1f, 0.47f, 2.1f}), {0.25f, -0.5f, 0.125f}, 1e-5f);
}

TEST(Gradient, AveragesCentralDifferencesWithClampedIndices) {
  const FloatMap map = random_map();
  const Float3 voxel_m = voxel_size(map.resolution, map.size_m);
  for (const Float3 p : sample_points()) {
    // A voxel beyond the border is the border's, and so are its own neighbours along the others.
    const auto difference = [&](int dx, int dy, int dz, float edge_m) {
      return trilinear_by_definition(map, p, [&](int x, int y, int z) {
        return (clamped(map, x + dx, y + dy, z + dz) - clamped(map, x - dx, y - dy, z - dz)) /
               (2 * 32766 * static_cast<double>(edge_m));
      });
    };
    const Float3 found = gradient(map, p);
    EXPECT_NEAR(found.x, difference(1, 0, 0, voxel_m.x), 1e-4);
    EXPECT_NEAR(found.y, difference(0, 1, 0, voxel_m.y), 1e-4);
    EXPECT_NEAR(found.z, difference(0, 0, 1, voxel_m.z), 1e-4);
  }
}

// --- clip_ray ------------------------------------------------------------------------------------

void expect_segment(Float3 origin, Float3 direction, float near_t, float far_t) {
  const RaySegment segment = clip_ray(origin, direction, {2, 4, 8}, 0.5f, 6);
  EXPECT_FLOAT_EQ(segment.near_t, near_t);
  EXPECT_FLOAT_EQ(segment.far_t, far_t);
}
bool misses(Float3 origin, Float3 direction) {
  const RaySegment segment = clip_ray(origin, direction, {2, 4, 8}, 0.5f, 6);
  return !(segment.near_t < segment.far_t);
}

TEST(ClipRay, EndsAtThePlanesAndAtTheBox) {
  expect_segment({1, 1, 0}, {0, 0, 1}, 0.5f, 6);
  expect_segment({1, 1, 3}, {0, 0, 1}, 0.5f, 5);
  expect_segment({1, 1, 3}, {0, 0, -1}, 0.5f, 3);
  expect_segment({1, 1, -2}, {0, 0, 1}, 2, 6);
  expect_segment({1, 1, 1}, {0.5f, 0, 1}, 0.5f, 2);
  expect_segment({1, 1, 1}, {-0.25f, 0, 1}, 0.5f, 4);
  expect_segment({1, 1, 1}, {0, 1, 1}, 0.5f, 3);
  expect_segment({1, 1, 1}, {0, -0.5f, 1}, 0.5f, 2);
  expect_segment({-1, 1, 1}, {1, 0, 1}, 1, 3);
  expect_segment({1, 5, 1}, {0, -1, 1}, 1, 5);
}

TEST(ClipRay, IsEmptyForRaysThatMissTheBox) {
  EXPECT_TRUE(misses({-1, 1, 0}, {0, 0, 1}));
  EXPECT_TRUE(misses({2.1f, 1, 0}, {0, 0, 1}));
  EXPECT_TRUE(misses({1, -0.1f, 0}, {0, 0, 1}));
  EXPECT_TRUE(misses({1, 4.1f, 0}, {0, 0, 1}));
  EXPECT_TRUE(misses({1, 1, 9}, {0, 0, 1}));
  EXPECT_TRUE(misses({1, 1, -7}, {0, 0, 1}));  // enters beyond the far plane
  EXPECT_TRUE(misses({1, 1, 1}, {4, 0, 1}));   // leaves before the near plane
  EXPECT_TRUE(misses({3, 1, 1}, {1, 0, 1}));
}

TEST(ClipRay, KeepsRaysAlongAFace) {
  expect_segment({0, 1, 0}, {0, 0, 1}, 0.5f, 6);
  expect_segment({2, 1, 0}, {0, 0, 1}, 0.5f, 6);
  expect_segment({1, 0, 0}, {0, 0, 1}, 0.5f, 6);
  expect_segment({1, 4, 0}, {0, 0, 1}, 0.5f, 6);
}

// --- find_surface --------------------------------------------------------------------------------

/// A field that changes along z alone: a voxel is 1/8 m deep, its value held at its centre.
struct ProfileMap {
  Int3 resolution{1, 1, 64};
  Float3 size_m{4, 4, 8};
  std::vector<float> values = std::vector<float>(64, 32766.0f);

  float tsdf(int, int, int z) const { return values[static_cast<std::size_t>(z)]; }
  /// All voxels with centres in [from, to).
  ProfileMap& set(double from, double to, double value) {
    for (std::size_t i = 0; i < 64; ++i) {
      const double center = (static_cast<double>(i) + 0.5) / 8;
      if (center >= from && center < to) values[i] = static_cast<float>(value * 32766);
    }
    return *this;
  }
};

/// A wall at z with a band of half a metre.
ProfileMap wall_at(double z) {
  ProfileMap map;
  for (std::size_t i = 0; i < 64; ++i) {
    const double distance = (z - (static_cast<double>(i) + 0.5) / 8) / 0.5;
    map.values[i] = static_cast<float>(std::clamp(distance, -1.0, 1.0) * 32766);
  }
  return map;
}

class FindSurface : public ::testing::Test {
 protected:
  FindSurface() {
    parameters_.near_m = 0.5f;
    parameters_.far_m = 6;
    parameters_.large_step_m = 0.5f;
    parameters_.small_step_m = 0.125f;
    parameters_.slow_below = 0.75f;
  }
  bool find(const ProfileMap& map, Float3 origin = {1, 1, 0}, Float3 direction = {0, 0, 1}) {
    return find_surface(map, origin, direction, parameters_, &hit_);
  }

  RaycastParameters parameters_;
  Float3 hit_;
};

TEST_F(FindSurface, StopsAtTheCrossing) {
  for (const double z : {1.1, 2.3, 3.0, 4.56, 5.7}) {
    ASSERT_TRUE(find(wall_at(z))) << z;
    expect_near(hit_, {1, 1, static_cast<float>(z)}, 1e-4f);
  }
}

TEST_F(FindSurface, MeasuresInDepthAlongSlantedRays) {
  ASSERT_TRUE(find(wall_at(3), {1, 1, 0}, {0.25f, -0.125f, 1}));
  expect_near(hit_, {1.75f, 0.625f, 3}, 1e-4f);
}

TEST_F(FindSurface, NeedsToStartInFreeSpace) {
  EXPECT_FALSE(find(wall_at(0.4)));
  EXPECT_FALSE(find(ProfileMap().set(0, 1, 0).set(2, 8, -1)));
  EXPECT_FALSE(find(ProfileMap().set(0, 1, -0.5).set(3, 8, -1)));
  EXPECT_TRUE(find(ProfileMap().set(0, 1, 0.01).set(3, 8, -1)));
}

/// Samples stand at 0.5, 1, 1.5, ...; 2.5 is the first behind the surface.
TEST_F(FindSurface, SeesUpToTheFarPlane) {
  parameters_.slow_below = -1;
  const ProfileMap map = ProfileMap().set(2.2, 8, -1);
  parameters_.far_m = 2.5f;
  EXPECT_FALSE(find(map));
  parameters_.far_m = 2.51f;
  EXPECT_TRUE(find(map));
}

TEST_F(FindSurface, StartsAtTheNearPlane) {
  const ProfileMap map = ProfileMap().set(0, 1, -1).set(3, 8, -1);
  parameters_.near_m = 0.75f;
  EXPECT_FALSE(find(map));
  parameters_.near_m = 1.25f;
  EXPECT_TRUE(find(map));
  parameters_.near_m = 6;
  EXPECT_FALSE(find(ProfileMap()));
}

/// 1 at 2 m and -0.5 at 2.5 m: a third of the last step back.
TEST_F(FindSurface, InterpolatesBetweenTheLastTwoSamples) {
  parameters_.slow_below = -1;
  ASSERT_TRUE(find(ProfileMap().set(2.2, 8, -0.5)));
  EXPECT_NEAR(hit_.z, 2.5 - 0.5 / 3, 1e-5);
  ASSERT_TRUE(find(ProfileMap().set(1.7, 2.2, 0.25).set(2.2, 8, -0.75)));
  EXPECT_NEAR(hit_.z, 2.5 - 0.5 * 0.75, 1e-5);
}

/// Negative around 2.8125 alone: neither steps of half a metre from 0.5 m nor from 1.125 m see it.
ProfileMap thin_slab() { return ProfileMap().set(2.8, 2.9, -1); }

TEST_F(FindSurface, TakesLargeStepsFarFromSurfaces) {
  parameters_.small_step_m = 0.0625f;
  EXPECT_FALSE(find(thin_slab()));
  parameters_.large_step_m = 0.0625f;
  EXPECT_TRUE(find(thin_slab()));
}

/// A dip at 1 m, then free space again.
TEST_F(FindSurface, TakesSmallStepsForGoodOnceNearASurface) {
  parameters_.small_step_m = 0.0625f;
  ASSERT_TRUE(find(thin_slab().set(0.9, 1.1, 0.7)));
  EXPECT_NEAR(hit_.z, 2.75, 1e-4);
  parameters_.small_step_m = 0.5f;
  EXPECT_FALSE(find(thin_slab().set(0.9, 1.1, 0.7)));
}

TEST_F(FindSurface, GoesOnInLargeStepsAtTheLimitItself) {
  parameters_.small_step_m = 0.0625f;
  const ProfileMap map = thin_slab().set(0.9, 1.1, 0.7);
  const float dip = interpolate(map, {1, 1, 1});
  parameters_.slow_below = dip;
  EXPECT_FALSE(find(map));
  parameters_.slow_below = std::nextafter(dip, 1.0f);
  EXPECT_TRUE(find(map));
}

TEST_F(FindSurface, PassesWhatOnlyTouchesZero) {
  EXPECT_FALSE(find(ProfileMap().set(2.4, 2.6, 0)));
  EXPECT_TRUE(find(ProfileMap().set(2.4, 2.6, -0.01)));
}

TEST_F(FindSurface, MissesOutsideTheVolume) {
  EXPECT_FALSE(find(wall_at(3), {5, 1, 0}));
  EXPECT_FALSE(find(wall_at(3), {1, 1, 9}));
  EXPECT_FALSE(find(ProfileMap()));
}

// --- raycast_pixel, shade ------------------------------------------------------------------------

class RaycastPixel : public FindSurface {
 protected:
  RaycastPixel() { parameters_.camera = {2, 4, 1, 1}; }
  void cast(const ProfileMap& map, int x, int y) {
    raycast_pixel(map, x, y, parameters_, &vertex_, &normal_);
  }
  Float3 vertex_{9, 9, 9}, normal_{9, 9, 9};
};

TEST_F(RaycastPixel, GivesPointAndNormalInTheVolume) {
  // Looks along z, turned a quarter about it: camera x is the volume's y, camera y its -x.
  parameters_.T_volume_camera = {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}, {2, 1, 0.5f}};
  cast(wall_at(2.5), 2, 3);  // ray (0.5, 0.5, 1) of the camera, (-0.5, 0.5, 1) of the volume
  expect_near(vertex_, {1, 2, 2.5f}, 1e-4f);
  expect_near(normal_, {0, 0, -1}, 1e-6f);
}

TEST_F(RaycastPixel, HasNeitherOnAMiss) {
  parameters_.T_volume_camera.translation = {2, 2, 0};
  cast(ProfileMap(), 1, 1);
  EXPECT_EQ(vertex_, Float3{});
  EXPECT_EQ(normal_, (Float3{invalid_normal, 0, 0}));
}

/// Alternating signs cross zero everywhere, and their central differences vanish.
TEST_F(RaycastPixel, HasAPointButNoNormalWhereTheGradientVanishes) {
  ProfileMap map;
  for (std::size_t i = 0; i < 64; ++i) map.values[i] = i % 2 == 0 ? 32766.0f : -32766.0f;
  parameters_.near_m = 0.5625f;  // the centre of voxel 4
  parameters_.T_volume_camera.translation = {2, 2, 0};
  parameters_.large_step_m = 0.125f;
  cast(map, 1, 1);
  expect_near(vertex_, {2, 2, 0.625f}, 1e-5f);
  EXPECT_EQ(normal_, (Float3{invalid_normal, 0, 0}));
}

TEST(Shade, IsLambertianPlusAmbient) {
  const ShadeParameters shading{{1, 2, 1}, 0.25f};
  const auto grey = [&](Float3 normal) { return shade({1, 2, 3}, normal, shading); };
  EXPECT_EQ(grey({0, 0.8f, -0.6f}), (Rgba8{216, 216, 216, 255}));  // 0.85 x 255 = 216.75
  EXPECT_EQ(grey({0, 0, 1}), (Rgba8{63, 63, 63, 255}));            // turned away: 63.75
  EXPECT_EQ(grey({0, 0, -1}), (Rgba8{255, 255, 255, 255}));
  EXPECT_EQ(grey({invalid_normal, 0, 0}), (Rgba8{0, 0, 0, 255}));
}

/// The light has a place, not only a direction.
TEST(Shade, DependsOnWhereThePointIs) {
  const ShadeParameters shading{{0, 0, 0}, 0};
  EXPECT_EQ(shade({0, 0, 5}, {0, 0, -1}, shading).r, 255);
  EXPECT_EQ(shade({3, 0, 4}, {0, 0, -1}, shading).r, 204);  // 4/5
  EXPECT_EQ(shade({0, 0, -5}, {0, 0, -1}, shading).r, 0);
}

}  // namespace
}  // namespace slambench
