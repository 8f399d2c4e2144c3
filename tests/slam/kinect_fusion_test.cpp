// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "slam/kinect_fusion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/se3.h"
#include "slam/recording_backend.h"
#include "support/temporary_folder.h"

/// What the pipeline asks of its backend, and what it makes of the answers.
namespace slambench {
namespace {

constexpr Size input{48, 32};
constexpr Intrinsics camera{40, 44, 24, 16};

class Pipeline : public ::testing::Test {
 protected:
  Pipeline() {
    p_.volume_resolution = {16, 8, 12};
    p_.volume_size_m = {2, 3, 4};
    p_.pyramid_levels = {3, 2, 1};
    answer(true, 0.01, 0.5);
  }

  KinectFusion make() { return {backend_, p_, input, camera, 1000, nullptr}; }

  /// The next alignments give this pose (or another), error and share of full-size pixels.
  void answer(bool finite, double residual_m, double fraction, int level = 0, Size size = input) {
    AlignResult& a = backend_.answer;
    a.T_volume_camera = answered_pose();
    if (!finite) a.T_volume_camera.translation().x() = std::nan("");
    a.last.inliers = std::llround(fraction * static_cast<double>(size.count()));
    a.last.squared_error = residual_m * residual_m * static_cast<double>(a.last.inliers);
    a.last_level = level;
    a.iterations = {3, 2, 1};
  }
  static Pose answered_pose() {
    Eigen::Matrix<double, 6, 1> xi;
    xi << 1.1, 1.6, 0.3, 0.1, -0.2, 0.3;
    return se3_exp(xi);
  }

  FrameResult process(KinectFusion& fusion) {
    Frame frame;
    frame.depth = Image<std::uint16_t>(input);
    return fusion.process(frame);
  }
  /// The first tracked frame's result, after the four that are not.
  FrameResult process_fifth(KinectFusion& fusion) {
    for (int i = 0; i < 4; ++i) process(fusion);
    return process(fusion);
  }
  bool tracks() {
    KinectFusion fusion = make();
    return process_fifth(fusion).tracked;
  }

  testing::RecordingBackend backend_;
  KinectFusionParameters p_;
};

void expect_translation(const Rigid3f& transform, const Eigen::Vector3d& expected) {
  EXPECT_NEAR(transform.translation.x, expected.x(), 1e-6);
  EXPECT_NEAR(transform.translation.y, expected.y(), 1e-6);
  EXPECT_NEAR(transform.translation.z, expected.z(), 1e-6);
}

// --- what is asked -------------------------------------------------------------------------------

TEST_F(Pipeline, MakesVolumeAndWeightsAsConfigured) {
  p_.bilateral_radius_px = 3;
  p_.bilateral_sigma_px = 5;
  const KinectFusion fusion = make();
  EXPECT_EQ(backend_.made.resolution, (Int3{16, 8, 12}));
  EXPECT_EQ(backend_.made.size_m, (Float3{2, 3, 4}));
  EXPECT_EQ(backend_.gaussian_size, (Size{7, 1}));
  EXPECT_EQ(backend_.gaussian_sigma_px, 5.0f);
  EXPECT_EQ(fusion.map_bytes(), 16u * 8 * 12 * 4);
}

TEST_F(Pipeline, TakesBricksOnlyWhereTheBackendHasThem) {
  p_.map = "auto";
  make();
  EXPECT_EQ(backend_.made.map, MapKind::bricks);
  backend_.maps = {MapKind::grid};
  make();
  EXPECT_EQ(backend_.made.map, MapKind::grid);
}

TEST_F(Pipeline, PreprocessesWithTheSensorsScaleAndTheRange) {
  p_.bilateral_range_sigma_m = 0.25;
  KinectFusion fusion(backend_, p_, input, camera, 5000, nullptr);
  process(fusion);
  EXPECT_EQ(backend_.units_per_m, 5000.0f);
  EXPECT_EQ(backend_.range_sigma_m, 0.25f);
}

TEST_F(Pipeline, BuildsThePyramidOverTheComputationSize) {
  p_.compute_size_ratio = 2;
  p_.half_sample_range_m = 0.7;
  KinectFusion fusion = make();
  process_fifth(fusion);
  EXPECT_EQ(backend_.half_sizes, (std::vector<Size>{{12, 8}, {6, 4}}));
  EXPECT_EQ(backend_.half_ranges_m, (std::vector<float>{0.7f, 0.7f}));
  EXPECT_EQ(backend_.level_cameras,
            (std::vector<Intrinsics>{{20, 22, 12, 8}, {10, 11, 6, 4}, {5, 5.5f, 3, 2}}));
}

TEST_F(Pipeline, AlignsWithTheConfiguredThresholds) {
  p_.icp_distance_threshold_m = 0.3;
  p_.icp_normal_threshold = 0.6;
  p_.icp_threshold = 1e-3;
  p_.solve_condition = 123;
  p_.init_pose = {0.25, 0.5, 0.75};
  KinectFusion fusion = make();
  process_fifth(fusion);
  ASSERT_TRUE(backend_.align_input.has_value());
  const AlignInput& asked = *backend_.align_input;
  EXPECT_EQ(asked.iterations, (std::vector<int>{3, 2, 1}));
  EXPECT_EQ(asked.convergence, 1e-3);
  EXPECT_EQ(backend_.condition, 123);
  EXPECT_EQ(asked.parameters.distance_threshold_m, 0.3f);
  EXPECT_EQ(asked.parameters.normal_threshold, 0.6f);
  EXPECT_EQ(asked.parameters.model_camera, camera);
  EXPECT_TRUE(asked.keep_rows);
  ASSERT_EQ(asked.vertices.size(), 3u);
  ASSERT_EQ(asked.normals.size(), 3u);
  ASSERT_EQ(asked.rows.size(), 3u);
  EXPECT_TRUE(asked.T_volume_camera.translation().isApprox(Eigen::Vector3d(0.5, 1.5, 3)));
  expect_translation(asked.parameters.T_volume_camera, {0.5, 1.5, 3});
  expect_translation(asked.parameters.T_model_volume, {-0.5, -1.5, -3});
}

/// The model is where it was raycast from: the pose of the frame before.
TEST_F(Pipeline, AlignsAgainstTheLastModel) {
  KinectFusion fusion = make();
  process_fifth(fusion);
  process(fusion);
  const Pose expected = answered_pose().inverse();
  const Float3 found = backend_.align_input->parameters.T_model_volume.apply({1, 2, 3});
  const Eigen::Vector3d wanted = expected * Eigen::Vector3d(1, 2, 3);
  EXPECT_NEAR(found.x, wanted.x(), 1e-6);
  EXPECT_NEAR(found.y, wanted.y(), 1e-6);
  EXPECT_NEAR(found.z, wanted.z(), 1e-6);
  EXPECT_TRUE(backend_.align_input->T_volume_camera.isApprox(answered_pose()));
}

TEST_F(Pipeline, IntegratesAsConfigured) {
  p_.mu_m = 0.2;
  p_.max_weight = 50;
  p_.integrate_min_depth_m = 0.01;
  p_.init_pose = {0.25, 0.5, 0.75};
  p_.compute_size_ratio = 4;
  KinectFusion fusion = make();
  process(fusion);
  ASSERT_TRUE(backend_.integrated.has_value());
  EXPECT_EQ(backend_.integrated->mu_m, 0.2f);
  EXPECT_EQ(backend_.integrated->max_weight, 50.0f);
  EXPECT_EQ(backend_.integrated->min_depth_m, 0.01f);
  EXPECT_EQ(backend_.integrated->camera, (Intrinsics{10, 11, 6, 4}));
  expect_translation(backend_.integrated->T_camera_volume, {-0.5, -1.5, -3});
}

TEST_F(Pipeline, IntegratesTheUnfilteredDepth) {
  KinectFusion fusion = make();
  process(fusion);
  ASSERT_NE(backend_.integrated_depth, nullptr);
  EXPECT_EQ(backend_.integrated_depth, backend_.metric_depth);
}

TEST_F(Pipeline, IntegratesAtTheTrackedPose) {
  KinectFusion fusion = make();
  process_fifth(fusion);
  expect_translation(backend_.integrated->T_camera_volume, answered_pose().inverse().translation());
}

/// Small steps are the smallest edge over the largest resolution: 2 m / 16, times the factor.
TEST_F(Pipeline, RaycastsAsConfigured) {
  p_.near_m = 0.5;
  p_.far_m = 3;
  p_.mu_m = 0.2;
  p_.raycast_large_step = 0.5;
  p_.raycast_small_step = 2;
  p_.raycast_slow_below = 0.6;
  KinectFusion fusion = make();
  process_fifth(fusion);
  ASSERT_TRUE(backend_.raycasted.has_value());
  EXPECT_EQ(backend_.raycasted->near_m, 0.5f);
  EXPECT_EQ(backend_.raycasted->far_m, 3.0f);
  EXPECT_FLOAT_EQ(backend_.raycasted->large_step_m, 0.1f);
  EXPECT_FLOAT_EQ(backend_.raycasted->small_step_m, 0.25f);
  EXPECT_EQ(backend_.raycasted->slow_below, 0.6f);
  EXPECT_EQ(backend_.raycasted->camera, camera);
  expect_translation(backend_.raycasted->T_volume_camera, answered_pose().translation());
}

TEST_F(Pipeline, RendersAsConfigured) {
  p_.near_m = 0.5;
  p_.far_m = 3;
  p_.render_far_factor = 1.5;
  p_.light_m = {1, 2, 3};
  p_.light_frame = "volume";
  p_.ambient = 0.3;
  KinectFusion fusion = make();
  process(fusion);
  fusion.render();
  EXPECT_EQ(backend_.render_near_m, 0.5f);
  EXPECT_EQ(backend_.render_far_m, 3.0f);
  ASSERT_TRUE(backend_.rendered.has_value());
  EXPECT_EQ(backend_.rendered->near_m, 0.5f);
  EXPECT_EQ(backend_.rendered->far_m, 4.5f);
  EXPECT_EQ(backend_.shading.light_m, (Float3{1, 2, 3}));
  EXPECT_EQ(backend_.shading.ambient, 0.3f);
}

TEST_F(Pipeline, TheLightMovesWithTheCameraWhereItIsToldTo) {
  p_.light_m = {1, 2, 3};
  p_.light_frame = "camera";
  KinectFusion fusion = make();
  process_fifth(fusion);
  fusion.render();
  const Eigen::Vector3d light = answered_pose() * Eigen::Vector3d(1, 2, 3);
  EXPECT_NEAR(backend_.shading.light_m.x, light.x(), 1e-5);
  EXPECT_NEAR(backend_.shading.light_m.y, light.y(), 1e-5);
  EXPECT_NEAR(backend_.shading.light_m.z, light.z(), 1e-5);
}

/// Published defaults: ambient 0.1, twice the far plane, steps 0.075 m and 2/256.
TEST_F(Pipeline, AsksWithThePublishedDefaults) {
  p_ = {};
  p_.volume_resolution = {16, 8, 12};
  KinectFusion fusion = make();
  process_fifth(fusion);
  fusion.render();
  EXPECT_EQ(backend_.gaussian_size, (Size{5, 1}));
  EXPECT_EQ(backend_.align_input->iterations, (std::vector<int>{10, 5, 4}));
  EXPECT_EQ(backend_.condition, 1e6);
  EXPECT_FLOAT_EQ(backend_.raycasted->large_step_m, 0.075f);
  EXPECT_FLOAT_EQ(backend_.raycasted->small_step_m, 0.125f);
  EXPECT_EQ(backend_.rendered->far_m, 8.0f);
}

// --- when ----------------------------------------------------------------------------------------

TEST_F(Pipeline, TheFirstFourFramesAreIntegratedUntracked) {
  KinectFusion fusion = make();
  for (int frame = 0; frame < 4; ++frame) {
    const FrameResult result = process(fusion);
    EXPECT_FALSE(result.tracked) << frame;
    EXPECT_TRUE(result.integrated) << frame;
    EXPECT_TRUE(result.T_start_camera.isApprox(Pose::Identity())) << frame;
    EXPECT_TRUE(result.iterations.empty());
    EXPECT_EQ(result.inliers, 0u);
    EXPECT_EQ(backend_.integrations, frame + 1);
    EXPECT_EQ(backend_.raycasts, frame == 3 ? 1 : 0);
    EXPECT_FALSE(backend_.align_input.has_value());
  }
  EXPECT_TRUE(process(fusion).tracked);
  EXPECT_EQ(backend_.raycasts, 2);
}

TEST_F(Pipeline, BootstrapFramesAreConfigured) {
  p_.bootstrap_frames = 1;
  KinectFusion fusion = make();
  EXPECT_TRUE(process(fusion).integrated);
  EXPECT_EQ(backend_.raycasts, 1);
  EXPECT_TRUE(process(fusion).tracked);
}

std::string pattern(int frames, const std::function<bool(int)>& f) {
  std::string text;
  for (int i = 0; i < frames; ++i) text += f(i) ? '1' : '0';
  return text;
}

TEST_F(Pipeline, IntegratesEveryRatesFrame) {
  for (const auto& [rate, expected] : std::vector<std::pair<int, std::string>>{
           {1, "111111111111"}, {2, "111110101010"}, {3, "111100100100"}}) {
    p_.integration_rate = rate;
    KinectFusion fusion = make();
    EXPECT_EQ(pattern(12, [&](int) { return process(fusion).integrated; }), expected) << rate;
  }
}

TEST_F(Pipeline, TracksEveryRatesFrame) {
  for (const auto& [rate, expected] : std::vector<std::pair<int, std::string>>{
           {1, "000011111111"}, {2, "000010101010"}, {3, "000000100100"}}) {
    p_.tracking_rate = rate;
    p_.integration_rate = 1;
    KinectFusion fusion = make();
    std::string integrated;
    EXPECT_EQ(pattern(12,
                      [&](int frame) {
                        const FrameResult result = process(fusion);
                        if (frame >= 4) integrated += result.integrated ? '1' : '0';
                        return result.tracked;
                      }),
              expected)
        << rate;
    EXPECT_EQ(integrated, expected.substr(4)) << "only what is tracked is integrated";
  }
}

TEST_F(Pipeline, DrawsTheVolumeFromTheRaycastOnlyWhenKernelsMayShareWork) {
  p_.rendering_rate = 1;
  p_.bootstrap_frames = 2;
  for (const bool fused : {false, true}) {
    p_.fused = fused;
    KinectFusion fusion = make();
    for (int i = 0; i < 3; ++i) {
      process(fusion);
      fusion.render();
    }
    if (!fused) {
      EXPECT_TRUE(backend_.seen.empty());
    }
  }
  ASSERT_EQ(backend_.seen.size(), 2u) << "there is no raycast of the first frame";
  EXPECT_EQ(backend_.seen.back().view.T_volume_camera.translation,
            backend_.raycasted->T_volume_camera.translation);
  EXPECT_EQ(backend_.seen.back().view.far_m, backend_.raycasted->far_m);
}

TEST_F(Pipeline, DrawsTheVolumeEveryRatesFrame) {
  for (const auto& [rate, expected] : std::vector<std::pair<int, std::string>>{
           {1, "111111111"}, {2, "101010101"}, {4, "100010001"}}) {
    p_.rendering_rate = rate;
    KinectFusion fusion = make();
    EXPECT_EQ(pattern(9,
                      [&](int) {
                        process(fusion);
                        const int before = backend_.volume_pictures;
                        fusion.render();
                        return backend_.volume_pictures > before;
                      }),
              expected)
        << rate;
  }
}

// --- what is made of the answer ------------------------------------------------------------------

TEST_F(Pipeline, ReportsTheAlignmentAndThePoseFromTheStart) {
  p_.init_pose = {0.25, 0.5, 0.75};
  KinectFusion fusion = make();
  const FrameResult result = process_fifth(fusion);
  EXPECT_TRUE(result.tracked);
  EXPECT_EQ(result.iterations, (std::vector<int>{3, 2, 1}));
  EXPECT_EQ(result.inliers, input.count() / 2);
  EXPECT_DOUBLE_EQ(result.inlier_fraction, 0.5);
  EXPECT_NEAR(result.residual_m, 0.01, 1e-12);
  Pose expected = answered_pose();
  expected.translation() -= Eigen::Vector3d(0.5, 1.5, 3);
  EXPECT_TRUE(result.T_start_camera.isApprox(expected, 1e-12));
}

TEST_F(Pipeline, ALostFrameKeepsThePoseAndIsNotIntegrated) {
  KinectFusion fusion = make();
  process_fifth(fusion);
  const Pose before = process(fusion).T_start_camera;
  backend_.answer.T_volume_camera.translation().x() += 1;
  backend_.answer.last.inliers = 0;
  process(fusion);
  const FrameResult lost = process(fusion);  // frame 7
  EXPECT_FALSE(lost.tracked);
  EXPECT_FALSE(lost.integrated);
  EXPECT_TRUE(lost.T_start_camera.isApprox(before, 0));
  const int integrations = backend_.integrations;
  EXPECT_FALSE(process(fusion).integrated);  // frame 8 would be due
  EXPECT_EQ(backend_.integrations, integrations);
  answer(true, 0.01, 0.5);
  EXPECT_FALSE(process(fusion).integrated);
  EXPECT_TRUE(process(fusion).integrated) << "it goes on when it is found again";
}

/// The model is still raycast while lost, from the pose that is kept.
TEST_F(Pipeline, ALostFrameIsRaycastNonetheless) {
  KinectFusion fusion = make();
  process_fifth(fusion);
  const int before = backend_.raycasts;
  backend_.answer.last.inliers = 0;
  process(fusion);
  EXPECT_EQ(backend_.raycasts, before + 1);
}

TEST_F(Pipeline, IsLostWhenTheErrorIsLarge) {
  p_.tracked_residual_m = 0.125;
  answer(true, 0.125, 0.5);
  EXPECT_TRUE(tracks());
  answer(true, 0.1251, 0.5);
  EXPECT_FALSE(tracks());
}

TEST_F(Pipeline, IsLostWhenFewPixelsAgree) {
  p_.tracked_fraction = 0.25;
  answer(true, 0.01, 0.25);
  EXPECT_TRUE(tracks());
  backend_.answer.last.inliers -= 1;
  EXPECT_FALSE(tracks());
  p_.tracked_fraction = 0;
  backend_.answer.last.inliers = 0;
  EXPECT_FALSE(tracks());
}

TEST_F(Pipeline, JudgesWithThePublishedLimits) {
  answer(true, 0.0199, 0.16);
  EXPECT_TRUE(tracks());
  answer(true, 0.0201, 0.16);
  EXPECT_FALSE(tracks());
  answer(true, 0.0199, 0.14);
  EXPECT_FALSE(tracks());
}

TEST_F(Pipeline, IsLostWhenThePoseIsNotANumber) {
  answer(false, 0.01, 0.5);
  EXPECT_FALSE(tracks());
}

/// Without iterations on the finest level, a quarter of the pixels is all there is.
TEST_F(Pipeline, JudgesByTheLevelThatRanLast) {
  p_.pyramid_levels = {0, 5, 4};
  answer(true, 0.01, 0.2, 1, {24, 16});
  KinectFusion fusion = make();
  const FrameResult result = process_fifth(fusion);
  EXPECT_TRUE(result.tracked);
  EXPECT_NEAR(result.inlier_fraction, 0.2, 0.002);
}

// --- what does not fit together ------------------------------------------------------------------

TEST_F(Pipeline, RefusesARatioThatDoesNotDivide) {
  for (const int ratio : {5, 3, 32}) {  // neither, width only, height only
    p_.compute_size_ratio = ratio;
    const std::string message = testing::message_of<UsageError>([&] { make(); });
    EXPECT_EQ(message, "--compute-size-ratio: found " + std::to_string(ratio) +
                           ", expected a divisor of the input's 48x32 pixels");
  }
  p_.compute_size_ratio = 8;
  EXPECT_NO_THROW(make());
}

TEST_F(Pipeline, RefusesMoreLevelsThanTheImageHas) {
  p_.pyramid_levels = std::vector<int>(6, 1);  // 48x32, 24x16, 12x8, 6x4, 3x2, 1x1
  EXPECT_NO_THROW(make());
  p_.pyramid_levels.push_back(1);
  EXPECT_EQ(testing::message_of<UsageError>([&] { make(); }),
            "--pyramid-levels: found 7 levels, expected at most 6 for 48x32");
}

TEST_F(Pipeline, RefusesAMapThatDoesNotExist) {
  p_.map = "octree";
  EXPECT_THROW(make(), UsageError);
}

TEST_F(Pipeline, NeedsEveryKernelButTheFusedOnes) {
  for (const KernelInfo& row : kernel_table()) {
    backend_.missing = {row.kernel};
    if (row.kernel == Kernel::acquire || row.kernel == Kernel::align) {
      EXPECT_NO_THROW(make()) << row.name;
      continue;
    }
    const std::string message = testing::message_of<UnavailableError>([&] { make(); });
    EXPECT_NE(message.find(row.name), std::string::npos) << message;
  }
}

TEST_F(Pipeline, RefusesAVolumeBeyondTheMemory) {
  p_.volume_resolution = {4096, 4096, 4096};
  EXPECT_THROW(make(), UnavailableError);
}

TEST_F(Pipeline, RefusesFramesOfAnotherSize) {
  KinectFusion fusion = make();
  Frame frame;
  frame.depth = Image<std::uint16_t>({47, 32});
  EXPECT_THROW(fusion.process(frame), std::invalid_argument);
}

// --- in one go -----------------------------------------------------------------------------------

class InOneGo : public Pipeline {
 protected:
  InOneGo() {
    p_.fused = true;
    backend_.in_one_go = true;
  }
  bool advanced(KinectFusion& fusion) {
    backend_.advance_input.reset();
    process(fusion);
    return backend_.advance_input.has_value();
  }
};

TEST_F(InOneGo, TracksFramesBehindTheFirst) {
  KinectFusion fusion = make();
  EXPECT_EQ(pattern(8, [&](int) { return advanced(fusion); }), "00001111");
  EXPECT_FALSE(backend_.align_input.has_value());
  EXPECT_EQ(backend_.raycasts, 1) << "of the last frame before";
  EXPECT_EQ(backend_.integrations, 4);
}

TEST_F(InOneGo, OnlyWhereItIsAskedForAndOffered) {
  backend_.in_one_go = false;
  KinectFusion without = make();
  EXPECT_EQ(pattern(6, [&](int) { return advanced(without); }), "000000");
  backend_.in_one_go = true;
  p_.fused = false;
  KinectFusion singly = make();
  EXPECT_EQ(pattern(6, [&](int) { return advanced(singly); }), "000000");
}

TEST_F(InOneGo, LeavesFramesThatAreNotTrackedToTheSingleSteps) {
  p_.tracking_rate = 3;
  KinectFusion fusion = make();
  EXPECT_EQ(pattern(10, [&](int) { return advanced(fusion); }), "0000001001");
  EXPECT_EQ(backend_.raycasts, 5);
}

TEST_F(InOneGo, AsksAsConfigured) {
  p_.tracked_residual_m = 0.125;
  p_.tracked_fraction = 0.25;
  p_.solve_condition = 123;
  p_.mu_m = 0.2;
  p_.far_m = 3;
  p_.init_pose = {0.25, 0.5, 0.75};
  KinectFusion fusion = make();
  process_fifth(fusion);
  ASSERT_TRUE(backend_.advance_input.has_value());
  const AdvanceInput& asked = *backend_.advance_input;
  EXPECT_EQ(asked.limits.residual_m, 0.125);
  EXPECT_EQ(asked.limits.inlier_fraction, 0.25);
  EXPECT_EQ(asked.condition, 123);
  EXPECT_EQ(asked.align.iterations, (std::vector<int>{3, 2, 1}));
  EXPECT_TRUE(asked.align.keep_rows);
  EXPECT_TRUE(asked.align.T_volume_camera.translation().isApprox(Eigen::Vector3d(0.5, 1.5, 3)));
  EXPECT_EQ(asked.depth_m, backend_.metric_depth);
  EXPECT_EQ(asked.model_vertices, asked.align.model_vertices);
  EXPECT_EQ(asked.model_normals, asked.align.model_normals);
  EXPECT_EQ(asked.volume->resolution, (Int3{16, 8, 12}));
  ASSERT_TRUE(asked.integrate.has_value());
  EXPECT_EQ(asked.integrate->mu_m, 0.2f);
  EXPECT_EQ(asked.raycast.far_m, 3.0f);
}

TEST_F(InOneGo, IntegratesEveryRatesFrame) {
  p_.integration_rate = 3;
  KinectFusion fusion = make();
  EXPECT_EQ(pattern(10,
                    [&](int) {
                      const bool integrated = process(fusion).integrated;
                      const auto& asked = backend_.advance_input;
                      EXPECT_TRUE(!asked || asked->integrate.has_value() == integrated);
                      return integrated;
                    }),
            "1111001001");
}

TEST_F(InOneGo, GoesOnFromTheAlignedPose) {
  KinectFusion fusion = make();
  const FrameResult result = process_fifth(fusion);
  EXPECT_TRUE(result.tracked);
  EXPECT_TRUE(result.integrated);
  EXPECT_EQ(result.iterations, (std::vector<int>{3, 2, 1}));
  EXPECT_EQ(result.inliers, input.count() / 2);
  EXPECT_DOUBLE_EQ(result.inlier_fraction, 0.5);
  EXPECT_NEAR(result.residual_m, 0.01, 1e-12);
  process(fusion);
  const AlignInput& asked = backend_.advance_input->align;
  EXPECT_TRUE(asked.T_volume_camera.isApprox(answered_pose()));
  expect_translation(asked.parameters.T_model_volume, answered_pose().inverse().translation());
}

/// Whatever the figures say: the kernels behind the alignment have gone by the same word.
TEST_F(InOneGo, TakesTheBackendsWordForALostFrame) {
  KinectFusion fusion = make();
  const Pose before = process_fifth(fusion).T_start_camera;
  backend_.answer.T_volume_camera.translation().x() += 1;
  backend_.believed = false;
  process(fusion);
  const FrameResult lost = process(fusion);
  EXPECT_FALSE(lost.tracked);
  EXPECT_FALSE(lost.integrated);
  EXPECT_TRUE(lost.T_start_camera.isApprox(before, 0));
  EXPECT_EQ(lost.inliers, input.count() / 2);
  backend_.believed = true;
  process(fusion);
  EXPECT_TRUE(process(fusion).integrated) << "it goes on when it is found again";
}

TEST_F(InOneGo, DoesNotWaitItself) {
  KinectFusion fusion = make();
  process_fifth(fusion);
  backend_.finished = 0;
  process(fusion);
  EXPECT_EQ(backend_.finished, 0) << "advance has waited";
  fusion.render();
  EXPECT_EQ(backend_.finished, 1);
}

// --- what it tells -------------------------------------------------------------------------------

class Journal : public Observer {
 public:
  void stage_begin(Stage stage) override { text_ += "(" + std::string(name(stage)) + ":"; }
  void stage_end(Stage) override { text_ += ")"; }
  void in_one_go_begin() override { text_ += "[in one go:"; }
  void in_one_go_end() override { text_ += "]"; }
  void kernel_begin(Kernel kernel) override { text_ += " " + std::string(name(kernel)); }
  void kernel_end(Kernel) override { text_ += "."; }
  void kernel_measured(Kernel, double) override { text_ += " measured"; }
  void transfer_measured(Transfer, std::size_t, double) override { text_ += " transfer"; }
  std::string take() { return std::exchange(text_, {}); }

 private:
  std::string text_;
};

TEST_F(Pipeline, TellsStagesAndKernelsInTheirOrder) {
  Journal journal;
  backend_.observe(&journal);
  p_.pyramid_levels = {3, 2};
  KinectFusion fusion(backend_, p_, input, camera, 1000, &journal);
  EXPECT_EQ(journal.take(), "(init: generate_gaussian. init_volume.)");
  const std::string preprocess = "(preprocess: mm2meters. bilateral_filter.)";
  const std::string integrate = "(integrate: integrate.)", raycast = "(raycast: raycast.)";
  for (int frame = 0; frame < 3; ++frame) {
    process(fusion);
    EXPECT_EQ(journal.take(), preprocess + integrate) << frame;
  }
  process(fusion);
  EXPECT_EQ(journal.take(), preprocess + integrate + raycast);
  const std::string track =
      "(track: depth2vertex. vertex2normal. half_sample. depth2vertex. vertex2normal.)";
  process(fusion);
  EXPECT_EQ(journal.take(), preprocess + track + integrate + raycast);
  process(fusion);
  EXPECT_EQ(journal.take(), preprocess + track + raycast);
  fusion.render();
  EXPECT_EQ(journal.take(), "(render: render_depth. render_track.)");
  for (int frame = 6; frame < 9; ++frame) process(fusion);
  journal.take();
  fusion.render();
  EXPECT_EQ(journal.take(), "(render: render_depth. render_track. render_volume.)");
  backend_.observe(nullptr);
}

TEST_F(InOneGo, TellsOfNoStageOfTheComputation) {
  Journal journal;
  backend_.observe(&journal);
  p_.pyramid_levels = {3};
  KinectFusion fusion(backend_, p_, input, camera, 1000, &journal);
  for (int frame = 0; frame < 4; ++frame) process(fusion);
  journal.take();
  process(fusion);
  EXPECT_EQ(journal.take(),
            "[in one go: mm2meters. bilateral_filter. depth2vertex. vertex2normal.]");
  backend_.observe(nullptr);
}

/// Times of asynchronous kernels belong to their stage: each stage waits at its end.
TEST_F(Pipeline, WaitsAtTheEndOfEveryStage) {
  KinectFusion fusion = make();
  EXPECT_EQ(backend_.finished, 1);  // init
  process(fusion);
  EXPECT_EQ(backend_.finished, 3);  // preprocess, integrate
  for (int i = 0; i < 3; ++i) process(fusion);
  backend_.finished = 0;
  process(fusion);
  EXPECT_EQ(backend_.finished, 4);  // preprocess, track, integrate, raycast
  fusion.render();
  EXPECT_EQ(backend_.finished, 5);
}

TEST_F(Pipeline, PicturesAreBlackBeforeTheFirst) {
  KinectFusion fusion = make();
  const Pictures pictures = fusion.pictures();
  const Image<Rgba8> black(input, Rgba8{0, 0, 0, 255});
  EXPECT_EQ(pictures.depth, black);
  EXPECT_EQ(pictures.track, black);
  EXPECT_EQ(pictures.volume, black);
}

}  // namespace
}  // namespace slambench
