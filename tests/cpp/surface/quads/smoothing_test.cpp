// SPDX-License-Identifier: BSD-3-Clause
// Smoothing finds lattices again, and turns nothing over.
#include "surface/elements/quads/passes.h"

#include <gtest/gtest.h>

#include <random>

#include "surface/elements/quads/quad_shape.h"

namespace carreau {
namespace {

/// n x n squares of unit edges in the metric diag(a^2, 1), border fixed, vertices inside moved by up to `noise`.
QuadPatch lattice(int n, double a, double noise) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> shift(-noise, noise);
  QuadPatch patch;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const bool border = i == 0 || j == 0 || i == n || j == n;
      const Vec2 d = border ? Vec2{0, 0} : Vec2{shift(random), shift(random)};
      patch.uv.push_back({(i + d.x()) / a, j + d.y()});
      patch.fixed.push_back(border ? 1 : 0);
    }
  const auto at = [n](int i, int j) { return j * (n + 1) + i; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) patch.cells.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  return patch;
}

TEST(QuadSmoothing, MovesALatticeBackToItsPlaces) {
  for (const double a : {1., 5.}) {
    const ControlSpace space = ControlSpace::constant({a * a, 0, 1});
    QuadPatch patch = lattice(8, a, 0.3);
    Monitor monitor;
    const FaceCharts charts(space);
    PlaneQuads quads(patch, charts);
    smooth_quads(quads, {.passes = 200}, monitor);
    const QuadPatch regular = lattice(8, a, 0);
    for (std::size_t v = 0; v < patch.uv.size(); ++v) EXPECT_LT(norm(patch.uv[v] - regular.uv[v]), 1e-6) << v;
  }
}

TEST(QuadSmoothing, LeavesAllCellsConvexAndTheBorderWhereItIs) {
  const ControlSpace space = ControlSpace::constant({1, 0, 1});
  const FaceCharts charts(space);
  QuadPatch patch = lattice(12, 1, 0.24);
  const QuadPatch before = patch;
  for (const MixedCell& cell : patch.cells) ASSERT_TRUE(is_convex(patch, cell));
  Monitor monitor;
  for (const double share : {1., 1.9}) {
    PlaneQuads quads(patch, charts);
    smooth_quads(quads, {.passes = 3, .share = share}, monitor);
    for (const MixedCell& cell : patch.cells) EXPECT_TRUE(is_convex(patch, cell));
  }
  for (std::size_t v = 0; v < patch.uv.size(); ++v)
    if (patch.fixed[v] != 0) {
      EXPECT_EQ(patch.uv[v], before.uv[v]);
    }
}

// If cells would be far larger than the border allows, vertices go back in nearly each pass. This may turn over cells
// beside them that had not turned over themselves.
TEST(QuadSmoothing, TurnsNothingOverWhereCellsPress) {
  const ControlSpace space = ControlSpace::constant({1, 0, 1});
  Monitor monitor;
  for (const double unit : {0.3, 2., 4.})
    for (const double share : {1., 1.9})
      for (const int passes : {1, 2, 3, 5, 8, 17}) {
        QuadPatch patch = lattice(16, 1, 0.24);
        const FaceCharts charts(space);
        PlaneQuads quads(patch, charts);
        smooth_quads(quads, {.passes = passes, .share = share, .pull = 0.8, .unit = unit}, monitor);
        for (const MixedCell& cell : patch.cells) ASSERT_TRUE(is_convex(patch, cell)) << unit << ' ' << passes;
      }
}

TEST(QuadSmoothing, RaisesTheWorstCells) {
  const ControlSpace space = ControlSpace::constant({1, 0, 1});
  const FaceCharts charts(space);
  QuadPatch patch = lattice(10, 1, 0.24);
  const auto worst = [&] {
    double q = 1;
    for (const MixedCell& cell : patch.cells) q = std::min(q, cell_quality(patch, charts, cell));
    return q;
  };
  const double before = worst();
  ASSERT_LT(before, 0.6);
  Monitor monitor;
  PlaneQuads quads(patch, charts);
  improve_worst_quads(quads, 0.6, monitor);
  EXPECT_GE(worst(), 0.6);
}

}  // namespace
}  // namespace carreau
