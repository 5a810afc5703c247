// SPDX-License-Identifier: BSD-3-Clause
// Triangulation of imposed vertices and edges alone: its properties, and rejected input.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "plane/plane_mesher.h"
#include "plane_checks.h"
#include "predicates/predicates.h"

namespace carreau {
namespace {

using testing::find_plane_defects;
using Defects = std::vector<std::string>;

constexpr auto boundary = PlaneEdgeKind::boundary;
constexpr auto internal = PlaneEdgeKind::internal;

// A closed polygon appended to a domain.
void add_loop(PlaneDomain& domain, const std::vector<Vec2>& polygon) {
  const int first = static_cast<int>(domain.vertices.size()), n = static_cast<int>(polygon.size());
  for (int i = 0; i < n; ++i) {
    domain.vertices.push_back(polygon[i]);
    domain.edges.push_back({first + i, first + (i + 1) % n, boundary});
  }
}

PlaneDomain square(double size = 1, Vec2 at = {0, 0}) {
  PlaneDomain domain;
  add_loop(domain, {at, at + Vec2{size, 0}, at + Vec2{size, size}, at + Vec2{0, size}});
  return domain;
}

std::vector<Vec2> reversed(std::vector<Vec2> polygon) { return {polygon.rbegin(), polygon.rend()}; }

PlaneMesh triangulate(const PlaneDomain& domain) {
  Monitor monitor;
  return triangulate_domain(domain, monitor);
}

std::string error_of(const PlaneDomain& domain) {
  try {
    triangulate(domain);
  } catch (const DomainError& error) {
    return error.what();
  }
  return "";
}

// A simple polygon round the origin: random radii at increasing angles.
std::vector<Vec2> random_star(std::mt19937& random, int n, double spikes) {
  std::uniform_real_distribution<double> radius(1 - spikes, 1);
  std::vector<Vec2> polygon;
  for (int i = 0; i < n; ++i) {
    const double r = radius(random), a = 2 * std::numbers::pi * i / n;
    polygon.push_back({r * std::cos(a), r * std::sin(a)});
  }
  return polygon;
}

TEST(TriangulateDomain, SquareGivesTwoTriangles) {
  const PlaneDomain domain = square();
  const PlaneMesh mesh = triangulate(domain);
  EXPECT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(find_plane_defects(domain, mesh), Defects{});
}

TEST(TriangulateDomain, RandomStarPolygonsHaveAllTheirEdges) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    PlaneDomain domain;
    const int n = 3 + trial;
    add_loop(domain, random_star(random, n, 0.95));
    const PlaneMesh mesh = triangulate(domain);
    ASSERT_EQ(find_plane_defects(domain, mesh), Defects{}) << "trial " << trial;
    ASSERT_EQ(mesh.triangles.size(), static_cast<std::size_t>(n) - 2);
  }
}

TEST(TriangulateDomain, HolesIslandsAndComponentsAreDistinguished) {
  PlaneDomain domain = square(10);
  add_loop(domain, reversed({{1, 1}, {6, 1}, {6, 6}, {1, 6}}));
  add_loop(domain, {{2, 2}, {5, 2}, {5, 5}, {2, 5}});
  add_loop(domain, reversed({{3, 3}, {4, 3}, {4, 4}, {3, 4}}));
  add_loop(domain, {{20, 0}, {21, 0}, {20, 1}});
  const PlaneMesh mesh = triangulate(domain);
  EXPECT_EQ(find_plane_defects(domain, mesh), Defects{});
  EXPECT_EQ(mesh.triangles.size(), 8U + 8U + 1U);
}

TEST(TriangulateDomain, LoopsMayTouchAtAVertex) {
  PlaneDomain domain = square(4);
  // A hole that touches the outer loop at vertex 0, and an island that touches the hole at vertex 4 + 0.
  domain.vertices.insert(domain.vertices.end(), {{3, 1}, {3, 3}, {1, 3}, {2, 1.5}, {2.5, 2}});
  for (const auto& [a, b] : {std::pair(0, 6), {6, 5}, {5, 4}, {4, 0}, {4, 8}, {8, 7}, {7, 4}})
    domain.edges.push_back({a, b, boundary});
  EXPECT_EQ(find_plane_defects(domain, triangulate(domain)), Defects{});
}

TEST(TriangulateDomain, InternalEdgesSeparateNothing) {
  PlaneDomain domain = square(4);
  domain.vertices.insert(domain.vertices.end(), {{1, 1}, {3, 1.1}, {2, 3}, {0.5, 3.5}});
  domain.edges.insert(domain.edges.end(), {{4, 5, internal}, {5, 6, internal}, {6, 4, internal}, {0, 4, internal}});
  const PlaneMesh mesh = triangulate(domain);  // vertex 7 is an isolated point
  EXPECT_EQ(find_plane_defects(domain, mesh), Defects{});
  EXPECT_EQ(mesh.triangles.size(), 2U + 2U * 4U);
}

TEST(TriangulateDomain, RandomInternalEdgesAreRecovered) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0.02, 0.98);
  for (int trial = 0; trial < 60; ++trial) {
    PlaneDomain domain = square();
    const int n = 30;
    for (int i = 0; i < n; ++i) domain.vertices.push_back({place(random), place(random)});
    // Long edges between random vertices, as long as they cross nothing.
    std::uniform_int_distribution<int> pick(0, n + 3);
    const auto crosses = [&](int a, int b) {
      for (const PlaneEdge& e : domain.edges) {
        const Vec2 p = domain.vertices[a], q = domain.vertices[b], r = domain.vertices[e.a], s = domain.vertices[e.b];
        if ((e.a == a && e.b == b) || (e.a == b && e.b == a)) return true;
        if (e.a == a || e.a == b || e.b == a || e.b == b) continue;
        if (orientation(p, q, r) * orientation(p, q, s) <= 0 && orientation(r, s, p) * orientation(r, s, q) <= 0)
          return true;
      }
      return false;
    };
    for (int i = 0; i < 200; ++i) {
      const int a = pick(random), b = pick(random);
      if (a != b && !crosses(a, b)) domain.edges.push_back({a, b, internal});
    }
    ASSERT_GT(domain.edges.size(), 20U);
    ASSERT_EQ(find_plane_defects(domain, triangulate(domain)), Defects{}) << "trial " << trial;
  }
}

TEST(TriangulateDomain, CombThatNeedsEveryEdgeRecovered) {
  // Teeth much thinner than they are far from the vertices of the other side.
  PlaneDomain domain;
  std::vector<Vec2> polygon{{0, 0}, {100, 0}};
  for (int i = 100; i > 0; --i) {
    polygon.push_back({i - 0.001, 1e-3});
    polygon.push_back({i - 0.5, 50});
  }
  add_loop(domain, polygon);
  const PlaneMesh mesh = triangulate(domain);
  EXPECT_EQ(find_plane_defects(domain, mesh), Defects{});
}

TEST(TriangulateDomain, IsDelaunayWhereNoEdgeIsImposed) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0.05, 0.95);
  PlaneDomain domain = square();
  for (int i = 0; i < 500; ++i) domain.vertices.push_back({place(random), place(random)});
  const PlaneMesh mesh = triangulate(domain);
  ASSERT_EQ(find_plane_defects(domain, mesh), Defects{});
  for (const auto& t : mesh.triangles)
    for (std::size_t v = 0; v < mesh.vertices.size(); v += 7)
      ASSERT_LE(in_circle(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[v]), 0);
}

TEST(TriangulateDomain, CollinearAndCocircularVerticesAreNoSpecialCase) {
  PlaneDomain domain;
  std::vector<Vec2> polygon;
  for (int i = 0; i < 40; ++i) polygon.push_back({0.1 * i, 0});
  for (int i = 0; i < 40; ++i) polygon.push_back({4, 0.1 * i});
  for (int i = 40; i > 0; --i) polygon.push_back({0.1 * i, 4});
  for (int i = 40; i > 0; --i) polygon.push_back({0, 0.1 * i});
  add_loop(domain, polygon);
  for (int i = 1; i < 39; ++i)
    for (int j = 1; j < 39; ++j) domain.vertices.push_back({0.1 * i, 0.1 * j});
  EXPECT_EQ(find_plane_defects(domain, triangulate(domain)), Defects{});
}

TEST(TriangulateDomain, CoordinatesMayBeTinyHugeOrFarAway) {
  std::mt19937 random(11);
  const std::vector<Vec2> shape = random_star(random, 57, 0.9);
  struct Map {
    Vec2 scale, shift;
  };
  for (const Map& map : {Map{{1e-150, 1e-150}, {0, 0}}, Map{{1e150, 1e150}, {0, 0}}, Map{{1e-200, 1e200}, {0, 0}},
                         Map{{1e300, 1e-250}, {0, 0}}, Map{{1, 1}, {1e9, -1e12}}, Map{{1e-3, 1e5}, {1e7, 1e3}}}) {
    PlaneDomain domain;
    std::vector<Vec2> polygon;
    for (const Vec2& p : shape) polygon.push_back({map.scale.x() * p.x() + map.shift.x(), map.scale.y() * p.y() + map.shift.y()});
    add_loop(domain, polygon);
    const PlaneMesh mesh = triangulate(domain);
    EXPECT_EQ(mesh.triangles.size(), 55U);
    for (const auto& t : mesh.triangles)
      EXPECT_GT(orientation(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]), 0);
  }
}

TEST(TriangulateDomain, NeedlesOfOneUnitInTheLastPlaceAreTriangulated) {
  PlaneDomain domain;
  const double up = std::nextafter(1.0, 2.0);
  add_loop(domain, {{0, 0}, {1, 1}, {2, 2}, {1, up}});
  const PlaneMesh mesh = triangulate(domain);
  EXPECT_EQ(find_plane_defects(domain, mesh), Defects{});
}

TEST(TriangulateDomain, CrossingEdgesAreNamedWithTheirPlace) {
  PlaneDomain domain;
  domain.vertices = {{0, 0}, {2, 2}, {2, 0}, {0, 2}};
  domain.edges = {{0, 1, boundary, 4, 0}, {1, 2, boundary, 5, 0}, {2, 3, boundary, 6, 7}, {3, 0, boundary, 8, 0}};
  const std::string error = error_of(domain);
  EXPECT_NE(error.find("edge 8 of curve 7"), std::string::npos) << error;
  EXPECT_NE(error.find("edge 1 of curve 5"), std::string::npos) << error;
  EXPECT_NE(error.find("u = 1, v = 1"), std::string::npos) << error;
}

TEST(TriangulateDomain, BadDomainsAreRejectedWithASentence) {
  const auto refused = [](const PlaneDomain& domain, const std::string& why) {
    const std::string error = error_of(domain);
    EXPECT_NE(error.find(why), std::string::npos) << why << " expected, got: " << error;
  };
  PlaneDomain open = square();
  open.edges.pop_back();
  refused(open, "does not close");

  PlaneDomain twice = square();
  twice.vertices.push_back({1, 1});
  refused(twice, "same point");

  PlaneDomain clockwise;
  add_loop(clockwise, {{0, 0}, {0, 1}, {1, 1}, {1, 0}});
  refused(clockwise, "wrong way");

  PlaneDomain hole_turned = square(3);
  add_loop(hole_turned, {{1, 1}, {2, 1}, {2, 2}, {1, 2}});
  refused(hole_turned, "turned against each other");

  PlaneDomain outside = square();
  outside.vertices.push_back({2, 2});
  refused(outside, "outside the domain");

  PlaneDomain in_hole = square(3);
  add_loop(in_hole, reversed({{1, 1}, {2, 1}, {2, 2}, {1, 2}}));
  in_hole.edges.push_back({4, 6, internal});
  refused(in_hole, "outside the domain");

  PlaneDomain on_edge = square();
  on_edge.vertices.push_back({0.5, 0});
  refused(on_edge, "lies on");

  PlaneDomain slit = square(4);
  slit.vertices.insert(slit.vertices.end(), {{1, 1}, {2, 1}});
  slit.edges.insert(slit.edges.end(), {{4, 5, boundary}, {5, 4, boundary}});
  refused(slit, "coincides");

  PlaneDomain line;
  add_loop(line, {{0, 0}, {1, 0}, {2, 0}});
  refused(line, "no area");

  PlaneDomain slanted;
  add_loop(slanted, {{0, 0}, {1, 1}, {2, 2}});
  EXPECT_NE(error_of(slanted), "");

  PlaneDomain not_finite = square();
  not_finite.vertices[2].x() = std::nan("");
  refused(not_finite, "not finite");
  not_finite.vertices[2].x() = INFINITY;
  refused(not_finite, "not finite");

  PlaneDomain index = square();
  index.edges[1].b = 99;
  refused(index, "does not exist");

  PlaneDomain point = square();
  point.edges.push_back({1, 1, internal});
  refused(point, "ends where it starts");

  refused({}, "fewer than three");
  PlaneDomain no_edges;
  no_edges.vertices = {{0, 0}, {1, 0}, {0, 1}};
  refused(no_edges, "no boundary");
}

// Any soup of edges ends in a mesh without defects or in a DomainError.
TEST(TriangulateDomain, RandomSoupNeverGivesAWrongMesh) {
  std::mt19937 random(5);
  int meshed = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    PlaneDomain domain;
    // Few places, so that coincidences and collinear vertices are common.
    const int n = 4 + static_cast<int>(random() % 6);
    for (int i = 0; i < n; ++i)
      domain.vertices.push_back({static_cast<double>(random() % 6), static_cast<double>(random() % 6)});
    std::vector<int> order(n);
    for (int i = 0; i < n; ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), random);
    const int loop = 3 + static_cast<int>(random() % static_cast<unsigned>(n - 2));
    for (int i = 0; i < loop; ++i) domain.edges.push_back({order[i], order[(i + 1) % loop], boundary});
    if (random() % 2 == 0)
      domain.edges.push_back({static_cast<int>(random() % static_cast<unsigned>(n)),
                              static_cast<int>(random() % static_cast<unsigned>(n)), internal});
    try {
      const PlaneMesh mesh = triangulate(domain);
      ++meshed;
      ASSERT_EQ(find_plane_defects(domain, mesh), Defects{}) << "trial " << trial;
    } catch (const DomainError&) {
    }
  }
  EXPECT_GT(meshed, 30);
}

}  // namespace
}  // namespace carreau
