// SPDX-License-Identifier: BSD-3-Clause
// Edges made to exist in a triangulation of random points.
#include "plane/kernel/edge_recovery.h"

#include <gtest/gtest.h>

#include <random>

#include "plane/kernel/boundary.h"
#include "predicates/predicates.h"

namespace carreau::plane {
namespace {

Triangulation random_triangulation(std::mt19937& random, int n, int grid) {
  PlaneDomain domain;
  domain.vertices = {{-1, -1}, {2, -1}, {2, 2}, {-1, 2}};
  for (int i = 0; i < 4; ++i) domain.edges.push_back({i, (i + 1) % 4});
  std::vector<char> taken(static_cast<std::size_t>(grid) * grid, 0);
  while (static_cast<int>(domain.vertices.size()) < n + 4) {
    const int i = static_cast<int>(random() % static_cast<unsigned>(grid)),
              j = static_cast<int>(random() % static_cast<unsigned>(grid));
    if (std::exchange(taken[i * grid + j], 1) != 0) continue;
    domain.vertices.push_back({static_cast<double>(i) / grid, static_cast<double>(j) / grid});
  }
  Monitor monitor;
  return triangulate_boundary(domain, monitor).mesh;
}

void expect_valid(const Triangulation& mesh) {
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const Triangle& T = mesh.triangles[t];
    ASSERT_GT(orientation(mesh.at(T.v[0]), mesh.at(T.v[1]), mesh.at(T.v[2])), 0);
    for (int i = 0; i < 3; ++i) {
      if (T.n[i] == no_edge) continue;
      const Triangle& U = mesh.triangles[T.n[i] >> 2];
      const int j = T.n[i] & 3;
      ASSERT_EQ(U.n[j], 4 * t + i);
      ASSERT_EQ(U.v[next3[j]], T.v[prev3[i]]);
      ASSERT_EQ(U.v[prev3[j]], T.v[next3[i]]);
      ASSERT_EQ(mesh.is_imposed(t, i), mesh.is_imposed(T.n[i] >> 2, j));
    }
  }
  for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v) {
    const Triangle& T = mesh.triangles[mesh.vertices[v].triangle];
    ASSERT_TRUE(T.v[0] == v || T.v[1] == v || T.v[2] == v);
  }
}

TEST(RecoverEdge, MakesTheEdgeOrReturnsTheVertexOnIt) {
  std::mt19937 random(2);
  int made = 0, on_vertex = 0;
  for (int trial = 0; trial < 20; ++trial) {
    Triangulation mesh = random_triangulation(random, 100, 20);
    for (int k = 0; k < 50; ++k) {
      const int a = static_cast<int>(random() % 104), b = static_cast<int>(random() % 104);
      if (a == b) continue;
      const RecoveredEdge found = recover_edge(mesh, a, b);
      if (found.edge != no_edge) {
        ++made;
        const Triangle& T = mesh.triangles[found.edge >> 2];
        const int u = T.v[next3[found.edge & 3]], v = T.v[prev3[found.edge & 3]];
        ASSERT_TRUE((u == a && v == b) || (u == b && v == a));
      } else {
        ++on_vertex;
        ASSERT_GE(found.vertex, 0);
        ASSERT_EQ(orientation(mesh.at(a), mesh.at(b), mesh.at(found.vertex)), 0);
        ASSERT_LT(dot(mesh.at(a) - mesh.at(found.vertex), mesh.at(b) - mesh.at(found.vertex)), 0);
      }
      expect_valid(mesh);
    }
  }
  EXPECT_GT(made, 200);
  EXPECT_GT(on_vertex, 50);
}

TEST(RecoverEdge, KeepsImposedEdges) {
  std::mt19937 random(9);
  for (int trial = 0; trial < 30; ++trial) {
    Triangulation mesh = random_triangulation(random, 60, 1000);
    std::vector<std::pair<int, int>> imposed;
    for (int k = 0; k < 60; ++k) {
      const int a = static_cast<int>(random() % 64), b = static_cast<int>(random() % 64);
      if (a == b) continue;
      const RecoveredEdge found = recover_edge(mesh, a, b);
      if (found.edge != no_edge) {
        mesh.impose(found.edge, false);
        imposed.emplace_back(a, b);
      } else if (found.imposed != no_edge) {
        ASSERT_TRUE(mesh.is_imposed(found.imposed >> 2, found.imposed & 3));
      }
      for (const auto& [u, v] : imposed) {
        const HalfEdge he = mesh.find_edge(u, v);
        ASSERT_NE(he, no_edge);
        ASSERT_TRUE(mesh.is_imposed(he >> 2, he & 3));
      }
      expect_valid(mesh);
    }
    EXPECT_GT(imposed.size(), 10U);
  }
}

}  // namespace
}  // namespace carreau::plane
