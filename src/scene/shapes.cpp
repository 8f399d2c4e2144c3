// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "scene/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace slambench {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float pi = std::numbers::pi_v<float>;

/// The coordinates at which a rounded edge of length `size` is cut: finely over the rounding, in
/// cells between.
std::vector<float> cuts(float size, float radius, float cell_m) {
  const int arc_steps = radius < 0.02f ? 1 : radius < 0.05f ? 2 : 4;
  const float half = size / 2;
  std::vector<float> at;
  if (radius > 0) {
    for (int i = 0; i < arc_steps; ++i) {
      at.push_back(-half + radius * (1 - std::tan(pi / 4 * (1 - float(i) / arc_steps))));
    }
  }
  const float flat = size - 2 * radius;
  const int cells = std::max(1, static_cast<int>(std::ceil(flat / cell_m)));
  for (int i = 0; i <= cells; ++i) {
    at.push_back(-half + radius + flat * float(i) / float(cells));
  }
  if (radius > 0) {
    for (int i = 1; i <= arc_steps; ++i) {
      at.push_back(half - radius + radius * std::tan(pi / 4 * float(i) / arc_steps));
    }
  }
  return at;
}

float signed_power(float base, float exponent) {
  return std::copysign(std::pow(std::abs(base), exponent), base);
}

/// Adds the quads of a grid of vertices that starts at `first`, row by row.
void stitch(Mesh* mesh, std::size_t first, int columns, int rows) {
  const auto at = [&](int x, int y) {
    return static_cast<std::uint32_t>(first + static_cast<std::size_t>(y * (columns + 1) + x));
  };
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      mesh->triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh->triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
}

void add_vertex(Mesh* mesh, const Vector3f& point, Rgb8 color) {
  mesh->vertices.push_back(point);
  mesh->colors.push_back(color);
}

/// One of the six faces of a rounded box around the origin: `axis` with its sign, drawn over the
/// two following axes.
void add_face(Mesh* mesh, const Vector3f& size, float radius, float cell_m, int axis, float sign,
              Rgb8 color) {
  const int a = (axis + (sign > 0 ? 1 : 2)) % 3, b = (axis + (sign > 0 ? 2 : 1)) % 3;
  const auto along_a = cuts(size[a], radius, cell_m), along_b = cuts(size[b], radius, cell_m);
  const Vector3f core = size / 2 - Vector3f::Constant(radius);
  const std::size_t first = mesh->vertices.size();
  for (const float q : along_b) {
    for (const float p : along_a) {
      Vector3f point;
      point[axis] = sign * size[axis] / 2;
      point[a] = p;
      point[b] = q;
      const Vector3f inner = point.cwiseMin(core).cwiseMax(-core);
      if (radius > 0) point = inner + radius * (point - inner).normalized();
      add_vertex(mesh, point, color);
    }
  }
  stitch(mesh, first, static_cast<int>(along_a.size()) - 1, static_cast<int>(along_b.size()) - 1);
}

}  // namespace

Mesh sheet(int columns, int rows, Rgb8 color,
           const std::function<Vector3f(float u, float v)>& point) {
  Mesh mesh;
  for (int y = 0; y <= rows; ++y) {
    for (int x = 0; x <= columns; ++x) {
      add_vertex(&mesh, point(float(x) / float(columns), float(y) / float(rows)), color);
    }
  }
  stitch(&mesh, 0, columns, rows);
  return mesh;
}

Mesh box(const Vector3f& size, Rgb8 color, float radius, float cell_m) {
  const float fitting = std::min(radius, 0.499f * size.minCoeff());
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0f, 1.0f}) {
      add_face(&mesh, size, fitting, cell_m, axis, sign, color);
    }
  }
  mesh.transform(placed(0, size.y() / 2, 0));
  return mesh;
}

Mesh superellipsoid(const Vector3f& radii, float exponent_vertical, float exponent_round,
                    Rgb8 color, int segments) {
  return sheet(segments, segments / 2, color, [&](float u, float v) {
    const float longitude = -2 * pi * u, latitude = pi * (v - 0.5f);
    const float ring = signed_power(std::cos(latitude), exponent_vertical);
    return Vector3f(radii.x() * ring * signed_power(std::cos(longitude), exponent_round),
                    radii.y() * signed_power(std::sin(latitude), exponent_vertical),
                    radii.z() * ring * signed_power(std::sin(longitude), exponent_round));
  });
}

Mesh lathe(std::span<const Vector2f> profile, Rgb8 color, int segments) {
  const int rows = static_cast<int>(profile.size()) - 1;
  return sheet(segments, rows, color, [&](float u, float v) {
    const auto row = static_cast<std::size_t>(std::lround(v * float(rows)));
    const float angle = -2 * pi * u;
    return Vector3f(profile[row].x() * std::cos(angle), profile[row].y(),
                    profile[row].x() * std::sin(angle));
  });
}

Mesh rod(std::span<const Vector3f> spine, float radius_begin, float radius_end, Rgb8 color,
         int segments) {
  const int rows = static_cast<int>(spine.size()) - 1;
  return sheet(segments, rows, color, [&](float u, float v) {
    const int row = static_cast<int>(std::lround(v * float(rows)));
    const Vector3f& before = spine[static_cast<std::size_t>(std::max(row - 1, 0))];
    const Vector3f& after = spine[static_cast<std::size_t>(std::min(row + 1, rows))];
    const Vector3f along = (after - before).normalized();
    const Vector3f helper = std::abs(along.y()) < 0.9f ? Vector3f::UnitY() : Vector3f::UnitX();
    const Vector3f side = along.cross(helper).normalized();
    const Vector3f other = along.cross(side);
    const float radius = radius_begin + (radius_end - radius_begin) * v;
    const float angle = 2 * pi * u;
    const Vector3f offset = radius * (std::cos(angle) * side + std::sin(angle) * other);
    return Vector3f(spine[static_cast<std::size_t>(row)] + offset);
  });
}

Mesh extrusion(std::span<const Vector2f> outline, float length, Rgb8 color) {
  const int cells = std::max(1, static_cast<int>(std::ceil(length / 0.2f)));
  Mesh mesh;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2f& from = outline[i];
    const Vector2f& to = outline[(i + 1) % outline.size()];
    mesh.append(sheet(1, cells, color, [&](float u, float v) {
      const Vector2f p = from + u * (to - from);
      return Vector3f(p.x(), p.y(), length * v);
    }));
  }
  return mesh;
}

Mesh leaf(float length, float width, float rise, float droop, Rgb8 color) {
  const auto side = [&](float sign) {
    return sheet(4, 8, color, [&, sign](float u, float v) {
      const float across = (u - 0.5f) * 2 * sign;
      // Slightly off zero at the ends, so that no triangle is without area.
      const float half = width / 2 * std::max(0.02f, std::sin(pi * std::pow(v, 0.8f)));
      const float fold = 0.25f * half * std::abs(across);
      return Vector3f(across * half, rise * v - droop * v * v + fold, length * v);
    });
  };
  Mesh mesh = side(-1);
  mesh.append(side(1));
  return mesh;
}

Eigen::Affine3f placed(float x, float y, float z, float turn_deg) {
  return Eigen::Affine3f(Eigen::Translation3f(x, y, z) *
                         Eigen::AngleAxisf(turn_deg * pi / 180, Vector3f::UnitY()));
}

Rgb8 shaded(Rgb8 color, float factor) {
  const auto scale = [&](std::uint8_t value) {
    return static_cast<std::uint8_t>(std::clamp(float(value) * factor, 0.0f, 255.0f));
  };
  return {scale(color.r), scale(color.g), scale(color.b)};
}

}  // namespace slambench
