// SPDX-License-Identifier: BSD-3-Clause
#include "surface/sample/interface_sizes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace carreau {
namespace {

/// A loop of straight sides between corners, each cut into n edges; added to a domain.
void add_loop(PlaneDomain& domain, const std::vector<Vec2>& corners, int n) {
  const int first = static_cast<int>(domain.vertices.size());
  for (std::size_t c = 0; c < corners.size(); ++c)
    for (int i = 0; i < n; ++i)
      domain.vertices.push_back(corners[c] + (double(i) / n) * (corners[(c + 1) % corners.size()] - corners[c]));
  const int count = static_cast<int>(domain.vertices.size()) - first;
  for (int i = 0; i < count; ++i) domain.edges.push_back({.a = first + i, .b = first + (i + 1) % count});
}

template <typename Field>
std::vector<double> sizes_of(const PlaneDomain& domain, const Field& field) {
  std::vector<double> h;
  for (const Vec2& p : domain.vertices) h.push_back(field(p));
  return h;
}

PlaneDomain square(int n = 8) {
  PlaneDomain domain;
  add_loop(domain, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, n);
  return domain;
}

std::vector<Vec2> random_points(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> in(0.001, 0.999);
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const double x = in(random);
    points.push_back({x, in(random)});
  }
  return points;
}

TEST(InterfaceSizes, ReproducesLinearSizesOnAConvexDomain) {
  const auto field = [](Vec2 p) { return 1 + 0.5 * p.x() - 0.3 * p.y(); };
  const PlaneDomain domain = square();
  Monitor monitor;
  const InterfaceSizes sizes(domain, sizes_of(domain, field), SizeLaw::linear, monitor);
  for (const Vec2& p : random_points(500)) EXPECT_NEAR(sizes(p), field(p), 1e-13);
}

TEST(InterfaceSizes, GeometricLawReproducesExponentials) {
  const auto field = [](Vec2 p) { return std::exp(-3 + 2 * p.x() + 4 * p.y()); };
  const PlaneDomain domain = square();
  Monitor monitor;
  const InterfaceSizes sizes(domain, sizes_of(domain, field), SizeLaw::geometric, monitor);
  for (const Vec2& p : random_points(500)) EXPECT_NEAR(sizes(p) / field(p), 1, 1e-12);
}

TEST(InterfaceSizes, MeetsTheSizesOfTheInterfaces) {
  PlaneDomain domain = square(5);
  add_loop(domain, {{0.3, 0.3}, {0.3, 0.6}, {0.6, 0.6}, {0.6, 0.3}}, 3);  // a hole
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0.1, 2);
  const std::vector<double> h = sizes_of(domain, [&](Vec2) { return any(random); });
  Monitor monitor;
  const InterfaceSizes sizes(domain, h, SizeLaw::linear, monitor);
  for (const PlaneEdge& e : domain.edges) {
    EXPECT_NEAR(sizes(domain.vertices[e.a]), h[e.a], 1e-9);
    // On the edge the law holds, and beside it the value is near.
    const Vec2 d = domain.vertices[e.b] - domain.vertices[e.a];
    const Vec2 middle = domain.vertices[e.a] + 0.5 * d;
    EXPECT_NEAR(sizes(middle), 0.5 * (h[e.a] + h[e.b]), 1e-9);
    EXPECT_NEAR(sizes(middle + 1e-6 * Vec2{-d.y(), d.x()}), 0.5 * (h[e.a] + h[e.b]), 1e-4);
  }
}

TEST(InterfaceSizes, StaysBetweenTheExtremesOnAnyDomain) {
  PlaneDomain domain;
  add_loop(domain, {{0, 0}, {1, 0}, {1, 0.2}, {0.2, 0.2}, {0.2, 0.8}, {1, 0.8}, {1, 1}, {0, 1}}, 4);  // a C
  const std::vector<double> h = sizes_of(domain, [](Vec2 p) { return p.x() > 0.9 && p.y() < 0.5 ? 0.01 : 1.0; });
  Monitor monitor;
  for (const SizeLaw law : {SizeLaw::linear, SizeLaw::geometric, SizeLaw::sinusoidal}) {
    const InterfaceSizes sizes(domain, h, law, monitor);
    for (const Vec2& p : random_points(500))
      if (p.x() < 0.2 || p.y() < 0.2 || p.y() > 0.8) {
        EXPECT_GE(sizes(p), 0.01 - 1e-12);
        EXPECT_LE(sizes(p), 1 + 1e-12);
      }
    // The small sizes of one arm are not seen from the other.
    EXPECT_NEAR(sizes({0.9, 0.9}), 1, 1e-12);
    EXPECT_LT(sizes({0.9, 0.1}), 0.6);
  }
}

TEST(InterfaceSizes, AnInternalCurveHidesCurvesBehindIt) {
  PlaneDomain domain = square(4);
  std::vector<double> h = sizes_of(domain, [](Vec2 p) { return p.x() < 0.5 ? 0.1 : (p.x() > 0.5 ? 3.0 : 1.0); });
  // From (0.5, 0), vertex 2, to (0.5, 1), vertex 10.
  ASSERT_EQ(domain.vertices[2].x(), 0.5);
  ASSERT_EQ(domain.vertices[10].x(), 0.5);
  domain.edges.push_back({.a = 2, .b = 10, .kind = PlaneEdgeKind::internal});
  Monitor monitor;
  const InterfaceSizes sizes(domain, h, SizeLaw::linear, monitor);
  for (const Vec2& p : random_points(300)) {
    const double there = sizes(p);
    if (p.x() < 0.5) {
      EXPECT_LE(there, 1 + 1e-12) << p.x();
    } else {
      EXPECT_GE(there, 1 - 1e-12) << p.x();
    }
  }
  EXPECT_NEAR(sizes({0.5, 0.4}), 1, 1e-9);
}

TEST(InterfaceSizes, UnitsOfTheParametersDoNotMatter) {
  const PlaneDomain domain = square();
  PlaneDomain stretched = domain;
  for (Vec2& p : stretched.vertices) p = {5 + 1000 * p.x(), 1e-3 * p.y()};
  const std::vector<double> h = sizes_of(domain, [](Vec2 p) { return 1 + std::sin(3 * p.x()) * std::cos(2 * p.y()); });
  Monitor monitor;
  const InterfaceSizes sizes(domain, h, SizeLaw::linear, monitor), other(stretched, h, SizeLaw::linear, monitor);
  for (const Vec2& p : random_points(100)) EXPECT_NEAR(sizes(p), other({5 + 1000 * p.x(), 1e-3 * p.y()}), 1e-9);
}

TEST(InterfaceSizes, TendsToTheMeanOnADiscsCentre) {
  // At the centre of a circle every direction counts the same.
  PlaneDomain domain;
  const int n = 400;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * M_PI * i / n;
    domain.vertices.push_back({std::cos(a), std::sin(a)});
    domain.edges.push_back({.a = i, .b = (i + 1) % n});
  }
  const auto field = [](Vec2 p) { return 2 + std::pow(p.x(), 2) + std::pow(p.y(), 3); };
  Monitor monitor;
  const InterfaceSizes sizes(domain, sizes_of(domain, field), SizeLaw::linear, monitor);
  EXPECT_NEAR(sizes({0, 0}), 2.5, 1e-4);
}

}  // namespace
}  // namespace carreau
