// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "kernels/pixel.h"

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

void expect_near(Float3 found, Float3 expected, float tolerance = 1e-6f) {
  EXPECT_NEAR(found.x, expected.x, tolerance);
  EXPECT_NEAR(found.y, expected.y, tolerance);
  EXPECT_NEAR(found.z, expected.z, tolerance);
}

// --- Float3, Rigid3f -----------------------------------------------------------------------------

TEST(Float3Maths, FollowsTheDefinitions) {
  const Float3 a{1, 2, 3}, b{4, -5, 6};
  EXPECT_EQ(a + b, (Float3{5, -3, 9}));
  EXPECT_EQ(a - b, (Float3{-3, 7, -3}));
  EXPECT_EQ(a * 2.0f, (Float3{2, 4, 6}));
  EXPECT_EQ(dot(a, b), 12.0f);
  EXPECT_EQ(cross(a, b), (Float3{27, 6, -13}));
  EXPECT_EQ(length(Float3{2, 3, 6}), 7.0f);
  expect_near(normalized({2, 3, 6}), {2 / 7.0f, 3 / 7.0f, 6 / 7.0f});
}

TEST(Float3Maths, RotatesBeforeItTranslates) {
  const Rigid3f quarter_turn{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}, {10, 20, 30}};
  EXPECT_EQ(quarter_turn.rotate({1, 2, 3}), (Float3{-2, 1, 3}));
  EXPECT_EQ(quarter_turn.apply({1, 2, 3}), (Float3{8, 21, 33}));
}

TEST(ClampIndex, KeepsIndicesInRange) {
  EXPECT_EQ(clamp_index(-3, 5), 0);
  EXPECT_EQ(clamp_index(-1, 5), 0);
  EXPECT_EQ(clamp_index(0, 5), 0);
  EXPECT_EQ(clamp_index(4, 5), 4);
  EXPECT_EQ(clamp_index(5, 5), 4);
  EXPECT_EQ(clamp_index(9, 5), 4);
}

// --- mm2meters, generate_gaussian ----------------------------------------------------------------

TEST(MetersFromUnits, DividesByTheScale) {
  EXPECT_EQ(meters_from_units(0, 1000), 0.0f);
  EXPECT_EQ(meters_from_units(1500, 1000), 1.5f);
  EXPECT_EQ(meters_from_units(65535, 1000), 65.535f);
  EXPECT_EQ(meters_from_units(10000, 5000), 2.0f);
}

TEST(GaussianWeight, IsTheDensityRelativeToItsPeak) {
  EXPECT_EQ(gaussian_weight(0, 4), 1.0f);
  EXPECT_FLOAT_EQ(gaussian_weight(2, 4), 0.8824969f);  // exp(-1/8)
  EXPECT_FLOAT_EQ(gaussian_weight(-2, 4), 0.8824969f);
  EXPECT_FLOAT_EQ(gaussian_weight(1, 4), 0.9692332f);  // exp(-1/32)
  EXPECT_FLOAT_EQ(gaussian_weight(3, 1), 0.0111090f);  // exp(-9/2)
}

// --- bilateral_filter ----------------------------------------------------------------------------

std::vector<float> weights(int radius, float sigma_px) {
  std::vector<float> gaussian;
  for (int i = -radius; i <= radius; ++i) gaussian.push_back(gaussian_weight(i, sigma_px));
  return gaussian;
}

float filtered(const Image<float>& depth, int x, int y, int radius = 2,
               float range_sigma_m = 0.1f) {
  return bilateral(depth.data(), depth.size(), x, y, weights(radius, 4).data(), radius,
                   1 / (2 * range_sigma_m * range_sigma_m));
}

TEST(Bilateral, LeavesAConstantImage) {
  const Image<float> depth({7, 6}, 1.25f);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 7; ++x) EXPECT_FLOAT_EQ(filtered(depth, x, y), 1.25f);
  }
}

TEST(Bilateral, LeavesPixelsWithoutDepth) {
  Image<float> depth({5, 5}, 1.0f);
  depth(2, 2) = 0;
  EXPECT_EQ(filtered(depth, 2, 2), 0.0f);
  depth(2, 2) = -1;
  EXPECT_EQ(filtered(depth, 2, 2), 0.0f);
  depth(2, 2) = nan_f;
  EXPECT_EQ(filtered(depth, 2, 2), 0.0f);
}

/// Three columns at 1 m, two at 1.2 m: rows are alike, so their weights cancel, and the far side
/// counts exp(-0.2^2 / (2 0.1^2)) = exp(-2).
TEST(Bilateral, WeighsAStepEdgeByItsHeight) {
  Image<float> depth({5, 5}, 1.0f);
  for (int y = 0; y < 5; ++y) depth(3, y) = depth(4, y) = 1.2f;
  const double near = std::exp(-1 / 8.0) + std::exp(-1 / 32.0) + 1;
  const double far = (std::exp(-1 / 32.0) + std::exp(-1 / 8.0)) * std::exp(-2.0);
  EXPECT_NEAR(filtered(depth, 2, 2), (near + 1.2 * far) / (near + far), 1e-6);
  EXPECT_NEAR(filtered(depth, 2, 2), 1.0161559, 1e-6);
}

TEST(Bilateral, KeepsAStepThatIsHigherThanTheRange) {
  Image<float> depth({5, 5}, 1.0f);
  for (int y = 0; y < 5; ++y) depth(3, y) = depth(4, y) = 3.0f;
  EXPECT_FLOAT_EQ(filtered(depth, 2, 2), 1.0f);
  EXPECT_FLOAT_EQ(filtered(depth, 3, 2), 3.0f);
}

TEST(Bilateral, DoesNotCountHoles) {
  for (const float hole : {0.0f, -1.0f, nan_f}) {
    Image<float> depth({5, 5}, 1.0f);
    for (int y = 0; y < 5; ++y) {
      depth(3, y) = hole;
      depth(4, y) = 1.1f;
    }
    const double near = std::exp(-1 / 8.0) + std::exp(-1 / 32.0) + 1;
    const double far = std::exp(-1 / 8.0) * std::exp(-0.5);
    EXPECT_NEAR(filtered(depth, 2, 2), (near + 1.1 * far) / (near + far), 1e-6) << hole;
  }
}

/// The definition, in double precision and with every neighbour's coordinates clamped.
double bilateral_by_definition(const Image<float>& depth, int x, int y, int radius,
                               double range_sigma_m) {
  double sum = 0, total = 0;
  for (int j = y - radius; j <= y + radius; ++j) {
    for (int i = x - radius; i <= x + radius; ++i) {
      const double value =
          depth(std::clamp(i, 0, depth.width() - 1), std::clamp(j, 0, depth.height() - 1));
      if (value <= 0) continue;
      const double difference = value - depth(x, y);
      const double weight =
          std::exp(-((i - x) * (i - x) + (j - y) * (j - y)) / 32.0) *
          std::exp(-difference * difference / (2 * range_sigma_m * range_sigma_m));
      sum += weight * value;
      total += weight;
    }
  }
  return sum / total;
}

TEST(Bilateral, FollowsTheDefinitionOnEveryBorderAndForEveryRadius) {
  const Image<float> depth = testing::random_depth_m({7, 6}, 1, 0.2, 1.0, 1.5);
  for (const int radius : {0, 1, 2, 3, 8}) {
    for (int y = 0; y < 6; ++y) {
      for (int x = 0; x < 7; ++x) {
        const double expected =
            depth(x, y) > 0 ? bilateral_by_definition(depth, x, y, radius, 0.2) : 0;
        EXPECT_NEAR(filtered(depth, x, y, radius, 0.2f), expected, 1e-5)
            << x << "," << y << " radius " << radius;
      }
    }
  }
}

// --- half_sample ---------------------------------------------------------------------------------

float half_of(std::array<float, 4> block, float range_m) {
  return half_sampled(block.data(), {2, 2}, 0, 0, range_m);
}

TEST(HalfSampled, AveragesWhatIsNearTheFirst) {
  EXPECT_FLOAT_EQ(half_of({1.0f, 1.25f, 1.5f, 1.125f}, 0.75f), 1.21875f);
  EXPECT_FLOAT_EQ(half_of({1.0f, 1.2f, 1.4f, 0.8f}, 0.3f), 1.0f);
  EXPECT_FLOAT_EQ(half_of({2.0f, 1.0f, 3.0f, 5.0f}, 0.3f), 2.0f);
}

TEST(HalfSampled, IncludesTheRangeItself) {
  EXPECT_EQ(half_of({1.0f, 1.25f, 0.75f, 9.0f}, 0.25f), 1.0f);
  EXPECT_EQ(half_of({1.0f, 1.25f, 9.0f, 9.0f}, 0.25f), 1.125f);
  EXPECT_EQ(half_of({1.0f, 1.25f, 1.0f, 9.0f}, 0.0f), 1.0f);
}

TEST(HalfSampled, TakesHolesAsValues) {
  EXPECT_FLOAT_EQ(half_of({0, 0.2f, 0.2f, 0.2f}, 0.3f), 0.15f);
  EXPECT_EQ(half_of({0, 2, 2, 2}, 0.3f), 0.0f);
  EXPECT_EQ(half_of({2, 0, 0, 0}, 0.3f), 2.0f);
}

TEST(HalfSampled, SurvivesNotANumber) {
  EXPECT_EQ(half_of({nan_f, 1, 1, 1}, 0.3f), 0.0f);
  EXPECT_EQ(half_of({1, nan_f, 1, 1}, 0.3f), 1.0f);
}

TEST(HalfSampled, SkipsTheLastColumnOfAnOddWidth) {
  Image<float> depth({5, 4});
  for (int i = 0; i < 20; ++i) depth.data()[i] = static_cast<float>(i);
  EXPECT_EQ(half_sampled(depth.data(), depth.size(), 0, 0, 100), (0 + 1 + 5 + 6) / 4.0f);
  EXPECT_EQ(half_sampled(depth.data(), depth.size(), 1, 0, 100), (2 + 3 + 7 + 8) / 4.0f);
  EXPECT_EQ(half_sampled(depth.data(), depth.size(), 1, 1, 100), (12 + 13 + 17 + 18) / 4.0f);
}

// --- depth2vertex --------------------------------------------------------------------------------

constexpr Intrinsics camera{500, 400, 3, 2};

TEST(VertexFromDepth, ScalesTheRayThroughThePixel) {
  expect_near(pixel_ray(camera, 8, 10), {0.01f, 0.02f, 1});
  expect_near(vertex_from_depth(2, camera, 8, 10), {0.02f, 0.04f, 2});
  expect_near(vertex_from_depth(2, camera, 0, 0), {-0.012f, -0.01f, 2});
  EXPECT_EQ(vertex_from_depth(2, camera, 3, 2), (Float3{0, 0, 2}));
}

TEST(VertexFromDepth, IsZeroWithoutDepth) {
  EXPECT_EQ(vertex_from_depth(0, camera, 8, 10), Float3{});
  EXPECT_EQ(vertex_from_depth(-1, camera, 8, 10), Float3{});
  EXPECT_EQ(vertex_from_depth(nan_f, camera, 8, 10), Float3{});
}

// --- vertex2normal -------------------------------------------------------------------------------

Image<Float3> tilted_plane() {
  Image<Float3> vertices({3, 3});
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x) {
      const float u = static_cast<float>(x), v = static_cast<float>(y);
      vertices(x, y) = {u, v, 5 + 0.5f * u - 0.25f * v};
    }
  }
  return vertices;
}

Float3 normal_at(const Image<Float3>& vertices, int x, int y) {
  return normal_from_vertices(vertices.data(), vertices.size(), x, y);
}

/// z = 5 + x/2 - y/4 has the normal (1/2, -1/4, -1) toward the camera, on the borders too.
TEST(NormalFromVertices, IsThatOfThePlaneTowardTheCamera) {
  const Image<Float3> vertices = tilted_plane();
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x) {
      expect_near(normal_at(vertices, x, y), normalized({0.5f, -0.25f, -1.0f}));
    }
  }
}

TEST(NormalFromVertices, NeedsAllFourNeighbours) {
  const std::array<std::array<int, 2>, 4> neighbours = {{{0, 1}, {2, 1}, {1, 0}, {1, 2}}};
  for (const auto [x, y] : neighbours) {
    Image<Float3> vertices = tilted_plane();
    vertices(x, y) = {};
    EXPECT_EQ(normal_at(vertices, 1, 1), (Float3{invalid_normal, 0, 0})) << x << "," << y;
  }
}

TEST(NormalFromVertices, IgnoresDiagonalsAndThePixelItself) {
  const std::array<std::array<int, 2>, 5> others = {{{0, 0}, {2, 0}, {0, 2}, {2, 2}, {1, 1}}};
  for (const auto [x, y] : others) {
    Image<Float3> vertices = tilted_plane();
    vertices(x, y) = {};
    expect_near(normal_at(vertices, 1, 1), normalized({0.5f, -0.25f, -1.0f}));
  }
}

TEST(NormalFromVertices, IsInvalidWhereThereIsNoDirection) {
  const Image<Float3> point({3, 3}, Float3{1, 1, 1});
  EXPECT_EQ(normal_at(point, 1, 1), (Float3{invalid_normal, 0, 0}));
  const Image<Float3> unknown({3, 3}, Float3{nan_f, nan_f, nan_f});
  EXPECT_EQ(normal_at(unknown, 1, 1), (Float3{invalid_normal, 0, 0}));
  EXPECT_EQ(invalid_normal, -2.0f);
}

/// With the inner neighbours of a border taken twice, differences are one-sided: a kink shows it.
TEST(NormalFromVertices, UsesThePixelItselfBeyondTheBorder) {
  Image<Float3> vertices = tilted_plane();
  vertices(2, 1).z += 1;
  expect_near(normal_at(vertices, 2, 1), normalized({1.5f, -0.25f, -1.0f}));
  vertices = tilted_plane();
  vertices(0, 1).z -= 1;
  expect_near(normal_at(vertices, 0, 1), normalized({1.5f, -0.25f, -1.0f}));
  vertices = tilted_plane();
  vertices(1, 2).z += 1;
  expect_near(normal_at(vertices, 1, 2), normalized({0.5f, 0.75f, -1.0f}));
  vertices = tilted_plane();
  vertices(1, 0).z -= 1;
  expect_near(normal_at(vertices, 1, 0), normalized({0.5f, 0.75f, -1.0f}));
}

// --- projection ----------------------------------------------------------------------------------

struct Pixel {
  bool inside;
  int x, y;
  friend bool operator==(const Pixel&, const Pixel&) = default;
};

Pixel projected(Float3 point, Intrinsics k = {1, 1, 0, 0}, float min_depth = 0.5f) {
  Pixel pixel{false, -1, -1};
  pixel.inside = project(point, k, {4, 6}, min_depth, &pixel.x, &pixel.y);
  return pixel;
}
constexpr Pixel outside{false, -1, -1};

TEST(Project, FollowsThePinhole) {
  EXPECT_EQ(projected({0.5f, 0.8f, 2.0f}, {4, 6, 1, 2}), (Pixel{true, 2, 4}));
}

TEST(Project, RoundsToTheNearestPixel) {
  EXPECT_EQ(projected({0.49f, 0, 1}), (Pixel{true, 0, 0}));
  EXPECT_EQ(projected({0.5f, 0, 1}), (Pixel{true, 1, 0}));
  EXPECT_EQ(projected({0, 1.49f, 1}), (Pixel{true, 0, 1}));
  EXPECT_EQ(projected({0, 1.5f, 1}), (Pixel{true, 0, 2}));
}

/// Inside is what rounds up to 0 and at most to the last pixel's own centre plus a half.
TEST(Project, EndsAtTheBorders) {
  EXPECT_EQ(projected({-0.5f, 0, 1}), (Pixel{true, 0, 0}));
  EXPECT_EQ(projected({-0.51f, 0, 1}), outside);
  EXPECT_EQ(projected({2.5f, 0, 1}), (Pixel{true, 3, 0}));
  EXPECT_EQ(projected({2.51f, 0, 1}), outside);
  EXPECT_EQ(projected({0, -0.5f, 1}), (Pixel{true, 0, 0}));
  EXPECT_EQ(projected({0, -0.51f, 1}), outside);
  EXPECT_EQ(projected({0, 4.5f, 1}), (Pixel{true, 0, 5}));
  EXPECT_EQ(projected({0, 4.51f, 1}), outside);
}

TEST(Project, NeedsDepth) {
  EXPECT_EQ(projected({0, 0, 0.5f}), (Pixel{true, 0, 0}));
  EXPECT_EQ(projected({0, 0, 0.49f}), outside);
  EXPECT_EQ(projected({0, 0, -1}), outside);
  EXPECT_EQ(projected({0, 0, nan_f}), outside);
  EXPECT_EQ(projected({nan_f, 0, 1}), outside);
  EXPECT_EQ(projected({0, nan_f, 1}), outside);
}

// --- track ---------------------------------------------------------------------------------------

/// A model of 4x3 pixels whose points lie on the plane z = 2 of the model camera, which is a
/// quarter turn about z and a shift away from the volume's axes.
class TrackPoint : public ::testing::Test {
 protected:
  TrackPoint() {
    parameters_.T_volume_camera = {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}, {1, 2, 3}};
    parameters_.T_model_volume = {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, {-2, 1, -3}};
    parameters_.model_camera = {2, 2, 1, 1};
    parameters_.distance_threshold_m = 0.25f;
    parameters_.normal_threshold = 0.5f;
  }

  TrackData track(Float3 vertex, Float3 normal = {0, 0, -1}) const {
    return track_point(vertex, normal, vertices_.data(), normals_.data(), vertices_.size(),
                       parameters_);
  }

  // Camera point (0.5, 0.25, 2) is volume point (0.75, 2.5, 5), model point (0.5, 0.25, 2), and
  // projects to (1.5, 1.25): pixel (2, 1).
  const Float3 vertex_{0.5f, 0.25f, 2.0f};
  Image<Float3> vertices_ = Image<Float3>({4, 3}, Float3{0.75f, 2.5f, 5.0f});
  Image<Float3> normals_ = Image<Float3>({4, 3}, Float3{0, 0, -1});
  TrackParameters parameters_;
};

TEST_F(TrackPoint, WritesTheRowOfThePlane) {
  vertices_(2, 1) = {0.75f + 0.125f, 2.5f, 5.0f - 0.0625f};
  normals_(2, 1) = {0.6f, 0, -0.8f};
  const TrackData row = track(vertex_);
  EXPECT_EQ(row.outcome, TrackOutcome::ok);
  EXPECT_FLOAT_EQ(row.error, 0.6f * 0.125f + 0.8f * 0.0625f);
  // n, then p x n with p = (0.75, 2.5, 5): (2.5 (-0.8) - 0, 5 0.6 + 0.75 0.8, -2.5 0.6)
  const std::array<float, 6> expected = {0.6f, 0, -0.8f, -2.0f, 3.6f, -1.5f};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_FLOAT_EQ(row.jacobian[i], expected[i]) << i;
}

TEST_F(TrackPoint, RejectsWhatHasNoNormal) {
  EXPECT_EQ(track(vertex_, {invalid_normal, 0, 0}).outcome, TrackOutcome::invalid_input);
}

TEST_F(TrackPoint, RoundsToTheNearestModelPixel) {
  normals_(2, 1) = {invalid_normal, 0, 0};  // the only one without a model
  EXPECT_EQ(track({0.5f, 0.25f, 2}).outcome, TrackOutcome::invalid_model);  // u 1.5, v 1.25
  EXPECT_EQ(track({0.49f, 0.25f, 2}).outcome, TrackOutcome::ok);            // u 1.49
  EXPECT_EQ(track({0.5f, 0.49f, 2}).outcome, TrackOutcome::invalid_model);  // v 1.49
  EXPECT_NE(track({0.5f, 0.5f, 2}).outcome, TrackOutcome::invalid_model);   // v 1.5
}

TEST_F(TrackPoint, RejectsWhatTheModelCameraDoesNotSee) {
  EXPECT_EQ(track({5, 0, 2}).outcome, TrackOutcome::outside_model);
  EXPECT_EQ(track({0, -5, 2}).outcome, TrackOutcome::outside_model);
  EXPECT_EQ(track({-0.5f, -0.25f, -2}).outcome, TrackOutcome::outside_model);  // behind
  EXPECT_EQ(track({nan_f, 0, 2}).outcome, TrackOutcome::outside_model);
  EXPECT_EQ(track({0, 0, 0}).outcome, TrackOutcome::outside_model);
}

/// In the camera's plane nothing projects; a micrometre in front of it does.
TEST_F(TrackPoint, ProjectsFromAMicrometreOn) {
  parameters_.T_volume_camera = parameters_.T_model_volume = {};
  EXPECT_EQ(track({0, 0, 0.9e-6f}).outcome, TrackOutcome::outside_model);
  EXPECT_EQ(track({0, 0, 1.1e-6f}).outcome, TrackOutcome::too_far);
}

TEST_F(TrackPoint, RejectsPointsBeyondTheDistance) {
  vertices_(2, 1) = {0.75f, 2.5f, 5.25f};
  EXPECT_EQ(track(vertex_).outcome, TrackOutcome::ok);  // the threshold itself is a pair
  vertices_(2, 1) = {0.75f, 2.5f, 5.2501f};
  EXPECT_EQ(track(vertex_).outcome, TrackOutcome::too_far);
  vertices_(2, 1) = {0.75f - 0.2f, 2.5f + 0.2f, 5.0f};  // sideways counts as well
  EXPECT_EQ(track(vertex_).outcome, TrackOutcome::too_far);
  vertices_(2, 1) = {nan_f, 2.5f, 5};
  EXPECT_EQ(track(vertex_).outcome, TrackOutcome::too_far);
}

TEST_F(TrackPoint, RejectsNormalsBeyondTheAngle) {
  normals_(2, 1) = {1, 0, -0.5f};  // dot 0.5: the threshold itself is a pair
  EXPECT_EQ(track(vertex_).outcome, TrackOutcome::ok);
  normals_(2, 1) = {1, 0, -0.4999f};
  EXPECT_EQ(track(vertex_).outcome, TrackOutcome::wrong_normal);
  normals_(2, 1) = {0, 0, 1};
  EXPECT_EQ(track(vertex_).outcome, TrackOutcome::wrong_normal);
  normals_(2, 1) = {nan_f, 0, -1};
  EXPECT_EQ(track(vertex_).outcome, TrackOutcome::wrong_normal);
}

TEST_F(TrackPoint, TurnsTheLiveNormalIntoTheVolume) {
  normals_(2, 1) = {0, 1, 0};  // the camera's x axis in the volume
  EXPECT_EQ(track(vertex_, {1, 0, 0}).outcome, TrackOutcome::ok);
  EXPECT_EQ(track(vertex_, {0, 1, 0}).outcome, TrackOutcome::wrong_normal);
}

TEST_F(TrackPoint, KeepsThePublishedCodes) {
  EXPECT_EQ(static_cast<int>(TrackOutcome::ok), 1);
  EXPECT_EQ(static_cast<int>(TrackOutcome::invalid_input), -1);
  EXPECT_EQ(static_cast<int>(TrackOutcome::outside_model), -2);
  EXPECT_EQ(static_cast<int>(TrackOutcome::invalid_model), -3);
  EXPECT_EQ(static_cast<int>(TrackOutcome::too_far), -4);
  EXPECT_EQ(static_cast<int>(TrackOutcome::wrong_normal), -5);
}

// --- reduce --------------------------------------------------------------------------------------

TEST(Accumulate, SumsTheRowsThatAreOk) {
  Reduction sum;
  accumulate({TrackOutcome::ok, 2, {1, 2, 3, 4, 5, 6}}, &sum);
  accumulate({TrackOutcome::ok, -1, {0, 1, 0, 2, 0, 3}}, &sum);
  EXPECT_EQ(sum.inliers, 2);
  EXPECT_EQ(sum.squared_error, 5);
  const std::array<double, 6> jt_error = {2, 3, 6, 6, 10, 9};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(sum.jt_error[i], jt_error[i]) << i;
  const std::array<double, 21> jt_j = {1,  2,  3,  4,  5,  6,  // row 0
                                       5,  6,  10, 10, 15,     // row 1: 4+1, 6, 8+2, 10, 12+3
                                       9,  12, 15, 18,         // row 2
                                       20, 20, 30,             // row 3: 16+4, 20, 24+6
                                       25, 30, 45};            // rows 4, 5: 36+9
  for (std::size_t i = 0; i < 21; ++i) EXPECT_EQ(sum.jt_j[i], jt_j[i]) << i;
}

TEST(Accumulate, CountsTheOthersByOutcome) {
  Reduction sum;
  const auto add = [&](TrackOutcome outcome, int times) {
    for (int i = 0; i < times; ++i) accumulate({outcome, 7, {7, 7, 7, 7, 7, 7}}, &sum);
  };
  add(TrackOutcome::too_far, 2);
  add(TrackOutcome::wrong_normal, 3);
  add(TrackOutcome::invalid_input, 1);
  add(TrackOutcome::outside_model, 4);
  add(TrackOutcome::invalid_model, 8);
  EXPECT_EQ(sum.inliers, 0);
  EXPECT_EQ(sum.too_far, 2);
  EXPECT_EQ(sum.wrong_normal, 3);
  EXPECT_EQ(sum.others, 13);
  EXPECT_EQ(sum.squared_error, 0);
  for (const double value : sum.jt_error) EXPECT_EQ(value, 0);
  for (const double value : sum.jt_j) EXPECT_EQ(value, 0);
}

// --- render --------------------------------------------------------------------------------------

TEST(DepthColor, RunsThroughTheHues) {
  const auto at = [](float depth_m) { return depth_color(depth_m, 0.5f, 4.5f); };
  EXPECT_EQ(at(0.5f), (Rgba8{191, 64, 64, 255}));
  EXPECT_EQ(at(1.0f), (Rgba8{191, 128, 64, 255}));
  EXPECT_EQ(at(1.5f), (Rgba8{191, 191, 64, 255}));
  EXPECT_EQ(at(2.0f), (Rgba8{128, 191, 64, 255}));
  EXPECT_EQ(at(2.5f), (Rgba8{64, 191, 64, 255}));
  EXPECT_EQ(at(3.0f), (Rgba8{64, 191, 128, 255}));
  EXPECT_EQ(at(3.5f), (Rgba8{64, 191, 191, 255}));
  EXPECT_EQ(at(4.0f), (Rgba8{64, 128, 191, 255}));
  EXPECT_EQ(at(4.5f), (Rgba8{64, 64, 191, 255}));
}

TEST(DepthColor, IsWhiteBeforeAndBlackBehindTheRamp) {
  EXPECT_EQ(depth_color(0.499f, 0.5f, 4.5f), (Rgba8{255, 255, 255, 255}));
  EXPECT_EQ(depth_color(0, 0.5f, 4.5f), (Rgba8{255, 255, 255, 255}));
  EXPECT_EQ(depth_color(nan_f, 0.5f, 4.5f), (Rgba8{255, 255, 255, 255}));
  EXPECT_EQ(depth_color(4.501f, 0.5f, 4.5f), (Rgba8{0, 0, 0, 255}));
}

TEST(TrackColor, IsThePublishedOne) {
  EXPECT_EQ(track_color(TrackOutcome::ok), (Rgba8{128, 128, 128, 255}));
  EXPECT_EQ(track_color(TrackOutcome::invalid_input), (Rgba8{0, 0, 0, 255}));
  EXPECT_EQ(track_color(TrackOutcome::outside_model), (Rgba8{255, 0, 0, 255}));
  EXPECT_EQ(track_color(TrackOutcome::invalid_model), (Rgba8{0, 255, 0, 255}));
  EXPECT_EQ(track_color(TrackOutcome::too_far), (Rgba8{0, 0, 255, 255}));
  EXPECT_EQ(track_color(TrackOutcome::wrong_normal), (Rgba8{255, 255, 0, 255}));
  EXPECT_EQ(track_color(static_cast<TrackOutcome>(0)), (Rgba8{255, 128, 128, 255}));
}

}  // namespace
}  // namespace slambench
