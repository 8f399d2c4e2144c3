// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "scene/mesh.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/DefaultIOSystem.h>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "core/error.h"
#include "io/files.h"
#include "scene/ply.h"

namespace slambench {
namespace {

std::uint8_t to_byte(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

/// The mesh's vertex colours, else its material's, else grey.
Rgb8 color_of(const aiScene& scene, const aiMesh& mesh, unsigned vertex) {
  aiColor4D color(0.7f, 0.7f, 0.7f, 1.0f);
  if (mesh.HasVertexColors(0)) {
    color = mesh.mColors[0][vertex];
  } else if (mesh.mMaterialIndex < scene.mNumMaterials) {
    scene.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_COLOR_DIFFUSE, color);
  }
  return {to_byte(color.r), to_byte(color.g), to_byte(color.b)};
}

void append_mesh(const std::string& path, const aiScene& scene, const aiMesh& part, Mesh* mesh) {
  const auto first = static_cast<std::uint32_t>(mesh->vertices.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& v = part.mVertices[i];
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
      throw InputError(path, fmt::format("vertex {}", first + i), "a coordinate that is not finite",
                       "numbers");
    }
    mesh->vertices.emplace_back(v.x, v.y, v.z);
    mesh->colors.push_back(color_of(scene, part, i));
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines have no surface
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (face.mIndices[k] >= part.mNumVertices) {
        throw InputError(path, fmt::format("face {}", i),
                         fmt::format("vertex {}", face.mIndices[k]),
                         fmt::format("at most {}", part.mNumVertices - 1));
      }
      triangle[k] = first + face.mIndices[k];
    }
    mesh->triangles.push_back(triangle);
  }
}

/// Opens files that hold something: of folders and empty files, which an OBJ may name as its
/// materials, Assimp's parser does not let go.
class FilesWithContents final : public Assimp::DefaultIOSystem {
 public:
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    std::error_code ignored;
    const bool usable = std::filesystem::is_regular_file(file, ignored) &&
                        std::filesystem::file_size(file, ignored) > 0;
    return usable ? DefaultIOSystem::Open(file, mode) : nullptr;
  }
};

/// With its materials, which lie in files beside it.
Mesh read_obj(const std::string& path) {
  Assimp::Importer importer;
  importer.SetIOHandler(new FilesWithContents);  // the importer's from now on
  const aiScene* const scene =
      importer.ReadFile(path, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                  aiProcess_PreTransformVertices);
  if (scene == nullptr) {
    throw InputError(fmt::format("{}: cannot read the mesh: {}", path, importer.GetErrorString()));
  }
  Mesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    append_mesh(path, *scene, *scene->mMeshes[i], &mesh);
  }
  return mesh;
}

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
