// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "backends/openmp/openmp_backend.h"
#include "backends/serial/serial_backend.h"
#include "support/device_images.h"
#include "support/random_images.h"
#include "support/synthetic_scene.h"

namespace slambench {
namespace {

using testing::downloaded;
using testing::Random;
using testing::random_depth_m;
using testing::uploaded;

/// Smaller than, equal to and no multiple of any vector; one pixel wide and high.
constexpr Size sizes[] = {{1, 1}, {1, 9}, {9, 1}, {3, 2}, {16, 4}, {17, 5}, {33, 31}, {67, 50}};
constexpr int thread_counts[] = {1, 2, 3, 7};

template <class T>
bool same_bits(const Image<T>& a, const Image<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.bytes()) == 0;
}

Intrinsics camera_of(Size size) {
  const auto width = static_cast<float>(size.width), height = static_cast<float>(size.height);
  return {0.8f * width, 0.8f * width, 0.49f * width, 0.52f * height};
}

Pose small_motion() {
  Pose pose = Pose::Identity();
  pose.rotate(Eigen::AngleAxisd(0.02, Eigen::Vector3d(1, 2, -1).normalized()));
  pose.translation() = Eigen::Vector3d(0.01, -0.02, 0.015);
  return pose;
}

/// Runs `kernel(backend)` on the reference and on every number of threads.
template <class F>
void expect_the_same_bits(const F& kernel, const char* what) {
  SerialBackend serial;
  const auto expected = kernel(serial);
  for (const int threads : thread_counts) {
    OpenmpBackend openmp(threads);
    EXPECT_TRUE(same_bits(kernel(openmp), expected)) << what << " on " << threads << " threads";
  }
}

class OpenmpSizes : public ::testing::TestWithParam<Size> {};

TEST_P(OpenmpSizes, Mm2metersHasTheSameBits) {
  for (const int ratio : {1, 2, 3}) {
    const Size size = GetParam();
    const auto depth =
        testing::random_depth_units({size.width * ratio, size.height * ratio}, 3, 0.2);
    expect_the_same_bits(
        [&](Backend& backend) {
          auto out = backend.make_image<float>(size);
          backend.mm2meters(out, uploaded(backend, depth), 1000);
          return downloaded(backend, out);
        },
        "mm2meters");
  }
}

Image<float> bilateral(Backend& backend, const Image<float>& depth, int radius) {
  auto gaussian = backend.make_image<float>({2 * radius + 1, 1});
  backend.generate_gaussian(gaussian, 4);
  auto out = backend.make_image<float>(depth.size());
  backend.bilateral_filter(out, uploaded(backend, depth), gaussian, 0.1f);
  return downloaded(backend, out);
}

// The exponential is good to 4 units in the last place: weights to 3e-7, means to the same part
// of the window's spread, which is below a metre where weights are not negligible.
TEST_P(OpenmpSizes, BilateralFilterAgrees) {
  for (const int radius : {0, 1, 2, 5}) {
    Image<float> depth = random_depth_m(GetParam(), 4, 0.2, 0.9, 1.3);
    depth(0, 0) = std::numeric_limits<float>::quiet_NaN();
    SerialBackend serial;
    const Image<float> expected = bilateral(serial, depth, radius);
    OpenmpBackend one_thread(1);
    const Image<float> found = bilateral(one_thread, depth, radius);
    for (std::size_t i = 0; i < found.count(); ++i) {
      ASSERT_NEAR(found.data()[i], expected.data()[i], 1e-6f) << "pixel " << i;
      ASSERT_EQ(found.data()[i] == 0, expected.data()[i] == 0) << "pixel " << i;
    }
    for (const int threads : thread_counts) {
      OpenmpBackend openmp(threads);
      EXPECT_TRUE(same_bits(bilateral(openmp, depth, radius), found)) << threads << " threads";
    }
  }
}

TEST_P(OpenmpSizes, HalfSampleHasTheSameBits) {
  const Size half = GetParam();
  for (const Size size :
       {Size{2 * half.width, 2 * half.height}, Size{2 * half.width + 1, 2 * half.height + 1}}) {
    Image<float> depth = random_depth_m(size, 5, 0.2, 0.8, 1.5);
    depth(0, 0) = std::numeric_limits<float>::quiet_NaN();
    expect_the_same_bits(
        [&](Backend& backend) {
          auto out = backend.make_image<float>(half);
          backend.half_sample(out, uploaded(backend, depth), 0.3f);
          return downloaded(backend, out);
        },
        "half_sample");
  }
}

TEST_P(OpenmpSizes, VerticesAndNormalsHaveTheSameBits) {
  const Size size = GetParam();
  const Image<float> depth = random_depth_m(size, 6, 0.05);
  expect_the_same_bits(
      [&](Backend& backend) {
        auto vertices = backend.make_image<Float3>(size);
        backend.depth2vertex(vertices, uploaded(backend, depth), camera_of(size));
        return downloaded(backend, vertices);
      },
      "depth2vertex");
  expect_the_same_bits(
      [&](Backend& backend) {
        auto vertices = backend.make_image<Float3>(size);
        auto normals = backend.make_image<Float3>(size);
        backend.depth2vertex(vertices, uploaded(backend, depth), camera_of(size));
        backend.vertex2normal(normals, vertices);
        return downloaded(backend, normals);
      },
      "vertex2normal");
}

/// Live and model maps of a furnished corner, with holes in both.
struct TrackScene {
  explicit TrackScene(Size size)
      : camera(camera_of(size)),
        T_volume_model(Eigen::Translation3d(1, 1, 0)),
        model(
            testing::surface_maps_of(testing::furnished_corner(2), T_volume_model, camera, size)) {
    const Pose T_volume_live = T_volume_model * small_motion();
    live = testing::surface_maps_of(testing::furnished_corner(2), T_volume_live, camera, size,
                                    T_volume_live.inverse());
    Random random(7);
    for (testing::SurfaceMaps* maps : {&live, &model}) {
      for (Float3& normal : maps->normals) {
        if (random.chance(0.1)) normal = {invalid_normal, 0, 0};
        if (random.chance(0.1)) normal = {0, 0, 1};
      }
      for (Float3& vertex : maps->vertices) {
        if (random.chance(0.1)) vertex.z += 0.5f;
      }
    }
    parameters = {to_rigid3f(T_volume_model), to_rigid3f(T_volume_model.inverse()), camera, 0.1f,
                  0.8f};
  }

  Intrinsics camera;
  Pose T_volume_model;
  testing::SurfaceMaps model, live;
  TrackParameters parameters;
};

Image<TrackData> tracked(Backend& backend, const TrackScene& scene) {
  auto rows = backend.make_image<TrackData>(scene.live.vertices.size());
  backend.track(rows, uploaded(backend, scene.live.vertices), uploaded(backend, scene.live.normals),
                uploaded(backend, scene.model.vertices), uploaded(backend, scene.model.normals),
                scene.parameters);
  return downloaded(backend, rows);
}

TEST_P(OpenmpSizes, TrackHasTheSameBits) {
  const TrackScene scene(GetParam());
  expect_the_same_bits([&](Backend& backend) { return tracked(backend, scene); }, "track");
}

void expect_near(const Reduction& found, const Reduction& expected) {
  EXPECT_EQ(found.inliers, expected.inliers);
  EXPECT_EQ(found.too_far, expected.too_far);
  EXPECT_EQ(found.wrong_normal, expected.wrong_normal);
  EXPECT_EQ(found.others, expected.others);
  // Some hundred additions in single precision a lane: relative to the sum of absolute values.
  const double scale = 1e-5 * (static_cast<double>(expected.inliers) + 1e-3);
  EXPECT_NEAR(found.squared_error, expected.squared_error, scale * 0.01);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(found.jt_error[i], expected.jt_error[i], scale * 0.3);
  for (int i = 0; i < 21; ++i) EXPECT_NEAR(found.jt_j[i], expected.jt_j[i], scale * 9);
}

TEST_P(OpenmpSizes, ReduceAgreesAndDoesNotDependOnThreads) {
  SerialBackend serial;
  const Image<TrackData> rows = tracked(serial, TrackScene(GetParam()));
  const Reduction expected = serial.reduce(uploaded(serial, rows));
  OpenmpBackend one_thread(1);
  const Reduction found = one_thread.reduce(uploaded(one_thread, rows));
  expect_near(found, expected);
  for (const int threads : thread_counts) {
    OpenmpBackend openmp(threads);
    const Reduction again = openmp.reduce(uploaded(openmp, rows));
    EXPECT_EQ(std::memcmp(&again, &found, sizeof(found)), 0) << threads << " threads";
  }
}

AlignResult aligned(Backend& backend, const TrackScene& scene, bool fused,
                    Image<TrackData>* rows_out) {
  const auto vertices = uploaded(backend, scene.live.vertices);
  const auto normals = uploaded(backend, scene.live.normals);
  const auto model_vertices = uploaded(backend, scene.model.vertices);
  const auto model_normals = uploaded(backend, scene.model.normals);
  auto rows = backend.make_image<TrackData>(vertices.size);
  AlignInput input;
  input.vertices = {&vertices};
  input.normals = {&normals};
  input.rows = {&rows};
  input.model_vertices = &model_vertices;
  input.model_normals = &model_normals;
  input.iterations = {6};
  input.parameters = scene.parameters;
  input.T_volume_camera = scene.T_volume_model;
  input.keep_rows = true;
  input.fused = fused;
  const AlignResult result = backend.align(input, 1e6);
  *rows_out = downloaded(backend, rows);
  return result;
}

TEST_P(OpenmpSizes, FusedAlignEqualsTheSingleKernels) {
  const TrackScene scene(GetParam());
  OpenmpBackend one_thread(1);
  Image<TrackData> expected_rows, rows;
  const AlignResult expected = aligned(one_thread, scene, false, &expected_rows);
  EXPECT_EQ(expected.iterations, std::vector<int>{6});
  for (const int threads : thread_counts) {
    OpenmpBackend openmp(threads);
    const AlignResult found = aligned(openmp, scene, true, &rows);
    EXPECT_EQ(found.T_volume_camera.matrix(), expected.T_volume_camera.matrix());
    EXPECT_EQ(found.iterations, expected.iterations);
    EXPECT_EQ(std::memcmp(&found.last, &expected.last, sizeof(Reduction)), 0);
    EXPECT_TRUE(same_bits(rows, expected_rows)) << threads << " threads";
  }
}

TEST_P(OpenmpSizes, PicturesHaveTheSameBits) {
  const Size size = GetParam();
  const Image<float> depth = random_depth_m(size, 8, 0.1, 0.1, 5);
  expect_the_same_bits(
      [&](Backend& backend) {
        auto picture = backend.make_image<Rgba8>(size);
        backend.render_depth(picture, uploaded(backend, depth), 0.4f, 4);
        return downloaded(backend, picture);
      },
      "render_depth");
  SerialBackend serial;
  const Image<TrackData> rows = tracked(serial, TrackScene(size));
  expect_the_same_bits(
      [&](Backend& backend) {
        auto picture = backend.make_image<Rgba8>(size);
        backend.render_track(picture, uploaded(backend, rows));
        return downloaded(backend, picture);
      },
      "render_track");
}

INSTANTIATE_TEST_SUITE_P(All, OpenmpSizes, ::testing::ValuesIn(sizes));

TEST(Openmp, OffersEveryKernelOnEveryMap) {
  const OpenmpBackend backend(1);
  for (const KernelInfo& row : kernel_table()) {
    for (const MapInfo& map : map_table()) {
      EXPECT_EQ(backend.supports(row.kernel, map.map), row.kernel != Kernel::acquire) << row.name;
    }
  }
}

}  // namespace
}  // namespace slambench
