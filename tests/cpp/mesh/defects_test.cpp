// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "mesh/surface_mesh.h"

namespace carreau {
namespace {

// Two unit squares side by side, each of two triangles; the side between them is curve 2, the others are curves of one
// use.
SurfaceMesh two_squares() {
  SurfaceMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  mesh.vertex_ref.assign(6, 0);
  const std::vector<Vec2> uv{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.faces.push_back({1, "", -1, FaceStatus::meshed, "", uv, {0, 1, 2, 3}, {{0, 1, 2}, {0, 2, 3}}, {}});
  mesh.faces.push_back({2, "", -1, FaceStatus::meshed, "", uv, {1, 4, 5, 2}, {{0, 1, 2}, {0, 2, 3}}, {}});
  mesh.curves = {{1, {0, 1}, {{0, false}}},
                 {2, {1, 2}, {{0, false}, {1, false}}},
                 {3, {2, 3, 0}, {{0, false}}},
                 {4, {1, 4, 5, 2}, {{1, false}}}};
  return mesh;
}

TEST(FindDefects, IsEmptyForASoundMesh) { EXPECT_EQ(find_defects(two_squares()), std::vector<std::string>{}); }

TEST(FindDefects, ReportsOpenEdgesWhenTheMeshShouldBeClosed) {
  EXPECT_EQ(find_defects(two_squares(), {.closed = true}).size(), 6U);
}

struct Damage {
  const char* name;
  const char* word;  // of the sentence
  std::function<void(SurfaceMesh&)> apply;
};
class Damaged : public ::testing::TestWithParam<Damage> {};

TEST_P(Damaged, MeshIsFoundOut) {
  SurfaceMesh mesh = two_squares();
  GetParam().apply(mesh);
  const auto defects = find_defects(mesh);
  ASSERT_FALSE(defects.empty());
  bool said = false;
  for (const std::string& sentence : defects) said = said || sentence.find(GetParam().word) != std::string::npos;
  EXPECT_TRUE(said) << defects.front();
}

INSTANTIATE_TEST_SUITE_P(
    Each, Damaged,
    ::testing::Values(Damage{"Index", "does not exist", [](SurfaceMesh& m) { m.faces[0].triangles[0][1] = 9; }},
                      Damage{"Local", "no vertex in space", [](SurfaceMesh& m) { m.faces[0].vertex[1] = 77; }},
                      Damage{"Nan", "not finite",
                             [](SurfaceMesh& m) { m.vertices[3].y() = std::numeric_limits<double>::quiet_NaN(); }},
                      Damage{"Repeated", "appears twice",
                             [](SurfaceMesh& m) {
                               m.faces[0].triangles[0] = {0, 1, 1};
                             }},
                      Damage{"Turned", "no positive area",
                             [](SurfaceMesh& m) { std::swap(m.faces[0].triangles[0][1], m.faces[0].triangles[0][2]); }},
                      Damage{"FlatInSpace", "no area in space",
                             [](SurfaceMesh& m) {
                               m.vertices[3] = {0.5, 0.5, 0};
                             }},
                      Damage{"Duplicate", "same vertices",
                             [](SurfaceMesh& m) {
                               m.faces[0].triangles.push_back({0, 1, 2});
                             }},
                      Damage{"Unused", "belongs to no triangle",
                             [](SurfaceMesh& m) {
                               m.vertices.push_back({5, 5, 5}), m.vertex_ref.push_back(0);
                             }},
                      Damage{"Hole", "instead of", [](SurfaceMesh& m) { m.faces[0].triangles.pop_back(); }},
                      Damage{"TornSeam", "instead of",
                             [](SurfaceMesh& m) {
                               m.vertices.push_back(m.vertices[1]), m.vertex_ref.push_back(0);
                               m.faces[1].vertex[0] = 6;
                             }},
                      Damage{"EmptyFace", "no triangle", [](SurfaceMesh& m) { m.faces[1].triangles.clear(); }}),
    [](const auto& instance) { return instance.param.name; });

TEST(FindDefects, PassesOverFacesThatFailed) {
  SurfaceMesh mesh = two_squares();
  mesh.faces[1].triangles.clear();
  mesh.faces[1].status = FaceStatus::failed;
  EXPECT_EQ(find_defects(mesh), std::vector<std::string>{});
}

TEST(FindDefects, StopsAtItsLimit) {
  SurfaceMesh mesh = two_squares();
  for (Vec3& p : mesh.vertices) p.x() = std::nan("");
  EXPECT_EQ(find_defects(mesh, {.closed = false, .limit = 3}).size(), 3U);
}

}  // namespace
}  // namespace carreau
