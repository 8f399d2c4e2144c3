// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "backends/registry.h"
#include "support/device_images.h"
#include "support/synthetic_scene.h"

namespace slambench {
namespace {

using testing::downloaded;
using testing::uploaded;

constexpr Size view{40, 30};
constexpr Intrinsics camera{36, 34, 19.5f, 14.5f};

class VolumeKernels : public ::testing::Test {
 protected:
  void make_volume(Int3 resolution, Float3 size_m) {
    volume_ = backend_->make_volume(MapKind::grid, resolution, size_m);
  }
  std::vector<Voxel> voxels() {
    std::vector<Voxel> read;
    backend_->read_volume(read, volume_);
    return read;
  }
  std::unique_ptr<Backend> backend_ = create_backend("serial", {});
  Volume volume_;
};

// --- integrate -----------------------------------------------------------------------------------

/// The update of every voxel as the formula says it, in double precision: no voxel may differ, but
/// for rounding where a projection falls between two pixels.
class Integrate : public VolumeKernels {
 protected:
  struct Expected {
    bool certain = true;  ///< not within rounding of a pixel's or the band's edge
    bool changed = false;
    double tsdf = 1;
  };

  Expected measured(const Eigen::Vector3d& center, const Image<float>& depth) const {
    constexpr double rounding = 1e-4;
    if (std::abs(center.z() - min_depth_m_) < rounding) return {false};
    if (center.z() < min_depth_m_) return {};
    const double u = camera.fx * center.x() / center.z() + camera.cx + 0.5;
    const double v = camera.fy * center.y() / center.z() + camera.cy + 0.5;
    if (std::abs(u - std::round(u)) < rounding || std::abs(v - std::round(v)) < rounding) {
      return {false};
    }
    if (u < 0 || u > view.width - 1 || v < 0 || v > view.height - 1) return {};
    const double pixel_depth = depth(static_cast<int>(u), static_cast<int>(v));
    if (pixel_depth == 0) return {};
    const double distance = (pixel_depth - center.z()) * (center / center.z()).norm();
    if (std::abs(distance + mu_m_) < rounding) return {false};
    if (distance <= -mu_m_) return {};
    return {true, true, std::min(1.0, distance / mu_m_)};
  }

  void expect_one_measurement(const Pose& T_volume_camera, const Image<float>& depth) {
    backend_->integrate(volume_, uploaded(*backend_, depth),
                        {to_rigid3f(T_volume_camera.inverse()), camera, static_cast<float>(mu_m_),
                         100, static_cast<float>(min_depth_m_)});
    const Int3 n = volume_.resolution;
    const Eigen::Vector3d voxel_m(volume_.size_m.x / n.x, volume_.size_m.y / n.y,
                                  volume_.size_m.z / n.z);
    const std::vector<Voxel> found = voxels();
    std::size_t i = 0, changed = 0, uncertain = 0;
    for (int z = 0; z < n.z; ++z) {
      for (int y = 0; y < n.y; ++y) {
        for (int x = 0; x < n.x; ++x, ++i) {
          const Eigen::Vector3d center =
              T_volume_camera.inverse() *
              Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5).cwiseProduct(voxel_m);
          const Expected expected = measured(center, depth);
          changed += expected.changed ? 1 : 0;
          uncertain += expected.certain ? 0 : 1;
          if (!expected.certain) continue;
          ASSERT_EQ(found[i].weight, expected.changed ? 1 : 0) << x << "," << y << "," << z;
          ASSERT_NEAR(found[i].tsdf, expected.tsdf * 32766, 1.5) << x << "," << y << "," << z;
        }
      }
    }
    EXPECT_GT(changed, found.size() / 10);
    EXPECT_LT(changed, found.size() * 9 / 10);
    EXPECT_LT(uncertain, found.size() / 50);
  }

  const double mu_m_ = 0.15, min_depth_m_ = 0.25;
};

TEST_F(Integrate, FollowsTheFormulaInEveryVoxel) {
  make_volume({24, 32, 28}, {2.1f, 1.9f, 2.3f});
  Pose T_volume_camera = Pose::Identity();
  T_volume_camera.translation() = Eigen::Vector3d(1.02, 0.97, -0.1);
  const auto scene = testing::Scene().add_plane({0.2, -0.3, -1}, {1, 1, 1.4});
  expect_one_measurement(T_volume_camera,
                         testing::depth_m_of(scene, T_volume_camera, camera, view));
}

/// A turned camera within the volume, holes, and voxels behind it.
TEST_F(Integrate, FollowsTheFormulaFromATurnedCamera) {
  make_volume({31, 27, 33}, {2, 2, 2});
  Pose T_volume_camera = Pose::Identity();
  T_volume_camera.linear() =
      (Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.2, 1, -0.4).normalized())).toRotationMatrix();
  T_volume_camera.translation() = Eigen::Vector3d(0.6, 0.9, 0.5);
  const auto scene =
      testing::Scene().add_plane({-0.5, 0, -1}, {1.5, 1, 1.7}).add_sphere({1.1, 1, 1.2}, 0.2);
  Image<float> depth = testing::depth_m_of(scene, T_volume_camera, camera, view);
  for (int y = 10; y < 14; ++y) {
    for (int x = 20; x < 30; ++x) depth(x, y) = 0;
  }
  expect_one_measurement(T_volume_camera, depth);
}

/// 0.5, then 0.25, then -0.5 of the band at every voxel of one layer before the wall.
TEST_F(Integrate, KeepsTheRunningAverage) {
  make_volume({1, 1, 8}, {0.125f, 0.125f, 4});  // centres at 0.25, 0.75, ..., on the axis
  const Rigid3f T_camera_volume{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-0.0625f, -0.0625f, 0}};
  const Intrinsics axis{1, 1, 1, 1};
  const auto measure = [&](float depth_m, float max_weight) {
    const auto depth = uploaded(*backend_, Image<float>({4, 4}, depth_m));
    backend_->integrate(volume_, depth, {T_camera_volume, axis, 0.5f, max_weight, 0.0001f});
  };
  measure(2.0f, 2);
  measure(1.875f, 2);
  EXPECT_EQ(voxels()[3], (Voxel{12287, 2}));
  measure(1.5f, 2);
  EXPECT_EQ(voxels()[3], (Voxel{2730, 2}));
  EXPECT_EQ(voxels()[0], (Voxel{32766, 2}));
  EXPECT_EQ(voxels()[7], Voxel{});
  EXPECT_EQ(voxels()[4], (Voxel{-20478, 2}));  // 2.25 m: -0.5 and -0.75, then beyond the band
}

// --- raycast -------------------------------------------------------------------------------------

class Raycast : public VolumeKernels {
 protected:
  Raycast() { T_volume_camera_.translation() = Eigen::Vector3d(1, 1, 0); }

  void fill(const testing::Scene& scene, Int3 resolution, double size_m) {
    const auto edge = static_cast<float>(size_m);
    make_volume(resolution, {edge, edge, edge});
    backend_->write_volume(
        volume_, testing::tsdf_of(scene, resolution, Eigen::Vector3d::Constant(size_m), mu_m_));
  }
  RaycastParameters parameters() const {
    const float voxel_m = volume_.size_m.x / static_cast<float>(volume_.resolution.x);
    return {to_rigid3f(T_volume_camera_),      camera,  0.4f, 4.0f,
            0.75f * static_cast<float>(mu_m_), voxel_m, 0.8f};
  }
  testing::SurfaceMaps cast(const RaycastParameters& p) {
    auto vertices = backend_->make_image<Float3>(view);
    auto normals = backend_->make_image<Float3>(view);
    backend_->raycast(vertices, normals, volume_, p);
    return {downloaded(*backend_, vertices), downloaded(*backend_, normals)};
  }

  const double mu_m_ = 0.2;
  Pose T_volume_camera_ = Pose::Identity();
};

TEST_F(Raycast, FindsAPlaneExactly) {
  const auto scene = testing::Scene().add_plane({0.2, -0.3, -1}, {1, 1, 1.4});
  fill(scene, {48, 48, 48}, 2);
  const auto found = cast(parameters());
  const auto expected = testing::surface_maps_of(scene, T_volume_camera_, camera, view);
  int hits = 0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const Float3 point = expected.vertices(x, y);
      const auto within = [](float v) { return v > 0.1f && v < 1.9f; };
      if (!within(point.x) || !within(point.y) || !within(point.z)) continue;
      ++hits;
      EXPECT_LT(length(found.vertices(x, y) - point), 2e-4f) << x << "," << y;
      EXPECT_GT(dot(found.normals(x, y), expected.normals(x, y)), 0.9999f) << x << "," << y;
    }
  }
  EXPECT_GT(hits, 900);
}

TEST_F(Raycast, FindsASphereFromATurnedCamera) {
  const auto scene = testing::Scene().add_sphere({1.2, 0.9, 1.1}, 0.5);
  fill(scene, {64, 64, 64}, 2);
  T_volume_camera_.linear() =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(0.3, 1, 0.5).normalized()).toRotationMatrix();
  T_volume_camera_.translation() = Eigen::Vector3d(0.7, 0.9, 0.02);
  RaycastParameters fine = parameters();
  fine.large_step_m = fine.small_step_m;  // along a large one, the distance to a ball is not linear
  const auto found = cast(fine);
  const auto expected = testing::surface_maps_of(scene, T_volume_camera_, camera, view);
  int hits = 0, misses = 0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const Eigen::Vector3d ray = T_volume_camera_.linear() * testing::ray_of(camera, x, y);
      const Eigen::Vector3d normal(expected.normals(x, y).x, expected.normals(x, y).y,
                                   expected.normals(x, y).z);
      if (expected.normals(x, y).x == invalid_normal) {
        misses += found.normals(x, y).x == invalid_normal ? 1 : 0;
      } else if (normal.dot(ray.normalized()) < -0.4) {  // away from the rim
        ++hits;
        EXPECT_LT(length(found.vertices(x, y) - expected.vertices(x, y)), 4e-3f) << x << "," << y;
        EXPECT_GT(dot(found.normals(x, y), expected.normals(x, y)), 0.998f) << x << "," << y;
      }
    }
  }
  EXPECT_GT(hits, 150);
  EXPECT_GT(misses, 300);
}

TEST_F(Raycast, SeesNothingInAnEmptyVolumeOrFromBehindASurface) {
  make_volume({16, 16, 16}, {2, 2, 2});
  for (const Float3 normal : cast(parameters()).normals) EXPECT_EQ(normal.x, invalid_normal);
  fill(testing::Scene().add_plane({0, 0, 1}, {1, 1, 1.5}), {16, 16, 16}, 2);  // solid to 1.5 m
  for (const Float3 vertex : cast(parameters()).vertices) EXPECT_EQ(vertex, Float3{});
}

TEST_F(Raycast, EndsAtNearAndFar) {
  fill(testing::Scene().add_plane({0, 0, -1}, {1, 1, 1.0}), {32, 32, 32}, 2);
  const auto center_hit = [&](float near_m, float far_m) {
    RaycastParameters p = parameters();
    p.near_m = near_m;
    p.far_m = far_m;
    return cast(p).normals(20, 15).x != invalid_normal;
  };
  EXPECT_TRUE(center_hit(0.4f, 4));
  EXPECT_FALSE(center_hit(0.4f, 0.9f));
  EXPECT_TRUE(center_hit(0.4f, 1.1f));
  EXPECT_TRUE(center_hit(0.9f, 4));
  EXPECT_FALSE(center_hit(1.1f, 4));
}

TEST_F(Raycast, RefusesMapsOfDifferentSizes) {
  make_volume({8, 8, 8}, {2, 2, 2});
  auto vertices = backend_->make_image<Float3>({4, 3});
  auto normals = backend_->make_image<Float3>({3, 4});
  EXPECT_THROW(backend_->raycast(vertices, normals, volume_, parameters()), std::invalid_argument);
}

// --- render_volume -------------------------------------------------------------------------------

/// The wall faces the camera; where the light is in front of a pixel's point it is brightest.
TEST_F(Raycast, RenderVolumeShadesWhatRaysMeet) {
  fill(testing::Scene().add_plane({0, 0, -1}, {1, 1, 1.5}), {32, 32, 32}, 2);
  const RaycastParameters p = parameters();
  const ShadeParameters shading{{1, 1, 0.5f}, 0.05f};
  auto picture = backend_->make_image<Rgba8>(view);
  backend_->render_volume(picture, volume_, p, shading);
  const Image<Rgba8> found = downloaded(*backend_, picture);
  int lit = 0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const Eigen::Vector3d point =
          T_volume_camera_.translation() + 1.5 * testing::ray_of(camera, x, y);
      if ((point.array() < 0.02).any() || (point.array() > 1.98).any()) {
        continue;
      }
      ++lit;
      const double lambert = 1 / (Eigen::Vector3d(1, 1, 0.5) - point).norm();
      const double grey = std::min(1.0, lambert + 0.05) * 255;
      EXPECT_NEAR(found(x, y).r, grey, 1.5) << x << "," << y;
      EXPECT_EQ(found(x, y), (Rgba8{found(x, y).r, found(x, y).r, found(x, y).r, 255}));
    }
  }
  EXPECT_GT(lit, 900);
}

TEST_F(Raycast, RenderVolumeIsBlackWhereNothingIs) {
  make_volume({8, 8, 8}, {2, 2, 2});
  auto picture = backend_->make_image<Rgba8>({5, 3});
  backend_->render_volume(picture, volume_, parameters(), {{1, 1, -1}, 0.1f});
  EXPECT_EQ(downloaded(*backend_, picture), Image<Rgba8>({5, 3}, Rgba8{0, 0, 0, 255}));
}

}  // namespace
}  // namespace slambench
