// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/DefaultIOSystem.h>
#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "core/error.h"
#include "scene/obj.h"

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

}  // namespace

bool can_read_obj() { return true; }

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

}  // namespace slambench
