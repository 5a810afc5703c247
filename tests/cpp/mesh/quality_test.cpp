#include "mesh/quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

}  // namespace
}  // namespace carreau
