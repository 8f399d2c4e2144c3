// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstring>
#include <memory>
#include <vector>

#include "backends/openmp/openmp_backend.h"
#include "backends/serial/serial_backend.h"
#include "support/device_images.h"
#include "support/random_images.h"
#include "support/synthetic_scene.h"

namespace slambench {
namespace {

using testing::downloaded;
using testing::uploaded;

constexpr Size size{67, 50};
constexpr Intrinsics camera{55, 55, 33, 25};
constexpr double room_m = 2;

Pose view_at(int step) {
  Pose pose(Eigen::Translation3d(1.0 + 0.03 * step, 1.0 - 0.02 * step, 0.1 + 0.05 * step));
  pose.rotate(Eigen::AngleAxisd(0.07 * step, Eigen::Vector3d(0.3, 1, 0.1).normalized()));
  return pose;
}

/// What the camera measures at a step of its way: now and then with holes, and once with a ball
/// that was not there before, so that free space becomes occupied.
Image<float> depth_at(int step) {
  const testing::Scene scene =
      step < 5 ? testing::room_corner(room_m) : testing::furnished_corner(room_m);
  Image<float> depth = testing::depth_m_of(scene, view_at(step), camera, size);
  if (step % 2 == 1) {
    testing::punch_holes(depth, static_cast<std::uint32_t>(step), 0.002);
    for (int x = 10; x < 20; ++x) depth(x, 30) = 0;
  }
  return depth;
}

struct Fusion {
  Int3 resolution{64, 64, 64};
  Float3 size_m{2, 2, 2};
  int steps = 10;
  float max_weight = 100;
};

Volume fused(Backend& backend, MapKind map, const Fusion& fusion) {
  Volume volume = backend.make_volume(map, fusion.resolution, fusion.size_m);
  for (int step = 0; step < fusion.steps; ++step) {
    backend.integrate(
        volume, uploaded(backend, depth_at(step)),
        {to_rigid3f(view_at(step).inverse()), camera, 0.1f, fusion.max_weight, 0.0001f});
  }
  return volume;
}

std::vector<Voxel> voxels_of(Backend& backend, const Volume& volume) {
  std::vector<Voxel> voxels;
  backend.read_volume(voxels, volume);
  return voxels;
}

RaycastParameters ray_parameters(Float3 size_m, Int3 resolution, int step) {
  return {to_rigid3f(view_at(step)),
          camera,
          0.2f,
          4.0f,
          0.075f,
          std::min({size_m.x, size_m.y, size_m.z}) /
              static_cast<float>(std::max({resolution.x, resolution.y, resolution.z})),
          0.8f};
}

struct Surface {
  Image<Float3> vertices, normals;
  friend bool operator==(const Surface&, const Surface&) = default;
};

Surface raycast(Backend& backend, const Volume& volume, const RaycastParameters& parameters) {
  auto vertices = backend.make_image<Float3>(size), normals = backend.make_image<Float3>(size);
  backend.raycast(vertices, normals, volume, parameters);
  return {downloaded(backend, vertices), downloaded(backend, normals)};
}

struct Case {
  const char* name;
  Fusion fusion;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class VolumeAgreement : public ::testing::TestWithParam<Case> {};

/// Every voxel: to be lazy about free space loses nothing.
TEST_P(VolumeAgreement, EveryMapAndBackendHasTheSameVoxels) {
  const Fusion& fusion = GetParam().fusion;
  SerialBackend serial;
  const std::vector<Voxel> expected = voxels_of(serial, fused(serial, MapKind::grid, fusion));
  EXPECT_NE(expected, std::vector<Voxel>(expected.size()));
  EXPECT_EQ(voxels_of(serial, fused(serial, MapKind::bricks, fusion)), expected);
  for (const int threads : {1, 2, 3, 7}) {
    OpenmpBackend openmp(threads);
    EXPECT_EQ(voxels_of(openmp, fused(openmp, MapKind::grid, fusion)), expected) << threads;
    EXPECT_EQ(voxels_of(openmp, fused(openmp, MapKind::bricks, fusion)), expected) << threads;
  }
}

TEST_P(VolumeAgreement, EveryMapAndBackendSeesTheSameSurface) {
  const Fusion& fusion = GetParam().fusion;
  const auto parameters = ray_parameters(fusion.size_m, fusion.resolution, 4);
  SerialBackend serial;
  const Surface expected = raycast(serial, fused(serial, MapKind::grid, fusion), parameters);
  int hits = 0;
  for (const Float3& normal : expected.normals) hits += normal.x != invalid_normal ? 1 : 0;
  const bool coarse = fusion.resolution.x < BrickVolume::edge;  // no surface fits in
  EXPECT_GT(hits, coarse ? -1 : 500);
  EXPECT_EQ(raycast(serial, fused(serial, MapKind::bricks, fusion), parameters), expected);
  for (const int threads : {1, 3}) {
    OpenmpBackend openmp(threads);
    EXPECT_EQ(raycast(openmp, fused(openmp, MapKind::grid, fusion), parameters), expected);
    EXPECT_EQ(raycast(openmp, fused(openmp, MapKind::bricks, fusion), parameters), expected);
  }
}

TEST_P(VolumeAgreement, VoxelsComeBackAsWritten) {
  const Fusion& fusion = GetParam().fusion;
  SerialBackend serial;
  const std::vector<Voxel> voxels = voxels_of(serial, fused(serial, MapKind::grid, fusion));
  Volume bricks = serial.make_volume(MapKind::bricks, fusion.resolution, fusion.size_m);
  serial.write_volume(bricks, voxels);
  EXPECT_EQ(voxels_of(serial, bricks), voxels);
  const auto parameters = ray_parameters(fusion.size_m, fusion.resolution, 4);
  Volume grid = serial.make_volume(MapKind::grid, fusion.resolution, fusion.size_m);
  serial.write_volume(grid, voxels);
  OpenmpBackend openmp(2);
  Volume openmp_bricks = openmp.make_volume(MapKind::bricks, fusion.resolution, fusion.size_m);
  openmp.write_volume(openmp_bricks, voxels);
  EXPECT_EQ(raycast(openmp, openmp_bricks, parameters), raycast(serial, grid, parameters));
  serial.init_volume(bricks);
  EXPECT_EQ(voxels_of(serial, bricks), std::vector<Voxel>(voxels.size()));
}

INSTANTIATE_TEST_SUITE_P(
    All, VolumeAgreement,
    ::testing::Values(Case{"Cube", {}},
                      Case{"NoMultipleOfABrick", {{61, 50, 67}, {2, 2, 2}, 8, 100}},
                      Case{"NoCube", {{40, 72, 56}, {1.6f, 2.2f, 1.9f}, 8, 100}},
                      Case{"WeightsSaturate", {{32, 32, 32}, {2, 2, 2}, 12, 3}},
                      Case{"SmallerThanABrick", {{5, 6, 7}, {2, 2, 2}, 6, 100}}),
    [](const auto& test) { return std::string(test.param.name); });

/// Kernels of one instruction set, as long as it lives.
class Only {
 public:
  explicit Only(std::int64_t target) { choose(target); }
  ~Only() { choose(0); }
  Only(const Only&) = delete;
  Only& operator=(const Only&) = delete;

 private:
  static void choose(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

TEST(InstructionSets, AllGiveTheSameBits) {
  const std::int64_t here = (hwy::SupportedTargets() | HWY_STATIC_TARGET) & HWY_TARGETS;
  const Fusion fusion{{61, 50, 67}, {2, 2, 2}, 7, 100};
  const auto parameters = ray_parameters(fusion.size_m, fusion.resolution, 4);
  SerialBackend serial;
  const Volume expected_volume = fused(serial, MapKind::grid, fusion);
  const std::vector<Voxel> expected = voxels_of(serial, expected_volume);
  const Surface surface = raycast(serial, expected_volume, parameters);
  for (int bit = 0; bit < 63; ++bit) {
    const std::int64_t target = std::int64_t{1} << bit;
    if ((here & target) == 0) continue;
    const Only only(target);
    for (const MapInfo& map : map_table()) {
      OpenmpBackend openmp(2);
      const Volume volume = fused(openmp, map.map, fusion);
      EXPECT_EQ(voxels_of(openmp, volume), expected) << hwy::TargetName(target);
      EXPECT_EQ(openmp.instruction_set(), hwy::TargetName(target));
      EXPECT_EQ(raycast(openmp, volume, parameters), surface) << hwy::TargetName(target);
    }
  }
}

/// The truth that lazy free space rests on.
TEST(Bricks, FreeSpaceIsAFixedPointWhateverTheWeight) {
  const float depth_m[] = {3, 3, 3, 3};
  const IntegrateParameters parameters{{}, {1, 1, 0, 0}, 0.1f, 32767, 0.0001f};
  for (int weight = 0; weight < 32767; ++weight) {
    Voxel voxel{BrickVolume::free_space, static_cast<std::int16_t>(weight)};
    ASSERT_TRUE(integrate_voxel(&voxel, {0, 0, 1}, depth_m, {2, 2}, parameters));
    ASSERT_EQ(voxel.tsdf, BrickVolume::free_space) << weight;
    ASSERT_EQ(voxel.weight, weight + 1);
  }
}

/// Whether every row of a plane goes on with the next brick's first value, where readers of pairs
/// can meet anything but +1.
bool rows_go_on(const BrickVolume& volume) {
  const auto width = static_cast<std::size_t>(volume.bricks().x);
  for (std::size_t brick = 0; brick < volume.count(); ++brick) {
    const bool last = (brick + 1) % width == 0;
    if (last || (volume.is_free(brick) && volume.is_free(brick + 1))) continue;
    const std::int16_t* row =
        volume.planes() +
        static_cast<std::ptrdiff_t>(volume.plane_table()[brick]) * BrickVolume::plane_values;
    for (int i = 0; i < BrickVolume::voxels;
         i += BrickVolume::edge, row += BrickVolume::row_values) {
      if (row[BrickVolume::edge] != volume.tsdf(brick + 1, i)) return false;
    }
  }
  return true;
}

/// Bricks in any order, as a surface grows to either side, over free ones and again.
TEST(Bricks, RowsGoOnIntoTheNextBrick) {
  BrickVolume volume({48, 16, 8});
  std::vector<std::int16_t> tsdf(BrickVolume::voxels), weights(BrickVolume::voxels, 1);
  std::int16_t value = 0;
  for (const std::size_t brick : {2, 1, 0, 4, 5, 3, 7, 9, 8, 11, 1, 2}) {
    for (std::int16_t& distance : tsdf) distance = value++;
    volume.reserve(1);
    volume.store(brick, tsdf.data(), weights.data());
    volume.refresh();
    ASSERT_TRUE(rows_go_on(volume)) << brick;
    EXPECT_FALSE(volume.is_free(brick));
  }
  EXPECT_TRUE(volume.is_free(6));
  EXPECT_TRUE(volume.is_free(10));
}

/// Rays that look along x at a slab whose first voxels are the first of a brick.
TEST(Bricks, RaysMeetASurfaceThatBeginsWithABrick) {
  const Int3 n{64, 64, 64};
  std::vector<Voxel> voxels(voxel_count(n));
  for (int i = 0; i < static_cast<int>(voxels.size()); ++i) {
    const int x = i % n.x;
    if (x >= 32) voxels[static_cast<std::size_t>(i)] = {static_cast<std::int16_t>(-900 * x), 1};
  }
  Pose pose(Eigen::Translation3d(0.1, 1.0, 1.0));
  pose.rotate(Eigen::AngleAxisd(1.5, Eigen::Vector3d::UnitY()));
  RaycastParameters parameters = ray_parameters({2, 2, 2}, n, 0);
  parameters.T_volume_camera = to_rigid3f(pose);
  const auto seen = [&](Backend& backend, MapKind map) {
    Volume volume = backend.make_volume(map, n, {2, 2, 2});
    backend.write_volume(volume, voxels);
    return raycast(backend, volume, parameters);
  };
  SerialBackend serial;
  OpenmpBackend openmp(2);
  const Surface expected = seen(serial, MapKind::grid);
  EXPECT_EQ(seen(openmp, MapKind::grid), expected);
  EXPECT_EQ(seen(openmp, MapKind::bricks), expected);
}

TEST(Bricks, FreeSpaceTakesNoPlanes) {
  OpenmpBackend backend(2);
  Volume volume = backend.make_volume(MapKind::bricks, {64, 64, 64}, {2, 2, 2});
  const std::size_t empty = backend.volume_bytes(volume);
  // The camera stands far back: every brick is inside the image and in front of the wall.
  const Pose behind(Eigen::Translation3d(1, 1, -8));
  const IntegrateParameters parameters{to_rigid3f(behind.inverse()), camera, 0.1f, 100, 0.0001f};
  for (int i = 0; i < 3; ++i) {
    backend.integrate(volume, uploaded(backend, Image<float>(size, 20.0f)), parameters);
  }
  EXPECT_EQ(backend.volume_bytes(volume), empty);
  EXPECT_THAT(voxels_of(backend, volume), ::testing::Each(Voxel{32766, 3}));
}

TEST(Bricks, TakeLessMemoryThanTheGrid) {
  OpenmpBackend backend(2);
  const Fusion fusion{{128, 128, 128}, {2, 2, 2}, 2, 100};
  const Volume grid = fused(backend, MapKind::grid, fusion);
  const Volume bricks = fused(backend, MapKind::bricks, fusion);
  EXPECT_EQ(backend.volume_bytes(grid), 128u * 128 * 128 * 4);
  EXPECT_LT(backend.volume_bytes(bricks), backend.volume_bytes(grid) / 2);
}

Image<Rgba8> rendered(Backend& backend, const Volume& volume, const RaycastParameters& view,
                      const RaycastParameters* seen_view = nullptr) {
  auto picture = backend.make_image<Rgba8>(size);
  auto vertices = backend.make_image<Float3>(size), normals = backend.make_image<Float3>(size);
  SeenSurface seen{&vertices, &normals, {}};
  if (seen_view != nullptr) {
    backend.raycast(vertices, normals, volume, *seen_view);
    seen.view = *seen_view;
  }
  backend.render_volume(picture, volume, view, {{1, 1, -1}, 0.1f},
                        seen_view != nullptr ? &seen : nullptr);
  return downloaded(backend, picture);
}

/// render_volume may draw from a raycast: never from one that is not of the view.
TEST(RenderVolume, EqualsTheReferenceWhateverWasSeenBefore) {
  const Fusion fusion;
  SerialBackend serial;
  OpenmpBackend openmp(2);
  for (const MapKind map : {MapKind::grid, MapKind::bricks}) {
    const Volume expected_volume = fused(serial, map, fusion), volume = fused(openmp, map, fusion);
    auto near_view = ray_parameters(fusion.size_m, fusion.resolution, 4);
    auto far_view = near_view, other_view = near_view;
    near_view.far_m = 1.2f;
    other_view.T_volume_camera = to_rigid3f(view_at(2));
    for (const auto& view : {near_view, far_view, other_view}) {
      const Image<Rgba8> expected = rendered(serial, expected_volume, view);
      EXPECT_EQ(rendered(openmp, volume, view), expected);
      for (const auto& seen : {near_view, far_view, other_view}) {
        EXPECT_EQ(rendered(openmp, volume, view, &seen), expected);
      }
    }
  }
}

/// What was seen is drawn as it is, and only what was not is looked for.
TEST(RenderVolume, DrawsWhatWasSeenOnOpenmp) {
  const Fusion fusion;
  OpenmpBackend openmp(2);
  const Volume volume = fused(openmp, MapKind::bricks, fusion);
  const auto view = ray_parameters(fusion.size_m, fusion.resolution, 4);
  const Image<Float3> vertices(size, {1, 1, 1}), normals(size, {0, 0, -1});
  const auto seen_vertices = uploaded(openmp, vertices), seen_normals = uploaded(openmp, normals);
  auto picture = openmp.make_image<Rgba8>(size);
  auto farther = view;
  farther.far_m *= 2;
  const SeenSurface seen{&seen_vertices, &seen_normals, view};
  for (const auto& drawn : {view, farther}) {
    openmp.render_volume(picture, volume, drawn, {{1, 1, 0}, 0}, &seen);
    EXPECT_THAT(downloaded(openmp, picture), ::testing::Each(Rgba8{255, 255, 255, 255}));
  }
}

}  // namespace
}  // namespace slambench
