// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "scene/renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "scene/camera_path.h"
#include "scene/frame_codec.h"
#include "scene/living_room.h"
#include "scene/rendered_sequence.h"
#include "scene/shapes.h"

namespace slambench {
namespace {

#define REQUIRE_RENDERER() \
  if (!can_render()) GTEST_SKIP() << "built without Embree"

constexpr Size size{160, 120};
constexpr Intrinsics camera{120.3f, 120.0f, 79.5f, 59.5f};

Eigen::Vector3d ray(int x, int y) {
  return {(x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1};
}

Rendering rendered(const Mesh& mesh, const Pose& pose, Shading shading = Shading::none) {
  Rendering out;
  Renderer(mesh, size, camera, shading, 1).render(pose, out);
  return out;
}

TEST(Renderer, OfAPlaneIsExact) {
  REQUIRE_RENDERER();
  // The plane n . p = d, seen by a turned and moved camera.
  const Eigen::Vector3d n = Eigen::Vector3d(0.2, -0.3, -1).normalized();
  const double d = -2;
  const Eigen::Vector3d u = n.cross(Eigen::Vector3d::UnitX()).normalized(), v = n.cross(u);
  const Mesh plane = sheet(1, 1, {}, [&](float a, float b) {
    return Eigen::Vector3f((d * n + 40 * (a - 0.5) * u + 40 * (b - 0.5) * v).cast<float>());
  });
  Pose pose = Pose::Identity();
  pose.translation() << 0.1, -0.2, 0.3;
  pose.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()));
  const Rendering out = rendered(plane, pose);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Eigen::Vector3d direction = pose.linear() * ray(x, y);
      const double depth = (d - n.dot(pose.translation())) / n.dot(direction);
      ASSERT_NEAR(out.depth_m(x, y), depth, 2e-6 * depth) << x << ' ' << y;
      ASSERT_NEAR(out.incidence(x, y), std::abs(n.dot(direction.normalized())), 1e-5);
    }
  }
}

TEST(Renderer, OfASphereIsItsClosedFormWithinTheFacets) {
  REQUIRE_RENDERER();
  Mesh sphere = superellipsoid({0.5f, 0.5f, 0.5f}, 1, 1, {}, 400);
  sphere.transform(placed(0.1f, -0.05f, 2));
  const Eigen::Vector3d center(0.1, -0.05, 2);
  const Rendering out = rendered(sphere, Pose::Identity());
  int hits = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Eigen::Vector3d r = ray(x, y);
      const double a = r.squaredNorm(), b = r.dot(center), c = center.squaredNorm() - 0.25;
      const double discriminant = b * b - a * c;
      if (std::abs(discriminant) < 0.02) continue;  // the rim
      if (discriminant < 0) {
        ASSERT_EQ(out.depth_m(x, y), 0);
        continue;
      }
      ++hits;
      // Facets of 1/200 of a half turn lie at most r (1 - cos(pi/400)) = 16 um inside.
      ASSERT_NEAR(out.depth_m(x, y), (b - std::sqrt(discriminant)) / a, 2e-4);
    }
  }
  EXPECT_GT(hits, 2000);
}

TEST(Renderer, SeesTheNearerSurfaceWithItsColour) {
  REQUIRE_RENDERER();
  const auto square = [](float z, Rgb8 color) {
    return sheet(1, 1, color, [z](float u, float v) {
      return Eigen::Vector3f(4 * u - 2, 2 - 4 * v, z);  // faces the camera
    });
  };
  Mesh mesh = square(2, {200, 0, 0});
  mesh.append(square(1.5f, {0, 200, 0}));
  const Rendering out = rendered(mesh, Pose::Identity(), Shading::diffuse);
  EXPECT_FLOAT_EQ(out.depth_m(80, 60), 1.5f);
  EXPECT_GT(out.color(80, 60).g, 80);
  EXPECT_EQ(out.color(80, 60).r, 0);
}

TEST(Renderer, LeavesNothingWhereNothingIs) {
  REQUIRE_RENDERER();
  Mesh mesh = box({0.2f, 0.2f, 0.2f}, {9, 9, 9});
  mesh.transform(placed(0, 0, -3));
  const Rendering out = rendered(mesh, Pose::Identity(), Shading::diffuse);
  EXPECT_THAT(out.depth_m, ::testing::Each(0.0f));
  EXPECT_THAT(out.color, ::testing::Each(Rgb8{}));
}

TEST(Renderer, WorksAtSizesThatTilesDoNotDivide) {
  REQUIRE_RENDERER();
  const Mesh wall =
      sheet(1, 1, {}, [](float u, float v) { return Eigen::Vector3f(9 * u - 4, 9 * v - 4, 1); });
  Rendering out;
  Renderer(wall, {7, 5}, {10, 10, 3, 2}, Shading::none, 1).render(Pose::Identity(), out);
  ASSERT_EQ(out.depth_m.size(), (Size{7, 5}));
  EXPECT_THAT(out.depth_m, ::testing::Each(::testing::FloatEq(1.0f)));
}

TEST(QuantizeDepth, RoundsAndDropsWhatDoesNotFit) {
  Image<float> depth_m(Size{5, 1});
  depth_m(0, 0) = 0;
  depth_m(1, 0) = 1.00009f;
  depth_m(2, 0) = 1.00011f;
  depth_m(3, 0) = 13.1f;
  depth_m(4, 0) = 14;
  Image<std::uint16_t> depth;
  quantize_depth(depth_m, 5000, depth);
  EXPECT_THAT(depth, ::testing::ElementsAre(0, 5000, 5001, 65500, 0));
}

TEST(LivingRoom, IsRichAndTheSameEveryTime) {
  const Mesh room = living_room();
  EXPECT_GE(room.triangles.size(), 20000u);
  EXPECT_EQ(room.vertices.size(), room.colors.size());
  const Mesh again = living_room();
  EXPECT_EQ(room.triangles, again.triangles);
  EXPECT_EQ(room.vertices, again.vertices);
  EXPECT_EQ(room.colors, again.colors);
  for (const auto& vertex : room.vertices) {
    ASSERT_LE(std::abs(vertex.x()), living_room_half_m + 0.05f);
    ASSERT_LE(std::abs(vertex.z()), living_room_half_m + 0.05f);
    ASSERT_GE(vertex.y(), -living_room_height_m - 0.001f);
    ASSERT_LE(vertex.y(), 0.001f);
  }
}

class LivingRoomViews : public ::testing::TestWithParam<int> {};

TEST_P(LivingRoomViews, HitSurfacesAtGoodDistanceEverywhere) {
  REQUIRE_RENDERER();
  const Trajectory path = living_room_path(GetParam());
  const Renderer renderer(living_room(), size, camera, Shading::none, 2);
  Rendering out;
  std::size_t good = 0, all = 0;
  for (std::size_t i = 0; i < path.size(); i += 10) {
    renderer.render(path[i].T_world_camera, out);
    for (const float z : out.depth_m) {
      ASSERT_GT(z, 0.45f) << "frame " << i;
      good += z > 0.6f && z < 3.8f ? 1 : 0;
      ++all;
    }
  }
  EXPECT_GT(static_cast<double>(good), 0.9 * static_cast<double>(all));
}

TEST_P(LivingRoomViews, OfTwoFramesAgree) {
  REQUIRE_RENDERER();
  const Trajectory path = living_room_path(GetParam());
  const Renderer renderer(living_room(), size, camera, Shading::none, 2);
  const std::size_t first = path.size() / 2;
  const Pose& from = path[first].T_world_camera;
  const Pose& to = path[first + 15].T_world_camera;
  Rendering a, b;
  renderer.render(from, a);
  renderer.render(to, b);
  int agree = 0, seen = 0;
  for (int y = 2; y < size.height - 2; ++y) {
    for (int x = 2; x < size.width - 2; ++x) {
      const Eigen::Vector3d p = to.inverse() * (from * (ray(x, y) * double(a.depth_m(x, y))));
      const auto u = static_cast<int>(std::lround(camera.fx * p.x() / p.z() + camera.cx));
      const auto v = static_cast<int>(std::lround(camera.fy * p.y() / p.z() + camera.cy));
      if (u < 0 || v < 0 || u >= size.width || v >= size.height) continue;
      ++seen;
      // Half a pixel beside the point, the surface may be a few millimetres nearer or farther.
      agree += std::abs(b.depth_m(u, v) - p.z()) < 0.01 * p.z() ? 1 : 0;
    }
  }
  EXPECT_GT(seen, 12000);
  EXPECT_GT(agree, 0.85 * seen);
}

INSTANTIATE_TEST_SUITE_P(All, LivingRoomViews, ::testing::Range(0, living_room_path_count));

TEST(RenderedSequence, GivesTheSameFrameInAnyOrder) {
  REQUIRE_RENDERER();
  const Trajectory path = living_room_path(2);
  const RenderedSequence sequence(living_room(), {path.begin(), path.begin() + 3}, Shading::diffuse,
                                  7, 2);
  Rendering in_order, alone;
  for (int i = 0; i < 3; ++i) sequence.render(i, in_order);
  sequence.render(2, alone);
  EXPECT_EQ(in_order.depth_m, alone.depth_m);
  EXPECT_EQ(in_order.color, alone.color);
}

}  // namespace
}  // namespace slambench
