// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "support/error.h"

namespace carreau {
namespace {

/// Adds the surface of a box, two triangles a side, face references first, first + 1, ... in the order -x, +x, -y, +y, -z, +z.
void add_box(const Vec3& low, const Vec3& high, int first, FlatMesh& mesh, bool inward = false) {
  const auto start = static_cast<std::int32_t>(mesh.vertices.size());
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back({(i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(), (i & 4) != 0 ? high.z() : low.z()});
  const std::array<std::array<std::int32_t, 4>, 6> sides{{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (std::size_t s = 0; s < 6; ++s)
    for (const std::size_t k : {1U, 2U}) {
      std::array<std::int32_t, 3> t{sides[s][0] + start, sides[s][k] + start, sides[s][k + 1] + start};
      if (inward) std::swap(t[1], t[2]);
      mesh.triangles.push_back(t);
      mesh.triangle_refs.push_back(first + static_cast<int>(s));
    }
}

bool is_in(const Vec3& p, const Vec3& low, const Vec3& high) {
  return (p - low).minCoeff() > 0 && (high - p).minCoeff() > 0;
}

std::string sentence_of(const FlatMesh& mesh) {
  try {
    (void)find_regions(mesh);
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "";
}

TEST(Regions, ABoxIsASolidOfItsVolume) {
  FlatMesh mesh;
  add_box({1, 2, 3}, {2, 4, 6}, 1, mesh);
  const MeshRegions found = find_regions(mesh);
  ASSERT_EQ(found.solids.size(), 1U);
  EXPECT_TRUE(found.holes.empty());
  EXPECT_TRUE(is_in(found.solids[0].inside, {1, 2, 3}, {2, 4, 6}));
  EXPECT_NEAR(found.volumes.at(1), 6, 1e-14);
  EXPECT_NEAR(found.solids[0].longest_edge, std::sqrt(13), 1e-15);
  for (const auto& sides : found.sides) EXPECT_EQ(sides, (std::array{1, 0}));
}

TEST(Regions, ABallInsideACavityIsASolidOfItsOwn) {
  FlatMesh mesh;
  add_box({0, 0, 0}, {4, 4, 4}, 1, mesh);
  add_box({1, 1, 1}, {3, 3, 3}, 11, mesh, true);
  add_box({1.5, 1.5, 1.5}, {2, 2, 2}, 21, mesh);
  const MeshRegions found = find_regions(mesh);
  ASSERT_EQ(found.solids.size(), 2U);
  EXPECT_NEAR(found.volumes.at(1), 64 - 8, 1e-13);
  EXPECT_NEAR(found.volumes.at(2), .125, 1e-14);
  EXPECT_TRUE(is_in(found.solids[0].inside, {0, 0, 0}, {4, 4, 4}) && !is_in(found.solids[0].inside, {1, 1, 1}, {3, 3, 3}));
  EXPECT_TRUE(is_in(found.solids[1].inside, {1.5, 1.5, 1.5}, {2, 2, 2}));
  ASSERT_EQ(found.holes.size(), 1U);
  EXPECT_TRUE(is_in(found.holes[0].inside, {1, 1, 1}, {3, 3, 3}) && !is_in(found.holes[0].inside, {1.5, 1.5, 1.5}, {2, 2, 2}));
}

/// Two cubes with a common side, which looks from the first into the second.
FlatMesh two_cubes() {
  FlatMesh mesh;
  for (int i = 0; i < 12; ++i) mesh.vertices.push_back({static_cast<double>(i % 3), static_cast<double>(i / 3 % 2), static_cast<double>(i / 6)});
  const auto add = [&](std::array<std::int32_t, 4> q, int ref) {
    mesh.triangles.push_back({q[0], q[1], q[2]}), mesh.triangles.push_back({q[0], q[2], q[3]});
    mesh.triangle_refs.insert(mesh.triangle_refs.end(), 2, ref);
  };
  add({0, 6, 9, 3}, 1), add({1, 4, 10, 7}, 2), add({2, 5, 11, 8}, 3);
  for (const int x : {0, 1}) {
    add({x, x + 1, x + 7, x + 6}, 4 + x), add({x + 3, x + 9, x + 10, x + 4}, 6 + x);
    add({x, x + 3, x + 4, x + 1}, 8 + x), add({x + 6, x + 7, x + 10, x + 9}, 10 + x);
  }
  mesh.names.face_solids = {{1, {7, 0}}, {2, {7, 3}}, {3, {3, 0}}, {4, {7, 0}}, {5, {3, 0}}, {6, {7, 0}},
                            {7, {3, 0}}, {8, {7, 0}}, {9, {3, 0}}, {10, {7, 0}}, {11, {3, 0}}};
  return mesh;
}

TEST(Regions, SolidsShareAFace) {
  const FlatMesh mesh = two_cubes();
  const MeshRegions found = find_regions(mesh);
  ASSERT_EQ(found.solids.size(), 2U);
  EXPECT_EQ(found.solids[0].solid, 3);
  EXPECT_TRUE(is_in(found.solids[0].inside, {1, 0, 0}, {2, 1, 1}));
  EXPECT_TRUE(is_in(found.solids[1].inside, {0, 0, 0}, {1, 1, 1}));
  EXPECT_NEAR(found.volumes.at(3), 1, 1e-15);
  EXPECT_NEAR(found.volumes.at(7), 1, 1e-15);
  EXPECT_EQ(found.sides[2], (std::array{7, 3}));
}

TEST(Regions, SolidsThatShareAFaceNeedNoNames) {
  FlatMesh mesh = two_cubes();
  mesh.names.face_solids.clear();
  for (const bool turned : {false, true}) {
    if (turned)  // the common side looks into the first cube
      for (const std::size_t t : {2U, 3U}) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    const MeshRegions found = find_regions(mesh);
    EXPECT_EQ(found.solids.size(), 2U);
    EXPECT_TRUE(found.holes.empty());
    EXPECT_EQ(found.sides[2][0] + found.sides[2][1], 3);
    for (const int solid : {1, 2}) EXPECT_NEAR(found.volumes.at(solid), 1, 1e-15);
  }
}

TEST(Regions, OneSolidOfTwoIsLeftOutAsAHole) {
  FlatMesh mesh = two_cubes();
  for (auto& [face, sides] : mesh.names.face_solids)
    for (int& solid : sides) solid = solid == 3 ? 0 : solid;
  const MeshRegions found = find_regions(mesh);
  ASSERT_EQ(found.solids.size(), 1U);
  ASSERT_EQ(found.holes.size(), 1U);
  EXPECT_TRUE(is_in(found.holes[0].inside, {1, 0, 0}, {2, 1, 1}));
}

TEST(Regions, CubesThatTouchInAnEdgeStayApart) {
  FlatMesh mesh;
  add_box({0, 0, 0}, {1, 1, 1}, 1, mesh);
  add_box({1, 1, 0}, {2, 2, 1}, 7, mesh);
  // Vertices 3 and 7 of the first cube are 0 and 4 of the second.
  for (auto& triangle : mesh.triangles)
    for (std::int32_t& v : triangle) v = v == 8 ? 3 : v == 12 ? 7 : v;
  const MeshRegions found = find_regions(mesh);
  ASSERT_EQ(found.solids.size(), 2U);
  for (const int solid : {1, 2}) EXPECT_NEAR(found.volumes.at(solid), 1, 1e-15);
  EXPECT_TRUE(is_in(found.solids[1].inside, {1, 1, 0}, {2, 2, 1}));
}

TEST(Regions, ASurfaceTurnedInsideOutIsASolidToo) {
  FlatMesh mesh;
  add_box({0, 0, 0}, {1, 1, 1}, 1, mesh, true);
  const MeshRegions found = find_regions(mesh);
  ASSERT_EQ(found.solids.size(), 1U);
  EXPECT_EQ(found.sides[0], (std::array{0, 1}));
}

TEST(Regions, AnOpenSurfaceIsNamedWithTheEdge) {
  FlatMesh mesh;
  add_box({0, 0, 0}, {1, 1, 1}, 1, mesh);
  mesh.triangles.pop_back(), mesh.triangle_refs.pop_back();
  const std::string sentence = sentence_of(mesh);
  EXPECT_TRUE(sentence.starts_with("the surface is open: the edge from (")) << sentence;
  EXPECT_TRUE(sentence.ends_with(" has one triangle, as have 2 other edges")) << sentence;
  for (int ref = 1; ref <= 6; ++ref) mesh.names.face_solids[ref] = {1, 0};
  EXPECT_EQ(sentence_of(mesh), sentence);
}

TEST(Regions, SolidsThatContradictEachOtherAreNamed) {
  FlatMesh mesh = two_cubes();
  mesh.names.face_solids[5] = {7, 0};
  const std::string sentence = sentence_of(mesh);
  EXPECT_TRUE(sentence.starts_with("the solids on both sides of the surface contradict each other: the edge from (")) << sentence;
}

}  // namespace
}  // namespace carreau
