// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace carreau {
namespace {

TEST(Quality, IsOneForAnEquilateralTriangleWhateverItsPlaceAndSize) {
  for (const double s : {1e-8, 1.0, 1e8}) {
    const Vec3 a{s, 0, 0}, b{0, s, 0}, c{0, 0, s};
    EXPECT_NEAR(quality_q1(a, b, c), 1, 1e-14);
    EXPECT_NEAR(quality_q2(a, b, c), 1, 1e-14);
  }
}

TEST(Quality, HasItsClosedFormForARightTriangle) {
  // Legs 1: inradius 1 - 1/sqrt 2, longest edge sqrt 2, area 1/2, sum of squares 4 (HDR eq. 1.5, 1.6).
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  EXPECT_NEAR(quality_q1(a, b, c), 2 * std::numbers::sqrt3 * (1 - std::numbers::sqrt2 / 2) / std::numbers::sqrt2,
              1e-15);
  EXPECT_NEAR(quality_q2(a, b, c), std::numbers::sqrt3 / 2, 1e-15);
}

TEST(Quality, IsZeroForFlatTriangles) {
  EXPECT_EQ(quality_q2({0, 0, 0}, {1, 0, 0}, {2, 0, 0}), 0);
  EXPECT_EQ(quality_q1({1, 1, 1}, {1, 1, 1}, {1, 1, 1}), 0);
}

TEST(QualitySummary, CountsOfATetrahedron) {
  FlatMesh mesh;
  mesh.vertices = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  const QualitySummary q = summarise_quality(mesh);
  EXPECT_EQ(q.edges, 6U);
  EXPECT_EQ(q.open_edges, 0U);
  EXPECT_NEAR(q.q1.min, 1, 1e-14);
  EXPECT_NEAR(q.area, 8 * std::numbers::sqrt3, 1e-13);
  EXPECT_NEAR(q.angle_min_deg, 60, 1e-12);
  EXPECT_NEAR(q.angle_max_deg, 60, 1e-12);
  EXPECT_NEAR(q.edge_mean, 2 * std::numbers::sqrt2, 1e-14);
  EXPECT_EQ(q.degree6, 0);
}

// Triangles of many shapes, also flat ones and such with corners that coincide, against one at a time.
TEST(QualitySummary, MatchesEachTriangleForAnyNumberOfThreads) {
  FlatMesh mesh;
  double area = 0, smallest = 180, largest = 0, sum = 0;
  const auto angle = [](Vec3 p, Vec3 q) { return std::atan2(norm(cross(p, q)), dot(p, q)) * 180 / std::numbers::pi; };
  for (int i = 0; i < 20000; ++i) {
    const Vec3 a{0, 0, 0}, b{1. + i % 3, 0, 0}, c{std::cos(i), std::sin(i) * std::pow(i % 101, 2), 0.1 * (i % 7)};
    for (const Vec3& p : {a, b, c}) mesh.vertices.push_back(p);
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    area += norm(cross(b - a, c - a)) / 2;
    sum += quality_q2(a, b, c);
    for (const auto& [p, q] : {std::pair{b - a, c - a}, std::pair{c - b, a - b}, std::pair{a - c, b - c}})
      smallest = std::min(smallest, angle(p, q)), largest = std::max(largest, angle(p, q));
  }
  for (const int threads : {1, 2, 8}) {
    const QualitySummary q = summarise_shapes(mesh, threads);
    EXPECT_NEAR(q.area, area, 1e-12 * area);
    EXPECT_EQ(q.area, summarise_shapes(mesh, 1).area);
    EXPECT_NEAR(q.q2.mean, sum / 20000, 1e-13);
    EXPECT_NEAR(q.angle_min_deg, smallest, 1e-12);
    EXPECT_NEAR(q.angle_max_deg, largest, 1e-12);
  }
  mesh.vertices = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(summarise_shapes(mesh, 2).angle_min_deg, 0);
  mesh.vertices[1] = {0.5, 0, 0};
  EXPECT_NEAR(summarise_shapes(mesh, 2).angle_max_deg, 180, 1e-12);
}

// Faces number their vertices themselves; values read in place must agree with a flat copy.
TEST(QualitySummary, MatchesTheFlatCopyOfFaces) {
  SurfaceMesh mesh;
  for (int i = 0; i < 3000; ++i) mesh.vertices.push_back({i % 60 + 0.3 * std::sin(i), i / 60 + 0.3 * std::cos(3 * i), 0.1 * (i % 7)});
  mesh.vertex_ref.assign(mesh.vertices.size(), 0);
  for (const int face : {0, 1, 2}) {  // rows of squares from 0, none, and on to the end; backwards in the last one
    mesh.faces.push_back({.ref = face + 1, .status = FaceStatus::meshed, .why = {}, .uv = {}, .vertex = {}, .triangles = {}, .flattened = {}});
    FaceMesh& made = mesh.faces.back();
    for (int v = 0; v < 3000; ++v) made.vertex.push_back(face == 2 ? 2999 - v : v);
    const int rows = face == 0 ? 20 : face == 1 ? 0 : 29;
    for (int row = 0; row < rows; ++row)
      for (int k = 60 * row; k < 60 * row + 59; ++k) {
        made.triangles.push_back({k, k + 1, k + 61});
        made.triangles.push_back({k, k + 61, k + 60});
      }
  }
  const FlatMesh flat = flatten(mesh, false);
  ASSERT_GT(flat.triangles.size(), 5000U);  // more than one part of the sums
  for (const int threads : {1, 3}) {
    const QualitySummary p = summarise_quality(flat, threads), q = summarise_quality(TriangleLists(mesh), threads);
    EXPECT_EQ(p.triangles, q.triangles);
    EXPECT_EQ(p.edges, q.edges);
    EXPECT_EQ(p.open_edges, q.open_edges);
    EXPECT_EQ(p.area, q.area);
    EXPECT_EQ(p.q1.mean, q.q1.mean);
    EXPECT_EQ(p.q2.p1, q.q2.p1);
    EXPECT_EQ(p.edge_mean, q.edge_mean);
    EXPECT_EQ(p.angle_min_deg, q.angle_min_deg);
    EXPECT_EQ(p.degree6, q.degree6);
  }
  std::size_t next = 2359, seen = 0;  // from the last triangle of the first face into the third
  TriangleLists(mesh).for_each(2359, 2362, [&](std::size_t t, const std::array<std::int32_t, 3>& corners) {
    EXPECT_EQ(t, next++);
    EXPECT_EQ(corners, flat.triangles[t]);
    ++seen;
  });
  EXPECT_EQ(seen, 3U);
}

/// Two faces with a common side, each 40 x 40 squares cut in two, in space. Vertices on the 7 curves come first.
SurfaceMesh two_faces() {
  SurfaceMesh mesh;
  constexpr int n = 40;
  std::vector<std::int32_t> number((2 * n + 1) * (n + 1));
  const auto at = [&](int i, int j) -> std::int32_t& { return number[static_cast<std::size_t>(i * (n + 1) + j)]; };
  const auto on_curve = [](int i, int j) { return i % n == 0 || j % n == 0; };
  for (const bool curves : {true, false})
    for (int i = 0; i <= 2 * n; ++i)
      for (int j = 0; j <= n; ++j) {
        if (on_curve(i, j) != curves) continue;
        at(i, j) = static_cast<std::int32_t>(mesh.vertices.size());
        mesh.vertices.push_back({i + 0.3 * std::sin(7 * i + j), j + 0.3 * std::cos(3 * i + 5 * j), 0.1 * (i * j % 7)});
        if (!curves) continue;
        if (mesh.curves.empty()) mesh.curves.emplace_back();
        mesh.curves.back().vertices.push_back(at(i, j));
      }
  for (const int first : {0, n}) {
    FaceMesh& face = mesh.faces.emplace_back();
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) face.vertex.push_back(static_cast<std::int32_t>(v));
    for (int i = first; i < first + n; ++i)
      for (int j = 0; j < n; ++j) {
        face.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        face.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        if (first > 0)  // turned over
          for (auto t = face.triangles.end() - 2; t != face.triangles.end(); ++t) std::swap((*t)[0], (*t)[1]);
      }
  }
  return mesh;
}

// Curves give the figures of edges without a list of all edges.
TEST(QualitySummary, DoesNotDependOnKnowledgeOfCurves) {
  SurfaceMesh whole = two_faces(), hole = whole, triple = whole;
  hole.faces[0].triangles.erase(hole.faces[0].triangles.begin() + 1777);
  triple.faces[1].triangles.push_back(triple.faces[1].triangles[901]);
  for (const SurfaceMesh& mesh : {whole, hole, triple})
    for (const int threads : {1, 3}) {
      const QualitySummary p = summarise_quality(flatten(mesh, false), threads), q = summarise_quality(TriangleLists(mesh), threads);
      EXPECT_EQ(p.edges, q.edges);
      EXPECT_EQ(p.open_edges, q.open_edges);
      EXPECT_EQ(p.edge_min, q.edge_min);
      EXPECT_EQ(p.edge_mean, q.edge_mean);
      EXPECT_EQ(p.edge_max, q.edge_max);
      EXPECT_EQ(p.degree6, q.degree6);
    }
  const QualitySummary q = summarise_quality(TriangleLists(whole), 1);
  EXPECT_EQ(q.open_edges, 240U);
  EXPECT_EQ(q.edges, (3 * 6400U + 240U) / 2);
}

}  // namespace
}  // namespace carreau
