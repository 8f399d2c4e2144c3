// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "verify/scenes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slambench {
namespace {

using Vector = Eigen::Vector3d;
constexpr double never = std::numeric_limits<double>::infinity();

struct Ray {
  Vector origin, direction;
};

double hit(const Plane& plane, const Ray& ray) {
  const double approach = -ray.direction.dot(plane.normal);
  return approach > 0 ? (ray.origin - plane.point_m).dot(plane.normal) / approach : never;
}

double hit(const Sphere& sphere, const Ray& ray) {
  const Vector offset = ray.origin - sphere.center_m;
  const double a = ray.direction.squaredNorm();
  const double half_b = ray.direction.dot(offset);
  const double discriminant =
      half_b * half_b - a * (offset.squaredNorm() - sphere.radius_m * sphere.radius_m);
  return discriminant > 0 ? (-half_b - std::sqrt(discriminant)) / a : never;
}

double hit(const Box& box, const Ray& ray) {
  double enter = -never, leave = never;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.low_m[axis] - ray.origin[axis]) / ray.direction[axis];
    const double b = (box.high_m[axis] - ray.origin[axis]) / ray.direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave ? enter : never;
}

template <class Solid>
void nearest(const std::vector<Solid>& solids, const Ray& ray, double* t) {
  for (const Solid& solid : solids) {
    const double candidate = hit(solid, ray);
    if (candidate > 0) *t = std::min(*t, candidate);
  }
}

}  // namespace

Scene plane_scene(double distance_m) {
  return {{{{0, 0, distance_m}, Vector(0.2, -0.1, -1).normalized()}}, {}, {}};
}

Scene sphere_scene(const Vector& center_m, double radius_m) {
  return {{}, {}, {{center_m, radius_m}}};
}

Scene room_scene(double edge_m) {
  Scene scene;
  for (int axis = 0; axis < 3; ++axis) {
    Vector inward = Vector::Zero();
    inward[axis] = 1;
    scene.planes.push_back({inward * 0.02 * edge_m, inward});
    scene.planes.push_back({inward * 0.98 * edge_m, -inward});
  }
  const auto at = [edge_m](double x, double y, double z) -> Vector {
    return Vector(x, y, z) * edge_m;
  };
  scene.boxes = {{at(0.15, 0.62, 0.70), at(0.42, 0.98, 0.85)},
                 {at(0.60, 0.72, 0.62), at(0.80, 0.98, 0.72)},
                 {at(0.55, 0.15, 0.88), at(0.75, 0.40, 0.98)}};
  scene.spheres = {{at(0.30, 0.35, 0.80), 0.09 * edge_m}, {at(0.70, 0.55, 0.80), 0.08 * edge_m}};
  return scene;
}

Image<float> depth_of(const Scene& scene, const Pose& T_world_camera, Intrinsics camera,
                      Size size) {
  Image<float> depth(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Vector direction((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1);
      const Ray ray{T_world_camera.translation(), T_world_camera.linear() * direction};
      double t = never;
      nearest(scene.planes, ray, &t);
      nearest(scene.boxes, ray, &t);
      nearest(scene.spheres, ray, &t);
      depth(x, y) = t < never ? static_cast<float>(t) : 0.0f;
    }
  }
  return depth;
}

Image<std::uint16_t> quantized(const Image<float>& depth_m, float units_per_m) {
  Image<std::uint16_t> units(depth_m.size());
  std::transform(depth_m.begin(), depth_m.end(), units.begin(), [&](float depth) {
    const float value = std::round(depth * units_per_m);
    return value <= 65535.0f ? static_cast<std::uint16_t>(value) : std::uint16_t{0};
  });
  return units;
}

Intrinsics camera_for(Size size) {
  const auto width = static_cast<float>(size.width), height = static_cast<float>(size.height);
  const float focal = 0.75f * std::max(width, height);
  return {focal, 1.003f * focal, 0.49f * width - 0.2f, 0.51f * height - 0.4f};
}

}  // namespace slambench
