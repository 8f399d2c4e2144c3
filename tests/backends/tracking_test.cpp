// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "backends/registry.h"
#include "core/se3.h"
#include "kernels/pixel.h"
#include "support/device_images.h"
#include "support/random_images.h"
#include "support/synthetic_scene.h"

namespace slambench {
namespace {

using testing::downloaded;
using testing::uploaded;
using Vector6 = Eigen::Matrix<double, 6, 1>;

Twist twist_of(const Vector6& v) {
  Twist twist;
  Eigen::Map<Vector6>(twist.v) = v;
  return twist;
}

/// Packs J^T J and J^T error as the backends do.
Reduction system_of(const Eigen::Matrix<double, 6, 6>& jt_j, const Vector6& jt_error) {
  Reduction reduction;
  double* next = reduction.jt_j;
  for (int row = 0; row < 6; ++row) {
    reduction.jt_error[row] = jt_error(row);
    for (int column = row; column < 6; ++column) *next++ = jt_j(row, column);
  }
  return reduction;
}

class Tracking : public ::testing::Test {
 protected:
  std::unique_ptr<Backend> backend_ = create_backend("serial", {});
};

// --- poses and twists ----------------------------------------------------------------------------

TEST(PoseSteps, KeepTheRowsOfTheRotation) {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(1, 2, 3);
  const Float3 moved_point = to_rigid3f(pose).apply({4, 5, 6});
  EXPECT_FLOAT_EQ(moved_point.x, -4);
  EXPECT_FLOAT_EQ(moved_point.y, 6);
  EXPECT_FLOAT_EQ(moved_point.z, 9);
}

TEST(PoseSteps, MoveInTheVolumesAxes) {
  Pose pose = Pose::Identity();
  pose.translation() = Eigen::Vector3d(1, 0, 0);
  Vector6 quarter_turn = Vector6::Zero();
  quarter_turn(5) = M_PI / 2;
  const Pose turned = moved(pose, twist_of(quarter_turn));
  EXPECT_TRUE(turned.translation().isApprox(Eigen::Vector3d(0, 1, 0), 1e-12));
  EXPECT_TRUE(
      (turned.linear() * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
}

TEST(PoseSteps, MeasureAllSixComponents) {
  Vector6 v;
  v << 1, 2, 2, 4, 2, 2;
  EXPECT_DOUBLE_EQ(norm(twist_of(v)), std::sqrt(33.0));
}

// --- reduce, solve -------------------------------------------------------------------------------

TEST_F(Tracking, ReduceAddsUpEveryRow) {
  Image<TrackData> rows({5, 3});
  double squared_error = 0, cross_term = 0;
  for (std::size_t i = 0; i < rows.count(); ++i) {
    const auto value = static_cast<float>(i);
    rows.data()[i] = {TrackOutcome::ok, value, {1, value, 0, 0, 0, 2}};
    squared_error += static_cast<double>(i * i);
    cross_term += 2.0 * static_cast<double>(i);
  }
  rows(0, 0).outcome = TrackOutcome::too_far;
  rows(4, 2).outcome = TrackOutcome::wrong_normal;
  rows(2, 1).outcome = TrackOutcome::outside_model;
  squared_error -= 14 * 14 + 7 * 7;
  cross_term -= 2 * 14 + 2 * 7;
  const Reduction sum = backend_->reduce(uploaded(*backend_, rows));
  EXPECT_EQ(sum.inliers, 12);
  EXPECT_EQ(sum.too_far, 1);
  EXPECT_EQ(sum.wrong_normal, 1);
  EXPECT_EQ(sum.others, 1);
  EXPECT_DOUBLE_EQ(sum.squared_error, squared_error);
  EXPECT_DOUBLE_EQ(sum.jt_error[1], squared_error);
  EXPECT_DOUBLE_EQ(sum.jt_error[5], cross_term);
  EXPECT_DOUBLE_EQ(sum.jt_j[0], 12);
  EXPECT_DOUBLE_EQ(sum.jt_j[6], squared_error);
  EXPECT_DOUBLE_EQ(sum.jt_j[10], cross_term);
}

TEST_F(Tracking, SolveFindsTheLeastSquaresMotion) {
  testing::Random random(3);
  Eigen::Matrix<double, 20, 6> j;
  for (double& entry : j.reshaped()) entry = random.uniform(-1, 1);
  Vector6 expected;
  expected << 0.01, -0.02, 0.03, -0.004, 0.005, 0.006;
  const Twist twist =
      backend_->solve(system_of(j.transpose() * j, j.transpose() * (j * expected)), 1e6);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(twist.v[i], expected(i), 1e-12) << i;
}

/// What the data does not tell does not move.
TEST_F(Tracking, SolveLeavesUnknownDirectionsAlone) {
  const Vector6 diagonal = (Vector6() << 4, 2, 1, 0, 1e-5, 3).finished();
  const Vector6 jt_error = (Vector6() << 4, 4, 3, 5, 1e-5, 3).finished();
  const Reduction system = system_of(diagonal.asDiagonal(), jt_error);
  const Twist twist = backend_->solve(system, 1e6);
  const Vector6 expected = (Vector6() << 1, 2, 3, 0, 1, 1).finished();
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(twist.v[i], expected(i), 1e-9) << i;
}

TEST_F(Tracking, SolveCutsOffAtTheCondition) {
  const Vector6 diagonal = (Vector6() << 100, 50, 10, 1, 50, 100).finished();
  const Reduction system = system_of(diagonal.asDiagonal(), diagonal);
  EXPECT_NEAR(backend_->solve(system, 101).v[3], 1, 1e-9);
  EXPECT_NEAR(backend_->solve(system, 99).v[3], 0, 1e-9);
  EXPECT_NEAR(backend_->solve(system, 99).v[2], 1, 1e-9);
  EXPECT_NEAR(backend_->solve(system, 9).v[2], 0, 1e-9);
}

TEST_F(Tracking, SolveStandsStillWithoutASystem) {
  EXPECT_EQ(norm(backend_->solve({}, 1e6)), 0);
  Reduction broken = system_of(Eigen::Matrix<double, 6, 6>::Identity(), Vector6::Ones());
  broken.jt_j[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(norm(backend_->solve(broken, 1e6)), 0);
  broken = system_of(Eigen::Matrix<double, 6, 6>::Identity(), Vector6::Ones());
  broken.jt_error[2] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(norm(backend_->solve(broken, 1e6)), 0);
}

// --- track, align --------------------------------------------------------------------------------

constexpr Size finest{80, 60};
constexpr Intrinsics camera{70, 70, 40, 30};

/// A model of the corner of a room seen from one pose, live frames of it seen from another.
class Aligning : public Tracking {
 protected:
  Aligning() {
    T_scene_model_.translation() = Eigen::Vector3d(1, 1, 0);
    const auto model = testing::surface_maps_of(scene_, T_scene_model_, camera, finest);
    model_vertices_ = uploaded(*backend_, model.vertices);
    model_normals_ = uploaded(*backend_, model.normals);
  }

  /// The camera moved by this twist from where the model was seen; the estimate did not.
  void see(const Vector6& motion, std::size_t levels) {
    T_scene_live_ = se3_exp(motion) * T_scene_model_;
    for (std::size_t level = 0; level < levels; ++level) {
      const Size size{finest.width >> level, finest.height >> level};
      const auto live = testing::surface_maps_of(scene_, T_scene_live_,
                                                 camera.divided_by(static_cast<float>(1 << level)),
                                                 size, T_scene_live_.inverse());
      vertices_.push_back(uploaded(*backend_, live.vertices));
      normals_.push_back(uploaded(*backend_, live.normals));
      rows_.push_back(uploaded(*backend_, Image<TrackData>(size)));
    }
  }

  AlignInput input(std::vector<int> iterations, double convergence) {
    AlignInput input = align_input(vertices_, normals_, rows_);
    input.model_vertices = &model_vertices_;
    input.model_normals = &model_normals_;
    input.iterations = std::move(iterations);
    input.parameters = {to_rigid3f(T_scene_model_), to_rigid3f(T_scene_model_.inverse()), camera,
                        0.1f, 0.8f};
    input.T_volume_camera = T_scene_model_;
    input.convergence = convergence;
    return input;
  }

  static double distance(const Pose& a, const Pose& b) { return se3_log(a.inverse() * b).norm(); }

  const testing::Scene scene_ = testing::room_corner(2);
  Pose T_scene_model_ = Pose::Identity(), T_scene_live_ = Pose::Identity();
  DeviceImage<Float3> model_vertices_, model_normals_;
  std::vector<DeviceImage<Float3>> vertices_, normals_;
  std::vector<DeviceImage<TrackData>> rows_;
  const Vector6 motion_ = (Vector6() << 0.02, -0.015, 0.025, 0.01, -0.015, 0.02).finished();
};

TEST_F(Aligning, TrackJudgesEveryPixelByItself) {
  see(motion_, 1);
  Image<Float3> live_normals = downloaded(*backend_, normals_[0]);
  live_normals(3, 5) = {invalid_normal, 0, 0};
  backend_->write(normals_[0], live_normals);
  const TrackParameters parameters = input({1}, 0).parameters;
  backend_->track(rows_[0], vertices_[0], normals_[0], model_vertices_, model_normals_, parameters);

  const Image<TrackData> rows = downloaded(*backend_, rows_[0]);
  const Image<Float3> live = downloaded(*backend_, vertices_[0]);
  const Image<Float3> model = downloaded(*backend_, model_vertices_);
  const Image<Float3> model_normals = downloaded(*backend_, model_normals_);
  int paired = 0;
  for (int y = 0; y < finest.height; ++y) {
    for (int x = 0; x < finest.width; ++x) {
      const TrackData expected = track_point(live(x, y), live_normals(x, y), model.data(),
                                             model_normals.data(), finest, parameters);
      ASSERT_EQ(rows(x, y).outcome, expected.outcome) << x << "," << y;
      ASSERT_EQ(rows(x, y).error, expected.error) << x << "," << y;
      for (int i = 0; i < 6; ++i) ASSERT_EQ(rows(x, y).jacobian[i], expected.jacobian[i]);
      paired += expected.outcome == TrackOutcome::ok ? 1 : 0;
    }
  }
  EXPECT_EQ(rows(3, 5).outcome, TrackOutcome::invalid_input);
  EXPECT_GT(paired, 3000);
}

/// Every level is compared with the full model, so that each alone is exact for planes.
TEST_F(Aligning, FindsAKnownMotionOnEachLevel) {
  see(motion_, 3);
  for (std::size_t level = 0; level < 3; ++level) {
    std::vector<int> iterations(3, 0);
    iterations[level] = 15;
    const AlignResult result = backend_->align(input(iterations, 1e-7), 1e6);
    EXPECT_LT(distance(result.T_volume_camera, T_scene_live_), 1e-4) << "level " << level;
    EXPECT_EQ(result.last_level, static_cast<int>(level));
    EXPECT_LT(result.iterations[level], 15);
    EXPECT_GT(static_cast<double>(result.last.inliers),
              0.7 * static_cast<double>(rows_[level].size.count()));
    EXPECT_LT(std::sqrt(result.last.squared_error / static_cast<double>(result.last.inliers)),
              1e-5);
  }
}

TEST_F(Aligning, StartsWhereItIsTold) {
  see(motion_, 1);
  AlignInput there = input({3}, 1e-3);
  there.T_volume_camera = T_scene_live_;
  const AlignResult result = backend_->align(there, 1e6);
  EXPECT_EQ(result.iterations, std::vector<int>{1});
  EXPECT_LT(distance(result.T_volume_camera, T_scene_live_), 1e-5);
}

TEST_F(Aligning, EndsALevelWhenTheStepIsShort) {
  see(motion_, 1);
  const AlignResult precise = backend_->align(input({15}, 1e-6), 1e6);
  const AlignResult coarse = backend_->align(input({15}, 1e-2), 1e6);
  const AlignResult never = backend_->align(input({15}, 0), 1e6);
  EXPECT_EQ(never.iterations, std::vector<int>{15});
  EXPECT_LT(precise.iterations[0], 15);
  EXPECT_LT(coarse.iterations[0], precise.iterations[0]);
  EXPECT_GE(coarse.iterations[0], 2);  // the first step is as long as the motion: 0.045
  const AlignResult at_once = backend_->align(input({15}, 1), 1e6);
  EXPECT_EQ(at_once.iterations, std::vector<int>{1});
}

/// The step itself decides, and only for its own level.
TEST_F(Aligning, ComparesTheStepsNormWithTheLimit) {
  see(motion_, 2);
  const AlignResult first = backend_->align(input({0, 1}, 0), 1e6);
  const double step = se3_log(first.T_volume_camera * T_scene_model_.inverse()).norm();
  EXPECT_EQ(backend_->align(input({0, 2}, 1.001 * step), 1e6).iterations, (std::vector<int>{0, 1}));
  EXPECT_EQ(backend_->align(input({0, 2}, 0.999 * step), 1e6).iterations, (std::vector<int>{0, 2}));
  EXPECT_EQ(backend_->align(input({3, 3}, 1), 1e6).iterations, (std::vector<int>{1, 1}));
}

TEST_F(Aligning, StepsBeforeItStops) {
  see(motion_, 1);
  const AlignResult result = backend_->align(input({1}, 1), 1e6);
  EXPECT_LT(distance(result.T_volume_camera, T_scene_live_), 0.2 * motion_.norm());
}

class Listener : public Observer {
 public:
  void stage_begin(Stage) override {}
  void stage_end(Stage) override {}
  void in_one_go_begin() override {}
  void in_one_go_end() override {}
  void kernel_begin(Kernel kernel) override { kernels.push_back(kernel); }
  void kernel_end(Kernel) override { ++ended; }
  void kernel_measured(Kernel, double) override { ADD_FAILURE() << "serial has no device clock"; }
  void transfer_measured(Transfer, std::size_t, double) override { ADD_FAILURE(); }
  std::vector<Kernel> kernels;
  std::size_t ended = 0;
};

TEST_F(Aligning, RunsFromTheCoarsestLevelAndSkipsEmptyOnes) {
  see(motion_, 3);
  const AlignResult result = backend_->align(input({2, 0, 1}, 0), 1e6);
  EXPECT_EQ(result.iterations, (std::vector<int>{2, 0, 1}));
  EXPECT_EQ(result.last_level, 0);
  // Level 1 did not run: its rows are as they were made.
  for (const TrackData& row : downloaded(*backend_, rows_[1])) {
    ASSERT_EQ(row.outcome, TrackOutcome::invalid_input);
  }
  const Reduction last = backend_->reduce(rows_[0]);
  EXPECT_EQ(last.inliers, result.last.inliers);
  EXPECT_EQ(last.squared_error, result.last.squared_error);
  // The coarsest ran first, from the start: its last error is far above the finest's.
  const Reduction coarse = backend_->reduce(rows_[2]);
  EXPECT_GT(coarse.squared_error / static_cast<double>(coarse.inliers),
            last.squared_error / static_cast<double>(last.inliers));
}

TEST_F(Aligning, DoesNothingWithoutIterations) {
  see(motion_, 2);
  const AlignResult result = backend_->align(input({0, 0}, 1e-5), 1e6);
  EXPECT_EQ(result.iterations, (std::vector<int>{0, 0}));
  EXPECT_EQ(result.last.inliers, 0);
  EXPECT_TRUE(result.T_volume_camera.isApprox(T_scene_model_, 0));
}

TEST_F(Aligning, ReportsItsThreeKernelsInTurn) {
  see(motion_, 2);
  Listener listener;
  backend_->observe(&listener);
  backend_->align(input({1, 1}, 0), 1e6);
  backend_->observe(nullptr);
  EXPECT_EQ(listener.kernels, (std::vector<Kernel>{Kernel::track, Kernel::reduce, Kernel::solve,
                                                   Kernel::track, Kernel::reduce, Kernel::solve}));
  EXPECT_EQ(listener.ended, 6u);
}

TEST_F(Aligning, RefusesLevelsThatDoNotFit) {
  see(motion_, 2);
  EXPECT_THROW(backend_->align(input({1}, 0), 1e6), std::invalid_argument);
  EXPECT_THROW(backend_->align(input({1, 1, 1}, 0), 1e6), std::invalid_argument);
  AlignInput broken = input({1, 1}, 0);
  broken.model_vertices = nullptr;
  EXPECT_THROW(backend_->align(broken, 1e6), std::invalid_argument);
  broken = input({1, 1}, 0);
  broken.model_normals = nullptr;
  EXPECT_THROW(backend_->align(broken, 1e6), std::invalid_argument);
  broken = input({1, 1}, 0);
  broken.vertices.pop_back();
  EXPECT_THROW(backend_->align(broken, 1e6), std::invalid_argument);
  broken = input({1, 1}, 0);
  broken.normals.pop_back();
  EXPECT_THROW(backend_->align(broken, 1e6), std::invalid_argument);
  broken = input({1, 1}, 0);
  broken.rows.pop_back();
  EXPECT_THROW(backend_->align(broken, 1e6), std::invalid_argument);
  EXPECT_THROW(backend_->align(AlignInput{}, 1e6), std::invalid_argument);
}

}  // namespace
}  // namespace slambench
