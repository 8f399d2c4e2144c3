// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "scene/furniture.h"
#include "scene/shapes.h"

namespace slambench {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float pi = std::numbers::pi_v<float>;
constexpr Rgb8 white{236, 234, 228}, brass{186, 150, 84}, black{38, 38, 42}, linen{222, 208, 182},
    earth{72, 52, 40}, terracotta{176, 98, 66}, wood{138, 98, 64};

/// Numbers in [low, high), the same everywhere.
class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed * 7919u + 17u) { engine_.discard(5); }
  float between(float low, float high) {
    const double unit = double(engine_() - std::minstd_rand::min()) /
                        double(std::minstd_rand::max() - std::minstd_rand::min());
    return low + (high - low) * static_cast<float>(unit);
  }
  template <std::size_t N>
  Rgb8 pick(const std::array<Rgb8, N>& colors) {
    return colors[std::min(N - 1, static_cast<std::size_t>(between(0, float(N))))];
  }

 private:
  std::minstd_rand engine_;
};

constexpr std::array<Rgb8, 8> book_colors = {Rgb8{142, 44, 40}, {38, 74, 110}, {196, 160, 84},
                                             {58, 92, 62},      {96, 58, 88},  {206, 196, 176},
                                             {46, 46, 54},      {190, 104, 52}};

Mesh book(const Vector3f& size, Rgb8 color) {
  Mesh mesh = box(size, color, 0.004f);
  // The pages stand back a little between the covers.
  mesh.append(box({size.x() * 0.8f, size.y() * 1.004f, size.z() * 0.9f}, {226, 220, 200}));
  return mesh;
}

}  // namespace

Mesh book_row(float length, float height, unsigned seed) {
  Dice dice(seed);
  Mesh mesh;
  for (float x = 0;;) {
    const float thick = dice.between(0.018f, 0.048f);
    if (x + thick > length) return mesh;
    const float tall = height * dice.between(0.72f, 1.0f), deep = dice.between(0.14f, 0.21f);
    mesh.append(book({thick * 0.96f, tall, deep}, dice.pick(book_colors)),
                placed(x + thick / 2, 0, 0.2f - deep / 2 + dice.between(-0.02f, 0.015f)));
    x += thick;
  }
}

Mesh book_pile(unsigned seed) {
  Dice dice(seed);
  Mesh mesh;
  float y = 0;
  for (int i = 0; i < 4; ++i) {
    const float thick = dice.between(0.018f, 0.04f);
    mesh.append(box({dice.between(0.15f, 0.2f), thick, dice.between(0.21f, 0.26f)},
                    dice.pick(book_colors), 0.004f),
                placed(0, y, 0, dice.between(-16, 16)));
    y += thick;
  }
  return mesh;
}

Mesh vase(float height, Rgb8 color) {
  std::array<Vector2f, 15> profile;
  profile[0] = {0, 0};
  for (std::size_t i = 1; i < 13; ++i) {
    const float t = float(i - 1) / 11;
    profile[i] = {height * (0.17f + 0.16f * std::sin(pi * std::pow(t, 0.75f)) - 0.08f * t),
                  height * t};
  }
  profile[13] = {profile[12].x() * 0.85f, height};
  profile[14] = {profile[12].x() * 0.8f, height * 0.75f};
  return lathe(profile, color);
}

Mesh bowl_of_fruit() {
  const std::array<Vector2f, 10> profile = {
      Vector2f{0, 0}, {0.06f, 0},      {0.06f, 0.012f}, {0.1f, 0.03f},   {0.14f, 0.07f},
      {0.15f, 0.09f}, {0.14f, 0.088f}, {0.1f, 0.045f},  {0.05f, 0.022f}, {0, 0.02f}};
  Mesh mesh = lathe(profile, white, 36);
  const std::array<Vector3f, 5> at = {Vector3f{-0.05f, 0.07f, 0.02f},
                                      {0.05f, 0.07f, 0.03f},
                                      {0, 0.07f, -0.06f},
                                      {0.01f, 0.115f, 0.01f},
                                      {-0.07f, 0.085f, -0.05f}};
  constexpr std::array<Rgb8, 3> colors = {Rgb8{206, 122, 40}, {176, 40, 36}, {150, 170, 60}};
  for (std::size_t i = 0; i < at.size(); ++i) {
    mesh.append(superellipsoid({0.042f, 0.038f, 0.042f}, 1, 1, colors[i % 3], 16),
                placed(at[i].x(), at[i].y(), at[i].z()));
  }
  return mesh;
}

Mesh plant(float height, unsigned seed) {
  Dice dice(seed);
  const float pot = 0.26f * height;
  const std::array<Vector2f, 7> profile = {
      Vector2f{0, 0},     {pot * 0.42f, 0},   {pot * 0.58f, pot * 0.9f}, {pot * 0.64f, pot * 0.92f},
      {pot * 0.64f, pot}, {pot * 0.54f, pot}, {pot * 0.52f, pot * 0.9f}};
  Mesh mesh = lathe(profile, terracotta);
  const std::array<Vector2f, 2> soil = {Vector2f{pot * 0.55f, pot * 0.9f}, {0, pot * 0.93f}};
  mesh.append(lathe(soil, earth));
  const int count = 26;
  for (int i = 0; i < count; ++i) {
    const float t = float(i) / float(count);
    const float turn = 137.5f * float(i), stem = pot + (height - pot) * 0.5f * t;
    const float reach = height * dice.between(0.26f, 0.36f) * (1.1f - 0.4f * t);
    const Rgb8 green{static_cast<std::uint8_t>(52 + 40 * dice.between(0, 1)),
                     static_cast<std::uint8_t>(104 + 40 * dice.between(0, 1)), 52};
    mesh.append(leaf(reach, reach * 0.36f, reach * dice.between(0.8f, 1.5f),
                     reach * dice.between(0.5f, 0.9f), green),
                placed(0, stem, 0, turn));
  }
  const std::array<Vector3f, 3> trunk = {Vector3f{0, pot * 0.9f, 0},
                                         {0.01f * height, height * 0.4f, 0},
                                         {0, pot + (height - pot) * 0.5f, 0}};
  mesh.append(rod(trunk, 0.018f * height, 0.01f * height, wood));
  return mesh;
}

Mesh flowers(unsigned seed) {
  Dice dice(seed);
  Mesh mesh;
  for (int i = 0; i < 9; ++i) {
    const float angle = 0.7f * float(i), spread = dice.between(0.03f, 0.11f);
    const Vector3f tip(spread * std::cos(angle), dice.between(0.14f, 0.24f),
                       spread * std::sin(angle));
    const std::array<Vector3f, 3> stem = {
        Vector3f{0, -0.05f, 0}, Vector3f{tip.x() * 0.4f, tip.y() * 0.6f, tip.z() * 0.4f}, tip};
    mesh.append(rod(stem, 0.004f, 0.003f, {82, 120, 60}, 6));
    mesh.append(superellipsoid({0.032f, 0.024f, 0.032f}, 1, 1,
                               i % 2 == 0 ? Rgb8{214, 170, 60} : Rgb8{196, 84, 110}, 12),
                placed(tip.x(), tip.y(), tip.z()));
  }
  return mesh;
}

Mesh floor_lamp() {
  const std::array<Vector2f, 6> foot = {Vector2f{0, 0},  {0.15f, 0},      {0.15f, 0.015f},
                                        {0.05f, 0.035f}, {0.016f, 0.06f}, {0.016f, 0.08f}};
  const std::array<Vector3f, 2> stem = {Vector3f{0, 0.05f, 0}, {0, 1.5f, 0}};
  const std::array<Vector2f, 4> shade = {
      Vector2f{0.23f, 1.32f}, {0.14f, 1.66f}, {0.13f, 1.66f}, {0.22f, 1.32f}};
  Mesh mesh = lathe(foot, brass);
  mesh.append(rod(stem, 0.014f, 0.012f, brass, 12));
  mesh.append(lathe(shade, linen, 36));
  mesh.append(superellipsoid({0.05f, 0.07f, 0.05f}, 1, 1, white, 16), placed(0, 1.52f, 0));
  mesh.transform(placed(0, 0, 0.25f));
  return mesh;
}

Mesh table_lamp() {
  const std::array<Vector2f, 4> shade = {
      Vector2f{0.13f, 0.26f}, {0.08f, 0.46f}, {0.075f, 0.46f}, {0.125f, 0.26f}};
  Mesh mesh = vase(0.24f, {96, 128, 128});
  const std::array<Vector3f, 2> stem = {Vector3f{0, 0.15f, 0}, {0, 0.38f, 0}};
  mesh.append(rod(stem, 0.01f, 0.01f, brass));
  mesh.append(lathe(shade, linen, 32));
  mesh.transform(placed(0, 0, 0.14f));
  return mesh;
}

Mesh ceiling_lamp() {
  const std::array<Vector2f, 5> rose = {
      Vector2f{0, -0.04f}, {0.05f, -0.04f}, {0.09f, -0.02f}, {0.1f, 0}, {0, 0}};
  const std::array<Vector3f, 2> stem = {Vector3f{0, -0.24f, 0}, {0, -0.03f, 0}};
  Mesh mesh = lathe(rose, brass);
  mesh.append(rod(stem, 0.012f, 0.012f, brass));
  for (int i = 0; i < 5; ++i) {
    const float angle = 2 * pi * float(i) / 5, x = std::cos(angle), z = std::sin(angle);
    const std::array<Vector3f, 5> arm = {Vector3f{0, -0.22f, 0},
                                         {0.1f * x, -0.27f, 0.1f * z},
                                         {0.2f * x, -0.28f, 0.2f * z},
                                         {0.27f * x, -0.24f, 0.27f * z},
                                         {0.29f * x, -0.2f, 0.29f * z}};
    mesh.append(rod(arm, 0.009f, 0.009f, brass));
    mesh.append(superellipsoid({0.07f, 0.07f, 0.07f}, 1, 1, white, 20),
                placed(0.29f * x, -0.16f, 0.29f * z));
  }
  return mesh;
}

Mesh picture(float width, float height, unsigned seed) {
  Dice dice(seed);
  constexpr float border = 0.045f, depth = 0.03f;
  const std::array<Rgb8, 3> frames = {Rgb8{92, 62, 40}, {40, 38, 38}, {188, 152, 88}};
  const Rgb8 frame = frames[seed % 3];
  Mesh mesh;
  for (const float side : {-1.0f, 1.0f}) {
    mesh.append(box({width, border, depth}, frame, 0.008f),
                placed(0, side * (height - border) / 2 - border / 2, depth / 2));
    mesh.append(box({border, height, depth}, frame, 0.008f),
                placed(side * (width - border) / 2, -height / 2, depth / 2));
  }
  // Hills under a sky.
  const std::array<Rgb8, 4> bands = {
      Rgb8{86, 112, 76}, {136, 140, 84}, {188, 160, 120}, {150, 184, 206}};
  const float phase = dice.between(0, 6), slope = dice.between(3, 7);
  Mesh canvas = sheet(24, 24, {}, [&](float u, float v) {
    return Vector3f((u - 0.5f) * (width - border), (v - 0.5f) * (height - border), 0.012f);
  });
  for (std::size_t i = 0; i < canvas.vertices.size(); ++i) {
    const Vector3f& p = canvas.vertices[i];
    const float level = 2 + 4 * p.y() / height + 0.5f * std::sin(slope * p.x() / width * 2 + phase);
    canvas.colors[i] = bands[static_cast<std::size_t>(std::clamp(level, 0.0f, 3.0f))];
  }
  mesh.append(canvas);
  return mesh;
}

Mesh window(float width, float height) {
  Mesh mesh;
  for (const float side : {-1.0f, 0.0f, 1.0f}) {
    const float bar = side == 0 ? 0.05f : 0.08f;
    mesh.append(box({bar, height, 0.07f}, white, 0.012f),
                placed(side * (width - bar) / 2, 0, 0.03f));
  }
  for (const float level : {0.0f, 0.62f, 1.0f}) {
    const float bar = level == 0.62f ? 0.045f : 0.08f;
    mesh.append(box({width, bar, 0.07f}, white, 0.012f), placed(0, level * (height - bar), 0.03f));
  }
  mesh.append(box({width + 0.16f, 0.035f, 0.2f}, white, 0.012f), placed(0, -0.035f, 0.1f));
  mesh.append(sheet(12, 12, {186, 214, 232}, [&](float u, float v) {
    return Vector3f((u - 0.5f) * width, v * height, 0.004f);
  }));
  const std::array<Vector3f, 3> handle = {Vector3f{0.03f, height * 0.42f, 0.06f},
                                          {0.03f, height * 0.42f, 0.1f},
                                          {0.03f, height * 0.34f, 0.1f}};
  mesh.append(rod(handle, 0.01f, 0.009f, brass));
  return mesh;
}

Mesh curtain(float width, float height) {
  const Rgb8 cloth{164, 84, 72};
  Mesh mesh = sheet(72, 14, cloth, [&](float u, float v) {
    const float folds = 0.045f + 0.012f * std::sin(9 * u + 2 * v);
    const float gather = 1 - 0.12f * std::sin(pi * v);
    return Vector3f((u - 0.5f) * width * gather, v * height,
                    0.1f + folds * std::sin(2 * pi * (5.5f * u + 0.08f * v)));
  });
  const std::array<Vector3f, 2> rail = {Vector3f{-width / 2 - 0.06f, height + 0.02f, 0.1f},
                                        {width / 2 + 0.06f, height + 0.02f, 0.1f}};
  mesh.append(rod(rail, 0.014f, 0.014f, brass, 12));
  for (int i = 0; i < 9; ++i) {
    mesh.append(superellipsoid({0.012f, 0.026f, 0.026f}, 1, 1, brass, 10),
                placed((float(i) / 8 - 0.5f) * width, height + 0.02f, 0.1f));
  }
  return mesh;
}

Mesh door() {
  constexpr float width = 0.86f, height = 2.02f, frame = 0.09f;
  const Rgb8 paint{206, 200, 186};
  Mesh mesh;
  for (const float side : {-1.0f, 1.0f}) {
    mesh.append(box({frame, height + frame, 0.06f}, white, 0.014f),
                placed(side * (width + frame) / 2, 0, 0.03f));
  }
  mesh.append(box({width + 2 * frame + 0.06f, frame, 0.075f}, white, 0.014f),
              placed(0, height, 0.035f));
  mesh.append(box({width, height, 0.02f}, paint, 0, 0.1f), placed(0, 0, 0.012f));
  for (const float x : {-0.2f, 0.2f}) {  // raised panels
    mesh.append(box({0.27f, 0.62f, 0.025f}, paint, 0.01f), placed(x, 0.2f, 0.025f));
    mesh.append(box({0.27f, 0.86f, 0.025f}, paint, 0.01f), placed(x, 1.02f, 0.025f));
  }
  mesh.append(box({0.045f, 0.2f, 0.012f}, brass, 0.004f), placed(0.37f, 0.95f, 0.026f));
  const std::array<Vector3f, 4> handle = {Vector3f{0.37f, 1.07f, 0.02f},
                                          {0.37f, 1.07f, 0.07f},
                                          {0.35f, 1.07f, 0.08f},
                                          {0.25f, 1.065f, 0.08f}};
  mesh.append(rod(handle, 0.012f, 0.01f, brass, 12));
  return mesh;
}

Mesh wall_clock() {
  const std::array<Vector2f, 7> profile = {Vector2f{0, 0}, {0.17f, 0},       {0.18f, 0.02f},
                                           {0.17f, 0.04f}, {0.155f, 0.038f}, {0.15f, 0.02f},
                                           {0, 0.02f}};
  Mesh mesh = lathe(profile, white, 40);
  mesh.append(box({0.012f, 0.006f, 0.13f}, black), placed(0, 0.024f, 0.05f));
  mesh.append(box({0.1f, 0.006f, 0.014f}, black), placed(0.04f, 0.024f, 0));
  Eigen::Affine3f upright = Eigen::Affine3f::Identity();
  upright.rotate(Eigen::AngleAxisf(pi / 2, Vector3f::UnitX()));
  mesh.transform(upright);
  return mesh;
}

}  // namespace slambench
