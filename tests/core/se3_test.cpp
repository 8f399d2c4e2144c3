// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "core/se3.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random_images.h"

namespace slambench {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

Vector6 twist(double x, double y, double z, double a, double b, double c) {
  return (Vector6() << x, y, z, a, b, c).finished();
}

TEST(Se3, ExpOfZeroIsTheIdentity) {
  EXPECT_TRUE(se3_exp(Vector6::Zero()).isApprox(Pose::Identity(), 0));
  EXPECT_EQ(se3_log(Pose::Identity()), Vector6::Zero());
}

TEST(Se3, ExpOfATranslationIsThatTranslation) {
  const Pose pose = se3_exp(twist(1, -2, 3, 0, 0, 0));
  EXPECT_EQ(pose.translation(), Eigen::Vector3d(1, -2, 3));
  EXPECT_EQ(pose.linear(), Eigen::Matrix3d::Identity());
}

/// Driving forward at 1 while turning by a quarter: a quarter circle of radius 2/pi.
TEST(Se3, ExpOfAScrewRunsAlongTheCircle) {
  const Pose pose = se3_exp(twist(1, 0, 5, 0, 0, M_PI / 2));
  EXPECT_TRUE(pose.translation().isApprox(Eigen::Vector3d(2 / M_PI, 2 / M_PI, 5), 1e-14));
  Eigen::Matrix3d turn;
  turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_TRUE(pose.linear().isApprox(turn, 1e-14));
}

/// exp(xi) = lim (1 + xi/n)^n, by repeated squaring of a tiny step.
TEST(Se3, ExpIsTheLimitOfSmallSteps) {
  testing::Random random(2);
  for (int i = 0; i < 20; ++i) {
    Vector6 xi;
    for (double& v : xi) v = random.uniform(-2, 2);
    Eigen::Matrix4d generator = Eigen::Matrix4d::Zero();
    generator.topLeftCorner<3, 3>() << 0, -xi(5), xi(4), xi(5), 0, -xi(3), -xi(4), xi(3), 0;
    generator.topRightCorner<3, 1>() = xi.head<3>();
    Eigen::Matrix4d power = Eigen::Matrix4d::Identity() + generator / std::exp2(20) +
                            generator * generator / std::exp2(41);
    for (int k = 0; k < 20; ++k) power = power * power;
    EXPECT_TRUE(se3_exp(xi).matrix().isApprox(power, 1e-8));
  }
}

TEST(Se3, LogInvertsExp) {
  testing::Random random(5);
  for (const double scale : {1e-9, 1e-6, 0.99e-4, 1.01e-4, 1e-2, 1.0, 1.8}) {
    for (int i = 0; i < 20; ++i) {
      Vector6 xi;
      for (double& v : xi) v = random.uniform(-scale, scale);
      if (xi.tail<3>().norm() > 3.1) continue;
      EXPECT_LT((se3_log(se3_exp(xi)) - xi).norm(), 1e-9 * scale + 1e-15) << xi.transpose();
    }
  }
}

TEST(Se3, ExpIsContinuousWhereTheSeriesBegins) {
  const Vector6 xi = twist(1, 2, 3, 0.6e-4, 0.8e-4, 0);  // an angle of 1e-4
  const Pose below = se3_exp(xi * (1 - 1e-12)), above = se3_exp(xi * (1 + 1e-12));
  EXPECT_LT((below.matrix() - above.matrix()).norm(), 1e-11);
  // b's next terms: to fourth order the translation is known exactly.
  const Eigen::Vector3d v = xi.head<3>(), w = xi.tail<3>();
  const Eigen::Vector3d expected =
      v + w.cross(v) / 2 + w.cross(w.cross(v)) / 6 + w.cross(w.cross(w.cross(v))) / 24;
  EXPECT_LT((below.translation() - expected).norm(), 1e-11);
}

TEST(Se3, ExpOfTheOppositeIsTheInverse) {
  const Vector6 xi = twist(0.3, -0.2, 0.5, 1.0, -0.7, 0.4);
  EXPECT_TRUE((se3_exp(xi) * se3_exp(-xi)).isApprox(Pose::Identity(), 1e-14));
}

TEST(Se3, RotationsStayOrthonormal) {
  for (const double angle : {1e-12, 1e-5, 0.1, 3.0, 6.0, 100.0}) {
    const Eigen::Matrix3d r = se3_exp(twist(1, 1, 1, angle * 0.6, 0, angle * 0.8)).linear();
    EXPECT_TRUE((r * r.transpose()).isApprox(Eigen::Matrix3d::Identity(), 1e-12)) << angle;
    EXPECT_NEAR(r.determinant(), 1, 1e-12);
  }
}

}  // namespace
}  // namespace slambench
