// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "backends/registry.h"
#include "kernels/pixel.h"
#include "support/device_images.h"
#include "support/random_images.h"
#include "support/synthetic_scene.h"

namespace slambench {
namespace {

using testing::downloaded;
using testing::uploaded;

class ImageKernels : public ::testing::Test {
 protected:
  DeviceImage<float> gaussian(int radius, float sigma_px) {
    auto weights = backend_->make_image<float>({2 * radius + 1, 1});
    backend_->generate_gaussian(weights, sigma_px);
    return weights;
  }
  std::unique_ptr<Backend> backend_ = create_backend("serial", {});
};

TEST_F(ImageKernels, GenerateGaussianTabulatesFromMinusToPlusTheRadius) {
  const Image<float> weights = downloaded(*backend_, gaussian(2, 4));
  const std::vector<float> expected = {0.8824969f, 0.9692332f, 1, 0.9692332f, 0.8824969f};
  ASSERT_EQ(weights.count(), expected.size());
  for (std::size_t i = 0; i < 5; ++i) EXPECT_FLOAT_EQ(weights.data()[i], expected[i]) << i;
  EXPECT_EQ(downloaded(*backend_, gaussian(0, 4)), Image<float>({1, 1}, 1.0f));
}

// --- mm2meters -----------------------------------------------------------------------------------

TEST_F(ImageKernels, Mm2metersTakesEveryRatioThPixel) {
  Image<std::uint16_t> depth({12, 8});
  for (std::size_t i = 0; i < depth.count(); ++i) depth.data()[i] = static_cast<std::uint16_t>(i);
  const auto device_depth = uploaded(*backend_, depth);
  for (const int ratio : {1, 2, 4}) {
    auto depth_m = backend_->make_image<float>({12 / ratio, 8 / ratio});
    backend_->mm2meters(depth_m, device_depth, 1000);
    const Image<float> meters = downloaded(*backend_, depth_m);
    for (int y = 0; y < 8 / ratio; ++y) {
      for (int x = 0; x < 12 / ratio; ++x) {
        EXPECT_FLOAT_EQ(meters(x, y), static_cast<float>(y * ratio * 12 + x * ratio) / 1000.0f);
      }
    }
  }
}

TEST_F(ImageKernels, Mm2metersKeepsTheWholeRange) {
  Image<std::uint16_t> depth({2, 1});
  depth(1, 0) = 65535;
  auto depth_m = backend_->make_image<float>({2, 1});
  backend_->mm2meters(depth_m, uploaded(*backend_, depth), 5000);
  const Image<float> meters = downloaded(*backend_, depth_m);
  EXPECT_EQ(meters(0, 0), 0.0f);
  EXPECT_FLOAT_EQ(meters(1, 0), 13.107f);
}

TEST_F(ImageKernels, Mm2metersRefusesOtherRatios) {
  const auto depth = uploaded(*backend_, Image<std::uint16_t>({12, 8}));
  for (const Size size : {Size{5, 4}, Size{6, 8}, Size{12, 4}, Size{24, 16}, Size{6, 3}, Size{7, 4},
                          Size{0, 0}, Size{6, 0}}) {
    auto depth_m = backend_->make_image<float>(size);
    EXPECT_THROW(backend_->mm2meters(depth_m, depth, 1000), std::invalid_argument)
        << size.width << "x" << size.height;
  }
}

// --- bilateral_filter ----------------------------------------------------------------------------

TEST_F(ImageKernels, BilateralFilterVisitsEveryPixelOfOddSizes) {
  for (const Size size : {Size{13, 7}, Size{1, 9}, Size{5, 1}}) {
    const Image<float> depth = testing::random_depth_m(size, 5, 0.2, 1.0, 1.4);
    for (const int radius : {1, 2, 4}) {
      const auto weights = gaussian(radius, 3);
      auto filtered = backend_->make_image<float>(size);
      backend_->bilateral_filter(filtered, uploaded(*backend_, depth), weights, 0.25f);
      const Image<float> found = downloaded(*backend_, filtered);
      const Image<float> table = downloaded(*backend_, weights);
      for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
          EXPECT_FLOAT_EQ(found(x, y), bilateral(depth.data(), size, x, y, table.data(), radius,
                                                 1 / (2 * 0.25f * 0.25f)));
        }
      }
    }
  }
}

/// One neighbour, 0.1 m farther: with sigma 0.1 it counts exp(-1/2).
TEST_F(ImageKernels, BilateralFilterTakesTheRangeAsStandardDeviation) {
  Image<float> depth({3, 1}, 1.0f);
  depth(0, 0) = 0;
  depth(2, 0) = 1.1f;
  auto filtered = backend_->make_image<float>({3, 1});
  backend_->bilateral_filter(filtered, uploaded(*backend_, depth), gaussian(1, 1e6f), 0.1f);
  const double weight = std::exp(-0.5);
  EXPECT_NEAR(downloaded(*backend_, filtered)(1, 0), (1 + 1.1 * weight) / (1 + weight), 1e-6);
}

TEST_F(ImageKernels, BilateralFilterRefusesOtherShapes) {
  const auto depth = uploaded(*backend_, Image<float>({4, 3}));
  auto larger = backend_->make_image<float>({5, 3});
  auto same = backend_->make_image<float>({4, 3});
  const auto even = uploaded(*backend_, Image<float>({4, 1}));
  const auto square = uploaded(*backend_, Image<float>({3, 3}));
  EXPECT_THROW(backend_->bilateral_filter(larger, depth, gaussian(2, 4), 0.1f),
               std::invalid_argument);
  EXPECT_THROW(backend_->bilateral_filter(same, depth, even, 0.1f), std::invalid_argument);
  EXPECT_THROW(backend_->bilateral_filter(same, depth, square, 0.1f), std::invalid_argument);
}

// --- half_sample ---------------------------------------------------------------------------------

TEST_F(ImageKernels, HalfSampleRoundsOddSizesDown) {
  const Size size{7, 5};
  const Image<float> depth = testing::random_depth_m(size, 9, 0.1, 1.0, 1.5);
  auto half = backend_->make_image<float>({3, 2});
  backend_->half_sample(half, uploaded(*backend_, depth), 0.3f);
  const Image<float> found = downloaded(*backend_, half);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) {
      float sum = 0, count = 0;
      for (int i = 0; i < 4; ++i) {
        const float value = depth(2 * x + i % 2, 2 * y + i / 2);
        const bool near = std::abs(value - depth(2 * x, 2 * y)) <= 0.3f;
        sum += near ? value : 0;
        count += near ? 1 : 0;
      }
      EXPECT_FLOAT_EQ(found(x, y), sum / count);
    }
  }
}

TEST_F(ImageKernels, HalfSampleRefusesOtherSizes) {
  const auto depth = uploaded(*backend_, Image<float>({7, 5}));
  for (const Size size : {Size{4, 2}, Size{3, 3}, Size{7, 5}, Size{2, 2}}) {
    auto half = backend_->make_image<float>(size);
    EXPECT_THROW(backend_->half_sample(half, depth, 0.3f), std::invalid_argument);
  }
}

// --- depth2vertex, vertex2normal -----------------------------------------------------------------

constexpr Size view{33, 25};
constexpr Intrinsics camera{40, 44, 15.5f, 11.25f};

class Surfaces : public ImageKernels {
 protected:
  void see(const testing::Scene& scene) {
    expected_ = testing::surface_maps_of(scene, Pose::Identity(), camera, view);
    const auto depth =
        uploaded(*backend_, testing::depth_m_of(scene, Pose::Identity(), camera, view));
    auto vertices = backend_->make_image<Float3>(view);
    auto normals = backend_->make_image<Float3>(view);
    backend_->depth2vertex(vertices, depth, camera);
    backend_->vertex2normal(normals, vertices);
    found_ = {downloaded(*backend_, vertices), downloaded(*backend_, normals)};
  }
  testing::SurfaceMaps expected_, found_;
};

TEST_F(Surfaces, OfATiltedPlaneAreExactUpToTheBorders) {
  see(testing::Scene().add_plane({0.3, -0.2, -1}, {0, 0, 2}));
  for (std::size_t i = 0; i < view.count(); ++i) {
    const Float3 gap = found_.vertices.data()[i] - expected_.vertices.data()[i];
    EXPECT_LT(length(gap), 1e-5f);
    EXPECT_LT(length(found_.normals.data()[i] - expected_.normals.data()[i]), 1e-4f);
  }
}

TEST_F(Surfaces, OfASphereFollowItsRadius) {
  see(testing::Scene().add_sphere({0.1, -0.05, 2}, 0.5));
  int inside = 0;
  for (int y = 1; y + 1 < view.height; ++y) {
    for (int x = 1; x + 1 < view.width; ++x) {
      const auto hit = [&](int i, int j) { return expected_.vertices(i, j).z > 0; };
      EXPECT_LT(length(found_.vertices(x, y) - expected_.vertices(x, y)), 1e-5f);
      if (!(hit(x - 1, y) && hit(x + 1, y) && hit(x, y - 1) && hit(x, y + 1))) {
        EXPECT_EQ(found_.normals(x, y), (Float3{invalid_normal, 0, 0}));
      } else if (expected_.normals(x, y).z < -0.7f) {  // away from the rim, where it bends too fast
        ++inside;
        EXPECT_GT(dot(found_.normals(x, y), expected_.normals(x, y)), 0.99f) << x << "," << y;
      }
    }
  }
  EXPECT_GT(inside, 100);
}

TEST_F(Surfaces, RefuseOtherSizes) {
  const auto depth = uploaded(*backend_, Image<float>(view));
  auto vertices = backend_->make_image<Float3>({33, 24});
  EXPECT_THROW(backend_->depth2vertex(vertices, depth, camera), std::invalid_argument);
  auto normals = backend_->make_image<Float3>(view);
  EXPECT_THROW(backend_->vertex2normal(normals, vertices), std::invalid_argument);
}

// --- track, render -------------------------------------------------------------------------------

TEST_F(ImageKernels, TrackRefusesMapsOfOtherSizes) {
  const auto small = uploaded(*backend_, Image<Float3>({4, 3}));
  const auto large = uploaded(*backend_, Image<Float3>({8, 6}));
  auto rows = backend_->make_image<TrackData>({4, 3});
  const TrackParameters parameters{{}, {}, {1, 1, 0, 0}, 0.1f, 0.8f};
  EXPECT_NO_THROW(backend_->track(rows, small, small, large, large, parameters));
  EXPECT_THROW(backend_->track(rows, large, large, large, large, parameters),
               std::invalid_argument);
  EXPECT_THROW(backend_->track(rows, small, large, large, large, parameters),
               std::invalid_argument);
  EXPECT_THROW(backend_->track(rows, small, small, large, small, parameters),
               std::invalid_argument);
}

TEST_F(ImageKernels, RenderDepthColoursEveryPixel) {
  Image<float> depth({4, 2}, 2.5f);
  depth(1, 0) = 0.3f;
  depth(2, 0) = 5;
  depth(3, 1) = 4.5f;
  auto image = backend_->make_image<Rgba8>({4, 2});
  backend_->render_depth(image, uploaded(*backend_, depth), 0.5f, 4.5f);
  Image<Rgba8> expected({4, 2}, Rgba8{64, 191, 64, 255});
  expected(1, 0) = {255, 255, 255, 255};
  expected(2, 0) = {0, 0, 0, 255};
  expected(3, 1) = {64, 64, 191, 255};
  EXPECT_EQ(downloaded(*backend_, image), expected);
}

TEST_F(ImageKernels, RenderTrackColoursEveryPixel) {
  Image<TrackData> rows({3, 2}, TrackData{TrackOutcome::ok});
  rows(1, 0).outcome = TrackOutcome::too_far;
  rows(2, 1).outcome = TrackOutcome::outside_model;
  auto image = backend_->make_image<Rgba8>({3, 2});
  backend_->render_track(image, uploaded(*backend_, rows));
  Image<Rgba8> expected({3, 2}, Rgba8{128, 128, 128, 255});
  expected(1, 0) = {0, 0, 255, 255};
  expected(2, 1) = {255, 0, 0, 255};
  EXPECT_EQ(downloaded(*backend_, image), expected);
}

TEST_F(ImageKernels, RenderingRefusesOtherSizes) {
  auto image = backend_->make_image<Rgba8>({4, 2});
  EXPECT_THROW(backend_->render_depth(image, uploaded(*backend_, Image<float>({4, 3})), 0.4f, 4),
               std::invalid_argument);
  EXPECT_THROW(backend_->render_track(image, uploaded(*backend_, Image<TrackData>({5, 2}))),
               std::invalid_argument);
}

}  // namespace
}  // namespace slambench
