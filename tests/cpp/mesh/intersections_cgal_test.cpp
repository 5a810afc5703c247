// SPDX-License-Identifier: BSD-3-Clause
// Pairs of triangles that cross, as CGAL finds them with its exact predicates. Built where CGAL is installed.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "mesh/crossings/intersections.h"

namespace carreau {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Indices = std::array<std::int32_t, 3>;
using Pairs = std::set<std::pair<int, int>>;

Kernel::Point_3 point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

Pairs ours(const std::vector<Vec3>& vertices, const std::vector<Indices>& triangles) {
  Monitor monitor;
  Pairs pairs;
  for (const auto& each : find_intersections(vertices, triangles, {.limit = 10'000'000}, monitor).pairs)
    pairs.emplace(each.triangles[0], each.triangles[1]);
  return pairs;
}

/// A torus of n x 2 n quadrangles, with points moved by noise.
void make_torus(int n, double noise, int seed, std::vector<Vec3>& vertices, std::vector<Indices>& triangles) {
  std::mt19937 random(seed);
  std::normal_distribution<double> shift(0, 1);
  for (int j = 0; j < 2 * n; ++j)
    for (int i = 0; i < n; ++i) {
      const double u = 2 * std::numbers::pi * i / n, v = std::numbers::pi * j / n, r = 2 + std::cos(u);
      const double x = shift(random), y = shift(random), z = shift(random);
      vertices.push_back({r * std::cos(v) + noise * x, r * std::sin(v) + noise * y, std::sin(u) + noise * z});
    }
  for (int j = 0; j < 2 * n; ++j)
    for (int i = 0; i < n; ++i) {
      const std::int32_t a = j * n + i, b = j * n + (i + 1) % n;
      const std::int32_t d = (j + 1) % (2 * n) * n + i, c = (j + 1) % (2 * n) * n + (i + 1) % n;
      triangles.push_back({a, c, b});
      triangles.push_back({a, d, c});
    }
}

TEST(IntersectionsOfCgal, AreOursOnSurfacesThatCrossThemselves) {
  for (const double noise : {0.0, 0.02, 0.05, 0.2, 1.0}) {
    std::vector<Vec3> vertices;
    std::vector<Indices> triangles;
    make_torus(16, noise, 5, vertices, triangles);
    CGAL::Surface_mesh<Kernel::Point_3> mesh;
    for (const Vec3& p : vertices) mesh.add_vertex(point(p));
    using Vertex = CGAL::Surface_mesh<Kernel::Point_3>::Vertex_index;
    for (const auto& [a, b, c] : triangles)
      mesh.add_face(Vertex(static_cast<unsigned>(a)), Vertex(static_cast<unsigned>(b)),
                    Vertex(static_cast<unsigned>(c)));
    std::vector<
        std::pair<CGAL::Surface_mesh<Kernel::Point_3>::Face_index, CGAL::Surface_mesh<Kernel::Point_3>::Face_index>>
        theirs;
    CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(theirs));
    Pairs expected;
    for (const auto& [f, g] : theirs)
      expected.emplace(std::min<int>(static_cast<int>(f), static_cast<int>(g)),
                       std::max<int>(static_cast<int>(f), static_cast<int>(g)));
    EXPECT_EQ(ours(vertices, triangles), expected) << noise;
    EXPECT_EQ(noise > 0.1, expected.size() > 100) << noise << ": " << expected.size();
  }
}

TEST(IntersectionsOfCgal, AreOursOnTrianglesWithoutCommonCorners) {
  std::mt19937 random(2);
  // Multiples of 1/8: many triangles touch.
  std::uniform_int_distribution<int> place(0, 24);
  constexpr int n = 300;
  std::vector<Vec3> vertices;
  std::vector<Indices> triangles;
  for (int i = 0; i < 3 * n; ++i) {
    const double x = place(random) / 8.0, y = place(random) / 8.0, z = place(random) / 8.0;
    vertices.push_back({x, y, z});
  }
  for (std::int32_t i = 0; i < n; ++i) triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  const auto corner = [&](int i, int k) { return vertices[static_cast<std::size_t>(3 * i + k)]; };
  const Pairs found = ours(vertices, triangles);
  int compared = 0;
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) {
      const Kernel::Triangle_3 s(point(corner(i, 0)), point(corner(i, 1)), point(corner(i, 2)));
      const Kernel::Triangle_3 t(point(corner(j, 0)), point(corner(j, 1)), point(corner(j, 2)));
      if (s.is_degenerate() || t.is_degenerate()) continue;
      bool common = false;
      for (int k = 0; k < 9; ++k) common = common || corner(i, k / 3) == corner(j, k % 3);
      if (common) continue;
      ++compared;
      ASSERT_EQ(found.contains({i, j}), CGAL::do_intersect(s, t)) << i << ", " << j;
    }
  EXPECT_GT(compared, 40000);
  EXPECT_GT(found.size(), 1000u);
}

}  // namespace
}  // namespace carreau
