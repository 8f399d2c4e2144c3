// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "scene/furniture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/shapes.h"

namespace slambench {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr Rgb8 oak{176, 128, 82}, walnut{112, 74, 48}, white{232, 230, 224}, steel{150, 152, 156},
    black{34, 34, 38}, sand{198, 178, 146}, petrol{58, 104, 116}, mustard{206, 156, 52},
    brick{168, 76, 58};

/// Turned legs at the four corners of a width x depth rectangle around (0, depth / 2).
Mesh legs(float width, float depth, float height, float radius, Rgb8 color) {
  const std::array<Vector2f, 5> profile = {Vector2f{0, 0},
                                           {radius * 0.6f, 0},
                                           {radius * 0.7f, height * 0.1f},
                                           {radius, height * 0.8f},
                                           {radius * 0.9f, height}};
  const Mesh leg = lathe(profile, color, 12);
  Mesh all;
  for (const float x : {-width / 2, width / 2}) {
    for (const float z : {radius * 1.5f, depth - radius * 1.5f}) {
      all.append(leg, placed(x * (1 - 3 * radius / width), 0, z));
    }
  }
  return all;
}

/// A square cushion standing upright, leaning back.
void add_throw_pillow(Mesh* mesh, const Eigen::Affine3f& where, float lean_deg, Rgb8 color) {
  Eigen::Affine3f pose = where;
  pose.rotate(Eigen::AngleAxisf(lean_deg * 0.0174533f, Vector3f::UnitX()));
  mesh->append(superellipsoid({0.21f, 0.21f, 0.085f}, 0.55f, 0.7f, color), pose);
}

/// The seat that sofa and armchair share: base, arms, `seats` cushions and their backs.
Mesh upholstered(float width, int seats, Rgb8 cloth) {
  constexpr float depth = 0.9f, arm = 0.18f;
  Mesh mesh = legs(width, depth, 0.12f, 0.03f, walnut);
  mesh.append(box({width - 0.06f, 0.18f, depth - 0.06f}, shaded(cloth, 0.9f), 0.04f),
              placed(0, 0.11f, depth / 2));
  mesh.append(box({width - 0.1f, 0.62f, 0.2f}, cloth, 0.08f), placed(0, 0.2f, 0.12f));
  for (const float side : {-1.0f, 1.0f}) {
    mesh.append(box({arm, 0.46f, depth - 0.04f}, cloth, 0.085f),
                placed(side * (width - arm) / 2, 0.13f, depth / 2));
  }
  const float seat = (width - 2 * arm) / float(seats);
  for (int i = 0; i < seats; ++i) {
    const float x = -width / 2 + arm + seat * (float(i) + 0.5f);
    mesh.append(superellipsoid({seat * 0.495f, 0.1f, 0.34f}, 0.35f, 0.25f, shaded(cloth, 1.08f)),
                placed(x, 0.37f, 0.55f));
    Eigen::Affine3f back = placed(x, 0.64f, 0.28f);
    back.rotate(Eigen::AngleAxisf(-0.2f, Vector3f::UnitX()));
    mesh.append(superellipsoid({seat * 0.48f, 0.22f, 0.11f}, 0.4f, 0.4f, shaded(cloth, 1.03f)),
                back);
  }
  return mesh;
}

}  // namespace

Mesh sofa() {
  Mesh mesh = upholstered(2.0f, 3, sand);
  add_throw_pillow(&mesh, placed(-0.68f, 0.66f, 0.46f, 20), -22, petrol);
  add_throw_pillow(&mesh, placed(-0.42f, 0.63f, 0.52f, -12), -30, mustard);
  add_throw_pillow(&mesh, placed(0.66f, 0.66f, 0.46f, -25), -24, brick);
  // A blanket thrown over the right arm.
  mesh.append(sheet(20, 28, {186, 92, 84}, [](float u, float v) {
    const float turn = (0.5f - v) * 3.4f, wave = 0.008f * std::sin(u * 19 + v * 5);
    const float half = 0.105f + wave;
    const float across = std::clamp(turn, -1.0f, 1.0f) * half;
    const float fall = std::max(0.0f, std::abs(turn) - 1.0f) * 0.3f;
    return Vector3f(0.91f + across, 0.6f + wave - fall, 0.75f - 0.35f * u);
  }));
  return mesh;
}

Mesh armchair(Rgb8 cloth) {
  Mesh mesh = upholstered(0.86f, 1, cloth);
  add_throw_pillow(&mesh, placed(0.06f, 0.64f, 0.5f, 8), -26, white);
  return mesh;
}

Mesh footstool() {
  Mesh mesh = legs(0.5f, 0.42f, 0.14f, 0.025f, walnut);
  mesh.append(superellipsoid({0.29f, 0.14f, 0.23f}, 0.35f, 0.4f, petrol), placed(0, 0.27f, 0.21f));
  return mesh;
}

Mesh coffee_table() {
  constexpr float width = 1.1f, depth = 0.6f, height = 0.4f;
  Mesh mesh = legs(width, depth, height - 0.03f, 0.03f, oak);
  mesh.append(box({width, 0.035f, depth}, oak, 0.012f, 0.1f),
              placed(0, height - 0.035f, depth / 2));
  mesh.append(box({width - 0.16f, 0.02f, depth - 0.12f}, shaded(oak, 0.85f), 0.006f),
              placed(0, 0.14f, depth / 2));
  mesh.append(bowl_of_fruit(), placed(-0.02f, height, 0.27f));
  mesh.append(book_pile(5), placed(0.33f, height, 0.33f, 14));
  mesh.append(vase(0.24f, {120, 150, 168}), placed(-0.38f, height, 0.2f));
  mesh.append(flowers(3), placed(-0.38f, height + 0.2f, 0.2f));
  mesh.append(book_pile(8), placed(-0.2f, 0.16f, 0.3f, -8));
  const std::array<Vector2f, 7> mug = {Vector2f{0, 0}, {0.036f, 0},     {0.04f, 0.01f},
                                       {0.04f, 0.09f}, {0.035f, 0.09f}, {0.034f, 0.015f},
                                       {0, 0.012f}};
  const std::array<Vector3f, 5> handle = {Vector3f{0.038f, 0.075f, 0},
                                          {0.062f, 0.07f, 0},
                                          {0.07f, 0.048f, 0},
                                          {0.06f, 0.025f, 0},
                                          {0.038f, 0.02f, 0}};
  for (const auto& place : {placed(0.1f, height, 0.48f, 40), placed(-0.22f, height, 0.46f, 200)}) {
    mesh.append(lathe(mug, brick, 20), place);
    mesh.append(rod(handle, 0.007f, 0.007f, brick, 8), place);
  }
  return mesh;
}

Mesh side_table() {
  const std::array<Vector2f, 8> profile = {Vector2f{0, 0}, {0.17f, 0},     {0.17f, 0.02f},
                                           {0.03f, 0.06f}, {0.025f, 0.3f}, {0.05f, 0.5f},
                                           {0.06f, 0.52f}, {0, 0.52f}};
  const std::array<Vector2f, 5> top = {
      Vector2f{0, 0.52f}, {0.24f, 0.52f}, {0.255f, 0.535f}, {0.24f, 0.55f}, {0, 0.55f}};
  Mesh mesh = lathe(profile, walnut);
  mesh.append(lathe(top, walnut, 36));
  mesh.transform(placed(0, 0, 0.27f));
  return mesh;
}

Mesh bookshelf() {
  constexpr float width = 1.5f, height = 2.05f, depth = 0.3f, board = 0.025f;
  Mesh mesh;
  for (const float x : {-width / 2, -width / 6, width / 6, width / 2}) {
    mesh.append(box({board, height, depth}, oak, 0.004f), placed(x, 0, depth / 2));
  }
  mesh.append(box({width, height - 0.04f, 0.012f}, shaded(oak, 0.75f), 0, 0.15f),
              placed(0, 0.02f, 0.012f));
  mesh.append(box({width + 0.06f, 0.05f, depth + 0.04f}, oak, 0.012f),
              placed(0, height, depth / 2));
  constexpr std::array<float, 6> levels = {0.08f, 0.46f, 0.8f, 1.12f, 1.44f, 1.75f};
  for (const float y : levels) {
    mesh.append(box({width, board, depth}, oak, 0.004f), placed(0, y - board, depth / 2));
  }
  constexpr float bay = width / 3;
  for (unsigned level = 0; level < levels.size(); ++level) {
    for (unsigned column = 0; column < 3; ++column) {
      const unsigned seed = level * 3 + column;
      const float left = -width / 2 + bay * float(column) + board;
      const float y = levels[level];
      if (seed % 7 == 5) {
        mesh.append(vase(0.24f, shaded(petrol, 1.2f)), placed(left + 0.14f, y, 0.17f));
        mesh.append(book_pile(seed), placed(left + 0.33f, y, 0.16f, 10));
      } else if (seed % 7 == 3) {
        mesh.append(book_row(0.25f, 0.24f, seed), placed(left, y, 0.05f));
        mesh.append(vase(0.2f, mustard), placed(left + 0.36f, y, 0.17f));
      } else {
        mesh.append(book_row(seed % 2 == 0 ? 0.43f : 0.36f, 0.25f, seed), placed(left, y, 0.05f));
      }
    }
  }
  mesh.append(vase(0.3f, brick), placed(-0.5f, height + 0.05f, 0.16f));
  mesh.append(plant(0.35f, 21), placed(0.35f, height + 0.05f, 0.17f));
  return mesh;
}

Mesh television() {
  constexpr float width = 1.7f, height = 0.42f, depth = 0.4f;
  Mesh mesh = legs(width, depth, 0.1f, 0.025f, black);
  mesh.append(box({width, height, depth}, walnut, 0.01f), placed(0, 0.09f, depth / 2));
  for (const float x : {-0.56f, 0.0f, 0.56f}) {  // drawers with knobs
    mesh.append(box({0.52f, 0.34f, 0.025f}, shaded(walnut, 1.15f), 0.008f),
                placed(x, 0.13f, depth + 0.01f));
    mesh.append(superellipsoid({0.018f, 0.018f, 0.022f}, 1, 1, steel, 12),
                placed(x, 0.31f, depth + 0.04f));
  }
  const float top = 0.09f + height;
  const std::array<Vector2f, 6> foot = {Vector2f{0, 0},  {0.15f, 0},     {0.15f, 0.012f},
                                        {0.03f, 0.025f}, {0.025f, 0.1f}, {0, 0.1f}};
  mesh.append(lathe(foot, black), placed(-0.1f, top, 0.2f));
  mesh.append(box({1.0f, 0.6f, 0.045f}, black, 0.012f), placed(-0.1f, top + 0.08f, 0.2f));
  mesh.append(sheet(16, 10, {52, 58, 74}, [top](float u, float v) {
    const float bulge = 0.012f * (1 - (2 * u - 1) * (2 * u - 1));
    return Vector3f(-0.57f + 0.94f * u, top + 0.11f + 0.54f * v, 0.224f + bulge);
  }));
  mesh.append(table_lamp(), placed(0.66f, top, 0.06f));
  mesh.append(book_row(0.14f, 0.22f, 40), placed(-0.84f, top, 0.1f));
  return mesh;
}

Mesh radiator() {
  Mesh mesh;
  for (int i = 0; i < 14; ++i) {
    mesh.append(box({0.062f, 0.5f, 0.09f}, white, 0.02f),
                placed(-0.585f + 0.09f * float(i), 0.12f, 0.08f));
  }
  for (const float y : {0.17f, 0.57f}) {
    const std::array<Vector3f, 2> pipe = {Vector3f{-0.6f, y, 0.08f}, {0.6f, y, 0.08f}};
    mesh.append(rod(pipe, 0.018f, 0.018f, white));
  }
  return mesh;
}

}  // namespace slambench
