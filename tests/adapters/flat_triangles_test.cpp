// SPDX-License-Identifier: BSD-3-Clause
// The causes that the sweep takes for forced by the input: each on a mesh of a few triangles, and a flat one that has none.
#include "flat_triangles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace adapters {
namespace {

using Points = std::vector<std::array<double, 3>>;
using Triangles = std::vector<std::array<std::int32_t, 3>>;
using Edges = std::vector<std::array<std::int32_t, 2>>;

std::vector<FlatCause> causes(const Points& points, const Triangles& triangles, const std::vector<std::int32_t>& refs,
                              const Edges& edges) {
  std::vector<FlatCause> found;
  for (const FlatTriangle& f : explain_flat_triangles({points, triangles, refs, edges, 1}, 0.1))
    found.push_back(f.cause);
  return found;
}

TEST(FlatTriangles, QualityOfAnEquilateralTriangleIsOne) {
  EXPECT_NEAR(q2_of({0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}), 1, 1e-15);
}

TEST(FlatTriangles, CornerUnderASmallAngleAndItsFollowers) {
  const Points points{{0, 0, 0}, {1, 0, 0}, {1, 0.02, 0}, {2, 0, 0}};
  EXPECT_EQ(causes(points, {{0, 1, 2}, {1, 3, 2}}, {1, 0, 0, 0}, {{0, 1}, {0, 2}, {1, 3}}),
            (std::vector{FlatCause::corner_angle, FlatCause::narrow_face}));
}

TEST(FlatTriangles, ShortCurve) {
  const Points points{{0, 0, 0}, {0.02, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(causes(points, {{0, 1, 2}}, {1, 2, 0}, {{0, 1}}), std::vector{FlatCause::short_curve});
}

TEST(FlatTriangles, NarrowFace) {
  const Points points{{0, 0, 0}, {1, 0, 0}, {0, 0.02, 0}, {1, 0.02, 0}};
  EXPECT_EQ(causes(points, {{0, 1, 3}, {0, 3, 2}}, {0, 0, 0, 0}, {{0, 1}, {2, 3}}),
            (std::vector{FlatCause::narrow_face, FlatCause::narrow_face}));
}

TEST(FlatTriangles, EarsOfOneCurveAndInnerTrianglesHaveNoExcuse) {
  const Points points{{0, 0, 0}, {1, 0, 0}, {0.5, 0.02, 0}};
  EXPECT_EQ(causes(points, {{0, 1, 2}}, {0, 0, 0}, {{0, 2}, {1, 2}}), std::vector{FlatCause::none});
  EXPECT_EQ(causes(points, {{0, 1, 2}}, {0, 0, 0}, {}), std::vector{FlatCause::none});
}

}  // namespace
}  // namespace adapters
