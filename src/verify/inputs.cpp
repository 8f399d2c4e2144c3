// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "verify/inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "backends/backend.h"
#include "kernels/pixel.h"
#include "verify/scenes.h"

namespace slambench {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

Image<float> noise(Size size, Random* random) {
  Image<float> depth(size);
  for (float& value : depth) {
    value = random->chance(0.2) ? 0.0f : random->uniform_f(0.3, 8.0);
  }
  return depth;
}

Image<float> room(Size size, Random* random) {
  Pose pose = Pose::Identity();
  pose.translation() << random->uniform(1.5, 2.5), random->uniform(1.5, 2.5), 0.9;
  return depth_of(room_scene(4.0), pose, camera_for(size), size);
}

/// As a sensor sees it: single pixels and whole patches missing.
void punch_holes(Image<float>* depth, Random* random) {
  for (float& value : *depth) {
    if (random->chance(0.03)) value = 0.0f;
  }
  const int left = random->index(depth->width()), top = random->index(depth->height());
  for (int y = top; y < std::min(depth->height(), top + depth->height() / 4); ++y) {
    for (int x = left; x < std::min(depth->width(), left + depth->width() / 4); ++x) {
      (*depth)(x, y) = 0.0f;
    }
  }
}

float& any_pixel(Image<float>* image, Random* random) {
  return (*image)(random->index(image->width()), random->index(image->height()));
}

float bad_value(Random* random) {
  constexpr float values[] = {not_a_number, infinity, -infinity};
  return values[random->index(3)];
}

void add_special(std::vector<Named<Image<float>>>* images, Random* random) {
  const Size size{37, 23};
  images->push_back({"zeros " + text(size), Image<float>(size)});
  Image<float> hole(size, 1.5f);
  any_pixel(&hole, random) = 0.0f;
  images->push_back({"one hole " + text(size), hole});
  Image<float> lonely(size);
  any_pixel(&lonely, random) = 2.5f;
  images->push_back({"one value " + text(size), lonely});
  Image<float> wall = depth_of(plane_scene(2.0), Pose::Identity(), camera_for(size), size);
  images->push_back({"plane " + text(size), wall});
  const Scene ball = sphere_scene({0.1, -0.1, 1.5}, 0.4);
  images->push_back(
      {"sphere " + text(size), depth_of(ball, Pose::Identity(), camera_for(size), size)});
  Image<float> ends(size);
  for (float& value : ends) {
    constexpr float values[] = {0.001f, 0.3999f, 0.4f, 0.4001f, 4.0f, 4.0001f, 20.0f, 65.535f};
    value = values[random->index(8)];
  }
  images->push_back({"near and far " + text(size), ends});
  Image<float> spoiled = noise(size, random);
  spoil(&spoiled, random);
  any_pixel(&spoiled, random) = -1.0f;
  images->push_back({"not finite " + text(size), spoiled});
}

}  // namespace

std::string text(Size size) { return fmt::format("{}x{}", size.width, size.height); }
std::string text(Int3 r) { return fmt::format("{}x{}x{}", r.x, r.y, r.z); }

std::vector<Named<Image<float>>> depth_images(Random random,
                                              const std::vector<Recording>& recordings) {
  std::vector<Named<Image<float>>> images;
  for (const Size size : image_sizes) {
    images.push_back({"noise " + text(size), noise(size, &random)});
    images.push_back({"room " + text(size), room(size, &random)});
    punch_holes(&images.back().value, &random);
  }
  add_special(&images, &random);
  for (const Recording& recording : recordings) {
    for (std::size_t i : {std::size_t{0}, recording.frames.size() - 1}) {
      images.push_back({fmt::format("{} frame {}", recording.name, recording.frames[i].index),
                        view(recording, i).depth_m});
    }
  }
  return images;
}

std::vector<Named<Image<Float3>>> vertex_maps(Random random,
                                              const std::vector<Recording>& recordings) {
  std::vector<Named<Image<Float3>>> maps;
  for (const auto& [name, depth] : depth_images(random, recordings)) {
    maps.push_back({name, vertices_of(depth, camera_for(depth.size()))});
  }
  Image<Float3> points({127, 65});
  for (Float3& point : points) {
    point = {random.uniform_f(-2, 2), random.uniform_f(-2, 2), random.uniform_f(0.5, 5)};
  }
  maps.push_back({"points " + text(points.size()), points});
  spoil(&points, &random);
  maps.push_back({"points not finite " + text(points.size()), points});
  return maps;
}

Image<Float3> vertices_of(const Image<float>& depth_m, Intrinsics camera) {
  Image<Float3> vertices(depth_m.size());
  for (int y = 0; y < depth_m.height(); ++y) {
    for (int x = 0; x < depth_m.width(); ++x) {
      vertices(x, y) = vertex_from_depth(depth_m(x, y), camera, x, y);
    }
  }
  return vertices;
}

Maps maps_of(const Image<float>& depth_m, Intrinsics camera) {
  Maps maps{vertices_of(depth_m, camera), Image<Float3>(depth_m.size())};
  for (int y = 0; y < depth_m.height(); ++y) {
    for (int x = 0; x < depth_m.width(); ++x) {
      maps.normals(x, y) = normal_from_vertices(maps.vertices.data(), depth_m.size(), x, y);
    }
  }
  return maps;
}

Maps moved(const Maps& maps, const Pose& T_volume_camera) {
  const Rigid3f transform = to_rigid3f(T_volume_camera);
  Maps result = maps;
  for (std::size_t i = 0; i < maps.normals.count(); ++i) {
    Float3& normal = result.normals.data()[i];
    if (normal.x == invalid_normal) continue;
    normal = transform.rotate(normal);
    result.vertices.data()[i] = transform.apply(maps.vertices.data()[i]);
  }
  return result;
}

Image<float> halved(const Image<float>& depth_m) {
  Image<float> half({depth_m.width() / 2, depth_m.height() / 2});
  for (int y = 0; y < half.height(); ++y) {
    for (int x = 0; x < half.width(); ++x) {
      half(x, y) = half_sampled(depth_m.data(), depth_m.size(), x, y, 0.3f);
    }
  }
  return half;
}

void spoil(Image<float>* image, Random* random) {
  for (float& value : *image) {
    if (random->chance(0.1)) value = bad_value(random);
  }
}

void spoil(Image<Float3>* image, Random* random) {
  for (Float3& value : *image) {
    if (!random->chance(0.1)) continue;
    float* const components[] = {&value.x, &value.y, &value.z};
    *components[random->index(3)] = bad_value(random);
  }
}

Float3 random_unit_vector(Random* random) {
  while (true) {
    const Float3 v{random->uniform_f(-1, 1), random->uniform_f(-1, 1), random->uniform_f(-1, 1)};
    const float l = length(v);
    if (l > 0.1f && l < 1.0f) return normalized(v);
  }
}

}  // namespace slambench
