// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "scene/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>
#include <filesystem>

#include "core/error.h"
#include "io/files.h"
#include "scene/obj.h"
#include "scene/ply.h"

namespace slambench {
namespace {

template <class T>
void put(std::string* bytes, T value) {
  static_assert(std::endian::native == std::endian::little);
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes->append(raw, sizeof(T));
}

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace

void Mesh::append(const Mesh& part, const Eigen::Affine3f& pose) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (const auto& vertex : part.vertices) vertices.push_back(pose * vertex);
  colors.insert(colors.end(), part.colors.begin(), part.colors.end());
  for (const auto& t : part.triangles) {
    triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
}

void Mesh::transform(const Eigen::Affine3f& pose) {
  for (auto& vertex : vertices) vertex = pose * vertex;
}

std::vector<Eigen::Vector3f> vertex_normals(const Mesh& mesh) {
  std::vector<Eigen::Vector3f> normals(mesh.vertices.size(), Eigen::Vector3f::Zero());
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3f a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    const Eigen::Vector3f twice_area = (b - a).cross(c - a);
    for (const std::uint32_t i : t) normals[i] += twice_area;
  }
  for (auto& normal : normals) {
    const float length = normal.norm();
    if (length > 0) normal /= length;
  }
  return normals;
}

Mesh read_mesh(const std::string& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".obj" && extension != ".ply") {
    throw InputError(path, "file name", extension.empty() ? "no extension" : extension,
                     ".obj or .ply");
  }
  const std::string contents = read_file(path);
  // The shortest OBJ with a triangle is longer; Assimp leaves a shorter file open.
  constexpr std::size_t shortest = 16;
  if (contents.size() < shortest) {
    throw InputError(path, "contents",
                     contents.empty() ? "an empty file" : fmt::format("{} bytes", contents.size()),
                     "a mesh");
  }
  Mesh mesh = extension == ".ply" ? parse_ply(path, contents) : read_obj(path);
  if (mesh.triangles.empty()) throw InputError(path, "faces", "none", "triangles");
  return mesh;
}

std::string ply_bytes(const Mesh& mesh) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment metres\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  bytes.reserve(bytes.size() + mesh.vertices.size() * 15 + mesh.triangles.size() * 13);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    for (int k = 0; k < 3; ++k) put(&bytes, mesh.vertices[i][k]);
    put(&bytes, mesh.colors[i]);
  }
  for (const auto& triangle : mesh.triangles) {
    put(&bytes, std::uint8_t{3});
    for (const std::uint32_t index : triangle) put(&bytes, static_cast<std::int32_t>(index));
  }
  return bytes;
}

}  // namespace slambench
