// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/crossings/intersections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "common/thread_team.h"
#include "mesh/crossings/changed_triangles.h"
#include "mesh/crossings/shared_search.h"

namespace carreau {
namespace {

using Integer = __int128;
using Indices = std::array<std::int32_t, 3>;
using Pairs = std::set<std::pair<int, int>>;

/// A rational point (x, y, z) / w, w > 0, in lowest terms.
struct Exact {
  std::array<Integer, 4> n{};
};

Integer gcd(Integer a, Integer b) {
  if (a < 0) a = -a;
  if (b < 0) b = -b;
  while (b != 0) a %= b, std::swap(a, b);
  return a;
}
Exact reduced(Exact p) {
  Integer divisor = 0;
  for (const Integer x : p.n) divisor = gcd(divisor, x);
  if (p.n[3] < 0) divisor = -divisor;
  for (Integer& x : p.n) x /= divisor;
  return p;
}
Exact exact(const Vec3& p) { return {{Integer(p.x()), Integer(p.y()), Integer(p.z()), 1}}; }

using Plane = std::array<Integer, 4>;  // n.x + d >= 0
using Triple = std::array<Integer, 3>;
Triple minus(const Exact& a, const Exact& b) { return {a.n[0] - b.n[0], a.n[1] - b.n[1], a.n[2] - b.n[2]}; }
Triple cross(const Triple& a, const Triple& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Plane through(const Exact& p, const Triple& n) {
  return {n[0], n[1], n[2], -(n[0] * p.n[0] + n[1] * p.n[1] + n[2] * p.n[2])};
}
Integer value(const Plane& plane, const Exact& p) {
  return plane[0] * p.n[0] + plane[1] * p.n[1] + plane[2] * p.n[2] + plane[3] * p.n[3];
}

/// The part of a convex polygon (which may be a segment, a point or nothing) in a half space.
std::vector<Exact> clipped(const std::vector<Exact>& polygon, const Plane& plane) {
  std::vector<Exact> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Exact &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    // Values times positive w: this keeps the signs of the places.
    const Integer at_p = value(plane, p), at_q = value(plane, q);
    if (at_p >= 0) kept.push_back(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
      Exact crossing;
      for (int x = 0; x < 4; ++x) crossing.n[x] = p.n[x] * at_q - q.n[x] * at_p;
      kept.push_back(reduced(crossing));
    }
  }
  return kept;
}

bool equal(const Exact& p, const Exact& q) { return p.n == q.n; }

/// The definition: corners of the common part, of which one lies outside of the span of the common corners.
bool cross_by_definition(const std::array<Vec3, 3>& s, const std::array<Vec3, 3>& t) {
  std::array<Exact, 3> corner;
  for (int i = 0; i < 3; ++i) corner[i] = exact(t[i]);
  const Triple n = cross(minus(corner[1], corner[0]), minus(corner[2], corner[0]));
  std::vector<Exact> part{exact(s[0]), exact(s[1]), exact(s[2])};
  part = clipped(part, through(corner[0], n));
  part = clipped(part, through(corner[0], {-n[0], -n[1], -n[2]}));
  for (int i = 0; i < 3; ++i) part = clipped(part, through(corner[i], cross(n, minus(corner[(i + 1) % 3], corner[i]))));
  std::vector<Exact> shared;
  for (const Vec3& p : s)
    for (const Vec3& q : t)
      if (p == q) shared.push_back(exact(p));
  if (shared.size() == 3) return true;
  if (shared.size() < 2)
    return std::any_of(part.begin(), part.end(),
                       [&](const Exact& p) { return shared.empty() || !equal(p, shared[0]); });
  // All are in both triangles, whose common line is the line of their common edge.
  const Triple along = minus(shared[1], shared[0]);
  return std::any_of(part.begin(), part.end(), [&](const Exact& p) {
    const Triple to{p.n[0] - shared[0].n[0] * p.n[3], p.n[1] - shared[0].n[1] * p.n[3],
                    p.n[2] - shared[0].n[2] * p.n[3]};
    return cross(along, to) != Triple{0, 0, 0};
  });
}

std::array<Vec3, 3> corners(const std::vector<Vec3>& vertices, const Indices& t) {
  return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
}

bool has_area(const std::array<Vec3, 3>& t) {
  const Triple n = cross(minus(exact(t[1]), exact(t[0])), minus(exact(t[2]), exact(t[0])));
  return n != Triple{0, 0, 0};
}

Pairs found_in(const std::vector<Vec3>& vertices, const std::vector<Indices>& triangles, int threads = 1) {
  Monitor monitor;
  const Intersections found =
      find_intersections(vertices, triangles, {.limit = 1'000'000, .threads = threads}, monitor);
  Pairs pairs;
  for (const TriangleIntersection& each : found.pairs) pairs.emplace(each.triangles[0], each.triangles[1]);
  EXPECT_EQ(found.count, static_cast<std::int64_t>(found.pairs.size()));
  EXPECT_EQ(pairs.size(), found.pairs.size());
  return pairs;
}

/// Integer places in a small box: corners on edges, edges on edges, triangles in one plane and double points abound.
TEST(Intersections, MatchTheDefinitionOnRandomMeshes) {
  std::mt19937 random(11);
  std::array<int, 2> seen{};
  for (int round = 0; round < 300; ++round) {
    const int width = 2 + round % 6, count = 6 + round % 20;
    std::uniform_int_distribution<int> place(0, width), index(0, count - 1);
    std::vector<Vec3> vertices(static_cast<std::size_t>(count));
    for (Vec3& p : vertices) {
      const double x = place(random), y = place(random), z = round % 4 == 0 ? 0 : place(random);
      p = {x, y, z};
    }
    std::vector<Indices> triangles(20);
    for (Indices& t : triangles) t = {index(random), index(random), index(random)};
    Pairs expected;
    for (int i = 0; i < 20; ++i)
      for (int j = i + 1; j < 20; ++j) {
        const auto s = corners(vertices, triangles[i]), t = corners(vertices, triangles[j]);
        if (!has_area(s) || !has_area(t)) continue;
        const bool crosses = cross_by_definition(s, t);
        ++seen[crosses ? 1 : 0];
        if (crosses) expected.emplace(i, j);
        ASSERT_EQ(triangles_intersect(s, t, nullptr), crosses) << "round " << round << ": " << i << ", " << j;
        ASSERT_EQ(triangles_intersect(t, s, nullptr), crosses) << "round " << round << ": " << j << ", " << i;
      }
    ASSERT_EQ(found_in(vertices, triangles), expected) << "round " << round;
  }
  EXPECT_GT(seen[0], 3000);
  EXPECT_GT(seen[1], 3000);
}

/// A grid of (n + 1)^2 points z = f(x, y) over the unit square.
template <typename Height>
void add_sheet(int n, Height&& height, std::vector<Vec3>& vertices, std::vector<Indices>& triangles) {
  const auto first = static_cast<std::int32_t>(vertices.size());
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
      vertices.push_back({x, y, height(x, y)});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const std::int32_t a = first + j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
}

TEST(Intersections, AreNoneInASheetOrBetweenSheetsThatTouchAtVertices) {
  std::vector<Vec3> vertices;
  std::vector<Indices> triangles;
  const auto wave = [](double x, double y) { return 0.1 * std::sin(7 * x) * std::cos(5 * y); };
  add_sheet(40, wave, vertices, triangles);
  EXPECT_TRUE(found_in(vertices, triangles).empty());
  // A slanting plane, whose coordinates are rounded.
  vertices.clear(), triangles.clear();
  add_sheet(
      40, [](double x, double y) { return x / 3 + y / 7; }, vertices, triangles);
  EXPECT_TRUE(found_in(vertices, triangles).empty());
  // Beside it a triangle with separate vertices at the same places.
  const auto n = static_cast<std::int32_t>(vertices.size());
  const std::vector<Vec3> copy = vertices;
  for (const Vec3& p : copy)
    vertices.push_back({p.x() == 0 ? 0 : -p.x(), p.y(), p.x() == 0 ? p.z() : p.z() - 2 * p.x() / 3});
  const std::vector<Indices> ours = triangles;
  for (const auto& [a, b, c] : ours) triangles.push_back({n + a, n + c, n + b});
  EXPECT_TRUE(found_in(vertices, triangles).empty());
}

TEST(Intersections, TwoSheetsMeetAlongTheirCommonLineForAnyNumberOfThreads) {
  std::vector<Vec3> vertices;
  std::vector<Indices> triangles;
  constexpr int n = 30;
  add_sheet(
      n, [](double, double) { return 0.0; }, vertices, triangles);
  add_sheet(
      n, [](double x, double) { return x - 0.51; }, vertices, triangles);
  Monitor monitor;
  const Intersections one = find_intersections(vertices, triangles, {.limit = 1000, .threads = 1}, monitor);
  const Intersections four = find_intersections(vertices, triangles, {.limit = 1000, .threads = 4}, monitor);
  // The line x = .51 runs through one column of cells of each sheet, and both have the same y lines.
  EXPECT_GE(one.count, 2 * n);
  EXPECT_LE(one.count, 12 * n);
  ASSERT_EQ(one.count, four.count);
  ASSERT_EQ(static_cast<std::int64_t>(one.pairs.size()), one.count);
  for (std::size_t k = 0; k < one.pairs.size(); ++k) {
    EXPECT_EQ(one.pairs[k].triangles, four.pairs[k].triangles);
    EXPECT_EQ(one.pairs[k].place, four.pairs[k].place);
    EXPECT_LT(one.pairs[k].triangles[0], 2 * n * n);
    EXPECT_GE(one.pairs[k].triangles[1], 2 * n * n);
    EXPECT_NEAR(one.pairs[k].place.x(), 0.51, 1e-12);
    EXPECT_NEAR(one.pairs[k].place.z(), 0, 1e-12);
  }
  const Intersections few = find_intersections(vertices, triangles, {.limit = 7, .threads = 3}, monitor);
  EXPECT_EQ(few.count, one.count);
  ASSERT_EQ(few.pairs.size(), 7u);
  for (std::size_t k = 0; k < 7; ++k) EXPECT_EQ(few.pairs[k].triangles, one.pairs[k].triangles);
}

TEST(Intersections, AreFoundByManyProcessesAsByOne) {
  std::vector<Vec3> vertices;
  std::vector<Indices> triangles;
  constexpr int n = 60;
  for (const double where : {0.0, 0.3, 0.51})
    add_sheet(
        n, [where](double x, double) { return x - where; }, vertices, triangles);
  add_sheet(
      n, [](double, double) { return 0.0; }, vertices, triangles);
  for (const std::size_t limit : {std::size_t{7}, std::size_t{100'000}}) {
    Monitor monitor;
    const Intersections one = find_intersections(vertices, triangles, {.limit = limit, .threads = 1}, monitor);
    EXPECT_GE(one.count, 2 * n);
    const auto thrown = testing::in_processes(3, [&](Team& team) {
      Monitor own;
      const Intersections ours = find_intersections(vertices, triangles, limit, Executor{&team, 2}, own);
      EXPECT_EQ(ours.count, one.count);
      ASSERT_EQ(ours.pairs.size(), one.pairs.size());
      for (std::size_t k = 0; k < one.pairs.size(); ++k) {
        EXPECT_EQ(ours.pairs[k].triangles, one.pairs[k].triangles);
        EXPECT_EQ(ours.pairs[k].place, one.pairs[k].place);
      }
    });
    for (const std::string& sentence : thrown) EXPECT_EQ(sentence, "");
  }
}

/// After some vertices have moved, triangles have gone, come and been doubled, and all have other numbers.
TEST(Intersections, AreFoundInAChangedMeshFromPreviousOnes) {
  std::mt19937 random(5);
  const auto upto = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  std::int64_t all = 0, kept = 0;
  for (int run = 0; run < 40; ++run) {
    std::vector<Vec3> vertices;
    std::vector<Indices> triangles;
    add_sheet(
        12, [](double, double) { return 0.0; }, vertices, triangles);
    if (run % 2 == 0)
      add_sheet(
          12, [](double x, double) { return x - 0.51; }, vertices, triangles);
    Monitor monitor;
    const Intersections before = find_intersections(vertices, triangles, {}, monitor);
    std::vector<Vec3> now = vertices;
    std::vector<Indices> left = triangles;
    for (int k = 0; k < run; ++k) now[upto(now.size())] += Vec3{0, 0, 0.3 * static_cast<double>(upto(3)) - 0.3};
    for (int k = 0; k < 3; ++k) left.erase(left.begin() + static_cast<std::ptrdiff_t>(upto(left.size())));
    left.push_back({0, static_cast<std::int32_t>(upto(now.size() - 1)) + 1, static_cast<std::int32_t>(now.size()) - 1});
    if (run % 3 == 0) left.push_back(left[upto(left.size())]);
    std::shuffle(left.begin(), left.end(), random);
    for (Indices& t : left) std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(upto(3)), t.end());
    const Intersections whole = find_intersections(now, left, {}, monitor);
    const Intersections found = find_intersections_again({vertices, triangles, before.pairs}, now, left, IntersectionOptions{}.limit,
                                                         Executor{nullptr, 1 + run % 3}, monitor);
    ASSERT_EQ(found.count, whole.count) << run;
    ASSERT_EQ(found.pairs.size(), whole.pairs.size());
    for (std::size_t k = 0; k < whole.pairs.size(); ++k) {
      EXPECT_EQ(found.pairs[k].triangles, whole.pairs[k].triangles);
      EXPECT_EQ(found.pairs[k].place, whole.pairs[k].place);
    }
    all += whole.count, kept += before.count;
  }
  EXPECT_GT(kept, 0);
  EXPECT_GT(all, kept);
}

TEST(Intersections, PassOverTrianglesThatAreNone) {
  const double nan = std::nan("");
  const std::vector<Vec3> vertices{{0, 0, 0},   {1, 0, 0},   {0, 1, 0},  {.2, .2, -1},
                                   {.2, .2, 1}, {.3, .2, 1}, {nan, 0, 0}};
  const std::vector<Indices> triangles{{0, 1, 2}, {3, 4, 5}, {0, 0, 1}, {0, 1, 6}, {0, 1, 99}, {-1, 1, 2}, {4, 3, 4}};
  EXPECT_EQ(found_in(vertices, triangles), (Pairs{{0, 1}}));
  EXPECT_TRUE(found_in({}, {}).empty());
  Monitor monitor;
  EXPECT_EQ(find_intersections_again({{}, {}, {}}, vertices, triangles, 10, Executor{}, monitor).count, 1);
  EXPECT_EQ(find_intersections_again({vertices, triangles, {}}, vertices, triangles, 10, Executor{}, monitor).count, 0);
}

/// Twice as many triangles take about twice the time; a comparison of all pairs would take four times as long.
TEST(Intersections, TakeATimeThatGrowsAsTheTriangles) {
  const auto seconds = [](int n) {
    std::vector<Vec3> vertices;
    std::vector<Indices> triangles;
    add_sheet(
        n, [](double x, double y) { return 0.1 * std::sin(9 * x + 4 * y); }, vertices, triangles);
    double best = HUGE_VAL;
    for (int k = 0; k < 3; ++k) {
      Monitor monitor;
      const std::clock_t start = std::clock();  // of the processor: other work does not count
      EXPECT_EQ(find_intersections(vertices, triangles, {}, monitor).count, 0);
      best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return best;
  };
  // 16 times the triangles: 16 log(16 n) / log(n) = 23 times; all pairs: 256 times.
  EXPECT_LT(seconds(160) / seconds(40), 80);
}

TEST(Intersections, StopOnRequest) {
  std::vector<Vec3> vertices;
  std::vector<Indices> triangles;
  add_sheet(
      10, [](double, double) { return 0.0; }, vertices, triangles);
  Monitor monitor;
  monitor.request_stop();
  EXPECT_THROW(find_intersections(vertices, triangles, {}, monitor), Cancelled);
}

}  // namespace
}  // namespace carreau
