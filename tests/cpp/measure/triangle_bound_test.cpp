// SPDX-License-Identifier: BSD-3-Clause
// Bounds of single triangles against closed forms and dense samples.
#include "surface/remesh/bounds/triangle_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "mesh/distance/triangle_distance.h"

namespace carreau {
namespace {

using Surface = std::function<BoundPlace(PlaceInTriangle)>;

struct Bounded {
  double deviation = 0, angle = 0;
  std::size_t places = 0;
};

Bounded bound(const BoundedTriangle& triangle, const Surface& surface) {
  std::array<BoundPlace, TriangleBound::lattice_size> seen;
  for (std::size_t i = 0; i < seen.size(); ++i) seen[i] = surface(TriangleBound::lattice()[i]);
  TriangleBound bound(triangle, seen);
  Bounded told{0, 0, seen.size()};
  while (!bound.wanted().empty()) {
    std::vector<BoundPlace> more;
    for (const PlaceInTriangle& at : bound.wanted()) more.push_back(surface(at));
    told.places += more.size();
    bound.take(more);
  }
  told.deviation = bound.deviation(), told.angle = bound.angle();
  return told;
}

Vec3 flat(const BoundedTriangle& t, const PlaceInTriangle& at) {
  return (1 - at.x() - at.y()) * t.p[0] + at.x() * t.p[1] + at.y() * t.p[2];
}
double angle_between(const Vec3& p, const Vec3& q) { return std::atan2(norm(cross(p, q)), dot(p, q)); }

/// The largest distance and angle over n (n + 1) / 2 places.
Bounded dense(const BoundedTriangle& t, const Surface& surface, int n) {
  Bounded most;
  for (int j = 0; j <= n; ++j)
    for (int k = 0; j + k <= n; ++k) {
      const BoundPlace p = surface({static_cast<double>(j) / n, static_cast<double>(k) / n});
      most.deviation = std::max(most.deviation, distance_to_triangle(p.s, t.p[0], t.p[1], t.p[2]));
      most.angle = std::max(most.angle, angle_between(p.n, t.normal));
    }
  return most;
}

// A0 = R - sqrt(R^2 - h^2 / 3) at the middle, A1 = asin(h / (sqrt(3) R)) at the corners.
TEST(TriangleBound, SphereInClosedForm) {
  for (const double h : {0.01, 0.1, 0.3, 0.8}) {
    const double r = h / std::numbers::sqrt3, z = std::sqrt(1 - r * r);
    std::array<Vec3, 3> p;
    for (int i = 0; i < 3; ++i) p[i] = {r * std::cos(2 * i * std::numbers::pi / 3), r * std::sin(2 * i * std::numbers::pi / 3), z};
    const BoundedTriangle t(p);
    const Bounded b = bound(t, [&](PlaceInTriangle at) {
      const Vec3 x = flat(t, at), s = x / norm(x);
      return BoundPlace{s, s};
    });
    EXPECT_GE(b.deviation, (1 - z) * (1 - 1e-9)) << h;
    EXPECT_LE(b.deviation, 1.25 * (1 - z)) << h;
    EXPECT_GE(b.angle, std::asin(r) * (1 - 1e-9)) << h;
    EXPECT_LE(b.angle, 1.25 * std::asin(r)) << h;
    EXPECT_LE(b.places, h < 0.2 ? TriangleBound::lattice_size : 60) << h;  // none but the first
  }
}

// A side along the axis, one along the circle over an angle 2 a: A0 = R (1 - cos a), A1 = a.
TEST(TriangleBound, CylinderInClosedForm) {
  for (const double a : {0.05, 0.2, 0.5}) {
    const auto at = [&](double angle, double z) { return Vec3{2 * std::cos(angle), 2 * std::sin(angle), z}; };
    const BoundedTriangle t({at(-a, 0), at(a, 0), at(-a, 2 * a)});
    const Bounded b = bound(t, [&](PlaceInTriangle p) {
      const double angle = -a + 2 * a * p.x();
      return BoundPlace{at(angle, 2 * a * p.y()), {3 * std::cos(angle), 3 * std::sin(angle), 0}};
    });
    EXPECT_GE(b.deviation, 2 * (1 - std::cos(a)) * (1 - 1e-9));
    EXPECT_LE(b.deviation, 1.25 * 2 * (1 - std::cos(a)));
    EXPECT_GE(b.angle, a * (1 - 1e-9));
    EXPECT_LE(b.angle, 1.25 * a);
  }
}

TEST(TriangleBound, PlaneHasNone) {
  const BoundedTriangle t({Vec3{0, 0, 1}, {2, 0, 1}, {0, 3, 1}});
  const Bounded b = bound(t, [&](PlaceInTriangle p) { return BoundPlace{flat(t, p), {0, 0, 6}}; });
  EXPECT_EQ(b.deviation, 0);
  EXPECT_EQ(b.angle, 0);
}

// The plane itself, by parameters that are not even: it reaches beyond sides on the border of the mesh, and the bound counts this
// excess. Beyond other sides, the triangles around are under it.
TEST(TriangleBound, UnevenParametersCountWhereTheMeshEnds) {
  BoundedTriangle t({Vec3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  t.deviation_floor = 1e-4;
  const Surface bent = [](PlaceInTriangle p) {  // the first side bulges by 0.1 at its middle
    return BoundPlace{{p.x(), p.y() - 0.4 * p.x() * (1 - p.x() - p.y()), 0}, {0, 0, 1}};
  };
  const Bounded open = bound(t, bent);
  EXPECT_GE(open.deviation, 0.1);
  EXPECT_LE(open.deviation, 0.125);
  t.open_side = t.open_corner = {false, false, false};
  t.slope = 0, t.reach = 1;
  EXPECT_LE(bound(t, bent).deviation, 1e-12);
}

/// A bicubic Bezier patch over the unit square.
struct Patch {
  std::array<std::array<Vec3, 4>, 4> c;
  [[nodiscard]] BoundPlace at(Vec2 uv) const {
    const auto weights = [](double t) {
      const double s = 1 - t;
      return std::array{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
    };
    const auto slopes = [](double t) {
      const double s = 1 - t;
      return std::array{-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
    };
    const auto a = weights(uv.x()), b = weights(uv.y()), da = slopes(uv.x()), db = slopes(uv.y());
    Vec3 s{0, 0, 0}, su{0, 0, 0}, sv{0, 0, 0};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        s += a[i] * b[j] * c[i][j], su += da[i] * b[j] * c[i][j], sv += a[i] * db[j] * c[i][j];
    return {s, cross(su, sv)};
  }
};

TEST(TriangleBound, IsNoLessThanDenseSamplesOfBezierPatchesAndLittleMore) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> off(-1, 1);
  for (int trial = 0; trial < 60; ++trial) {
    Patch patch;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        patch.c[i][j] = {i / 3. + 0.06 * off(random), j / 3. + 0.06 * off(random), 0.15 * off(random)};
    const double size = trial % 3 == 0 ? 0.8 : trial % 3 == 1 ? 0.3 : 0.1, angle = off(random);
    std::array<Vec2, 3> uv;
    for (int i = 0; i < 3; ++i) {
      const double way = angle + 2 * i * std::numbers::pi / 3;
      uv[i] = {0.5 + 0.5 * size * std::cos(way), 0.5 + 0.5 * size * std::sin(way)};
    }
    BoundedTriangle t({patch.at(uv[0]).s, patch.at(uv[1]).s, patch.at(uv[2]).s});
    t.deviation_floor = 1e-6 * t.longest, t.angle_floor = 1e-4;
    const Surface surface = [&](PlaceInTriangle p) {
      return patch.at((1 - p.x() - p.y()) * uv[0] + p.x() * uv[1] + p.y() * uv[2]);
    };
    const Bounded b = bound(t, surface), seen = dense(t, surface, 100);
    ASSERT_LT(seen.angle, 1.5);
    EXPECT_GE(b.deviation, seen.deviation * (1 - 1e-9)) << trial;
    EXPECT_LE(b.deviation, 1.3 * seen.deviation) << trial;
    EXPECT_GE(b.angle, seen.angle * (1 - 1e-9)) << trial;
    EXPECT_LE(b.angle, 1.3 * seen.angle) << trial;
    EXPECT_LE(b.places, 600u) << trial;
  }
}

// A pole: Su x Sv vanishes at a corner, where all its directions meet.
TEST(TriangleBound, ConeHasAnAngleAtItsApex) {
  const double a = 0.3, slant = 1;  // S = r (cos, sin, slant)
  const auto at = [&](double r, double angle) { return Vec3{r * std::cos(angle), r * std::sin(angle), slant * r}; };
  const BoundedTriangle t({at(0, 0), at(1, -a), at(1, a)});
  const Bounded b = bound(t, [&](PlaceInTriangle p) {
    const double r = p.x() + p.y(), angle = r > 0 ? a * (p.y() - p.x()) / r : 0;
    const Vec3 ur{std::cos(angle), std::sin(angle), slant}, ut{-r * std::sin(angle), r * std::cos(angle), 0};
    return BoundPlace{at(r, angle), cross(ur, ut)};
  });
  const Vec3 end = cross(Vec3{std::cos(a), std::sin(a), slant}, Vec3{-std::sin(a), std::cos(a), 0});
  const Vec3 middle = cross(Vec3{1, 0, slant}, Vec3{0, 1, 0});
  const double exact = std::max(angle_between(end, t.normal), angle_between(middle, t.normal));
  EXPECT_GE(b.angle, exact * (1 - 1e-9));
  EXPECT_LE(b.angle, 1.5 * exact);  // parts at the apex keep their angle there
  const double height = std::abs(dot(at(1, 0) - t.p[0], t.normal));
  EXPECT_GE(b.deviation, height);
  EXPECT_LE(b.deviation, 1.3 * std::hypot(height, 1 - std::cos(a)));
}

TEST(TriangleBound, TrianglesTurnedOverHaveAHalfTurn) {
  const BoundedTriangle t({Vec3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const Bounded b = bound(t, [&](PlaceInTriangle p) { return BoundPlace{flat(t, p), {0, 0, -1}}; });
  EXPECT_EQ(b.angle, std::numbers::pi);
}

}  // namespace
}  // namespace carreau
