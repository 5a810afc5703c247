// SPDX-License-Identifier: BSD-3-Clause
// The figures of HDR sec. 3.3.1-3.3.3 in spirit, and the end of every refinement.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "domain_cases.h"
#include "support/error.h"
#include "surface/domain/domain_check.h"

namespace carreau {
namespace {

using test::arc;
using test::CurvedDomain;
using test::pi;
using test::segment;

template <typename Find>
int refine(CurvedDomain& domain, const Find& find, int most = 60) {
  for (int i = 0; i < most && domain.plane.edges.size() < 20'000; ++i) {
    const std::vector<int> edges = find(domain.plane);
    if (edges.empty()) return i;
    EXPECT_TRUE(std::is_sorted(edges.begin(), edges.end()));
    EXPECT_TRUE(std::adjacent_find(edges.begin(), edges.end()) == edges.end());
    for (const int e : edges) domain.split(e);
  }
  ADD_FAILURE() << "the refinement does not end: " << domain.plane.edges.size() << " edges";
  return most;
}

double uv_length(const PlaneDomain& domain, const PlaneEdge& e) {
  return norm(domain.vertices[e.b] - domain.vertices[e.a]);
}

double distance(Vec2 a, Vec2 b, Vec2 p) {
  const double w = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
  return norm(p - lerp(a, b, w));
}

double shortest(const PlaneDomain& domain) {
  double least = 1e300;
  for (const PlaneEdge& e : domain.edges) least = std::min(least, uv_length(domain, e));
  return least;
}

/// A square plate (corners +-2) with a tongue: a channel of the given width between two half squares, closed on the
/// right.
CurvedDomain channel(double width, double h) {
  const std::vector<Vec2> corners{{-2, -2},        {2, -2},        {2, -width / 2}, {-1, -width / 2},
                                  {-1, width / 2}, {2, width / 2}, {2, 2},          {-2, 2}};
  // The outside is the channel's left wing: a C-shaped domain would be open; here the C itself is the domain.
  CurvedDomain domain;
  for (const Vec2& p : corners) domain.add_vertex(p);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t j = (i + 1) % corners.size();
    const int n = std::max(1, static_cast<int>(std::lround(norm(corners[j] - corners[i]) / h)));
    domain.add_curve(segment(corners[i], corners[j]), n, static_cast<int>(i), static_cast<int>(j));
  }
  return domain;
}

/// Two squares joined by a bridge of the given width: its long sides are close, with the domain between them.
CurvedDomain bridge(double width, double h) {
  const double w = width / 2;
  const std::vector<Vec2> corners{{-3, -1}, {-1, -1}, {-1, -w}, {1, -w}, {1, -1}, {3, -1},
                                  {3, 1},   {1, 1},   {1, w},   {-1, w}, {-1, 1}, {-3, 1}};
  CurvedDomain domain;
  for (const Vec2& p : corners) domain.add_vertex(p);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t j = (i + 1) % corners.size();
    const int n = std::max(1, static_cast<int>(std::lround(norm(corners[j] - corners[i]) / h)));
    domain.add_curve(segment(corners[i], corners[j]), n, static_cast<int>(i), static_cast<int>(j));
  }
  return domain;
}

TEST(Crossings, AreRemovedByRefinement) {
  // HDR fig. 3.2: a ring between circles of radius 1 and 0.95 cut into 7 and 5 edges: the polygons cross.
  CurvedDomain ring;
  const int outer = ring.add_vertex({1, 0});
  ring.add_curve(arc({0, 0}, 1, 0, 2 * pi), 7, outer, outer);
  const int inner = ring.add_vertex({0.95 * std::cos(0.3), 0.95 * std::sin(0.3)});
  ring.add_curve(arc({0, 0}, 0.95, 0.3, 0.3 + 2 * pi), 5, inner, inner);
  ASSERT_FALSE(find_crossings(ring.plane).empty());
  refine(ring, edges_to_split_for_crossings);
  EXPECT_TRUE(find_crossings(ring.plane).empty());
  // Without a crossing the inner polygon is inside the outer one: chords of the outer circle need cos(pi / n) > 0.95
  // only where inner vertices are near; 20 edges always suffice (cos(pi / 20) = 0.988), halving may double that.
  EXPECT_LE(ring.plane.edges.size(), 7U * 4 + 5U * 2);
  ASSERT_TRUE(orient_loops(ring.plane, 0, true));
  EXPECT_TRUE(find_loop_defects(ring.plane).empty());
  EXPECT_GT(test::signed_area(ring.plane), 0);
}

TEST(Crossings, SplitBothEdgesThatJoinTheSameVertices) {
  // A lens of two arcs, one edge each.
  CurvedDomain lens;
  const int left = lens.add_vertex({-1, 0}), right = lens.add_vertex({1, 0});
  lens.add_curve(arc({0, 1}, std::sqrt(2), -3 * pi / 4, -pi / 4), 1, left, right);
  lens.add_curve(arc({0, -1}, std::sqrt(2), pi / 4, 3 * pi / 4), 1, right, left);
  EXPECT_EQ(edges_to_split_for_crossings(lens.plane), (std::vector<int>{0, 1}));
  lens.plane.edges[1].kind = PlaneEdgeKind::degenerate;
  EXPECT_EQ(edges_to_split_for_crossings(lens.plane), (std::vector<int>{0}));
  lens.plane.edges[1].kind = PlaneEdgeKind::boundary;
  EXPECT_EQ(refine(lens, edges_to_split_for_crossings), 1);
  EXPECT_TRUE(orient_loops(lens.plane, 0, true));
}

TEST(Closeness, RefinesANarrowZoneAndNothingElse) {
  // HDR fig. 3.3: no band holds a vertex afterwards; edges of the wings keep their length.
  for (const double width : {0.1, 0.05, 0.01}) {
    CurvedDomain domain = bridge(width, 0.5);
    const double coef = 0.25;
    const ControlSpace metric = ControlSpace::constant({4, 0, 4});  // size 0.5
    ASSERT_FALSE(edges_to_split_for_closeness(domain.plane, metric, coef).empty());
    refine(domain, [&](const PlaneDomain& d) { return edges_to_split_for_closeness(d, metric, coef); });
    for (const PlaneEdge& e : domain.plane.edges) {
      const Vec2 a = domain.plane.vertices[e.a], b = domain.plane.vertices[e.b], m = lerp(a, b, 0.5);
      const double length = norm(b - a);
      if (std::abs(m.x()) < 1 && std::abs(m.y()) < 0.75 * width) {
        EXPECT_LT(length, width / coef * 1.0001) << m.x();
        EXPECT_GT(length, 0.49 * width) << "much shorter than needed at " << m.x();
      }
      if (std::abs(m.x()) > 2.2) {
        EXPECT_DOUBLE_EQ(length, 0.5) << m.x() << ' ' << m.y();
      }
      for (int v = 0; v < static_cast<int>(domain.plane.vertices.size()); ++v) {
        const Vec2 p = domain.plane.vertices[v];
        if (v == e.a || v == e.b || cross(b - a, p - a) < 0) continue;
        EXPECT_GT(distance(a, b, p), coef * length) << m.x() << ' ' << m.y();
      }
    }
  }
}

TEST(Closeness, LooksAtTheSideOfTheDomainOnly) {
  // A slit of the same width that is no part of the domain needs nothing: the mesh is on the other sides.
  const ControlSpace metric = ControlSpace::constant({4, 0, 4});
  const CurvedDomain slit = channel(0.05, 0.5);
  EXPECT_LT(0, test::signed_area(slit.plane));
  for (const int e : edges_to_split_for_closeness(slit.plane, metric, 0.25)) {
    // Only beside the short bottom of the slit, 0.05 long between edges of 0.5.
    const PlaneEdge& edge = slit.plane.edges[e];
    EXPECT_LT(std::abs(slit.plane.vertices[edge.a].y()), 0.6);
    EXPECT_LT(std::min(slit.plane.vertices[edge.a].x(), slit.plane.vertices[edge.b].x()), -0.9);
  }
  // An internal edge has the domain on both sides.
  CurvedDomain square;
  for (const Vec2& p : {Vec2{0, 0}, {4, 0}, {4, 4}, {0, 4}}) square.add_vertex(p);
  for (int i = 0; i < 4; ++i)
    square.add_curve(segment(square.plane.vertices[i], square.plane.vertices[(i + 1) % 4]), 4, i, (i + 1) % 4);
  square.add_curve(segment({1, 2}, {3, 2}), 2, -1, -1, PlaneEdgeKind::internal);
  EXPECT_TRUE(edges_to_split_for_closeness(square.plane, metric, 0.25).empty());
  square.add_vertex({1.5, 2.1});
  EXPECT_EQ(edges_to_split_for_closeness(square.plane, metric, 0.25), (std::vector<int>{16}));
  square.plane.vertices.back() = {1.5, 1.9};
  EXPECT_EQ(edges_to_split_for_closeness(square.plane, metric, 0.25), (std::vector<int>{16}));
  square.plane.vertices.back() = {1.5, 1.7};
  EXPECT_TRUE(edges_to_split_for_closeness(square.plane, metric, 0.25).empty());
}

// A zone `width` sizes wide, cut by a coefficient: edges are a half to all of width / coef down to .004, then keep the
// length of .004 / coef until they are fifty times as long as wide; not for coefficients of .1 and more. Below .0004
// none is cut.
TEST(Closeness, KeepsTheLengthOfEdgesInThinZones) {
  for (const double coef : {0.065, 0.25}) {
    const double h = 0.5;
    double before = h;
    for (const double width : {0.02, 0.006, 0.003, 0.0015, 0.0008, 0.0005}) {
      CurvedDomain domain = bridge(width * h, h);
      const ControlSpace metric = ControlSpace::constant({1 / (h * h), 0, 1 / (h * h)});
      refine(domain, [&](const PlaneDomain& d) { return edges_to_split_for_closeness(d, metric, coef); });
      const double allowed =
          (coef < 0.1 ? std::max(width / coef, std::min(0.004 / coef, width / 0.02)) : width / coef) * h;
      double longest = 0;
      for (const PlaneEdge& e : domain.plane.edges) {
        const Vec2 m = lerp(domain.plane.vertices[e.a], domain.plane.vertices[e.b], 0.5);
        if (std::abs(m.x()) < 0.9 && std::abs(m.y()) < width * h) longest = std::max(longest, uv_length(domain.plane, e));
      }
      EXPECT_LE(longest, std::min(h, allowed * 1.0001)) << coef << ' ' << width;
      EXPECT_GT(longest, 0.4999 * std::min(h, allowed)) << coef << ' ' << width;
      EXPECT_LE(longest, before * 1.0001);
      before = longest;
    }
    const CurvedDomain domain = bridge(0.0003 * h, h);
    EXPECT_TRUE(edges_to_split_for_closeness(domain.plane, ControlSpace::constant({4, 0, 4}), coef).empty());
  }
}

TEST(Closeness, IsMeasuredInTheMetric) {
  // An affine map of the domain with the metric carried along changes nothing.
  const double a = 3, b = -1.7, c = 0.4, d = 0.9;
  const double det = a * d - b * c;
  const Vec2 row0{d / det, -b / det}, row1{-c / det, a / det};  // rows of the inverse
  const ControlSpace metric = ControlSpace::constant({4, 0, 4});
  const ControlSpace carried =
      ControlSpace::constant({4 * (row0.x() * row0.x() + row1.x() * row1.x()), 4 * (row0.x() * row0.y() + row1.x() * row1.y()),
                              4 * (row0.y() * row0.y() + row1.y() * row1.y())});
  for (const double width : {0.3, 0.11, 0.02})
    for (const double coef : {0.15, 0.25, 0.7}) {
      const CurvedDomain domain = bridge(width, 0.5);
      PlaneDomain mapped = domain.plane;
      for (Vec2& p : mapped.vertices) p = {a * p.x() + b * p.y(), c * p.x() + d * p.y()};
      EXPECT_EQ(edges_to_split_for_closeness(domain.plane, metric, coef),
                edges_to_split_for_closeness(mapped, carried, coef))
          << width << ' ' << coef;
    }
}

TEST(Closeness, EndsAtAcuteCorners) {
  const ControlSpace metric = ControlSpace::constant({100, 0, 100});
  for (const double degrees : {60.0, 30.0, 10.0, 3.0, 1.0, 0.1, 0.001})
    for (const double coef : {0.1, 0.25, 0.5, 1.0, 10.0}) {
      const double angle = degrees * pi / 180;
      CurvedDomain wedge;
      const Vec2 tip{std::cos(angle), std::sin(angle)};
      wedge.add_vertex({0, 0});
      wedge.add_vertex({1, 0});
      wedge.add_vertex(tip);
      wedge.add_curve(segment({0, 0}, {1, 0}), 10, 0, 1);
      wedge.add_curve(segment({1, 0}, tip), std::max(1, static_cast<int>(10 * angle)), 1, 2);
      wedge.add_curve(segment(tip, {0, 0}), 10, 2, 0);
      const double before = shortest(wedge.plane);
      refine(wedge, [&](const PlaneDomain& d) { return edges_to_split_for_closeness(d, metric, coef); });
      // Edges grade from the short side opposite to the tip: twice ten edges and some for each halving.
      EXPECT_LT(wedge.plane.edges.size(), 20U + 8 * static_cast<unsigned>(4 + std::log2(1 / before))) << degrees;
      EXPECT_GT(shortest(wedge.plane), 0.4 * std::min(before, 0.1)) << degrees << ' ' << coef;
    }
}

TEST(Closeness, EndsAtACusp) {
  // Between two circles that touch: the angle is zero, the arcs part as the square of the distance.
  for (const double coef : {0.25, 1.0}) {
    CurvedDomain horn;
    const int cusp = horn.add_vertex({0, 0});
    const double end = 0.8;
    const auto lower = arc({0, 1}, 1, -pi / 2, -pi / 2 + end), upper = arc({0, 0.5}, 0.5, -pi / 2, -pi / 2 + 2 * end);
    const int a = horn.add_curve(lower, 8, cusp, -1);
    const int b = horn.add_vertex(upper(1));
    horn.add_curve(segment(lower(1), upper(1)), 1, a, b);
    horn.add_curve([&](double t) { return upper(1 - t); }, 8, b, cusp);
    ASSERT_TRUE(find_crossings(horn.plane).empty());
    const ControlSpace metric = ControlSpace::constant({100, 0, 100});
    refine(horn, [&](const PlaneDomain& d) { return edges_to_split_for_closeness(d, metric, coef); });
    EXPECT_LT(horn.plane.edges.size(), 200U);
  }
}

TEST(Closeness, EndsAtAPole) {
  // A sector of a cone, u: angle, v: distance from the apex: the side v = 0 is one point. Metric (v k)^2 du^2 + dv^2
  // over h^2, sampled; the two meridians meet at the apex under the angle k although they are parallel in (u, v).
  for (const double k : {1.0, 0.3, 0.1, 0.02}) {
    CurvedDomain cone;
    for (const Vec2& p : {Vec2{0, 0}, {1, 0}, {1, 1}, {0, 1}}) cone.add_vertex(p);
    cone.add_curve(segment({0, 0}, {1, 0}), 1, 0, 1, PlaneEdgeKind::degenerate);
    cone.add_curve(segment({1, 0}, {1, 1}), 10, 1, 2);
    cone.add_curve(segment({1, 1}, {0, 1}), std::max(1, static_cast<int>(10 * k)), 2, 3);
    cone.add_curve(segment({0, 1}, {0, 0}), 10, 3, 0);
    SampledDomain sampled{cone.plane.vertices, {}};
    for (const PlaneEdge& e : cone.plane.edges) sampled.edges.emplace_back(e.a, e.b);
    Monitor monitor;
    const ControlSpace metric = ControlSpace::build(
        sampled,
        [&](std::span<const Vec2> uv, std::span<Metric2> m) {
          for (std::size_t i = 0; i < uv.size(); ++i) {
            const double r = std::max(uv[i].y(), 1e-4) * k;
            m[i] = {100 * r * r, 0, 100};
          }
        },
        {}, monitor);
    refine(cone, [&](const PlaneDomain& d) { return edges_to_split_for_closeness(d, metric, 0.25); });
    EXPECT_EQ(cone.plane.edges[0].kind, PlaneEdgeKind::degenerate);
    EXPECT_LT(cone.plane.edges.size(), 80U) << k;
    EXPECT_GT(shortest(cone.plane), 1e-3) << k;
  }
}

TEST(Closeness, RefinesBeyondTheTipOfANeedle) {
  // Parallel walls 0.02 apart closed by a tip of 20 degrees: the corner excuses the tip, not the walls.
  const double w = 0.01, tip = w / std::tan(10 * pi / 180);
  const std::vector<Vec2> corners{{0, 0}, {tip, -w}, {3, -w}, {3, w}, {tip, w}};
  CurvedDomain needle;
  for (const Vec2& p : corners) needle.add_vertex(p);
  const int n[] = {1, 30, 1, 30, 1};
  for (int i = 0; i < 5; ++i) needle.add_curve(segment(corners[i], corners[(i + 1) % 5]), n[i], i, (i + 1) % 5);
  const ControlSpace metric = ControlSpace::constant({100, 0, 100});
  refine(needle, [&](const PlaneDomain& d) { return edges_to_split_for_closeness(d, metric, 0.25); });
  for (const PlaneEdge& e : needle.plane.edges)
    if (needle.plane.vertices[e.a].x() > 6 * tip) {
      EXPECT_LT(uv_length(needle.plane, e), 0.0801);
    }
  EXPECT_GT(shortest(needle.plane), 0.009);
}

TEST(Closeness, CoefficientZeroHasNoEffect) {
  const CurvedDomain domain = bridge(0.01, 0.5);
  const ControlSpace metric = ControlSpace::constant({4, 0, 4});
  EXPECT_TRUE(edges_to_split_for_closeness(domain.plane, metric, 0).empty());
  EXPECT_TRUE(edges_to_split_for_closeness(domain.plane, metric, -1).empty());
  EXPECT_TRUE(edges_to_split_for_closeness(domain.plane, metric, std::nan("")).empty());
}

/// Ratio of the lengths of the two boundary edges at each vertex, the largest.
double worst_ratio(const PlaneDomain& domain) {
  std::map<int, std::vector<double>> at;
  for (const PlaneEdge& e : domain.edges)
    for (const int v : {e.a, e.b}) at[v].push_back(uv_length(domain, e));
  double worst = 1;
  for (const auto& [v, lengths] : at)
    if (lengths.size() == 2) worst = std::max({worst, lengths[0] / lengths[1], lengths[1] / lengths[0]});
  return worst;
}

TEST(Balance, FollowsClosenessAsInFigure34) {
  // Edges short enough for the bridge, but 0.5 long elsewhere, and 1/64 at one corner.
  CurvedDomain domain = bridge(0.02, 0.5);
  const ControlSpace metric = ControlSpace::constant({4, 0, 4});
  refine(domain, [&](const PlaneDomain& d) { return edges_to_split_for_closeness(d, metric, 0.25); });
  for (int i = 0; i < 5; ++i) domain.split(0);
  ASSERT_DOUBLE_EQ(uv_length(domain.plane, domain.plane.edges[0]), 1.0 / 64);
  const double least = shortest(domain.plane);
  EXPECT_GE(worst_ratio(domain.plane), 32);
  for (const double ratio : {3.0, 2.0}) {
    refine(domain, [&](const PlaneDomain& d) { return edges_to_split_for_balance(d, metric, ratio); });
    EXPECT_LT(worst_ratio(domain.plane), ratio * 1.000001);
    EXPECT_DOUBLE_EQ(shortest(domain.plane), least) << "halving an edge longer than two of its neighbour";
  }
}

TEST(Balance, ComparesEdgesOfOneCurveOrLoopInTheMetric) {
  CurvedDomain domain;
  for (const Vec2& p : {Vec2{0, 0}, {4, 0}, {4, 4}, {0, 4}}) domain.add_vertex(p);
  for (int i = 0; i < 4; ++i)
    domain.add_curve(segment(domain.plane.vertices[i], domain.plane.vertices[(i + 1) % 4]), 1, i, (i + 1) % 4);
  const ControlSpace unit = ControlSpace::constant({1, 0, 1}), stretched = ControlSpace::constant({1, 0, 16});
  EXPECT_TRUE(edges_to_split_for_balance(domain.plane, unit).empty());
  EXPECT_EQ(edges_to_split_for_balance(domain.plane, stretched), (std::vector<int>{1, 3}));
  EXPECT_TRUE(edges_to_split_for_balance(domain.plane, stretched, 4).empty()) << "exactly four times is allowed";
  // A short internal curve that ends at a corner does not concern the boundary, nor the boundary it.
  domain.add_curve(segment({0, 0}, {0.5, 0.5}), 1, 0, -1, PlaneEdgeKind::internal);
  EXPECT_TRUE(edges_to_split_for_balance(domain.plane, unit).empty());
  domain.add_curve(segment({0.5, 0.5}, {2.5, 0.5}), 1, 4, -1, PlaneEdgeKind::internal);
  EXPECT_EQ(edges_to_split_for_balance(domain.plane, unit), (std::vector<int>{5}));
  // A side without length in space is neither split nor compared with.
  domain.plane.edges[0].kind = PlaneEdgeKind::degenerate;
  EXPECT_EQ(edges_to_split_for_balance(domain.plane, stretched), (std::vector<int>{1, 3}));
  EXPECT_THROW(edges_to_split_for_balance(domain.plane, unit, 1.9), InvalidArgument);
  EXPECT_THROW(edges_to_split_for_balance(domain.plane, unit, std::nan("")), InvalidArgument);
}

TEST(Balance, DoublesOverTwoEdgesAtMost) {
  // Sides of lengths 1, 2, 4, 4 and a last one that closes the loop: exactly geometric.
  CurvedDomain domain;
  for (const Vec2& p : {Vec2{0, 0}, {1, 0}, {1, 2}, {-3, 2}, {-3, -2}, {0, -2}}) domain.add_vertex(p);
  for (int i = 0; i < 6; ++i)
    domain.add_curve(segment(domain.plane.vertices[i], domain.plane.vertices[(i + 1) % 6]), 1, i, (i + 1) % 6);
  const std::vector<double> lengths{1, 2, 4, 4, 3, 2};
  EXPECT_TRUE(edges_to_split_for_balance(domain.plane, lengths, 2, 1).empty());
  EXPECT_EQ(edges_to_split_for_balance(domain.plane, lengths, 2, 2), (std::vector<int>{2, 4}));
  EXPECT_TRUE(edges_to_split_for_balance(domain.plane, lengths, 4, 2).empty());
}

}  // namespace
}  // namespace carreau
