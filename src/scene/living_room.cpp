// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "scene/living_room.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "scene/furniture.h"
#include "scene/shapes.h"

// Built with y up and +z south (shapes.h), turned to the world's axes at the end.
namespace slambench {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float half = living_room_half_m, height = living_room_height_m;
constexpr Rgb8 plaster{226, 218, 202}, paint{240, 238, 232}, green{128, 148, 130},
    ceiling_white{244, 243, 240};

/// A mesh on the middle of one of the walls, or standing before it: `along` runs to the right as
/// seen by who faces the wall.
enum class Wall { north, east, south, west };

Eigen::Affine3f at_wall(Wall wall, float along, float y = 0, float away = 0) {
  switch (wall) {
    case Wall::north:
      return placed(along, y, -half + away, 0);
    case Wall::east:
      return placed(half - away, y, along, -90);
    case Wall::south:
      return placed(-along, y, half - away, 180);
    case Wall::west:
      break;
  }
  return placed(-half + away, y, -along, 90);
}

Mesh floor_boards() {
  constexpr int rows = 30;
  constexpr float width = 2 * half / rows;
  constexpr std::array<Rgb8, 4> woods = {
      Rgb8{158, 116, 76}, {150, 108, 70}, {166, 124, 84}, {144, 104, 68}};
  Mesh mesh;
  for (int row = 0; row < rows; ++row) {
    // Boards of four lengths, staggered from row to row.
    std::vector<float> joints = {-half};
    for (int i = 0; i < 4; ++i)
      joints.push_back(-half + 0.5f + 1.1f * float(i) + 0.13f * float(row * 5 % 7));
    joints.push_back(half);
    for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
      const float from = joints[i], length = joints[i + 1] - from;
      mesh.append(sheet(std::max(1, static_cast<int>(length / 0.15f)), 1,
                        woods[(static_cast<std::size_t>(row) * 3 + i * 5) % 4],
                        [&](float u, float v) {
                          return Vector3f(from + length * u, 0, half - width * (float(row) + v));
                        }));
    }
  }
  return mesh;
}

Mesh rug() {
  constexpr float width = 2.3f, depth = 1.6f;
  Mesh mesh = box({width, 0.015f, depth}, {150, 60, 56}, 0.006f, 0.03f);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vector3f& p = mesh.vertices[i];
    const float edge = std::min(width / 2 - std::abs(p.x()), depth / 2 - std::abs(p.z()));
    const bool diamond = std::fmod(std::abs(p.x()) + std::abs(p.z()), 0.4f) < 0.14f;
    if (edge < 0.1f || (edge > 0.2f && diamond)) mesh.colors[i] = {214, 190, 150};
  }
  return mesh;
}

/// The wall's own surface and what is fixed to every wall: skirting, raised panels under a rail,
/// pilasters, and a moulding under the ceiling.
Mesh wall_with_mouldings() {
  Mesh mesh = sheet(46, 26, plaster,
                    [](float u, float v) { return Vector3f(half * (2 * u - 1), height * v, 0); });
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (mesh.vertices[i].y() < 0.9f) mesh.colors[i] = green;
  }
  const auto run = [&](std::span<const Vector2f> outline, float y) {
    Mesh strip = extrusion(outline, 2 * half, paint);
    Eigen::Affine3f pose = placed(-half, y, 0, 90);  // drawn out along +x; outline x is then -z
    mesh.append(strip, pose);
  };
  const std::array<Vector2f, 5> skirting = {
      Vector2f{0, 0}, {0, 0.11f}, {-0.008f, 0.11f}, {-0.022f, 0.09f}, {-0.022f, 0}};
  const std::array<Vector2f, 5> rail = {
      Vector2f{0, 0}, {0, 0.06f}, {-0.03f, 0.05f}, {-0.035f, 0.02f}, {-0.012f, 0}};
  const std::array<Vector2f, 6> crown = {Vector2f{0, 0},  {0, 0.12f},      {-0.12f, 0.12f},
                                         {-0.11f, 0.08f}, {-0.05f, 0.03f}, {-0.02f, 0}};
  run(skirting, 0);
  run(rail, 0.9f);
  run(crown, height - 0.12f);
  constexpr int panels = 6;
  for (int i = 0; i < panels; ++i) {
    const float x = half * (2 * (float(i) + 0.5f) / panels - 1);
    mesh.append(box({0.56f, 0.6f, 0.03f}, shaded(green, 1.06f), 0.012f), placed(x, 0.2f, 0.005f));
  }
  for (const float x : {-1.0f, -0.42f, 0.42f, 1.0f}) {
    mesh.append(box({0.12f, height - 1.08f, 0.05f}, paint, 0.01f),
                placed(x * (half - 0.08f), 0.96f, 0.02f));
  }
  return mesh;
}

Mesh shell() {
  Mesh mesh = floor_boards();
  for (const Wall wall : {Wall::north, Wall::east, Wall::south, Wall::west}) {
    mesh.append(wall_with_mouldings(), at_wall(wall, 0));
  }
  mesh.append(sheet(30, 30, ceiling_white, [](float u, float v) {
    return Vector3f(half * (2 * u - 1), height, half * (2 * v - 1));
  }));
  for (const float x : {-1.15f, 0.0f, 1.15f}) {  // beams
    mesh.append(box({0.14f, 0.1f, 2 * half}, {150, 112, 78}, 0.01f), placed(x, height - 0.1f, 0));
  }
  return mesh;
}

void furnish_north(Mesh* room) {
  room->append(sofa(), at_wall(Wall::north, -0.1f, 0, 0.06f));
  room->append(side_table(), at_wall(Wall::north, -1.38f, 0, 0.05f));
  room->append(table_lamp(), at_wall(Wall::north, -1.38f, 0.55f, 0.17f));
  room->append(plant(1.25f, 2), at_wall(Wall::north, -1.8f, 0, 0.5f));
  room->append(floor_lamp(), at_wall(Wall::north, 1.22f, 0, 0.08f));
  room->append(picture(0.62f, 0.48f, 1), at_wall(Wall::north, -0.5f, 1.62f));
  room->append(picture(0.46f, 0.62f, 2), at_wall(Wall::north, 0.18f, 1.66f));
  room->append(picture(0.5f, 0.4f, 3), at_wall(Wall::north, -1.5f, 1.68f));
  room->append(wall_clock(), at_wall(Wall::north, 1.62f, 1.86f));
}

void furnish_east(Mesh* room) {
  room->append(window(1.5f, 1.2f), at_wall(Wall::east, 0, 0.98f, 0.05f));
  room->append(radiator(), at_wall(Wall::east, 0));
  for (const float side : {-1.0f, 1.0f}) {
    room->append(curtain(0.6f, 2.2f), at_wall(Wall::east, side * 0.92f, 0.08f));
  }
  room->append(plant(0.42f, 31), at_wall(Wall::east, -0.4f, 0.98f, 0.18f));
  room->append(vase(0.22f, {90, 120, 150}), at_wall(Wall::east, 0.42f, 0.98f, 0.15f));
  room->append(armchair({86, 112, 92}), placed(2.06f, 0, -1.0f, -72));
  room->append(armchair({146, 92, 62}), placed(2.0f, 0, 1.28f, -118));
  room->append(picture(0.42f, 0.52f, 4), at_wall(Wall::east, -1.75f, 1.6f));
  room->append(picture(0.42f, 0.34f, 6), at_wall(Wall::east, 1.72f, 1.62f));
}

void furnish_south(Mesh* room) {
  room->append(television(), at_wall(Wall::south, 0.05f, 0, 0.04f));
  room->append(picture(0.5f, 0.66f, 7), at_wall(Wall::south, 1.45f, 1.6f));
  room->append(picture(0.6f, 0.44f, 5), at_wall(Wall::south, -1.5f, 1.6f));
  room->append(picture(0.9f, 0.36f, 9), at_wall(Wall::south, 0, 1.95f));
  room->append(plant(1.05f, 4), at_wall(Wall::south, -1.75f, 0, 0.45f));
  room->append(footstool(), at_wall(Wall::south, 1.3f, 0, 0.1f));
  room->append(book_pile(17), at_wall(Wall::south, 1.22f, 0.4f, 0.3f));
}

void furnish_west(Mesh* room) {
  room->append(bookshelf(), at_wall(Wall::west, 0.35f, 0, 0.03f));
  room->append(door(), at_wall(Wall::west, -1.35f, 0, 0.03f));
  room->append(picture(0.36f, 0.46f, 8), at_wall(Wall::west, -0.64f, 1.6f));
  room->append(vase(0.55f, {170, 120, 84}), at_wall(Wall::west, -0.64f, 0, 0.2f));
  room->append(flowers(12), at_wall(Wall::west, -0.64f, 0.5f, 0.2f));
  room->append(picture(0.4f, 0.5f, 10), at_wall(Wall::west, 1.6f, 1.62f));
}

void furnish_middle(Mesh* room) {
  room->append(rug(), placed(0, 0, -0.2f));
  room->append(coffee_table(), placed(0.05f, 0.015f, -0.62f));
  room->append(ceiling_lamp(), placed(0, height, -0.1f));
}

}  // namespace

Mesh living_room() {
  Mesh room = shell();
  furnish_north(&room);
  furnish_east(&room);
  furnish_south(&room);
  furnish_west(&room);
  furnish_middle(&room);
  room.transform(
      Eigen::Affine3f(Eigen::AngleAxisf(std::numbers::pi_v<float>, Eigen::Vector3f::UnitX())));
  return room;
}

}  // namespace slambench
