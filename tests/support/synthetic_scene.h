// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/image.h"
#include "core/intrinsics.h"
#include "core/trajectory.h"
#include "kernels/types.h"

/// Scenes whose depth, normals and distances are known in closed form, in double precision.
namespace slambench::testing {

struct SurfacePoint {
  double t = 0;  ///< along the ray, in units of its direction
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, toward free space
};

/// The union of half-spaces and balls; free space is what none of them covers.
class Scene {
 public:
  /// The half-space behind `point`; the normal (any length) points to free space.
  Scene& add_plane(const Eigen::Vector3d& normal, const Eigen::Vector3d& point) {
    planes_.push_back({normal.normalized(), normal.normalized().dot(point)});
    return *this;
  }
  Scene& add_sphere(const Eigen::Vector3d& center, double radius) {
    spheres_.push_back({center, radius});
    return *this;
  }

  /// The first surface in front of a ray that starts in free space.
  std::optional<SurfacePoint> cast(const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& direction) const {
    SurfacePoint nearest;
    nearest.t = std::numeric_limits<double>::infinity();
    for (const Plane& plane : planes_) {
      const double approach = plane.normal.dot(direction);
      if (approach >= 0) continue;
      const double t = (plane.offset - plane.normal.dot(origin)) / approach;
      if (t > 0 && t < nearest.t) nearest = {t, origin + t * direction, plane.normal};
    }
    for (const Sphere& sphere : spheres_) {
      const Eigen::Vector3d offset = origin - sphere.center;
      const double a = direction.squaredNorm(), b = offset.dot(direction);
      const double discriminant =
          b * b - a * (offset.squaredNorm() - sphere.radius * sphere.radius);
      if (discriminant < 0) continue;
      const double t = (-b - std::sqrt(discriminant)) / a;
      if (t <= 0 || t >= nearest.t) continue;
      const Eigen::Vector3d point = origin + t * direction;
      nearest = {t, point, (point - sphere.center) / sphere.radius};
    }
    if (!std::isfinite(nearest.t)) return std::nullopt;
    return nearest;
  }

  /// Signed distance to the nearest surface, + in free space.
  double distance(const Eigen::Vector3d& point) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Plane& plane : planes_) {
      nearest = std::min(nearest, plane.normal.dot(point) - plane.offset);
    }
    for (const Sphere& sphere : spheres_) {
      nearest = std::min(nearest, (point - sphere.center).norm() - sphere.radius);
    }
    return nearest;
  }

 private:
  struct Plane {
    Eigen::Vector3d normal;
    double offset;
  };
  struct Sphere {
    Eigen::Vector3d center;
    double radius;
  };
  std::vector<Plane> planes_;
  std::vector<Sphere> spheres_;
};

/// Back wall, left wall and floor of a room in [0, size_m]^3, seen from the middle of the side
/// z = 0: planes in three directions, so that every motion of the camera can be told.
inline Scene room_corner(double size_m) {
  Scene scene;
  scene.add_plane({0, 0, -1}, {0, 0, 0.85 * size_m});
  scene.add_plane({1, 0, 0}, {0.2 * size_m, 0, 0});
  scene.add_plane({0, -1, 0}, {0, 0.75 * size_m, 0});
  return scene;
}

/// The same with a ball in it.
inline Scene furnished_corner(double size_m) {
  Scene scene = room_corner(size_m);
  scene.add_sphere(Eigen::Vector3d(0.55, 0.55, 0.6) * size_m, 0.12 * size_m);
  return scene;
}

inline Eigen::Vector3d ray_of(const Intrinsics& camera, int x, int y) {
  return {(x - static_cast<double>(camera.cx)) / camera.fx,
          (y - static_cast<double>(camera.cy)) / camera.fy, 1.0};
}

inline std::optional<SurfacePoint> seen(const Scene& scene, const Pose& T_scene_camera,
                                        const Intrinsics& camera, int x, int y) {
  return scene.cast(T_scene_camera.translation(), T_scene_camera.linear() * ray_of(camera, x, y));
}

/// Camera depth of every pixel; 0 where nothing is seen.
inline Image<float> depth_m_of(const Scene& scene, const Pose& T_scene_camera,
                               const Intrinsics& camera, Size size) {
  Image<float> depth(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const auto hit = seen(scene, T_scene_camera, camera, x, y);
      if (hit) depth(x, y) = static_cast<float>(hit->t);
    }
  }
  return depth;
}

/// As a sensor delivers it: rounded to its units; 0 also where the depth does not fit.
inline Image<std::uint16_t> depth_units_of(const Scene& scene, const Pose& T_scene_camera,
                                           const Intrinsics& camera, Size size,
                                           double units_per_m) {
  const Image<float> depth = depth_m_of(scene, T_scene_camera, camera, size);
  Image<std::uint16_t> units(size);
  for (std::size_t i = 0; i < units.count(); ++i) {
    const double value = std::round(static_cast<double>(depth.data()[i]) * units_per_m);
    if (value <= 65535) units.data()[i] = static_cast<std::uint16_t>(value);
  }
  return units;
}

/// A vertex and a normal per pixel; zero and x = invalid_normal where nothing is seen.
struct SurfaceMaps {
  Image<Float3> vertices, normals;
};

inline Float3 to_float3(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// What the camera sees, in the frame that `T_frame_scene` maps to: the scene's own for a model,
/// the camera's for a live frame.
inline SurfaceMaps surface_maps_of(const Scene& scene, const Pose& T_scene_camera,
                                   const Intrinsics& camera, Size size,
                                   const Pose& T_frame_scene = Pose::Identity()) {
  SurfaceMaps maps{Image<Float3>(size), Image<Float3>(size, Float3{invalid_normal, 0, 0})};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const auto hit = seen(scene, T_scene_camera, camera, x, y);
      if (!hit) continue;
      maps.vertices(x, y) = to_float3(T_frame_scene * hit->point);
      maps.normals(x, y) = to_float3(T_frame_scene.linear() * hit->normal);
    }
  }
  return maps;
}

/// The scene's truncated signed distance, as a volume with one measurement in every voxel.
inline std::vector<Voxel> tsdf_of(const Scene& scene, Int3 resolution,
                                  const Eigen::Vector3d& size_m, double mu_m) {
  const Eigen::Vector3d voxel_m =
      size_m.cwiseQuotient(Eigen::Vector3d(resolution.x, resolution.y, resolution.z));
  std::vector<Voxel> voxels;
  for (int z = 0; z < resolution.z; ++z) {
    for (int y = 0; y < resolution.y; ++y) {
      for (int x = 0; x < resolution.x; ++x) {
        const Eigen::Vector3d center =
            Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5).cwiseProduct(voxel_m);
        const double tsdf = std::clamp(scene.distance(center) / mu_m, -1.0, 1.0);
        voxels.push_back({static_cast<std::int16_t>(tsdf * 32766), 1});
      }
    }
  }
  return voxels;
}

}  // namespace slambench::testing
