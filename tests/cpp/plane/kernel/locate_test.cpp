// SPDX-License-Identifier: BSD-3-Clause
// Walks from a triangle to the triangle that holds a point.
#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "plane/kernel/triangulation.h"

namespace carreau::plane {
namespace {

/// n squares in a row, each cut in two: triangle 2 k is the lower left half of square k, 2 k + 1 the other one.
Triangulation row(int n) {
  Triangulation mesh;
  for (int k = 0; k <= n; ++k)
    for (const double y : {0., 1.}) {
      Vertex v;
      v.x = k, v.y = y;
      mesh.vertices.push_back(v);
    }
  std::map<std::pair<int, int>, HalfEdge> edges;
  const auto add = [&](int a, int b, int c) {
    Triangle t;
    t.v[0] = a, t.v[1] = b, t.v[2] = c;
    const int number = static_cast<int>(mesh.triangles.size());
    for (int i = 0; i < 3; ++i) {
      t.n[i] = no_edge;
      edges[{t.v[next3[i]], t.v[prev3[i]]}] = number << 2 | i;
    }
    mesh.triangles.push_back(t);
  };
  for (int k = 0; k < n; ++k) {
    add(2 * k, 2 * k + 2, 2 * k + 1);
    add(2 * k + 2, 2 * k + 3, 2 * k + 1);
  }
  for (const auto& [ends, h] : edges)
    if (const auto other = edges.find({ends.second, ends.first}); other != edges.end())
      mesh.triangles[static_cast<std::size_t>(h >> 2)].n[h & 3] = other->second;
  return mesh;
}

TEST(Locate, FindsTheTriangleThatHoldsAPoint) {
  const Triangulation mesh = row(500);
  for (const int k : {0, 1, 17, 499}) {
    EXPECT_EQ(mesh.locate({k + 0.25, 0.25}, 0), 2 * k);
    EXPECT_EQ(mesh.locate({k + 0.75, 0.75}, 999), 2 * k + 1);
  }
  EXPECT_EQ(mesh.locate({500.5, 0.5}, 3), -1);
}

// From triangle 0 to 2 k + 1 a walk passes 2 k + 2 triangles, the first and the last among them.
TEST(Locate, NearAPlaceLooksAtSoManyTriangles) {
  const Triangulation mesh = row(500);
  for (const int k : {0, 3, 120, 499}) {
    EXPECT_EQ(mesh.locate_near({k + 0.75, 0.75}, 0, 2 * k + 2), 2 * k + 1);
    EXPECT_EQ(mesh.locate_near({k + 0.75, 0.75}, 0, 2 * k + 1), -1);
  }
  EXPECT_EQ(mesh.locate_near({500.5, 0.5}, 990, 100), -1);
}

}  // namespace
}  // namespace carreau::plane
