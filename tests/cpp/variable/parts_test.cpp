// SPDX-License-Identifier: BSD-3-Clause
// The steps of HDR sec. 3.4 one by one: splines, tools, erosion, contact, runs, cut.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pieces.h"
#include "support/error.h"
#include "variable/boundary/boundary_cut.h"
#include "variable/boundary/cubic_spline.h"
#include "variable/self_overlap.h"

namespace carreau::testing {
namespace {

using namespace variable;
constexpr double pi = std::numbers::pi;

std::vector<Vec2> arc(double from, double to, int n) {
  std::vector<Vec2> points;
  for (int i = 0; i <= n; ++i) {
    const double angle = from + (to - from) * i / n;
    points.emplace_back(std::cos(angle), std::sin(angle));
  }
  return points;
}

double radius_error(const CubicSpline& spline) {
  double error = 0;
  for (std::size_t k = 0; k < spline.pieces(); ++k)
    for (double t = 0; t <= 1; t += 0.125) error = std::max(error, std::abs(norm(spline.at(k, t)) - 1));
  return error;
}

TEST(CubicSpline, IsOfFourthOrderOnCircles) {
  const auto closed = [](int n) { return radius_error(CubicSpline(circle({0, 0}, 1, n), SplineEnds::periodic)); };
  const auto open = [](int n, SplineEnds ends) { return radius_error(CubicSpline(arc(0.3, 2.5, n), ends)); };
  EXPECT_NEAR(std::log2(closed(20) / closed(40)), 4, 0.2);
  EXPECT_NEAR(std::log2(open(20, SplineEnds::tangent) / open(40, SplineEnds::tangent)), 4, 0.4);
  EXPECT_NEAR(std::log2(open(20, SplineEnds::natural) / open(40, SplineEnds::natural)), 2, 0.2);
  EXPECT_NEAR(CubicSpline(circle({0, 0}, 2, 60), SplineEnds::periodic).curvature(7, 0), 0.5, 1e-3);
}

TEST(CubicSpline, IsContinuousUpToCurvature) {
  std::vector<Vec2> points{{0, 0}, {1, 0.3}, {2.5, 0}, {3, 1}, {2, 2}, {0.2, 1.5}};
  for (const SplineEnds ends : {SplineEnds::natural, SplineEnds::tangent, SplineEnds::periodic}) {
    const CubicSpline spline(points, ends);
    for (std::size_t k = 0; k + 1 < spline.pieces(); ++k) {
      EXPECT_LT(norm(spline.at(k, 1) - points[k + 1]), 1e-14);
      EXPECT_LT(norm(spline.derivative(k, 1) - spline.derivative(k + 1, 0)), 1e-12);
      EXPECT_LT(norm(spline.second_derivative(k, 1) - spline.second_derivative(k + 1, 0)), 1e-14);
    }
  }
  const CubicSpline closed(points, SplineEnds::periodic);
  EXPECT_LT(norm(closed.derivative(5, 1) - closed.derivative(0, 0)), 1e-12);
  EXPECT_EQ(norm(CubicSpline(points, SplineEnds::natural).second_derivative(0, 0)), 0);
}

/// A rake of 0 degrees above an edge of radius .5 at the origin; the solid is in the first quadrant.
Tool corner() { return {{{0, 10}, {0, 0}, {10, 0}}, {0, 0.5, 0}, false}; }

TEST(Tools, GiveDistancesAndSides) {
  const Tools tools(std::vector<Tool>{corner()});
  const auto at = [&](double x, double y) { return tools.nearest({x, y}); };
  EXPECT_NEAR(at(-1, 5).distance, 1, 1e-14);
  EXPECT_FALSE(at(-1, 5).in_solid);
  EXPECT_NEAR(at(1, 5).distance, 1, 1e-14);
  EXPECT_TRUE(at(1, 5).in_solid);
  EXPECT_NEAR(at(0, 0).distance, 0.5 * (std::numbers::sqrt2 - 1), 1e-14);  // outside of the rounded edge
  EXPECT_FALSE(at(0, 0).in_solid);
  EXPECT_TRUE(at(0.2, 0.2).in_solid);
  EXPECT_FALSE(at(3, 12).in_solid);  // beyond the open end
  const double length = 9.5 + 0.25 * pi + 9.5;
  EXPECT_NEAR(at(12, 0).s, length, 1e-14);
  EXPECT_NEAR(norm(tools.at(0, 9.5 + 0.125 * pi).point - Vec2{0.5, 0.5}), 0.5, 1e-14);
}

TEST(Tools, RejectsRadiiThatDoNotFit) {
  const auto make = [](Tool tool) { return Tools(std::vector<Tool>{std::move(tool)}); };
  EXPECT_NO_THROW(make({{{0, 1}, {0, 0}, {1, 0}}, {0, 1, 0}, false}));  // takes all of both sides
  EXPECT_THROW(make({{{0, 1}, {0, 0}, {1, 0}}, {0, 1.01, 0}, false}), InvalidArgument);
  EXPECT_THROW(make({{{0, 1}, {0, 0}, {1, 0}}, {0, -1, 0}, false}), InvalidArgument);
  EXPECT_THROW(make({{{0, 1}}, {}, false}), InvalidArgument);
  EXPECT_THROW(make({{{0, 0}, {0, 1}, {1, 0}}, {}, true}), InvalidArgument);  // clockwise
  EXPECT_THROW(make({{{0, 0}, {0, 0}, {1, 0}}, {}, false}), InvalidArgument);
  EXPECT_THROW(make({{{0, 0}, {std::nan(""), 0}}, {}, false}), InvalidArgument);
}

/// A square of 4 x 4 in eight triangles around each inner vertex.
Piece square(int n = 4) {
  Piece piece;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) piece.vertices.emplace_back(i, j);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const std::int32_t v = j * (n + 1) + i;
      piece.triangles.push_back({v, v + 1, v + n + 2});
      piece.triangles.push_back({v, v + n + 2, v + n + 1});
    }
  return piece;
}

TEST(Erosion, UndoesMultipleVertices) {
  const Piece piece = square();
  std::vector<double> damage(piece.triangles.size(), 0);
  damage[2 * 5] = damage[2 * 5 + 1] = 1;    // the cell from (1, 1) to (2, 2)
  damage[2 * 10] = damage[2 * 10 + 1] = 1;  // that from (2, 2) to (3, 3): they meet at (2, 2) only
  const Eroded eroded = erode(piece, damage, 1, true);
  EXPECT_EQ(eroded.damaged, 4);
  EXPECT_GT(eroded.at_multiple_vertices, 0);
  std::vector<int> degree(eroded.piece.vertices.size(), 0);
  for (std::size_t t = 0; t < eroded.piece.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (eroded.adjacency[t][k] < 0)
        ++degree[static_cast<std::size_t>(eroded.piece.triangles[t][k])],
            ++degree[static_cast<std::size_t>(eroded.piece.triangles[t][(k + 1) % 3])];
  EXPECT_EQ(*std::max_element(degree.begin(), degree.end()), 2);
  EXPECT_NEAR(eroded.piece.area() + eroded.removed_area, 16, 1e-12);
}

TEST(Erosion, KeepsTheLargestPartOrAll) {
  const Piece piece = square();
  std::vector<double> damage(piece.triangles.size(), 0);
  for (int j = 0; j < 4; ++j)
    damage[static_cast<std::size_t>(2 * (4 * j + 2))] = damage[static_cast<std::size_t>(2 * (4 * j + 2) + 1)] = 1;
  const Eroded all = erode(piece, damage, 1, true), largest = erode(piece, damage, 1, false);
  EXPECT_EQ(all.parts_found, 2);
  EXPECT_EQ(all.parts_kept, 2);
  EXPECT_EQ(all.dangling, 2);  // at both ends of the crack one that had but a side left
  EXPECT_NEAR(all.piece.area(), 11, 1e-12);
  EXPECT_NEAR(all.removed_area, 5, 1e-12);
  EXPECT_EQ(largest.parts_kept, 1);
  EXPECT_EQ(largest.in_parts, 7);
  EXPECT_NEAR(largest.piece.area(), 7.5, 1e-12);
  EXPECT_THROW(erode(piece, std::vector<double>(piece.triangles.size(), 1), 1, true), InvalidArgument);
}

std::vector<BoundaryLoop> bound_square(const Tools& tools, double step) {
  std::vector<BoundaryLoop> loops = boundary_of(erode(square(), {}, 1, true));
  bind_to_tools(loops, tools, {step, step}, 1);
  return loops;
}

TEST(Contact, EdgesFollowTheTool) {
  // A plane .05 below the square.
  const Tools plane(std::vector<Tool>{{{{9, -0.05}, {-9, -0.05}}, {}, false}});
  const auto loops = bound_square(plane, 0.1);
  ASSERT_EQ(loops.size(), 1U);
  int bound = 0, follow = 0;
  for (std::size_t i = 0; i < loops[0].size(); ++i) {
    bound += loops[0].nodes[i].is_bound() ? 1 : 0, follow += loops[0].edges[i].follows_tool ? 1 : 0;
    if (loops[0].nodes[i].is_bound()) {
      EXPECT_NEAR(loops[0].nodes[i].point.y(), -0.05, 1e-14);
    }
  }
  EXPECT_EQ(bound, 5);
  EXPECT_EQ(follow, 4);
  EXPECT_EQ(bound_square(plane, 0.04)[0].nodes[0].is_bound(), false);
  // Between two nodes a notch of the tool as deep as wide: the edge bridges it.
  const Tools notch(std::vector<Tool>{{{{9, 0}, {1.9, 0}, {1.5, -2}, {1.1, 0}, {-9, 0}}, {}, false}});
  const auto bridged = bound_square(notch, 0.01);
  EXPECT_FALSE(bridged[0].edges[1].follows_tool);
  EXPECT_TRUE(bridged[0].edges[2].follows_tool);
}

TEST(Contact, ToolNodesBetweenNodesOfThePieceAreInserted) {
  // A wedge whose edge is .02 below the middle of the first side, its faces steep.
  const auto wedge = [](double depth) {
    return Tools(std::vector<Tool>{{{{3, -4}, {1.5, depth}, {0, -4}}, {}, false}});
  };
  const auto loops = bound_square(wedge(0.02), 0.05);
  EXPECT_EQ(loops[0].size(), 17U);
  EXPECT_EQ(loops[0].nodes[2].vertex, -1);
  EXPECT_LT(norm(loops[0].nodes[2].point - Vec2{1.5, 0.02}), 1e-14);
  EXPECT_THROW(bound_square(wedge(0.2), 0.05), InvalidArgument);  // deeper than the step
  const auto near = bound_square(Tools(std::vector<Tool>{{{{3, -4}, {1.1, 0.01}, {0, -4}}, {}, false}}), 0.05);
  EXPECT_EQ(near[0].size(), 16U);  // the node at (1, 0) went there
  EXPECT_LT(norm(near[0].nodes[1].point - Vec2{1.1, 0.01}), 1e-14);
}

BoundaryLoop loop_of(const std::vector<Vec2>& points) {
  BoundaryLoop loop;
  for (const Vec2& p : points) {
    BoundaryNode node;
    node.point = p;
    loop.nodes.push_back(node);
    loop.edges.emplace_back();
  }
  return loop;
}

TEST(BoundaryRuns, EndAtCorners) {
  EXPECT_TRUE(runs_of(loop_of(circle({0, 0}, 1, 12)), 45).front().closed);
  const auto runs = runs_of(loop_of(polygon({{0, 0}, {4, 0}, {4, 3}, {0, 3}}, 1)), 45);
  ASSERT_EQ(runs.size(), 4U);
  EXPECT_EQ(runs[0].count, 4U);
  EXPECT_EQ(runs[1].count, 3U);
}

TEST(BoundaryRuns, EndsThatAreTooCloseBecomeOne) {
  BoundaryLoop loop = loop_of({{0, 0}, {4, 0}, {4.2, 0.2}, {4.2, 3}, {0, 3}});  // two corners .28 apart
  join_close_ends(loop, Tools(), 20, 1);
  EXPECT_EQ(loop.size(), 4U);
  BoundaryLoop far = loop_of({{0, 0}, {4, 0}, {4.4, 0.4}, {4.4, 3}, {0, 3}});
  join_close_ends(far, Tools(), 20, 1);
  EXPECT_EQ(far.size(), 5U);
}

TEST(BoundaryRuns, TipsAreCut) {
  BoundaryLoop spike = loop_of({{0, 0}, {4, 0}, {4, 1.8}, {8, 2}, {4, 2.2}, {4, 4}, {0, 4}});  // 5.7 degrees
  cut_tips(spike, Tools(), 1);
  EXPECT_EQ(spike.size(), 6U);
  BoundaryLoop slit = loop_of({{0, 0}, {4, 0}, {4, 1.8}, {1, 2}, {4, 2.2}, {4, 4}, {0, 4}});  // of the outside
  cut_tips(slit, Tools(), 1);
  EXPECT_EQ(slit.size(), 7U);
}

TEST(RunCurve, WildSplinesArePolygons) {
  const auto is_spline = [](const std::vector<Vec2>& points) {
    const BoundaryLoop loop = loop_of(points);
    const auto runs = runs_of(loop, 179);
    return RunCurve(loop, runs.front(), Tools(), Smoothness::tangent, false).is_spline();
  };
  EXPECT_TRUE(is_spline(circle({0, 0}, 1, 8)));
  EXPECT_FALSE(is_spline(circle({0, 0}, 1, 3)));  // turns of 120 degrees
}

TEST(BoundaryCut, HasUnitEdges) {
  const Piece piece = disc({0, 0}, 5, 0.5);
  const Eroded eroded = erode(piece, {}, 1, true);
  std::vector<BoundaryShape> shapes(1);
  shapes[0].loop = boundary_of(eroded)[0];
  shapes[0].runs = runs_of(shapes[0].loop, 45);
  const Tools none;
  shapes[0].curves.emplace_back(shapes[0].loop, shapes[0].runs[0], none, Smoothness::tangent, false);
  const auto h = [](const Vec2& p) { return 0.3 + 0.05 * (p.x() + 5); };
  std::vector<double> sizes;
  for (const Vec2& p : eroded.piece.vertices) sizes.push_back(h(p));
  const TriangleSearch search(in_space(eroded.piece.vertices), eroded.piece.triangles);
  const CutBoundary cut = cut_boundary(shapes, none, SizeMap(eroded.piece, search, sizes, {0.1, 10}));
  double sum = 0;
  for (const PlaneEdge& e : cut.domain.edges) {
    const Vec2 a = cut.domain.vertices[static_cast<std::size_t>(e.a)],
               b = cut.domain.vertices[static_cast<std::size_t>(e.b)];
    EXPECT_NEAR(norm(b - a) / h((a + b) / 2), 1, 0.03);
    EXPECT_NEAR(norm(a), 5, 1e-4);
    sum += norm(b - a) / h((a + b) / 2);
  }
  EXPECT_NEAR(sum / static_cast<double>(cut.domain.edges.size()), 1, 0.01);
}

TEST(SelfOverlap, ElementsThatHaveMetGo) {
  // Two squares side by side, the second pushed into the first by .1.
  Piece piece = square(2), other = square(2);
  for (const Vec2& p : other.vertices) piece.vertices.emplace_back(p + Vec2{1.9, 0.3});
  for (auto t : other.triangles) {
    for (std::int32_t& v : t) v += 9;
    piece.triangles.push_back(t);
  }
  EXPECT_TRUE(crossing_triangles(erode(square(2), {}, 1, true)).empty());
  EXPECT_FALSE(crossing_triangles(erode(piece, {}, 1, true)).empty());
  RemeshInput input = input_of(piece, 0.5, 1);
  input.keep_all_parts = true;
  Monitor monitor;
  EXPECT_THROW(remesh(input, monitor), DomainError);
  input.remove_overlaps = true;
  const RemeshResult result = remesh(input, monitor);
  EXPECT_GT(result.summary.overlapping, 0);
  EXPECT_EQ(result.summary.damaged, 0);
  EXPECT_TRUE(find_defects(input, result).empty());
}

}  // namespace
}  // namespace carreau::testing
