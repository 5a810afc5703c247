// SPDX-License-Identifier: BSD-3-Clause
// Places in plane triangulations, against all triangles one by one.
#include "gradation/triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace carreau {
namespace {

struct Triangles {
  std::vector<Vec2> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// A ring of n x n squares, each cut in two, whose inner vertices are moved at random; as wide and high as given.
Triangles ring(int n, Vec2 extent, std::mt19937& random) {
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  Triangles mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double r = 0.3 + 0.7 * (j + (j > 0 && j < n ? shift(random) : 0)) / n;
      const double angle = 1.5 * std::numbers::pi * (i + (i > 0 && i < n ? shift(random) : 0)) / n;
      mesh.vertices.push_back({extent.x() * r * std::cos(angle), extent.y() * r * std::sin(angle)});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const std::int32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.push_back({a, c, b});
      mesh.triangles.push_back({b, c, d});
    }
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
  return mesh;
}

/// In units of the mean edge in u and in v, as the tree measures.
struct Scale {
  Vec2 low, by;
  explicit Scale(const Triangles& mesh) : low(mesh.vertices.front()) {
    Vec2 length;
    for (const Vec2& p : mesh.vertices) low = low.cwiseMin(p);
    for (const auto& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec2 d = mesh.vertices[t[(i + 1) % 3]] - mesh.vertices[t[i]];
        length = length + Vec2{std::abs(d.x()), std::abs(d.y())};
      }
    const double edges = 3 * static_cast<double>(mesh.triangles.size());
    by = {edges / length.x(), edges / length.y()};
  }
  [[nodiscard]] Vec3 operator()(Vec2 p) const { return {(p.x() - low.x()) * by.x(), (p.y() - low.y()) * by.y(), 0}; }
};

NearestOnMesh nearest_of_all(const Triangles& mesh, const Scale& scaled, Vec2 p) {
  NearestOnMesh best;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    NearestOnMesh one =
        nearest_on_triangle(scaled(p), {scaled(mesh.vertices[a]), scaled(mesh.vertices[b]), scaled(mesh.vertices[c])});
    if (!(one.distance < best.distance)) continue;
    best = one;
    best.triangle = static_cast<std::int32_t>(t);
  }
  return best;
}

class TriangleTreePlaces : public testing::TestWithParam<Vec2> {};

TEST_P(TriangleTreePlaces, MatchTheNearestTriangle) {
  std::mt19937 random(7);
  const Vec2 extent = GetParam();
  for (const int n : {4, 9, 24}) {
    const Triangles mesh = ring(n, extent, random);
    Monitor monitor;
    const TriangleTree tree(mesh.vertices, mesh.triangles, monitor);
    const Scale scaled(mesh);
    std::uniform_real_distribution<double> anywhere(-1.1, 1.1);
    int inside = 0;
    for (int k = 0; k < 1500; ++k) {
      const Vec2 p{extent.x() * anywhere(random), extent.y() * anywhere(random)};
      const TrianglePlace found = tree.find(p);
      const NearestOnMesh all = nearest_of_all(mesh, scaled, p);
      ASSERT_EQ(found.triangle, all.triangle) << n << ": " << p.x() << ' ' << p.y();
      ASSERT_EQ(found.weight, all.weight);
      inside += found.inside ? 1 : 0;
    }
    EXPECT_GT(inside, 300);
    EXPECT_LT(inside, 1200);
  }
}

TEST_P(TriangleTreePlaces, AtVerticesAndOnSidesAreInSomeTriangleThatHasThem) {
  std::mt19937 random(11);
  const Triangles mesh = ring(12, GetParam(), random);
  Monitor monitor;
  const TriangleTree tree(mesh.vertices, mesh.triangles, monitor);
  const Scale scaled(mesh);
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      for (const double w : {0., 0.5, 1.}) {
        const Vec2 p = lerp(mesh.vertices[t[i]], mesh.vertices[t[(i + 1) % 3]], w);
        const TrianglePlace found = tree.find(p);
        const auto [a, b, c] = mesh.triangles[found.triangle];
        const Vec3 q = found.weight[0] * scaled(mesh.vertices[a]) + found.weight[1] * scaled(mesh.vertices[b]) +
                       found.weight[2] * scaled(mesh.vertices[c]);
        EXPECT_LT(norm(q - scaled(p)), 1e-12);
        EXPECT_TRUE(found.inside);
      }
}

INSTANTIATE_TEST_SUITE_P(Domains, TriangleTreePlaces, testing::Values(Vec2{1, 1}, Vec2{1000, 0.01}, Vec2{1e-6, 3}));

TEST(TriangleTree, HasNothingWithoutTriangles) { EXPECT_EQ(TriangleTree().find({0, 0}).triangle, -1); }

}  // namespace
}  // namespace carreau
