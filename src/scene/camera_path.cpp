// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "scene/camera_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace slambench {
namespace {

using Eigen::Vector3d;
using Vector5d = Eigen::Matrix<double, 5, 1>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Where the hand leads the camera: position (the height above the floor, m), turn to the right
/// from north and upward tilt (degrees).
struct ControlPoint {
  double x, height, z, yaw_deg, pitch_deg;
};

struct PathPlan {
  int frames;
  double length_m;
  std::span<const ControlPoint> points;
};

// Path 0: slowly around the coffee table, from the south to the east and back.
constexpr auto points_0 = std::to_array<ControlPoint>({
    {-0.40, 1.30, -1.10, 0, 0},    {-0.55, 1.33, -0.95, 4, -4},   {-0.75, 1.38, -0.70, 14, -9},
    {-0.90, 1.42, -0.35, 32, -12}, {-0.85, 1.40, 0.05, 50, -14},  {-0.60, 1.36, 0.30, 62, -13},
    {-0.30, 1.32, 0.20, 66, -10},  {-0.15, 1.28, -0.15, 58, -8},  {0.00, 1.24, -0.55, 40, -10},
    {0.20, 1.22, -0.90, 20, -12},  {0.50, 1.26, -1.10, -2, -12},  {0.85, 1.32, -1.00, -24, -10},
    {1.00, 1.38, -0.65, -42, -10}, {0.95, 1.40, -0.25, -56, -12}, {0.75, 1.36, 0.10, -68, -12},
    {0.45, 1.30, 0.15, -70, -8},   {0.20, 1.26, -0.15, -56, -6},  {0.00, 1.28, -0.50, -36, -6},
    {-0.15, 1.32, -0.80, -18, -8}, {-0.25, 1.34, -1.00, -6, -9},
});

// Path 1: nearly standing, looking along the window side and the shelf.
constexpr auto points_1 = std::to_array<ControlPoint>({
    {-0.70, 1.35, 0.00, 90, 0},
    {-0.72, 1.36, -0.06, 84, -6},
    {-0.66, 1.38, -0.14, 72, -11},
    {-0.58, 1.40, -0.20, 56, -13},
    {-0.52, 1.38, -0.12, 40, -12},
    {-0.58, 1.34, 0.00, 34, -8},
    {-0.66, 1.32, 0.10, 44, -4},
    {-0.60, 1.30, 0.18, 62, -6},
    {-0.50, 1.32, 0.16, 82, -10},
    {-0.46, 1.36, 0.06, 102, -14},
    {-0.54, 1.40, -0.06, 120, -14},
    {-0.64, 1.40, -0.08, 130, -10},
    {-0.70, 1.36, 0.02, 122, -6},
    {-0.64, 1.32, 0.12, 106, -8},
    {-0.58, 1.32, 0.08, 94, -10},
});

// Path 2: briskly through the room, looking at every side.
constexpr auto points_2 = std::to_array<ControlPoint>({
    {0.00, 1.30, -1.15, 0, 0},     {0.10, 1.32, -1.05, 0, -4},     {0.42, 1.36, -0.86, -8, -9},
    {0.78, 1.40, -0.62, -22, -12}, {0.98, 1.42, -0.26, -40, -13},  {0.96, 1.40, 0.12, -58, -12},
    {0.74, 1.36, 0.44, -74, -9},   {0.40, 1.30, 0.52, -84, -8},    {0.06, 1.26, 0.38, -88, -9},
    {-0.16, 1.24, 0.06, -82, -10}, {-0.12, 1.28, -0.32, -66, -10}, {0.06, 1.34, -0.66, -46, -9},
    {0.02, 1.38, -0.98, -24, -10}, {-0.28, 1.40, -1.14, -2, -12},  {-0.64, 1.36, -1.06, 18, -13},
    {-0.92, 1.32, -0.80, 38, -12}, {-0.98, 1.30, -0.42, 56, -10},  {-0.82, 1.32, -0.06, 70, -8},
    {-0.52, 1.36, 0.16, 80, -8},   {-0.18, 1.38, 0.14, 78, -10},   {0.02, 1.36, -0.16, 66, -11},
    {-0.02, 1.32, -0.52, 48, -10}, {-0.16, 1.32, -0.80, 34, -8},
});

// Path 3: two turns through the room and once around itself, back to the start.
constexpr auto points_3 = std::to_array<ControlPoint>({
    {0.00, 1.35, -1.10, 0, 0},       {0.20, 1.36, -1.08, 2, -4},
    {0.56, 1.38, -0.92, -6, -9},     {0.86, 1.42, -0.62, -20, -12},
    {1.02, 1.44, -0.22, -36, -13},   {0.96, 1.42, 0.20, -52, -12},
    {0.70, 1.38, 0.54, -68, -10},    {0.32, 1.34, 0.70, -84, -9},
    {-0.10, 1.30, 0.70, -100, -9},   {-0.48, 1.28, 0.52, -116, -10},
    {-0.74, 1.30, 0.20, -132, -11},  {-0.72, 1.34, -0.20, -148, -11},
    {-0.44, 1.38, -0.46, -162, -10}, {-0.04, 1.40, -0.48, -176, -9},
    {0.34, 1.38, -0.30, -190, -9},   {0.56, 1.34, 0.04, -204, -10},
    {0.50, 1.30, 0.44, -218, -11},   {0.22, 1.28, 0.74, -232, -12},
    {-0.18, 1.30, 0.86, -246, -12},  {-0.56, 1.34, 0.72, -260, -11},
    {-0.84, 1.38, 0.40, -274, -10},  {-0.94, 1.40, 0.00, -288, -10},
    {-0.90, 1.40, -0.40, -304, -10}, {-0.70, 1.38, -0.76, -322, -9},
    {-0.40, 1.36, -0.98, -342, -6},  {-0.14, 1.35, -1.08, -356, -2},
    {0.00, 1.35, -1.10, -360, 0},
});

constexpr std::array<PathPlan, living_room_path_count> plans = {
    PathPlan{1510, 6.5, points_0}, PathPlan{967, 2.1, points_1}, PathPlan{882, 8.4, points_2},
    PathPlan{1242, 11.3, points_3}};

Vector5d vector_of(const ControlPoint& p) { return {p.x, -p.height, p.z, p.yaw_deg, p.pitch_deg}; }

/// The uniform cubic B-spline of the points with its ends tripled: it begins and ends exactly at
/// the first and last point, with zero velocity and acceleration. `t` in [0, 1].
Vector5d spline(std::span<const ControlPoint> points, double t) {
  const int last = static_cast<int>(points.size()) - 1;
  const int segments = last + 2;
  const double at = std::clamp(t, 0.0, 1.0) * segments;
  const int segment = std::min(static_cast<int>(at), segments - 1);
  const double u = at - segment;
  const std::array<double, 4> weights = {
      (1 - u) * (1 - u) * (1 - u) / 6, (3 * u * u * u - 6 * u * u + 4) / 6,
      (-3 * u * u * u + 3 * u * u + 3 * u + 1) / 6, u * u * u / 6};
  Vector5d sum = Vector5d::Zero();
  for (int i = 0; i < 4; ++i) {
    const int index = std::clamp(segment + i - 2, 0, last);
    sum +=
        weights[static_cast<std::size_t>(i)] * vector_of(points[static_cast<std::size_t>(index)]);
  }
  return sum;
}

/// The unrest of a hand: slow sines of unrelated frequencies, in the units of the spline, and the
/// roll in degrees as sixth number.
Vector6d sway(int path, double time_s) {
  struct Wave {
    double amplitude, frequency_hz;
  };
  // x, height, z: m; yaw, pitch, roll: degrees.
  constexpr std::array<std::array<Wave, 2>, 6> waves = {{{{{0.006, 0.43}, {0.0022, 1.13}}},
                                                         {{{0.005, 0.57}, {0.0025, 1.31}}},
                                                         {{{0.006, 0.37}, {0.0020, 0.97}}},
                                                         {{{0.45, 0.41}, {0.12, 1.21}}},
                                                         {{{0.40, 0.53}, {0.12, 1.07}}},
                                                         {{{0.70, 0.29}, {0.15, 0.89}}}}};
  Vector6d sum = Vector6d::Zero();
  for (int k = 0; k < 6; ++k) {
    double phase = 1.7 * path + 2.4 * k;
    for (const Wave& wave : waves[static_cast<std::size_t>(k)]) {
      sum[k] +=
          wave.amplitude * std::sin(2 * std::numbers::pi * wave.frequency_hz * time_s + phase);
      phase += 0.9;
    }
  }
  return sum;
}

/// Rises from 0 to 1 over the first `rise` and falls back over the last, without a jerk.
double envelope(double t, double rise) {
  const double x = std::clamp(std::min(t, 1 - t) / rise, 0.0, 1.0);
  return x * x * x * (10 + x * (6 * x - 15));
}

Pose pose_of(const Vector5d& p, double roll_deg) {
  constexpr double radians = std::numbers::pi / 180;
  Pose pose = Pose::Identity();
  pose.translation() = p.head<3>();
  pose.linear() = (Eigen::AngleAxisd(p[3] * radians, Vector3d::UnitY()) *
                   Eigen::AngleAxisd(p[4] * radians, Vector3d::UnitX()) *
                   Eigen::AngleAxisd(roll_deg * radians, Vector3d::UnitZ()))
                      .toRotationMatrix();
  return pose;
}

/// Stretches the path about its start until it has the length.
void stretch(Trajectory* trajectory, double length_m) {
  const Vector3d start = trajectory->front().T_world_camera.translation();
  const double factor = length_m / path_length(*trajectory);
  for (StampedPose& stamped : *trajectory) {
    auto position = stamped.T_world_camera.translation();
    position = start + factor * (position - start);
  }
}

}  // namespace

double path_length(const Trajectory& trajectory) {
  double sum = 0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    sum += (trajectory[i].T_world_camera.translation() -
            trajectory[i - 1].T_world_camera.translation())
               .norm();
  }
  return sum;
}

Trajectory living_room_path(int path) {
  const PathPlan& plan = plans.at(static_cast<std::size_t>(path));
  Trajectory trajectory;
  for (int frame = 0; frame < plan.frames; ++frame) {
    const double time_s = frame / living_room_fps, t = double(frame) / (plan.frames - 1);
    const Vector6d unrest = sway(path, time_s) * envelope(t, 60.0 / plan.frames);
    const Vector5d position = spline(plan.points, t) + unrest.head<5>();
    trajectory.push_back({time_s, pose_of(position, unrest[5])});
  }
  stretch(&trajectory, plan.length_m);
  return trajectory;
}

}  // namespace slambench
