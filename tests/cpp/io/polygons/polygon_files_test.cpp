// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numbers>

#include "io/mesh_files.h"
#include "io_test_support.h"

namespace carreau {
namespace {

using Triangles = std::vector<std::array<std::int32_t, 3>>;

double area_of(const FlatMesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const auto p = [&](int k) -> const Vec3& {
      return mesh.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
    };
    area += norm(cross(p(1) - p(0), p(2) - p(0))) / 2;
  }
  return area;
}

TEST(Off, SkipsCommentsAndColours) {
  const FlatMesh mesh = read_mesh_off(
      "OFF # of a square\n4 2 0\n\n0 0 0\n1 0 0 255 0 0\n1 1 0.5\n# between\n0 1 0\n3 0 1 2\n3 0 2 3 0.5 0.5 0.5", "x");
  EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh.triangle_refs, (std::vector<std::int32_t>{0, 0}));
}

TEST(Off, CutsAStarIntoTrianglesOfItsArea) {
  // Radii 1 and r: area n r sin(pi / n) of 2n triangles at the centre, and 2n - 2 triangles whose areas add up, none
  // turned over.
  constexpr int n = 7;
  constexpr double r = 0.3;
  std::string text = "OFF\n14 1 0\n";
  for (int i = 0; i < 2 * n; ++i) {
    const double angle = std::numbers::pi * i / n, radius = i % 2 == 0 ? 1 : r;
    text += std::to_string(radius * std::cos(angle)) + " 0 " + std::to_string(radius * std::sin(angle)) + "\n";
  }
  text += "14";
  for (int i = 0; i < 2 * n; ++i) text += " " + std::to_string(i);
  const FlatMesh mesh = read_mesh_off(text, "x");
  EXPECT_EQ(mesh.triangles.size(), 2u * n - 2);
  EXPECT_NEAR(area_of(mesh), n * r * std::sin(std::numbers::pi / n), 1e-5);
}

TEST(Off, NamesTheLineOfAMistake) {
  const std::string good = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(read_mesh_off(good, "x").triangles.size(), 1u);
  const auto sentence = [&](std::string_view from, std::string_view to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return sentence_of<FileError>([&] { read_mesh_off(text, "x.off"); });
  };
  EXPECT_EQ(sentence("OFF", "PLY"), "x.off, line 1: OFF was expected, not 'PLY'");
  EXPECT_EQ(sentence("3 0 1 2", "3 0 1 3"), "x.off, line 6: a polygon names vertex 3 (from 0) of 3");
  EXPECT_EQ(sentence("3 0 1 2", "2 0 1"), "x.off, line 6: a polygon has 2 corners");
  EXPECT_EQ(sentence("1 0 0", "1 nan 0"), "x.off, line 4: a coordinate of a vertex is not finite: 'nan'");
  EXPECT_EQ(sentence("OFF", "OFF BINARY"),
            "x.off, line 1: the binary form of OFF is not read: convert the file to text");
  for (std::size_t n = 0; n + 1 < good.size(); ++n)
    EXPECT_NE(sentence_of<FileError>([&] { read_mesh_off(good.substr(0, n), "x.off"); }), "") << n;
}

TEST(Obj, GroupsAreFacesAndVerticesMayCountBackwards) {
  const FlatMesh mesh = read_mesh_obj(
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0\nvt 0 0\nf 1 2 3\ng left\nf 1/1/1 2//1 3/1\ng "
      "right\n"
      "f -4 -2 -1 # the same\ng left\nf 1 2 3 4\nl 1 2 3\n",
      "x");
  EXPECT_EQ(mesh.triangle_refs, (std::vector<std::int32_t>{0, 1, 2, 1, 1}));
  EXPECT_EQ(mesh.triangles[2], (std::array<std::int32_t, 3>{0, 2, 3}));
  EXPECT_EQ(mesh.edges, (std::vector<std::array<std::int32_t, 2>>{{0, 1}, {1, 2}}));
  ASSERT_EQ(mesh.faces.size(), 2u);
  EXPECT_EQ(mesh.faces[0].name, "left");
  EXPECT_EQ(mesh.faces[1].name, "right");
  EXPECT_EQ(sentence_of<FileError>([] { read_mesh_obj("v 0 0 0\nv 1 0 0\nf 1 2 3", "x"); }),
            "x, line 3: vertex 3 is named, but there are 2");
  EXPECT_EQ(sentence_of<FileError>([] { read_mesh_obj("v 0 0\n", "x"); }),
            "x, line 1: a vertex has fewer than three coordinates");
  EXPECT_EQ(sentence_of<FileError>([] { read_mesh_obj("hello\n", "x"); }), "x, line 2: the file has no vertices");
}

std::string ply_header(const std::string& form, const std::string& index = "int") {
  return "ply\nformat " + form +
         " 1.0\ncomment of a square\nelement vertex 4\nproperty double x\nproperty uchar red\n" +
         "property float y\nproperty float z\nelement edge 1\nproperty int vertex1\nproperty int vertex2\n" +
         "element face 1\nproperty list uchar " + index +
         " vertex_indices\nproperty list int float weights\nend_header\n";
}

std::string ply_bytes(bool big) {
  std::string bytes = ply_header(big ? "binary_big_endian" : "binary_little_endian");
  for (const Vec3& p : std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}) {
    bytes += Bytes(big).f64(p.x()).text() + "\x07";
    bytes += Bytes(big).f32(static_cast<float>(p.y())).f32(0).text();
  }
  bytes += Bytes(big).i32(0).i32(1).text() + "\x04" + Bytes(big).i32(0).i32(1).i32(2).i32(3).text();
  return bytes + Bytes(big).i32(1).f32(0.5F).text();
}

TEST(Tri, ComponentsAreReferences) {
  const std::string text = "4 2\n0 0 0\n1 0 0\n1 1 0\n0 1 .5\n1 2 3\n1 3 4\n7\n9\n";
  const FlatMesh mesh = read_mesh_tri(text, "x");
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh.triangle_refs, (std::vector<std::int32_t>{7, 9}));
  const FlatMesh again = read_mesh_tri(mesh_bytes(mesh, MeshFormat::tri), "x");
  EXPECT_EQ(again.vertices, mesh.vertices);
  EXPECT_EQ(again.triangles, mesh.triangles);
  EXPECT_EQ(again.triangle_refs, mesh.triangle_refs);
  EXPECT_EQ(read_mesh_tri(text.substr(0, text.find("7\n")), "x").triangle_refs, (std::vector<std::int32_t>{0, 0}));
  const auto sentence = [](const std::string& broken) { return sentence_of<FileError>([&] { read_mesh_tri(broken, "x.tri"); }); };
  EXPECT_EQ(sentence("3 1\n0 0 0\n1 0 0\n0 1 0\n1 2 4\n"), "x.tri, line 5: triangle 1 names vertex 4 of 3");
  EXPECT_NE(sentence("3 9000\n0 0 0\n").find("x.tri, line 1"), std::string::npos);
}

TEST(Ply, ThreeFormsGiveOneMesh) {
  const std::string text = ply_header("ascii") + "0 7 0 0\n1 7 0 0\n1 7 1 0\n0 7 1 0\n0 1\n4 0 1 2 3 1 0.5\n";
  for (const std::string& content : {text, ply_bytes(false), ply_bytes(true)}) {
    const FlatMesh mesh = read_mesh_ply(content, "x");
    EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.triangles.size(), 2u);
    EXPECT_DOUBLE_EQ(area_of(mesh), 1);
  }
  for (const std::string& content : {text.substr(0, text.size() - 1), ply_bytes(false), ply_bytes(true)})
    for (std::size_t n = 0; n < content.size(); ++n) {
      if (content.substr(0, n).ends_with("1 0.") || content.substr(0, n).ends_with("1 0")) continue;  // a number still
      EXPECT_NE(sentence_of<FileError>([&] { read_mesh_ply(content.substr(0, n), "x.ply"); }), "") << n;
    }
}

TEST(Ply, ListsMayHaveFloatCountsAndIndices) {
  const FlatMesh mesh = read_mesh_ply(
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "property list float float weights\nelement face 1\nproperty list float float vertex_indices\nend_header\n"
      "0 0 0 2 .5 .5\n1 0 0 0\n1 1 0 1 1\n0 1 0 0\n4 0 1 2 3\n", "x");
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.triangles.size(), 2u);
}

TEST(Ply, NamesMistakes) {
  const auto sentence = [&](const std::string& text) {
    return sentence_of<FileError>([&] { read_mesh_ply(text, "x.ply"); });
  };
  EXPECT_EQ(sentence("off\n"), "x.ply, line 1: ply was expected, not 'off'");
  EXPECT_EQ(sentence("ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n"),
            "x.ply, line 6: the vertices have no x, y and z");
  EXPECT_EQ(sentence(ply_header("ascii") + "0 7 0 0\n1 7 0 0\n1 7 1 0\n0 7 1 0\n0 1\n4 0 1 2 9 1 0.5\n"),
            "x.ply, line 21: a face names vertex 9 (from 0) of 4");
  EXPECT_NE(sentence(ply_header("binary_little_endian") + "12345").find("the file ends too early"), std::string::npos);
  EXPECT_EQ(sentence(ply_header("ascii", "real")), "x.ply, line 13: the type of a number was expected, not 'real'");
}

}  // namespace
}  // namespace carreau
