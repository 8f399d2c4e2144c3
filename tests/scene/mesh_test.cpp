// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "scene/mesh.h"
#include "scene/obj.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>

#include "core/error.h"
#include "io/files.h"
#include "scene/shapes.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

constexpr const char* ascii_ply =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 1 255 0 0\n1 0 1 0 255 0\n1 1 1 0 0 255\n0 1 1 9 8 7\n4 0 1 2 3\n";

/// Twice the signed volume that a closed mesh encloses; positive when its outside is outside.
double six_volumes(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    sum += mesh.vertices[t[0]].cross(mesh.vertices[t[1]]).dot(mesh.vertices[t[2]]);
  }
  return sum;
}

TEST(Mesh, ReadsBackWhatPlyBytesWrote) {
  const TemporaryFolder folder;
  Mesh mesh = box({1, 2, 3}, {10, 20, 30});
  mesh.colors[3] = {200, 100, 50};
  write_file(folder.path("box.ply"), ply_bytes(mesh));
  const Mesh read = read_mesh(folder.path("box.ply"));
  ASSERT_EQ(read.triangles.size(), mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = mesh.triangles[i][k], b = read.triangles[i][k];
      ASSERT_EQ(a, b);
      ASSERT_EQ(mesh.vertices[a], read.vertices[b]);
      ASSERT_EQ(mesh.colors[a], read.colors[b]);
    }
  }
}

TEST(Mesh, CutsPolygonsAndKeepsColours) {
  const TemporaryFolder folder;
  const Mesh mesh = read_mesh(folder.write("quad.ply", ascii_ply));
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_THAT(mesh.colors, ::testing::Contains(Rgb8{9, 8, 7}));
}

TEST(Mesh, ReadsObjWithoutColoursAsGrey) {
  const TemporaryFolder folder;
  if (!can_read_obj()) GTEST_SKIP() << "built without Assimp";
  const Mesh mesh =
      read_mesh(folder.write("t.obj", "v 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\nf 1 2 3\nf 2 4 3\n"));
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.colors.at(0).r, mesh.colors.at(0).b);
}

TEST(Mesh, RejectsBadFilesByName) {
  const TemporaryFolder folder;
  const auto error_of = [&](const char* name, const char* contents) {
    return message_of<InputError>([&] { read_mesh(folder.write(name, contents)); });
  };
  EXPECT_THAT(message_of<InputError>([&] { read_mesh(folder.path("none.ply")); }),
              HasSubstr("none.ply: cannot read: No such file"));
  EXPECT_THAT(error_of("empty.ply", ""), HasSubstr("an empty file"));
  EXPECT_THAT(error_of("mesh.stl", "solid"), HasSubstr("expected .obj or .ply"));
  EXPECT_THAT(error_of("garbage.ply", "not a mesh at all"), HasSubstr("garbage.ply"));
  if (!can_read_obj()) GTEST_SKIP() << "built without Assimp: OBJ files are left out";
  EXPECT_THAT(error_of("points.obj", "v 0 0 0\nv 1 1 1\n"), HasSubstr("points.obj"));
  EXPECT_THAT(error_of("nan.obj", "v nan 0 1\nv 1 0 1\nv 0 1 1\nf 1 2 3\n"), HasSubstr("nan.obj"));
}

TEST(Mesh, NoTruncatedPlyIsAMesh) {
  const TemporaryFolder folder;
  const std::string binary = ply_bytes(box({1, 1, 1}, {1, 2, 3}, 0, 1));
  for (const std::string& whole : {binary, std::string(ascii_ply, std::strlen(ascii_ply) - 3)}) {
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const std::string path = folder.write("cut.ply", std::string_view(whole).substr(0, size));
      EXPECT_THAT(message_of<InputError>([&] { read_mesh(path); }), HasSubstr("cut.ply: ")) << size;
    }
  }
}

TEST(Mesh, ReadsEveryKindOfPly) {
  const TemporaryFolder folder;
  // Big-endian doubles, a property of a name that means nothing here, and 16-bit indices.
  std::string big =
      "ply\r\nformat binary_big_endian 1.0\r\nelement vertex 3\r\nproperty double x\r\n"
      "property double y\r\nproperty double z\r\nproperty short quality\r\nelement face 1\r\n"
      "property list uchar ushort vertex_index\r\nend_header\r\n";
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      const double value = i == k ? 1.5 : 0;
      char raw[8];
      std::memcpy(raw, &value, 8);
      std::reverse(std::begin(raw), std::end(raw));
      big.append(raw, 8);
    }
    big.append("\x01\x02", 2);
  }
  big.append("\x03\x00\x02\x00\x01\x00\x00", 7);
  const Mesh mesh = read_mesh(folder.write("big.ply", big));
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.triangles[0], (std::array<std::uint32_t, 3>{2, 1, 0}));
  EXPECT_EQ(mesh.vertices[1], Eigen::Vector3f(0, 1.5f, 0));
}

TEST(Mesh, SaysWhatIsWrongInAPly) {
  const TemporaryFolder folder;
  const auto error_with = [&](const std::string& from, const std::string& to) {
    std::string text = ascii_ply;
    text.replace(text.find(from), from.size(), to);
    return message_of<InputError>([&] { read_mesh(folder.write("bad.ply", text)); });
  };
  EXPECT_THAT(error_with("ascii", "text"), HasSubstr("line 2: found 'text'"));
  EXPECT_THAT(error_with("vertex 4", "vertex many"), HasSubstr("line 3: found 'many'"));
  EXPECT_THAT(error_with("vertex 4", "vertex 4000000000"),
              HasSubstr("vertex 4: found the end of the file"));
  EXPECT_THAT(error_with("float x", "string x"), HasSubstr("a type of PLY"));
  EXPECT_THAT(error_with("float z", "float w"), HasSubstr("no property z"));
  EXPECT_THAT(error_with("element vertex", "element corner"), HasSubstr("no element vertex"));
  EXPECT_THAT(error_with("4 0 1 2 3", "4 0 1 2 4"), HasSubstr("face 0: found vertex 4"));
  EXPECT_THAT(error_with("4 0 1 2 3", "4 0 1 2 -1"), HasSubstr("face 0: found vertex -1"));
  EXPECT_THAT(error_with("1 0 1", "1 nan 1"), HasSubstr("vertex 1: found 'nan'"));
}

TEST(Mesh, NoGarbageInAnObjCrashes) {
  if (!can_read_obj()) GTEST_SKIP() << "built without Assimp";
  const TemporaryFolder folder;
  const std::string whole =
      "mtllib none.mtl\nv 0 0 1\nv 1 0 1\nv 0 1 1\nvn 0 0 1\n"
      "usemtl a\nf 1//1 2//1 3//1\nf -1 -2 -3\n";
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    std::string text = whole;
    for (int k = 0; k < 4; ++k) text[random() % text.size()] = static_cast<char>(random() % 127);
    text.resize(random() % (text.size() + 1));
    try {
      const Mesh mesh = read_mesh(folder.write("bad.obj", text));
      for (const auto& t : mesh.triangles) {
        for (const auto corner : t) ASSERT_LT(corner, mesh.vertices.size());
      }
    } catch (const InputError& error) {
      ASSERT_THAT(error.what(), HasSubstr("bad.obj"));
    }
  }
}

TEST(Shapes, EncloseTheirVolumes) {
  EXPECT_NEAR(six_volumes(box({1, 2, 3}, {})) / 6, 6, 1e-5);
  EXPECT_NEAR(six_volumes(superellipsoid({1, 2, 3}, 1, 1, {}, 200)) / 6, 4.0 / 3 * M_PI * 6, 0.02);
  // A rounded cube is the cube of its flats, its six slabs, twelve quarter rods and a ball.
  const double r = 0.1, flat = 0.8;
  const double rounded = flat * flat * flat + 6 * flat * flat * r + 3 * flat * M_PI * r * r +
                         4.0 / 3 * M_PI * r * r * r;
  EXPECT_NEAR(six_volumes(box({1, 1, 1}, {}, 0.1f)) / 6, rounded, 0.003);
  const std::array<Eigen::Vector2f, 4> can = {Eigen::Vector2f{0, 0}, {0.5f, 0}, {0.5f, 2}, {0, 2}};
  EXPECT_NEAR(six_volumes(lathe(can, {}, 200)) / 6, M_PI * 0.25 * 2, 1e-3);
  const std::array<Eigen::Vector3f, 2> spine = {Eigen::Vector3f{0, 0, 0}, {0, 0, 2}};
  EXPECT_GT(six_volumes(rod(spine, 0.1f, 0.1f, {})), 0);
}

TEST(Shapes, ExtrusionFacesOutwards) {
  const std::array<Eigen::Vector2f, 4> square = {Eigen::Vector2f{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const Mesh mesh = extrusion(square, 2, {});
  const auto normals = vertex_normals(mesh);
  const Eigen::Vector3f middle(0.5f, 0.5f, 1);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    Eigen::Vector3f outward = mesh.vertices[i] - middle;
    outward.z() = 0;
    EXPECT_GT(normals[i].dot(outward), 0.4f);
  }
}

}  // namespace
}  // namespace slambench
