// SPDX-License-Identifier: BSD-3-Clause
#include "surface/domain/domain_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <set>
#include <utility>

#include "domain_cases.h"
#include "support/error.h"
#include "support/infinity.h"

namespace carreau {
namespace {

using test::add_loop;
using test::circle;
using test::pi;
using test::polygon;

using Pairs = std::set<std::pair<int, int>>;

Pairs pairs_of(const std::vector<EdgeConflict>& conflicts) {
  Pairs pairs;
  for (const EdgeConflict& c : conflicts) {
    EXPECT_LT(c.first, c.second);
    EXPECT_TRUE(pairs.emplace(c.first, c.second).second) << "twice";
  }
  return pairs;
}

// --- an independent judge for small integer coordinates

struct Lattice {
  std::int64_t x, y;
};

std::int64_t area(Lattice a, Lattice b, Lattice c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

bool holds(Lattice a, Lattice b, Lattice p) {
  return area(a, b, p) == 0 && (p.x - a.x) * (p.x - b.x) <= 0 && (p.y - a.y) * (p.y - b.y) <= 0;
}

bool properly_cross(Lattice a, Lattice b, Lattice c, Lattice d) {
  const auto opposite = [](std::int64_t s, std::int64_t t) { return (s < 0 && t > 0) || (s > 0 && t < 0); };
  return opposite(area(a, b, c), area(a, b, d)) && opposite(area(c, d, a), area(c, d, b));
}

bool conflict(const std::vector<Lattice>& v, const PlaneEdge& e, const PlaneEdge& f) {
  if (properly_cross(v[e.a], v[e.b], v[f.a], v[f.b])) return true;
  // A common point without a proper crossing is an end of one of them: more than the shared vertex?
  const auto foreign = [&](int vertex, const PlaneEdge& g) { return vertex != g.a && vertex != g.b; };
  for (const int vertex : {f.a, f.b})
    if (foreign(vertex, e) && holds(v[e.a], v[e.b], v[vertex])) return true;
  for (const int vertex : {e.a, e.b})
    if (foreign(vertex, f) && holds(v[f.a], v[f.b], v[vertex])) return true;
  return !foreign(e.a, f) && !foreign(e.b, f);
}

TEST(FindCrossings, AgreesWithIntegersOnRandomLatticeGraphs) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 600; ++trial) {
    const int size = 3 + trial % 40, n = 3 + trial % 50;
    std::vector<Lattice> lattice;
    PlaneDomain domain;
    for (int i = 0; i < n; ++i) {
      lattice.push_back({static_cast<std::int64_t>(random() % size), static_cast<std::int64_t>(random() % size)});
      domain.vertices.push_back({static_cast<double>(lattice.back().x), static_cast<double>(lattice.back().y)});
    }
    // From a few edges, often without conflict, to more than vertices.
    for (int i = 0; i < 1 + n * (trial % 7) / 6; ++i) {
      const int a = static_cast<int>(random() % n), b = static_cast<int>((a + 1 + random() % (n - 1)) % n);
      domain.edges.push_back({a, b, static_cast<PlaneEdgeKind>(random() % 3)});
    }
    Pairs expected;
    for (int i = 0; i < static_cast<int>(domain.edges.size()); ++i)
      for (int j = i + 1; j < static_cast<int>(domain.edges.size()); ++j)
        if (conflict(lattice, domain.edges[i], domain.edges[j])) expected.emplace(i, j);
    const auto one = find_a_crossing(domain);
    ASSERT_EQ(one.has_value(), !expected.empty()) << trial;
    ASSERT_TRUE(!one || expected.count({one->first, one->second}) == 1) << trial;
    if (expected.size() > 4 * domain.edges.size()) continue;
    ASSERT_EQ(pairs_of(find_crossings(domain)), expected) << trial;
    // Powers of two change nothing, to the ends of the range.
    for (const int exponent : {-1074, 1023 - 6}) {
      PlaneDomain scaled = domain;
      for (Vec2& p : scaled.vertices) p = {std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent)};
      ASSERT_EQ(pairs_of(find_crossings(scaled)), expected) << trial << " at 2^" << exponent;
    }
  }
}

TEST(FindCrossings, CountsTheCrossingsOfRegularStars) {
  // {n / k}: every edge crosses 2 (k - 1) others, n (k - 1) crossings in all, at a known distance from the centre.
  for (const auto& [n, k] : {std::pair{5, 2}, {7, 3}, {101, 5}}) {
    PlaneDomain star;
    star.vertices = circle(n, {3, 4}, 1);
    for (int i = 0; i < n; ++i) star.edges.push_back({i, (i + k) % n});
    const auto conflicts = find_crossings(star);
    EXPECT_EQ(pairs_of(conflicts).size(), static_cast<std::size_t>(n * (k - 1)));
    for (const EdgeConflict& c : conflicts) {
      // Chords whose middles are m steps apart cross at cos(pi k / n) / cos(pi m / n) from the centre.
      const int turn = std::abs(c.first - c.second);
      const double m = std::min(turn, n - turn);
      EXPECT_NEAR(norm(c.uv - Vec2{3, 4}), std::cos(pi * k / n) / std::cos(pi * m / n), 1e-12);
    }
  }
}

TEST(FindCrossings, StarShapedPolygonsHaveNone) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> radius(0.1, 10);
  for (const int n : {3, 10, 1000, 20000}) {
    std::vector<Vec2> loop = circle(n, {0, 0}, 1);
    for (Vec2& p : loop) p = radius(random) * p;
    PlaneDomain domain = polygon(loop);
    EXPECT_TRUE(find_crossings(domain).empty()) << n;
    EXPECT_FALSE(find_a_crossing(domain)) << n;
    if (n == 3) continue;
    // A vertex pulled through the centre to the far side, outside: its two edges must cross the boundary there.
    domain.vertices[n / 2] = {30, 0};
    EXPECT_TRUE(find_a_crossing(domain)) << n;
    for (const EdgeConflict& c : find_crossings(domain))
      EXPECT_TRUE(c.first == n / 2 - 1 || c.first == n / 2 || c.second == n / 2 - 1 || c.second == n / 2);
    EXPECT_FALSE(find_crossings(domain).empty()) << n;
  }
}

TEST(FindCrossings, ReportsTouchesOverlapsAndTwins) {
  // A vertex in the middle of an edge.
  PlaneDomain touch = polygon({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}});
  EXPECT_EQ(pairs_of(find_crossings(touch)), (Pairs{{0, 2}, {0, 3}}));
  EXPECT_EQ(find_crossings(touch)[0].uv, (Vec2{2, 0}));
  // Two triangles that meet at a point: fine with one vertex, a conflict with two.
  PlaneDomain joined;
  joined.vertices = {{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  joined.edges = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {3, 4}, {4, 0}};
  EXPECT_TRUE(find_crossings(joined).empty());
  PlaneDomain apart = polygon({{0, 0}, {1, 0}, {0, 1}});
  add_loop(apart, {{0, 0}, {-1, 0}, {0, -1}});
  EXPECT_EQ(pairs_of(find_crossings(apart)), (Pairs{{0, 3}, {0, 5}, {2, 3}, {2, 5}}));
  // A spike there and back, an edge imposed twice, an internal edge along the boundary.
  PlaneDomain spike = polygon({{0, 0}, {4, 0}, {6, 0}, {4, 0}, {4, 4}});
  EXPECT_TRUE(pairs_of(find_crossings(spike)).count({1, 2}));
  PlaneDomain square = polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  EXPECT_TRUE(find_crossings(square).empty());
  square.edges.push_back({1, 0, PlaneEdgeKind::internal});
  EXPECT_EQ(pairs_of(find_crossings(square)), (Pairs{{0, 4}}));
  square.edges.back() = {0, 2, PlaneEdgeKind::internal};
  EXPECT_TRUE(find_crossings(square).empty());
  square.edges.push_back({1, 3, PlaneEdgeKind::internal});
  EXPECT_EQ(pairs_of(find_crossings(square)), (Pairs{{4, 5}}));
  EXPECT_EQ(find_crossings(square)[0].uv, (Vec2{0.5, 0.5}));
}

TEST(FindCrossings, SeesTheSmallestGap) {
  // A vertex one ulp off an edge is no touch; on it, it is. No epsilon can decide this.
  const double y = 0.1, above = std::nextafter(y, 1), below = std::nextafter(y, 0);
  for (const double tip : {above, y, below}) {
    const PlaneDomain domain = polygon({{0, y}, {1, y}, {1, 1}, {0.5, tip}, {0, 1}});
    EXPECT_EQ(find_crossings(domain).empty(), tip > y) << tip;
  }
}

TEST(FindCrossings, EndsOnGarbage) {
  PlaneDomain domain;  // every edge of a complete graph on one line, many times
  for (int i = 0; i < 200; ++i) domain.vertices.push_back({static_cast<double>(i), 0});
  for (int i = 0; i < 4000; ++i) domain.edges.push_back({i % 200, (i * 7 + 1) % 200});
  std::erase_if(domain.edges, [](const PlaneEdge& e) { return e.a == e.b; });
  EXPECT_GT(find_crossings(domain).size(), 4 * domain.edges.size());
  EXPECT_TRUE(find_crossings(PlaneDomain{}).empty());
}

// --- loops

/// Gives edges random directions and a random order; returns where edge 0 went and whether it was turned.
std::pair<int, bool> shuffle_edges(PlaneDomain& domain, std::mt19937_64& random) {
  std::vector<std::size_t> order(domain.edges.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), random);
  std::vector<PlaneEdge> edges;
  std::pair<int, bool> seed;
  for (std::size_t i = 0; i < order.size(); ++i) {
    PlaneEdge e = domain.edges[order[i]];
    const bool turned = random() % 2 != 0;
    if (turned) std::swap(e.a, e.b);
    if (order[i] == 0) seed = {static_cast<int>(i), turned};
    edges.push_back(e);
  }
  domain.edges = edges;
  return seed;
}

TEST(OrientLoops, TurnsHolesAndIslandsWhateverTheInput) {
  // HDR fig. 3.1, first and second: a disc, and with four holes; then islands in holes, and a second component.
  std::mt19937_64 random(3);
  PlaneDomain domain = polygon(circle(60, {0, 0}, 10));
  const auto regular_area = [](int n, double r) { return 0.5 * n * r * r * std::sin(2 * pi / n); };
  double area = regular_area(60, 10);
  const auto check = [&](PlaneDomain d) {
    for (int trial = 0; trial < 10; ++trial) {
      const auto [seed, turned] = shuffle_edges(d, random);
      const PlaneDomain before = d;
      ASSERT_FALSE(orient_loops(d, seed, turned)) << "the domain would be the outside";
      for (std::size_t e = 0; e < d.edges.size(); ++e) ASSERT_EQ(d.edges[e].a, before.edges[e].a);
      ASSERT_TRUE(orient_loops(d, seed, !turned));
      ASSERT_NEAR(test::signed_area(d), area, 1e-10 * area);
      ASSERT_TRUE(find_loop_defects(d).empty()) << find_loop_defects(d)[0];
      ASSERT_TRUE(orient_loops(d, seed, true)) << "already turned";
      std::rotate(d.edges.begin(), d.edges.begin() + seed, d.edges.end());
    }
  };
  check(domain);
  for (int i = 0; i < 4; ++i) {
    add_loop(domain, circle(12 + i, {5 * std::cos(i * pi / 2), 5 * std::sin(i * pi / 2)}, 3), i + 1);
    area -= regular_area(12 + i, 3);
  }
  check(domain);
  add_loop(domain, circle(5, {5, 0}, 2), 5);
  add_loop(domain, circle(30, {40, 0}, 10), 6);
  area += regular_area(5, 2) + regular_area(30, 10);
  check(domain);
}

TEST(OrientLoops, TakesLoopsThatMeetAtAVertex) {
  std::mt19937_64 random(4);
  // Outside each other; one inside the other; a chain of triangles round a square, all at shared vertices.
  PlaneDomain outside;
  outside.vertices = {{0, 0}, {2, -1}, {2, 1}, {-2, 1}, {-2, -1}};
  outside.edges = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {3, 4}, {4, 0}};
  PlaneDomain inside;
  inside.vertices = {{0, 0}, {8, -4}, {8, 4}, {4, -1}, {4, 1}};
  inside.edges = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {3, 4}, {4, 0}};
  PlaneDomain ring;  // a square with the diamond of its midpoints cut out
  ring.vertices = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  for (int i = 0; i < 8; ++i) ring.edges.push_back({i, (i + 1) % 8});
  for (int i = 1; i < 8; i += 2) ring.edges.push_back({i, (i + 2) % 8});
  for (auto& [domain, area] : {std::pair{outside, 4.0}, {inside, 32.0 - 4}, {ring, 4.0 - 2}})
    for (int trial = 0; trial < 30; ++trial) {
      PlaneDomain d = domain;
      const auto [seed, turned] = shuffle_edges(d, random);
      ASSERT_TRUE(orient_loops(d, seed, !turned));
      ASSERT_DOUBLE_EQ(test::signed_area(d), area);
      ASSERT_TRUE(find_loop_defects(d).empty()) << find_loop_defects(d)[0];
    }
}

TEST(OrientLoops, RejectsInvalidDomains) {
  // HDR fig. 3.1, third: open.
  PlaneDomain open = polygon(circle(10, {0, 0}, 1));
  open.edges.pop_back();
  EXPECT_FALSE(orient_loops(open, 0, true));
  EXPECT_FALSE(orient_loops(open, 0, false));
  PlaneDomain square = polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  square.edges.push_back({0, 2, PlaneEdgeKind::internal});
  EXPECT_THROW(orient_loops(square, 4, true), DomainError);
  EXPECT_THROW(orient_loops(square, 5, true), DomainError);
  EXPECT_THROW(orient_loops(square, -1, true), DomainError);
  square.edges[2].b = 17;
  EXPECT_THROW(orient_loops(square, 0, true), InvalidArgument);
  square = polygon({{0, 0}, {1, 0}, {1, std::nan("")}, {0, 1}});
  EXPECT_THROW(orient_loops(square, 0, true), InvalidArgument);
}

TEST(OrientLoops, FollowsTheLargerPartOfABoundaryThatCrossesItself) {
  // A disc with a small reversed curl next to the seed: turned as the disc is, so that refinement can repair it.
  std::vector<Vec2> loop = circle(40, {0, 0}, 10);
  std::swap(loop[0], loop[1]);
  PlaneDomain domain = polygon(loop);
  ASSERT_FALSE(find_crossings(domain).empty());
  for (int seed = 0; seed < 40; ++seed) {
    PlaneDomain d = domain;
    EXPECT_TRUE(orient_loops(d, seed, true)) << seed;
    EXPECT_GT(test::signed_area(d), 0);
  }
}

/// One sentence, with all the words in it.
void expect_sentence(const std::vector<std::string>& sentences, const std::vector<std::string>& words) {
  ASSERT_EQ(sentences.size(), 1U) << (sentences.empty() ? "" : sentences[1]);
  for (const std::string& word : words) EXPECT_NE(sentences[0].find(word), std::string::npos) << sentences[0];
}

TEST(FindLoopDefects, DescribesDefects) {
  const PlaneDomain square = polygon({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  EXPECT_TRUE(find_loop_defects(square).empty());

  PlaneDomain d = square;
  d.edges.pop_back();
  ASSERT_EQ(find_open_loops(d).size(), 2U);
  EXPECT_NE(find_open_loops(d)[0].find("does not close"), std::string::npos);
  EXPECT_NE(find_open_loops(d)[0].find("edge 1 of curve 1"), std::string::npos);
  EXPECT_NE(find_open_loops(d)[1].find("(0, 4)"), std::string::npos);

  d = square;
  for (PlaneEdge& e : d.edges) std::swap(e.a, e.b);
  expect_sentence(find_loop_defects(d), {"wrong way", "edge 1 of curve 1"});
  EXPECT_TRUE(find_open_loops(d).empty());

  d = square;
  std::swap(d.edges[2].a, d.edges[2].b);
  expect_sentence(find_loop_defects(d, [](const PlaneEdge& e) { return "side " + std::to_string(e.segment); }),
                  {"side 2", "against"});
  expect_sentence(find_loop_defects(d), {"against", "edge 3 of curve 1", "(0, 4)"});

  d = square;
  add_loop(d, circle(8, {2, 2}, 1), 7);  // a hole turned like an outer loop
  expect_sentence(find_loop_defects(d), {"wrong way", "edge 1 of curve 8"});
  d = square;
  std::vector<Vec2> hole = circle(8, {12, 2}, 1);
  std::reverse(hole.begin(), hole.end());
  add_loop(d, hole, 7);  // a hole outside every component
  expect_sentence(find_loop_defects(d), {"wrong way", "edge 1 of curve 8"});

  d = square;
  add_loop(d, {{1, 1}, {3, 3}}, 7);
  expect_sentence(find_loop_defects(d), {"no area", "curve 8"});

  d = square;
  d.vertices.push_back(d.vertices[3]);
  d.edges.push_back({3, 4, PlaneEdgeKind::boundary, 5, 0});
  d.edges[3].a = 4;
  expect_sentence(find_open_loops(d), {"no length", "edge 1 of curve 6"});

  expect_sentence(find_loop_defects(PlaneDomain{}), {"no boundary"});
  d = square;
  d.vertices[1].x() = infinity;
  expect_sentence(find_loop_defects(d), {"vertex 1", "not finite"});
  d = square;
  d.edges[1].b = 9;
  expect_sentence(find_loop_defects(d), {"joins vertices 1 and 9 of 4"});
}

TEST(FindLoopDefects, FindsInternalCurvesAndPointsOutside) {
  PlaneDomain domain = polygon({{0, 0}, {4, 0}, {4, 4}, {2, 2}, {0, 4}});
  domain.edges.push_back({1, 3, PlaneEdgeKind::internal, 3, 0});
  domain.vertices.push_back({1, 1});
  domain.edges.push_back({3, 5, PlaneEdgeKind::internal, 3, 1});  // a free end
  domain.vertices.push_back({3.5, 2});
  EXPECT_TRUE(find_loop_defects(domain).empty()) << find_loop_defects(domain)[0];

  PlaneDomain d = domain;
  d.edges.push_back({2, 4, PlaneEdgeKind::internal, 4, 0});  // both ends on the boundary, across the notch
  expect_sentence(find_loop_defects(d), {"edge 1 of curve 5", "not inside"});
  d = domain;
  d.vertices.push_back({9, 9});
  d.vertices.push_back({10, 9});
  d.edges.push_back({7, 8, PlaneEdgeKind::internal, 4, 2});
  expect_sentence(find_loop_defects(d), {"edge 3 of curve 5", "not inside"});

  const auto with_point = [&](Vec2 p) {
    PlaneDomain with = domain;
    with.vertices.push_back(p);
    return find_loop_defects(with);
  };
  EXPECT_TRUE(with_point({0.5, 0.25}).empty());
  expect_sentence(with_point({2, 3}), {"(2, 3)", "outside"});
  expect_sentence(with_point({2, 2.0000000000000004}), {"outside"});
  expect_sentence(with_point({1, 3}), {"(1, 3)", "lies on edge 4 of curve 1"});
  expect_sentence(with_point({0, 0}), {"lies on edge 1 of curve 1"});
  expect_sentence(with_point({1.5, 1.5}), {"lies on edge 2 of curve 4"});
  expect_sentence(with_point({3, 1}), {"lies on edge 1 of curve 4"});
}

TEST(FindLoopDefects, FindsPointsImposedTwice) {
  PlaneDomain domain = polygon({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  domain.vertices.push_back({1, 1});
  EXPECT_TRUE(find_loop_defects(domain).empty());
  domain.vertices.push_back({1, 1});
  expect_sentence(find_loop_defects(domain), {"(1, 1)", "twice"});
}

TEST(DomainChecks, TakeAnyFiniteInput) {
  std::mt19937_64 random(5);
  const double scales[] = {std::numeric_limits<double>::denorm_min(), 1e-300, 1, 1e300};
  for (int trial = 0; trial < 400; ++trial) {
    const int size = 2 + trial % 6, n = 1 + trial % 20;
    PlaneDomain domain;
    for (int i = 0; i < n; ++i)
      domain.vertices.push_back({scales[trial % 4] * static_cast<double>(random() % size),
                                 scales[trial / 4 % 4] * static_cast<double>(random() % size)});
    for (int i = 0; i < 2 * n; ++i)
      domain.edges.push_back({static_cast<int>(random() % n), static_cast<int>(random() % n),
                              static_cast<PlaneEdgeKind>(random() % 3), i / 3, i % 3});
    const ControlSpace metric = ControlSpace::constant({1, 0.5, 1});
    const auto crossings = find_crossings(domain);
    for (const int e : edges_to_split_for_crossings(domain)) EXPECT_NE(domain.edges[e].kind, PlaneEdgeKind::degenerate);
    for (const int e : edges_to_split_for_closeness(domain, metric, 0.25))
      EXPECT_NE(domain.edges[e].kind, PlaneEdgeKind::degenerate);
    edges_to_split_for_balance(domain, metric);
    const auto open = find_open_loops(domain);
    const auto seed = std::find_if(domain.edges.begin(), domain.edges.end(),
                                   [](const PlaneEdge& e) { return e.kind != PlaneEdgeKind::internal; });
    if (seed == domain.edges.end()) continue;
    const int s = static_cast<int>(seed - domain.edges.begin());
    const bool turned = orient_loops(domain, s, true) || orient_loops(domain, s, false);
    EXPECT_TRUE(turned || !open.empty()) << "one of the two sides of a closed loop is the inside";
    if (turned && open.empty() && crossings.empty())
      for (const std::string& sentence : find_loop_defects(domain)) {
        EXPECT_EQ(sentence.find("wrong way"), std::string::npos) << sentence;
        EXPECT_EQ(sentence.find("against"), std::string::npos) << sentence;
      }
  }
}

}  // namespace
}  // namespace carreau
