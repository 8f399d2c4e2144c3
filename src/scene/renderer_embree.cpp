// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "scene/embree.h"
#include "scene/parallel.h"
#include "scene/renderer.h"

namespace slambench {
namespace {

using Eigen::Vector3f;

constexpr int lanes = 16, tile = 4;  // a packet covers a tile of 4 x 4 pixels

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DevicePointer = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceRelease>;
using ScenePointer = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneRelease>;

void check(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  throw UnavailableError(
      fmt::format("rendering: Embree reports error {}", static_cast<int>(error)));
}

template <class T>
void upload(RTCDevice device, RTCGeometry geometry, RTCBufferType type, RTCFormat format,
            const std::vector<T>& values) {
  void* const buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), values.size());
  check(device);
  if (buffer == nullptr) throw std::bad_alloc();
  std::memcpy(buffer, static_cast<const void*>(values.data()), values.size() * sizeof(T));
}

ScenePointer build_scene(RTCDevice device, const Mesh& mesh) {
  ScenePointer scene(rtcNewScene(device));
  check(device);
  // No ray may slip through the edge that two triangles share.
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  upload(device, geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertices);
  upload(device, geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  check(device);
  return scene;
}

/// Sixteen directions over the hemisphere around +z, denser towards it as diffuse light weighs
/// them (Malley's method on a spiral).
std::array<Vector3f, lanes> hemisphere() {
  std::array<Vector3f, lanes> directions;
  for (int i = 0; i < lanes; ++i) {
    const float square = (float(i) + 0.5f) / lanes, radius = std::sqrt(square);
    const float angle = float(i) * 2.39996323f;  // the golden angle
    directions[static_cast<std::size_t>(i)] = {radius * std::cos(angle), radius * std::sin(angle),
                                               std::sqrt(1 - square)};
  }
  return directions;
}

/// The part of the sky over a point of a surface that nothing within `reach_m` covers, in [0, 1].
float openness(RTCScene scene, const Vector3f& point, const Vector3f& normal) {
  constexpr float reach_m = 0.7f, lift_m = 0.002f;
  static const std::array<Vector3f, lanes> directions = hemisphere();
  const Vector3f helper = std::abs(normal.x()) < 0.7f ? Vector3f::UnitX() : Vector3f::UnitY();
  const Vector3f tangent = normal.cross(helper).normalized(), other = normal.cross(tangent);
  const Vector3f origin = point + lift_m * normal;
  RTCRay16 rays = {};
  alignas(64) std::array<int, lanes> valid;
  for (std::size_t i = 0; i < lanes; ++i) {
    const Vector3f d =
        directions[i].x() * tangent + directions[i].y() * other + directions[i].z() * normal;
    rays.org_x[i] = origin.x(), rays.org_y[i] = origin.y(), rays.org_z[i] = origin.z();
    rays.dir_x[i] = d.x(), rays.dir_y[i] = d.y(), rays.dir_z[i] = d.z();
    rays.tfar[i] = reach_m;
    rays.mask[i] = ~0u;
    valid[i] = -1;
  }
  embree::occluded(valid.data(), scene, &rays);
  const auto open = std::count_if(std::begin(rays.tfar), std::end(rays.tfar),
                                  [](float tfar) { return tfar > 0; });
  return float(open) / lanes;
}

Rgb8 lit(Rgb8 color, float open, const Vector3f& normal) {
  const Vector3f lamp = Vector3f(0.55f, -0.6f, -0.58f).normalized();  // from above, south-east
  const float sky = 0.5f - 0.5f * normal.y();                         // y points down
  const float light =
      (0.35f + 0.65f * open) * (0.62f + 0.24f * sky) + 0.34f * std::max(0.0f, normal.dot(lamp));
  const auto scale = [light](std::uint8_t value) {
    return static_cast<std::uint8_t>(std::min(255.0f, float(value) * light));
  };
  return {scale(color.r), scale(color.g), scale(color.b)};
}

/// The lit colours of a triangle's corners, together, as a pixel needs them.
using CornerColors = std::array<Rgb8, 3>;

std::vector<CornerColors> light_up(RTCScene scene, const Mesh& mesh, int threads) {
  const std::vector<Vector3f> normals = vertex_normals(mesh);
  std::vector<Rgb8> colors(mesh.vertices.size());
  constexpr std::size_t block = 1024;
  const auto blocks = static_cast<int>((colors.size() + block - 1) / block);
  parallel_for(blocks, threads, [&](int b) {
    const std::size_t begin = static_cast<std::size_t>(b) * block;
    for (std::size_t i = begin; i < std::min(begin + block, colors.size()); ++i) {
      const bool has_normal = !normals[i].isZero();
      const float open = has_normal ? openness(scene, mesh.vertices[i], normals[i]) : 1.0f;
      colors[i] = lit(mesh.colors[i], open, normals[i]);
    }
  });
  std::vector<CornerColors> corners;
  corners.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    corners.push_back({colors[t[0]], colors[t[1]], colors[t[2]]});
  }
  return corners;
}

Rgb8 blend(const CornerColors& c, float u, float v) {
  const float w = 1 - u - v;
  const auto mix = [&](std::uint8_t Rgb8::*channel) {
    const float value = w * c[0].*channel + u * c[1].*channel + v * c[2].*channel;
    return static_cast<std::uint8_t>(static_cast<int>(std::clamp(value + 0.5f, 0.0f, 255.0f)));
  };
  return {mix(&Rgb8::r), mix(&Rgb8::g), mix(&Rgb8::b)};
}

}  // namespace

struct Renderer::Impl {
  DevicePointer device;
  ScenePointer scene;
  std::vector<CornerColors> colors;  ///< one a triangle; none without shading
  Size size;
  std::vector<float> slopes_x, slopes_y;  ///< of the rays of each column and row

  void aim(const Eigen::Matrix3f& rotation, const Vector3f& origin, int x0, int y0, int* valid,
           RTCRayHit16* rays) const;
  void shade(int x0, int y0, const int* valid, const RTCRayHit16& rays, Rendering& out) const;
};

/// Sets up the rays of the tile at (x0, y0); their directions have depth 1, so that a hit's
/// distance is its depth.
void Renderer::Impl::aim(const Eigen::Matrix3f& rotation, const Vector3f& origin, int x0, int y0,
                         int* valid, RTCRayHit16* rays) const {
  for (int lane = 0; lane < lanes; ++lane) {
    const int x = x0 + lane % tile, y = y0 + lane / tile;
    const bool inside = x < size.width && y < size.height;
    valid[lane] = inside ? -1 : 0;
    const float sx = inside ? slopes_x[static_cast<std::size_t>(x)] : 0;
    const float sy = inside ? slopes_y[static_cast<std::size_t>(y)] : 0;
    RTCRay16& ray = rays->ray;
    ray.org_x[lane] = origin.x();
    ray.org_y[lane] = origin.y();
    ray.org_z[lane] = origin.z();
    ray.dir_x[lane] = rotation(0, 2) + sx * rotation(0, 0) + sy * rotation(0, 1);
    ray.dir_y[lane] = rotation(1, 2) + sx * rotation(1, 0) + sy * rotation(1, 1);
    ray.dir_z[lane] = rotation(2, 2) + sx * rotation(2, 0) + sy * rotation(2, 1);
    ray.tnear[lane] = 0;
    ray.tfar[lane] = std::numeric_limits<float>::infinity();
    ray.time[lane] = 0;
    ray.mask[lane] = ~0u;
    ray.flags[lane] = 0;
    rays->hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    rays->hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
  }
}

void Renderer::Impl::shade(int x0, int y0, const int* valid, const RTCRayHit16& rays,
                           Rendering& out) const {
  for (int lane = 0; lane < lanes; ++lane) {
    if (valid[lane] == 0) continue;
    const int x = x0 + lane % tile, y = y0 + lane / tile;
    if (rays.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) {
      out.depth_m(x, y) = 0;
      out.incidence(x, y) = 0;
      if (!colors.empty()) out.color(x, y) = {};
      continue;
    }
    const Vector3f normal(rays.hit.Ng_x[lane], rays.hit.Ng_y[lane], rays.hit.Ng_z[lane]);
    const Vector3f ray(rays.ray.dir_x[lane], rays.ray.dir_y[lane], rays.ray.dir_z[lane]);
    out.depth_m(x, y) = rays.ray.tfar[lane];
    out.incidence(x, y) =
        std::abs(normal.dot(ray)) / std::sqrt(normal.squaredNorm() * ray.squaredNorm());
    if (colors.empty()) continue;
    out.color(x, y) = blend(colors[rays.hit.primID[lane]], rays.hit.u[lane], rays.hit.v[lane]);
  }
}

bool can_render() { return true; }

Renderer::Renderer(const Mesh& mesh, Size size, Intrinsics camera, Shading shading, int threads)
    : impl_(std::make_unique<Impl>()) {
  impl_->device.reset(rtcNewDevice(nullptr));
  check(impl_->device.get());
  impl_->scene = build_scene(impl_->device.get(), mesh);
  if (shading == Shading::diffuse) {
    impl_->colors = light_up(impl_->scene.get(), mesh, threads);
  }
  impl_->size = size;
  for (int x = 0; x < size.width; ++x)
    impl_->slopes_x.push_back((float(x) - camera.cx) / camera.fx);
  for (int y = 0; y < size.height; ++y) {
    impl_->slopes_y.push_back((float(y) - camera.cy) / camera.fy);
  }
}

Renderer::~Renderer() = default;

void Renderer::render(const Pose& T_world_camera, Rendering& out) const {
  const Size size = impl_->size;
  out.depth_m.resize(size);
  out.incidence.resize(size);
  out.color.resize(impl_->colors.empty() ? Size{} : size);
  const Eigen::Matrix3f rotation = T_world_camera.linear().cast<float>();
  const Vector3f origin = T_world_camera.translation().cast<float>();
  RTCRayHit16 rays = {};
  alignas(64) std::array<int, lanes> valid;
  for (int y = 0; y < size.height; y += tile) {
    for (int x = 0; x < size.width; x += tile) {
      impl_->aim(rotation, origin, x, y, valid.data(), &rays);
      embree::intersect_coherent(valid.data(), impl_->scene.get(), &rays);
      impl_->shade(x, y, valid.data(), rays, out);
    }
  }
}

}  // namespace slambench
