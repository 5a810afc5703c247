// SPDX-License-Identifier: BSD-3-Clause
// Places of meshes of tetrahedra, triangles and edges, against all of them one by one.
#include "mesh/simplices/simplex_search.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "common/kuhn_cube.h"
#include "mesh/triangle_search.h"

namespace carreau {
namespace {

using testing::kuhn_cube;

class Numbers {
 public:
  double operator()() { return number_(random_); }
  Vec3 point() { return {(*this)(), (*this)(), (*this)()}; }
  std::int32_t below(int n) { return static_cast<std::int32_t>(random_() % static_cast<unsigned>(n)); }

 private:
  std::mt19937_64 random_{7};
  std::uniform_real_distribution<double> number_{-1, 1};
};

/// The point of these weights.
Vec3 place_of(const std::vector<Vec3>& vertices, const Simplex& s, const std::array<double, 4>& weight) {
  Vec3 place{0, 0, 0};
  for (std::size_t k = 0; k < static_cast<std::size_t>(s.corners); ++k)
    place = place + weight[k] * vertices[static_cast<std::size_t>(s.vertex[k])];
  return place;
}

TEST(SimplexSearch, MatchesAllSimplicesTogether) {
  Numbers number;
  for (int round = 0; round < 30; ++round) {
    std::vector<Vec3> vertices;
    for (int i = 0; i < 40; ++i) vertices.push_back(number.point());
    std::vector<Simplex> simplices;
    for (int i = 0; i < 60; ++i) {
      Simplex s{.vertex = {-1, -1, -1, -1}, .corners = 2 + number.below(3)};
      for (std::size_t k = 0; k < static_cast<std::size_t>(s.corners); ++k)
        s.vertex[k] = number.below(40);  // some flat
      simplices.push_back(s);
    }
    const SimplexSearch tree(vertices, simplices);
    for (int k = 0; k < 50; ++k) {
      const Vec3 p = 1.5 * number.point();
      const NearestOnSimplices found = tree.nearest(p, number.below(60));
      double least = 1e9;
      for (const Simplex& s : simplices) least = std::min(least, SimplexSearch(vertices, {&s, 1}).nearest(p).distance);
      EXPECT_EQ(found.distance, least);
      EXPECT_EQ(tree.nearest(p).simplex, found.simplex) << "a guess changes the answer";
      const Simplex& s = simplices[static_cast<std::size_t>(found.simplex)];
      EXPECT_LT(norm(place_of(vertices, s, found.weight) - found.point), 1e-12) << "weights are those of the point";
      // No combination of the corners is nearer.
      for (int sample = 0; sample < 20; ++sample) {
        std::array<double, 4> w{};
        double sum = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(s.corners); ++i) sum += w[i] = std::abs(number());
        for (double& each : w) each /= sum;
        EXPECT_GE(norm(place_of(vertices, s, w) - p), found.distance * (1 - 1e-12));
      }
    }
  }
}

TEST(SimplexSearch, PointsOfACubeAreInItsTetrahedra) {
  const testing::Tetrahedra cube = kuhn_cube(3);
  const SimplexSearch tree(cube.vertices, simplices_of(cube.tetrahedra, {}, {}));
  Numbers number;
  for (int k = 0; k < 500; ++k) {
    const Vec3 p = 0.5 * (number.point() + Vec3{1, 1, 1});
    EXPECT_LT(tree.nearest(p).distance, 1e-15) << "weights below rounding may be negative beside a face";
    const Vec3 above{p.x(), p.y(), 1 + p.z()};
    EXPECT_NEAR(tree.nearest(above).distance, p.z(), 1e-14);
    EXPECT_LT(norm(tree.nearest(above).point - Vec3{p.x(), p.y(), 1}), 1e-14);
  }
}

TEST(SimplexSearch, SidesOfLargerSimplicesAreLeftOut) {
  const std::vector<Simplex> simplices = simplices_of(std::vector<std::array<std::int32_t, 4>>{{3, 2, 1, 0}},
                                                      std::vector<std::array<std::int32_t, 3>>{{2, 0, 1}, {4, 2, 3}},
                                                      std::vector<std::array<std::int32_t, 2>>{{3, 0}, {4, 2}, {5, 4}});
  ASSERT_EQ(simplices.size(), 3u);
  EXPECT_EQ(simplices[0].vertex, (std::array<std::int32_t, 4>{0, 1, 2, 3}));
  EXPECT_EQ(simplices[1].vertex, (std::array<std::int32_t, 4>{4, 2, 3, -1}));
  EXPECT_EQ(simplices[2].vertex, (std::array<std::int32_t, 4>{5, 4, -1, -1}));
}

TEST(SimplexSearch, TheBoundaryOfACubeIsClosedAndTurnedOutward) {
  testing::Tetrahedra cube = kuhn_cube(3);
  std::swap(cube.tetrahedra[5][0], cube.tetrahedra[5][1]);  // whatever the orientation of tetrahedra
  const auto boundary = boundary_of(cube.vertices, cube.tetrahedra);
  EXPECT_EQ(boundary.size(), 6u * 9 * 2);
  double volume = 0;
  std::map<std::array<std::int32_t, 2>, int> sides;
  for (const auto& t : boundary) {
    const auto at = [&](std::size_t k) { return cube.vertices[static_cast<std::size_t>(t[k])]; };
    volume += dot(at(0), cross(at(1), at(2))) / 6;
    for (std::size_t k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
  }
  EXPECT_NEAR(volume, 1, 1e-14);
  for (const auto& [side, uses] : sides) EXPECT_EQ(uses + sides.count({side[1], side[0]}), 2u);
}

TEST(SimplexSearch, AFlatTetrahedronIsItsFaces) {
  const std::vector<Vec3> flat{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const NearestOnSimplices found = nearest_on_simplex({0.25, 0.5, 2}, flat);
  EXPECT_EQ(found.distance, 2);
  EXPECT_LT(norm(found.point - Vec3{0.25, 0.5, 0}), 1e-15);
}

}  // namespace
}  // namespace carreau
