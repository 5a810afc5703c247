// SPDX-License-Identifier: BSD-3-Clause
// Glued borders, omitted cells, and rejected grids.
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "grid_test_support.h"
#include "support/error.h"

namespace carreau::grid {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

Block flat(int columns, int rows) {
  return block_of(columns, rows, [](int i, int j) -> Vec3 { return {double(i), double(j), 0}; });
}

std::string error_of(std::vector<Block> blocks, const Options& options = {}) {
  try {
    build(std::move(blocks), options);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

/// Points - curves + faces of a model whose faces are discs but for `holes` inner loops.
int euler(const Model& model, int holes = 0) {
  std::set<int> points, curves;
  for (const Face& face : model.faces)
    for (const FaceCurve& c : face.curves) {
      points.insert({c.end1, c.end2});
      if (c.end1 != c.end2) curves.insert(c.ref);
    }
  return static_cast<int>(points.size()) - static_cast<int>(curves.size()) + static_cast<int>(model.faces.size()) - holes;
}

TEST(Glue, ASphereHasASeamAndTwoPoles) {
  const GridGeometry made = build({sphere(24, 12)});
  ASSERT_EQ(made.built.model.faces.size(), 1U);
  const std::vector<FaceCurve>& curves = made.built.model.faces[0].curves;
  ASSERT_EQ(curves.size(), 4U);
  int points = 0;
  std::multiset<int> refs;
  for (const FaceCurve& c : curves) points += c.end1 == c.end2 ? 1 : 0, refs.insert(c.ref);
  EXPECT_EQ(points, 2);
  int seams = 0;
  for (const FaceCurve& c : curves) seams += refs.count(c.ref) == 2 ? 1 : 0;
  EXPECT_EQ(seams, 2);
  EXPECT_EQ(euler(made.built.model), 2);
}

TEST(Glue, ATorusIsClosedBothWays) {
  const GridGeometry made = build({block_of(25, 13, [](int i, int j) -> Vec3 {
    const double a = 2 * std::numbers::pi * (i % 24) / 24, b = 2 * std::numbers::pi * (j % 12) / 12;
    return {(3 + std::cos(b)) * std::cos(a), (3 + std::cos(b)) * std::sin(a), std::sin(b)};
  })});
  EXPECT_EQ(made.built.model.faces[0].curves.size(), 4U);
  std::set<int> refs, points;
  for (const FaceCurve& c : made.built.model.faces[0].curves) refs.insert(c.ref), points.insert(c.end1);
  EXPECT_EQ(refs.size(), 2U);
  EXPECT_EQ(points.size(), 1U);
}

TEST(Glue, AClosedGridWithAnEdgeAtItsJointKeepsTheEdge) {
  // A drop: a circle but for a right angle at its joint.
  const auto drop = [](int i, int j) -> Vec3 {
    const double t = 2 * std::numbers::pi * (i % 16) / 16, r = std::cos(t / 2);
    return i % 16 == 0 ? Vec3{2, 0, double(j)} : Vec3{2 - 3 * std::sin(t / 2), r * std::sin(t / 2) * 4, double(j)};
  };
  const GridGeometry made = build({block_of(17, 3, drop)});
  const Vec3 before = surface_at(*made.built.cad, 1, want_first, {16, 1}).su, after = surface_at(*made.built.cad, 1, want_first, {0, 1}).su;
  EXPECT_LT(dot(before, after), 0.5 * norm(before) * norm(after));
  std::set<int> refs;
  for (const FaceCurve& c : made.built.model.faces[0].curves) refs.insert(c.ref);
  EXPECT_EQ(refs.size(), 3U);  // the seam is glued all the same
}

TEST(Glue, SixBlocksMakeACube) {
  std::vector<Block> blocks;
  for (int axis = 0; axis < 3; ++axis)
    for (const double end : {0.0, 4.0})
      blocks.push_back(block_of(5, 5, [&](int i, int j) -> Vec3 {
        Vec3 p;
        p[axis] = end, p[(axis + 1) % 3] = end == 0 ? j : i, p[(axis + 2) % 3] = end == 0 ? i : j;
        return p;
      }));
  const GridGeometry made = build(blocks);
  EXPECT_EQ(euler(made.built.model), 2);
  std::multiset<int> refs;
  for (const Face& face : made.built.model.faces)
    for (const FaceCurve& c : face.curves) refs.insert(c.ref);
  EXPECT_EQ(refs.size(), 24U);
  for (const int ref : refs) EXPECT_EQ(refs.count(ref), 2U);
}

TEST(Glue, NormalsOfAClosedBodyPointOutwardsOnRequest) {
  for (unsigned mirrored = 0; mirrored < 64; ++mirrored) {
    std::vector<Block> blocks;
    for (unsigned side = 0; side < 6; ++side) {
      const int axis = static_cast<int>(side) / 2;
      const bool backwards = ((mirrored >> side) & 1U) != 0;
      blocks.push_back(block_of(3, 3, [&](int i, int j) -> Vec3 {
        Vec3 p;
        p[axis] = side % 2 == 0 ? -1 : 1, p[(axis + 1) % 3] = backwards ? 1 - i : i - 1, p[(axis + 2) % 3] = j - 1;
        return p;
      }));
    }
    const GridGeometry made = build(blocks, {.orient = true});
    for (int face = 1; face <= 6; ++face) {
      const SurfaceJet s = surface_at(*made.built.cad, face, want_position | want_first, {1, 1});
      EXPECT_GT(dot(s.s, cross(s.su, s.sv)), 0) << mirrored << " " << face;
    }
  }
}

TEST(Glue, ASideIsCutWhereOtherBlocksEnd) {
  const GridGeometry made = build({flat(9, 3), block_of(4, 3, [](int i, int j) -> Vec3 { return {double(i), 2.0 + j, 0}; }),
                                   block_of(6, 3, [](int i, int j) -> Vec3 { return {3.0 + i, 2.0 + j, 0}; })});
  EXPECT_EQ(made.built.model.faces[0].curves.size(), 5U);  // the upper side has two parts
  EXPECT_EQ(euler(made.built.model), 1);
}

TEST(Glue, NodesWithinTheToleranceAreOne) {
  Block left = flat(4, 4);
  Block right = block_of(4, 4, [](int i, int j) -> Vec3 { return {3 + i + (i == 0 ? 1e-3 : 0.0), double(j), 0}; });
  EXPECT_EQ(euler(build({left, right}).built.model), 2);  // apart
  EXPECT_EQ(euler(build({left, right}, {.tolerance = 1e-2}).built.model), 1);
}

TEST(Cells, AHoleIsALoopAndAStripOfHolesCutsTheBlockInTwo) {
  Block block = flat(8, 8);
  block.nodes[block.index(3, 3)].z() = missing;
  const GridGeometry holed = build({block});
  ASSERT_EQ(holed.built.model.faces.size(), 1U);
  EXPECT_EQ(holed.built.model.faces[0].curves.size(), 8U);
  EXPECT_EQ(holed.warnings, std::vector<std::string>{"4 cells of block 1 lack a node and are left out"});
  for (int j = 0; j < 8; ++j) block.nodes[block.index(3, j)].z() = missing;
  const GridGeometry cut = build({block});
  ASSERT_EQ(cut.built.model.faces.size(), 2U);
  EXPECT_EQ(cut.built.model.faces[0].ref, 1);
  EXPECT_EQ(cut.built.model.faces[1].part_of, 1);
  EXPECT_EQ(cut.warnings.back(), "holes cut block 1 into 2 parts; each is a separate face");
}

TEST(Holes, AreFilledByAMembraneThatIsExactForLinearGrids) {
  Block block = flat(20, 16);
  for (Vec3& p : block.nodes) p.z() = 0.5 * p.x() - 2 * p.y();
  const Block before = block;
  for (const auto& [i, j] : {std::pair{3, 3}, {4, 3}, {4, 4}, {9, 9}, {10, 12}}) block.nodes[block.index(i, j)].y() = missing;
  block.nodes[block.index(19, 5)].x() = missing;  // on a side: stays
  const GridGeometry made = build({block}, {.fill = true});
  EXPECT_EQ(made.warnings.front(), "5 missing nodes of block 1 were filled");
  ASSERT_EQ(made.built.model.faces.size(), 1U);
  EXPECT_EQ(made.warnings.back(), "2 cells of block 1 lack a node and are left out");
  for (const auto& [i, j] : {std::pair{3, 3}, {4, 4}, {9, 9}})
    EXPECT_LE(norm(surface_at(*made.built.cad, 1, want_position, {double(i), double(j)}).s - before.node(i, j)), 1e-7);
}

TEST(Cells, CellsThatTouchByACornerKeepTheirLoops) {
  Block block = flat(5, 5);
  // The remaining cells are (1, 1) and (2, 2), counted from 0, beside one missing corner each way.
  for (const auto& [i, j] : {std::pair{0, 0}, {4, 4}, {0, 4}, {4, 0}, {3, 1}, {1, 3}, {0, 1}, {0, 2}, {0, 3}, {4, 1}, {4, 2}, {4, 3},
                             {1, 0}, {2, 0}, {3, 0}, {1, 4}, {2, 4}, {3, 4}})
    block.nodes[block.index(i, j)].x() = missing;
  const GridGeometry made = build({block});
  ASSERT_EQ(made.built.model.faces.size(), 2U);
  for (const Face& face : made.built.model.faces) EXPECT_EQ(face.curves.size(), 4U);
}

TEST(Cells, FoldsAreReportedAndLinesLeftOut) {
  Block folded = flat(4, 4);
  folded.nodes[folded.index(1, 1)] = {2.5, 2.5, 0};
  EXPECT_EQ(build({folded}).warnings.at(0).substr(0, 17), "3 cells fold, the");
  Block doubled = block_of(4, 5, [](int i, int j) -> Vec3 { return {double(i), j < 3 ? double(j) : j - 1.0, 0}; });
  const GridGeometry made = build({doubled});
  EXPECT_EQ(made.warnings.at(0), "3 cells are lines and left out, the first is block 1, cell (1, 3)");
  EXPECT_EQ(made.built.model.faces.size(), 2U);  // glued again
  EXPECT_EQ(euler(made.built.model), 1);
}

TEST(Cells, BadGridsAreRejectedWithBlockAndNode) {
  EXPECT_EQ(error_of({}), "there is no block of a grid");
  EXPECT_EQ(error_of({flat(3, 3), flat(4, 1)}), "block 2 has 4 x 1 nodes; a surface needs two rows and two columns");
  Block infinite = flat(3, 3);
  infinite.nodes[4].y() = HUGE_VAL;
  EXPECT_EQ(error_of({infinite}), "block 1, node (2, 2) is not finite");
  Block empty = flat(3, 3);
  empty.nodes[4].y() = missing;
  EXPECT_EQ(error_of({empty}), "the grid has no cell with four nodes");
  EXPECT_EQ(error_of({flat(3, 3), flat(3, 3)}), "block 1, cell (1, 1) and block 2, cell (1, 1) are the same: blocks overlap");
  EXPECT_EQ(error_of({flat(3, 3)}, {.smoothing = {.rounds = -1}}), "the number of rounds of smoothing is negative");
  EXPECT_EQ(error_of({flat(3, 3)}, {.smoothing = {.rounds = 1, .inward = 2}}),
            "the weights of smoothing must lie between 0 and 1");
}

TEST(Lengths, ParametersAreMeanLengthsAndAscend) {
  const GridGeometry made = build({block_of(4, 3, [](int i, int j) -> Vec3 { return {i < 2 ? i * 1.0 : i * 20.0 - 19, double(j), 0}; })},
                                  {.lengths = true});
  double longest = 0;
  for (int ic = 1; ic <= 4; ++ic) longest = std::max(longest, made.built.cad->curve_interval(1, ic).b);
  EXPECT_NEAR(longest, 41, 1e-12);  // 1 + 20 + 20
}

}  // namespace
}  // namespace carreau::grid
