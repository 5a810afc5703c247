// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/distance/surface_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include "common/thread_team.h"
#include "mesh/triangle_search.h"
#include "support/error.h"

namespace carreau {
namespace {

constexpr double pi = std::numbers::pi;

struct Soup {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
  [[nodiscard]] TrianglesOfSpace view() const { return {vertices, triangles}; }
  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto n = static_cast<std::int32_t>(vertices.size());
    for (const Vec3* p : {&a, &b, &c}) vertices.push_back(*p);
    triangles.push_back({n, n + 1, n + 2});
  }
};

/// [0, a] x [0, b] at a height, cut into n x m rectangles of two triangles.
Soup sheet(double a, double b, double z, int n, int m) {
  Soup soup;
  const auto at = [&](int i, int j) { return Vec3{a * i / n, b * j / m, z}; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      soup.add(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      soup.add(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return soup;
}

/// An octahedron of radius 1, each side cut into n^2 triangles whose vertices go `onto` somewhere.
Soup octahedron(int n, const std::function<Vec3(const Vec3&)>& onto) {
  Soup soup;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0}) {
        const auto at = [&](int i, int j) -> Vec3 {
          return onto(Vec3{x * i / n, y * j / n, z * (n - i - j) / n});
        };
        for (int i = 0; i < n; ++i)
          for (int j = 0; i + j < n; ++j) {
            soup.add(at(i, j), at(i + 1, j), at(i, j + 1));
            if (i + j + 1 < n) soup.add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
          }
      }
  return soup;
}
Vec3 same(const Vec3& p) { return p; }
Vec3 onto_sphere(const Vec3& p) { return p / norm(p); }

/// [-a, a]^3.
Soup box(double a) {
  Soup soup;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-a, a}) {
      const auto at = [&](double s, double t) {
        Vec3 p;
        p[axis] = side, p[(axis + 1) % 3] = s, p[(axis + 2) % 3] = t;
        return p;
      };
      soup.add(at(-a, -a), at(a, -a), at(a, a));
      soup.add(at(-a, -a), at(a, a), at(-a, a));
    }
  return soup;
}

DistanceBounds bounds(const Soup& from, const Soup& to, double share = 0.01, int threads = 1) {
  Monitor silent;
  return bound_distance(from.view(), to.view(), {.share = share}, threads, silent);
}

/// The distance lies between, and the bounds are as near as requested.
void expect_distance(const Soup& from, const Soup& to, double distance, double diagonal) {
  for (const double share : {0.01, 1e-4}) {
    const DistanceBounds found = bounds(from, to, share);
    EXPECT_LE(found.lower, distance * (1 + 1e-12));
    EXPECT_GE(found.upper, distance * (1 - 1e-15));
    EXPECT_LE(found.upper, (1 + share) * found.lower + 1.001e-6 * diagonal);
  }
}

TEST(SurfaceDistance, IsTheOffsetOfParallelPlanes) {
  const Soup low = sheet(1, 1, 0, 3, 5), high = sheet(1, 1, 0.25, 7, 2);
  expect_distance(low, high, 0.25, std::sqrt(2));
  expect_distance(high, low, 0.25, std::sqrt(2));
  const Soup wide = sheet(1.5, 1, 0.25, 4, 3);  // overhangs by .5
  expect_distance(wide, low, std::hypot(0.5, 0.25), std::sqrt(2));
  expect_distance(low, wide, 0.25, std::hypot(1.5, 1));
}

TEST(SurfaceDistance, IsZeroForTheSameSurfaceWithOtherTriangles) {
  const DistanceBounds found = bounds(sheet(1, 1, 0.3, 7, 11), sheet(1, 1, 0.3, 64, 49));
  EXPECT_LT(found.lower, 1e-15);
  EXPECT_LE(found.upper, 1e-6 * std::sqrt(2) + 1e-14);
  expect_distance(octahedron(1, same), octahedron(20, same), 0, std::sqrt(12));
  expect_distance(octahedron(20, same), octahedron(3, same), 0, std::sqrt(12));
}

TEST(SurfaceDistance, CubesHaveTheDistancesOfCornersAndSides) {
  expect_distance(box(2), box(1), std::sqrt(3), std::sqrt(12));  // a corner from a corner
  expect_distance(box(1), box(2), 1, 2 * std::sqrt(12));
}

// Farthest from three walls over its sides is the centre of the circle that a triangle holds: no vertex, no middle and no centre of gravity.
TEST(SurfaceDistance, IsLargestWhereNoSampleIs) {
  Soup floor, walls;
  const Vec3 a{0, 0, 0}, b{4, 0, 0}, c{0, 3, 0}, up{0, 0, 5};
  floor.add(a, b, c);
  for (const auto& [p, q] : {std::pair{a, b}, {b, c}, {c, a}}) {
    walls.add(p, q, q + up);
    walls.add(p, q + up, p + up);
  }
  expect_distance(floor, walls, 1, norm(Vec3{4, 3, 5}));
  Monitor silent;
  EXPECT_LT(largest_distance(floor.vertices, floor.triangles, walls.vertices, walls.triangles, silent), 0.9);
}

// The octahedron in the unit sphere: from the middles of its sides to the sphere, 1 - 1 / sqrt(3). A sphere of triangles is nearer by its own sagitta.
TEST(SurfaceDistance, ASphereAndPolyhedra) {
  const double exact = 1 - 1 / std::sqrt(3.0);
  double before = 1;
  for (const int n : {3, 6, 12, 24}) {  // a vertex over the middle of each side
    const Soup sphere = octahedron(n, onto_sphere);
    const DistanceBounds there = bounds(sphere, octahedron(1, same), 1e-6);
    EXPECT_LE(there.lower, exact * (1 + 1e-12));
    EXPECT_GE(there.upper, exact * (1 - 1e-12));
    EXPECT_LE(there.upper, exact + 5e-6);
    const DistanceBounds back = bounds(octahedron(1, same), sphere, 1e-3);
    const double off = exact - back.lower;  // of second order
    EXPECT_GE(off, -1e-12);
    EXPECT_LT(off, before / 2.5);
    before = std::max(off, 1e-3);
  }
}

double sampled(const Soup& from, std::size_t t, const TriangleSearch& search, int n) {
  double most = 0;
  const auto& c = from.triangles[t];
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      const Vec3 p = (from.vertices[static_cast<std::size_t>(c[0])] * (n - i - j) +
                      from.vertices[static_cast<std::size_t>(c[1])] * i + from.vertices[static_cast<std::size_t>(c[2])] * j) / n;
      most = std::max(most, search.nearest(p).distance);
    }
  return most;
}

TEST(SurfaceDistance, BoundsHoldForTrianglesAnywhere) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(0, 1), small(-0.3, 0.3);
  const auto soup_of = [&](int n) {
    Soup soup;
    for (int i = 0; i < n; ++i) {
      const Vec3 p{any(random), any(random), any(random)};
      soup.add(p, p + Vec3{small(random), small(random), small(random)}, p + Vec3{small(random), small(random), small(random)});
    }
    return soup;
  };
  for (int run = 0; run < 5; ++run) {
    const Soup from = soup_of(40), to = soup_of(60);
    const TriangleSearch search(to.vertices, to.triangles);
    Monitor silent;
    std::vector<double> upper;
    const DistanceBounds found = bound_distance(from.view(), to.view(), {}, 1, silent, &upper);
    ASSERT_EQ(upper.size(), from.triangles.size());
    double most = 0;
    for (std::size_t t = 0; t < upper.size(); ++t) {
      const double seen = sampled(from, t, search, 60);
      EXPECT_GE(upper[t], seen);
      EXPECT_LE(upper[t], found.upper);
      most = std::max(most, seen);
    }
    EXPECT_GE(found.upper, most);
    EXPECT_LE(found.lower, found.upper);
    EXPECT_LE(found.upper, 1.01 * found.lower + 3e-6);
    EXPECT_NEAR(found.lower, most, 0.02 * most);
  }
}

/// Equal vertices become one.
Soup joined(const Soup& soup) {
  Soup all;
  std::map<std::array<double, 3>, std::int32_t> number;
  for (const auto& t : soup.triangles) {
    auto& made = all.triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& p = soup.vertices[static_cast<std::size_t>(t[i])];
      const auto [at, is_new] = number.try_emplace({p.x(), p.y(), p.z()}, static_cast<std::int32_t>(all.vertices.size()));
      if (is_new) all.vertices.push_back(p);
      made[i] = at->second;
    }
  }
  return all;
}

// Heights over a piece bound it where the mesh below is connected: distances equal the distances to single triangles.
TEST(SurfaceDistance, ConnectedMeshesMatchTheirTriangles) {
  const Soup floor = joined(sheet(1, 1, 0, 3, 200)), high = sheet(1, 1, 0.25, 7, 2), wide = sheet(1.5, 1, 0.25, 4, 3);
  expect_distance(high, floor, 0.25, std::sqrt(2));
  expect_distance(wide, floor, std::hypot(0.5, 0.25), std::sqrt(2));
  const double bent = 1 - std::cos(pi / 200);  // sagitta of a needle of a cylinder
  const auto cylinder = [](int n, int m, double turn) {
    Soup soup;
    const auto at = [&](int i, int j) {
      const double a = 2 * pi * i / n + turn;
      return Vec3{std::cos(a), std::sin(a), static_cast<double>(j) / m};
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < m; ++j) soup.add(at(i, j), at((i + 1) % n, j), at((i + 1) % n, j + 1)), soup.add(at(i, j), at((i + 1) % n, j + 1), at(i, j + 1));
    return soup;
  };
  // From chords of a tenth to the circle that they span: the sagitta of those.
  const Soup coarse = cylinder(20, 5, 0), fine = joined(cylinder(200, 1, pi / 20));
  const double sagitta = 1 - std::cos(pi / 20);
  const DistanceBounds found = bounds(coarse, fine);
  EXPECT_GE(found.upper, sagitta - bent);
  EXPECT_LE(found.lower, sagitta);
  EXPECT_LE(found.upper, 1.01 * found.lower + 3e-6);
  EXPECT_EQ(bounds(coarse, fine).upper, bounds(coarse, fine, 0.01, 3).upper);
}

// The same triangles with and without common vertices, at random: no bound is below the distances of samples.
TEST(SurfaceDistance, HeightsHoldOverRandomRelief) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> height(-0.1, 0.1), way(-0.03, 0.03);
  const auto relief = [&](int n) {
    Soup soup;
    std::vector<Vec3> at;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) at.push_back({(i + way(random)) / n, (j + way(random)) / n, height(random)});
    const auto k = [n](int i, int j) { return static_cast<std::size_t>(i * (n + 1) + j); };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        soup.add(at[k(i, j)], at[k(i + 1, j)], at[k(i + 1, j + 1)]);
        soup.add(at[k(i, j)], at[k(i + 1, j + 1)], at[k(i, j + 1)]);
      }
    return soup;
  };
  for (int run = 0; run < 3; ++run) {
    const Soup from = relief(6), to = joined(relief(25));
    const TriangleSearch search(to.vertices, to.triangles);
    Monitor silent;
    std::vector<double> upper;
    const DistanceBounds found = bound_distance(from.view(), to.view(), {}, 1, silent, &upper);
    for (std::size_t t = 0; t < upper.size(); ++t) EXPECT_GE(upper[t], sampled(from, t, search, 40));
    EXPECT_LE(found.upper, 1.01 * found.lower + 3e-6);
  }
}

TEST(SurfaceDistance, TheSameForAnyNumberOfThreads) {
  const Soup sphere = octahedron(30, onto_sphere), box_around = box(1);
  Monitor silent;
  std::vector<double> one, four;
  const DistanceBounds a = bound_distance(sphere.view(), box_around.view(), {}, 1, silent, &one),
                       b = bound_distance(sphere.view(), box_around.view(), {}, 4, silent, &four);
  EXPECT_EQ(a.lower, b.lower);
  EXPECT_EQ(a.upper, b.upper);
  EXPECT_EQ(one, four);
  EXPECT_NEAR(a.lower, 1 - 1 / std::sqrt(3.0), 0.01);  // of the corner directions to the nearest side
}

TEST(SurfaceDistance, TheSameForAnyNumberOfProcesses) {
  const Soup sphere = octahedron(30, onto_sphere), box_around = box(1);
  Monitor silent;
  std::vector<double> one;
  const DistanceBounds a = bound_distance(sphere.view(), box_around.view(), {}, 1, silent, &one);
  const double largest = largest_distance(sphere.vertices, sphere.triangles, box_around.vertices, box_around.triangles, silent);
  EXPECT_LE(largest, a.upper);
  EXPECT_GT(largest, 0.9 * a.lower);
  const auto thrown = testing::in_processes(3, [&](Team& team) {
    Monitor own;
    const Executor executor{&team, 2};
    std::vector<double> ours;
    const DistanceBounds b = bound_distance(sphere.view(), box_around.view(), {}, executor, own, &ours);
    EXPECT_EQ(a.lower, b.lower);
    EXPECT_EQ(a.upper, b.upper);
    EXPECT_EQ(one, ours);
    EXPECT_EQ(largest, largest_distance(sphere.vertices, sphere.triangles, box_around.vertices, box_around.triangles, own, executor));
  });
  for (const std::string& sentence : thrown) EXPECT_EQ(sentence, "");
}

TEST(SurfaceDistance, IsZeroForEmptyInputAndObeysAStop) {
  const Soup sphere = octahedron(40, onto_sphere);
  EXPECT_EQ(bounds({}, sphere).upper, 0);
  EXPECT_EQ(bounds(sphere, {}).upper, 0);
  Soup point;  // flat triangles are segments and points
  point.add({3, 0, 0}, {3, 0, 0}, {3, 0, 0});
  expect_distance(point, sphere, 2, std::sqrt(12));
  Monitor stopped;
  stopped.request_stop();
  EXPECT_THROW((void)bound_distance(sphere.view(), sphere.view(), {}, 1, stopped), Cancelled);
}

// Needles lie askew, so that several boxes hold each one: 200 needles of ratio 50 and 500 points, seed 7.
TEST(TriangleSearches, FindTheNearestOfNeedles) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> in(-1, 1);
  const auto any = [&] { return Vec3{in(random), in(random), in(random)}; };
  Soup soup;
  for (int k = 0; k < 200; ++k) {
    const Vec3 p = any();
    soup.add(p, p + any(), p + 0.02 * any());
  }
  const TriangleSearch search(soup.vertices, soup.triangles);
  for (int k = 0; k < 500; ++k) {
    const Vec3 p = any();
    NearestOnMesh best;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
      const NearestOnMesh found =
          nearest_on_triangle(p, {soup.vertices[3 * t], soup.vertices[3 * t + 1], soup.vertices[3 * t + 2]});
      if (found.distance < best.distance) best = found, best.triangle = static_cast<std::int32_t>(t);
    }
    const NearestOnMesh found = search.nearest(p);
    EXPECT_EQ(found.triangle, best.triangle);
    EXPECT_EQ(found.distance, best.distance);
    const Vec3 room = Vec3::Constant(0.1), low = p - room, high = p + room;
    std::vector<std::int32_t> beside;
    search.beside_box(low, high, beside);
    std::ranges::sort(beside);
    EXPECT_EQ(std::ranges::adjacent_find(beside), beside.end());
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
      const Vec3* const c = &soup.vertices[3 * t];
      const bool listed = std::ranges::binary_search(beside, static_cast<std::int32_t>(t));
      const Vec3 least = c[0].cwiseMin(c[1]).cwiseMin(c[2]), most = c[0].cwiseMax(c[1]).cwiseMax(c[2]);
      EXPECT_TRUE(listed || (nearest_on_triangle(p, {c[0], c[1], c[2]}).point - p).cwiseAbs().maxCoeff() > 0.1);
      EXPECT_TRUE(!listed || ((least.array() <= high.array()).all() && (most.array() >= low.array()).all()));
    }
  }
}

}  // namespace
}  // namespace carreau
