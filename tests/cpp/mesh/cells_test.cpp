// SPDX-License-Identifier: BSD-3-Clause
// Diagonals of quadrilaterals, over all faces of a mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "mesh/surface_mesh.h"

namespace carreau {
namespace {

using Quad = std::array<std::int32_t, 4>;

FaceMesh face_of(int ref, const std::vector<std::int32_t>& vertex, const std::vector<Vec2>& uv, const std::vector<Quad>& quads,
                 const std::vector<Vec3>& vertices) {
  FaceMesh face;
  face.ref = ref, face.status = FaceStatus::meshed;
  face.vertex = vertex, face.uv = uv;
  face.uv_face.assign(uv.size(), ref - 1);
  set_cells(face, quads, {}, vertices);
  face.spread.assign(face.triangles.size(), 0);
  return face;
}

// Quadrilaterals over corners 0, 1, 2 of two faces, or of one, with a last corner each; 1 has no other neighbour. The diagonal between 0
// and 2 is the better one of both.
SurfaceMesh two_over_three_corners(bool one_face) {
  SurfaceMesh mesh;
  mesh.independent = true;
  mesh.vertices = {{-0.5, 0, 0}, {0, 0.8, 0}, {0.5, 0, 0}, {0, -1, 0}, {0, 0, 1.2}};
  mesh.vertex_ref.assign(5, 0);
  const std::vector<Vec2> uv{{-0.5, 0}, {0, 0.8}, {0.5, 0}, {0, -1}}, mirrored{{-0.5, 0}, {0, -0.8}, {0.5, 0}, {0, 1}};
  if (one_face) {
    std::vector<Vec2> both = uv;
    both.insert(both.end(), mirrored.begin(), mirrored.end());
    mesh.faces = {face_of(1, {0, 1, 2, 3, 0, 1, 2, 4}, both, {{0, 3, 2, 1}, {4, 5, 6, 7}}, mesh.vertices)};
    mesh.curves = {{1, {0, 3, 2, 4, 0}, {{0, false}}}};
  } else {
    mesh.faces = {face_of(1, {0, 1, 2, 3}, uv, {{0, 3, 2, 1}}, mesh.vertices),
                  face_of(2, {0, 1, 2, 4}, mirrored, {{0, 1, 2, 3}}, mesh.vertices)};
    mesh.curves = {{1, {0, 3, 2}, {{0, false}}}, {2, {2, 4, 0}, {{1, false}}}};
  }
  return mesh;
}

class EqualDiagonals : public ::testing::TestWithParam<bool> {};

TEST_P(EqualDiagonals, ArePartedInWhateverFaces) {
  SurfaceMesh mesh = two_over_three_corners(GetParam());
  ASSERT_FALSE(find_defects(mesh).empty());
  EXPECT_EQ(find_wrong_joints(mesh), (std::vector<std::int32_t>{0, 1, 2}));
  const Quad first = mesh.faces[0].quad(0);
  part_equal_diagonals(mesh);
  const std::vector<std::string> defects = find_defects(mesh);
  EXPECT_TRUE(defects.empty()) << defects.front();
  EXPECT_TRUE(find_wrong_joints(mesh).empty());
  EXPECT_EQ(mesh.faces[0].quad(0), first) << "the first one keeps its better halves";
}

TEST_P(EqualDiagonals, ThatDifferStay) {
  SurfaceMesh mesh = two_over_three_corners(GetParam());
  part_equal_diagonals(mesh);
  std::vector<std::vector<std::array<std::int32_t, 3>>> before;
  for (const FaceMesh& face : mesh.faces) before.push_back(face.triangles);
  part_equal_diagonals(mesh);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) EXPECT_EQ(mesh.faces[f].triangles, before[f]);
}

INSTANTIATE_TEST_SUITE_P(OfOneFaceAndOfTwo, EqualDiagonals, ::testing::Bool());

// The better diagonal of the quadrilateral is an edge of triangles of another face.
TEST(Diagonals, AreNoEdgeOfOtherCells) {
  SurfaceMesh mesh = two_over_three_corners(false);
  FaceMesh& other = mesh.faces[1];
  set_cells(other, {}, std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 2, 3}}, mesh.vertices);
  ASSERT_FALSE(find_defects(mesh).empty());
  part_equal_diagonals(mesh);
  EXPECT_TRUE(find_defects(mesh).empty());
  EXPECT_EQ(other.triangles.front(), (std::array<std::int32_t, 3>{0, 1, 2}));
}

// Both diagonals are edges of other cells: the halves stay, and the defect is found.
TEST(Diagonals, StayIfBothAreEdges) {
  SurfaceMesh mesh = two_over_three_corners(false);
  set_cells(mesh.faces[1], {}, std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 2, 3}}, mesh.vertices);
  mesh.faces.push_back(face_of(3, {1, 3, 4}, {{0, 0}, {1, 0}, {0, 1}}, {}, mesh.vertices));
  mesh.faces.back().triangles = {{0, 1, 2}};
  mesh.faces.back().spread = {0};
  const auto before = mesh.faces[0].triangles;
  part_equal_diagonals(mesh);
  EXPECT_EQ(mesh.faces[0].triangles, before);
  EXPECT_FALSE(find_wrong_joints(mesh).empty());
}

}  // namespace
}  // namespace carreau
