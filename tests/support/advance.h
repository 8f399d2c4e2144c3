// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "backends/backend.h"
#include "support/device_images.h"
#include "support/random_images.h"
#include "support/synthetic_scene.h"

/// A frame that meets a model and a volume: what Backend::advance is to do with it.
namespace slambench::testing {

/// Views of the corner of a room.
namespace corner {

inline constexpr Size size{67, 50};
inline constexpr Intrinsics camera{55, 55, 33, 25};
inline constexpr Int3 resolution{72, 64, 61};
inline constexpr Float3 size_m{2, 2, 2};

inline Pose view_at(int step) {
  Pose pose(Eigen::Translation3d(1.0 + 0.03 * step, 1.0 - 0.02 * step, 0.1 + 0.05 * step));
  pose.rotate(Eigen::AngleAxisd(0.07 * step, Eigen::Vector3d(0.3, 1, 0.1).normalized()));
  return pose;
}

inline Volume fused(Backend& backend, MapKind map, int steps) {
  Volume volume = backend.make_volume(map, resolution, size_m);
  for (int step = 0; step < steps; ++step) {
    Image<float> depth =
        depth_m_of(step < 5 ? room_corner(2) : furnished_corner(2), view_at(step), camera, size);
    if (step % 2 == 1) punch_holes(depth, static_cast<std::uint32_t>(step), 0.002);
    backend.integrate(volume, uploaded(backend, depth),
                      {to_rigid3f(view_at(step).inverse()), camera, 0.1f, 6, 0.0001f});
  }
  return volume;
}

}  // namespace corner

inline std::vector<Voxel> voxels_of(Backend& backend, const Volume& volume) {
  std::vector<Voxel> voxels;
  backend.read_volume(voxels, volume);
  return voxels;
}

struct AfterFrame {
  AlignResult aligned;
  bool tracked = false;
  std::vector<Voxel> voxels;
  Image<Float3> vertices, normals;
};

/// A frame's maps, and the model and the volume that it meets.
struct Meeting {
  Meeting(Backend& backend, MapKind map, bool believed, bool due)
      : volume(corner::fused(backend, map, 4)),
        depth_m(uploaded(
            backend, depth_m_of(room_corner(2), corner::view_at(4), corner::camera, corner::size))),
        vertices(backend.make_image<Float3>(corner::size)),
        normals(backend.make_image<Float3>(corner::size)),
        model_vertices(backend.make_image<Float3>(corner::size)),
        model_normals(backend.make_image<Float3>(corner::size)),
        rows(backend.make_image<TrackData>(corner::size)) {
    backend.depth2vertex(vertices, depth_m, corner::camera);
    backend.vertex2normal(normals, vertices);
    backend.raycast(model_vertices, model_normals, volume, ray(corner::view_at(3)));
    input.align = {
        {&vertices},
        {&normals},
        {&rows},
        &model_vertices,
        &model_normals,
        {10},
        {to_rigid3f(start()), to_rigid3f(corner::view_at(3).inverse()), corner::camera, 0.1f, 0.8f},
        start(),
        1e-5,
        true,
        true};
    input.condition = 1e6;
    input.limits = {0.02, believed ? 0.15 : 1.1};
    input.volume = &volume;
    input.depth_m = &depth_m;
    input.model_vertices = &model_vertices;
    input.model_normals = &model_normals;
    // Of another pose, which nobody may look at.
    if (due) input.integrate = measurement(corner::view_at(9));
    input.raycast = ray(corner::view_at(9));
  }

  /// Not where the model was seen from: a lost frame's raycast shows.
  static Pose start() { return corner::view_at(3) * Eigen::Translation3d(0.01, 0, 0); }
  static IntegrateParameters measurement(const Pose& pose) {
    return {to_rigid3f(pose.inverse()), corner::camera, 0.1f, 6, 0.0001f};
  }
  static RaycastParameters ray(const Pose& pose) {
    return {to_rigid3f(pose), corner::camera, 0.2f, 4, 0.075f, 0.028f, 0.8f};
  }
  AfterFrame now(Backend& backend, const AlignResult& aligned, bool tracked) const {
    return {aligned, tracked, voxels_of(backend, volume), downloaded(backend, model_vertices),
            downloaded(backend, model_normals)};
  }

  Volume volume;
  DeviceImage<float> depth_m;
  DeviceImage<Float3> vertices, normals, model_vertices, model_normals;
  DeviceImage<TrackData> rows;
  AdvanceInput input;
};

/// The map, whether the alignment is believed, whether the frame is due for integration.
using MeetingCase = std::tuple<MapKind, bool, bool>;

inline auto every_meeting() {
  return ::testing::Combine(::testing::Values(MapKind::grid, MapKind::bricks), ::testing::Bool(),
                            ::testing::Bool());
}

inline std::string name_of_meeting(const ::testing::TestParamInfo<MeetingCase>& combination) {
  const auto& [map, believed, due] = combination.param;
  return std::string(name(map)) + (believed ? "_tracked" : "_lost") + (due ? "_due" : "_not_due");
}

/// What the pipeline does with the backend's single steps.
inline AfterFrame step_by_step(Backend& backend, Meeting& meeting) {
  const AdvanceInput& in = meeting.input;
  const AlignResult aligned = backend.align(in.align, in.condition);
  const bool tracked = is_believed(in.align, aligned, in.limits);
  const Pose pose = tracked ? aligned.T_volume_camera : in.align.T_volume_camera;
  if (tracked && in.integrate) {
    backend.integrate(meeting.volume, meeting.depth_m, Meeting::measurement(pose));
  }
  backend.raycast(meeting.model_vertices, meeting.model_normals, meeting.volume,
                  Meeting::ray(pose));
  return meeting.now(backend, aligned, tracked);
}

inline void expect_same(const AfterFrame& found, const AfterFrame& expected) {
  EXPECT_EQ(found.tracked, expected.tracked);
  EXPECT_EQ(found.aligned.iterations, expected.aligned.iterations);
  EXPECT_EQ(found.aligned.last.inliers, expected.aligned.last.inliers);
  EXPECT_TRUE(found.aligned.T_volume_camera.isApprox(expected.aligned.T_volume_camera, 1e-12));
  EXPECT_EQ(found.voxels, expected.voxels);
  EXPECT_EQ(found.vertices, expected.vertices);
  EXPECT_EQ(found.normals, expected.normals);
}

/// A motion that is not finite is none, whatever the limits allow.
inline void expect_that_a_pose_is_finite(Backend& backend, MapKind map) {
  Meeting meeting(backend, map, true, true);
  meeting.input.limits = {HUGE_VAL, 0};
  meeting.input.align.T_volume_camera.translation().x() = std::nan("");
  const std::vector<Voxel> before = voxels_of(backend, meeting.volume);
  EXPECT_FALSE(backend.advance(meeting.input).tracked);
  EXPECT_EQ(voxels_of(backend, meeting.volume), before);
}

}  // namespace slambench::testing
