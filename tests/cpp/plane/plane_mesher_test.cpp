// SPDX-License-Identifier: BSD-3-Clause
// The guarantees of mesh_plane on any domain: a valid mesh, limits, cancellation, determinism.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "plane/kernel/boundary.h"
#include "plane/placement/insertion.h"
#include "plane/plane_mesher.h"
#include "plane_checks.h"

namespace carreau {
namespace {

using namespace testing;
using Defects = std::vector<std::string>;

PlaneMesh mesh_of(const PlaneCase& c, bool frontal = true) {
  Monitor monitor;
  PlaneMesherOptions options;
  options.frontal = frontal;
  return mesh_plane(c.domain, control_space(c), options, monitor);
}

struct Named {
  const char* name;
  PlaneCase (*make)(double);
  double size;
};
void PrintTo(const Named& n, std::ostream* out) { *out << n.name << " " << n.size; }

class AnyCase : public ::testing::TestWithParam<Named> {};

TEST_P(AnyCase, IsAValidMeshFrontalAndAlgebraic) {
  const PlaneCase c = GetParam().make(GetParam().size);
  for (const bool frontal : {true, false}) {
    const PlaneMesh mesh = mesh_of(c, frontal);
    EXPECT_EQ(find_plane_defects(c.domain, mesh), Defects{});
    // Some triangle of a coarse mesh is bound to be small at a sharp corner; none may be a sliver.
    EXPECT_GT(measure(c, mesh).worst, 0.25) << to_string(measure(c, mesh));
  }
}

PlaneCase swirl_case(double h) { return swirl(h); }
PlaneCase cone_case(double h) { return polar_cone(h, 0.25); }

INSTANTIATE_TEST_SUITE_P(
    Mesh, AnyCase,
    ::testing::Values(
        Named{"square", flat_square, 0.5}, Named{"square", flat_square, 0.21}, Named{"square", flat_square, 0.02},
        Named{"paraboloid", paraboloid, 1.5}, Named{"paraboloid", paraboloid, 0.5},
        Named{"paraboloid", paraboloid, 0.15462}, Named{"hemisphere", hemisphere, 0.4},
        Named{"hemisphere", hemisphere, 0.1}, Named{"hemisphere", hemisphere, 0.03}, Named{"torus", torus_patch, 1},
        Named{"torus", torus_patch, 0.3}, Named{"torus", torus_patch, 0.08}, Named{"swirl", swirl_case, 0.08},
        Named{"swirl", swirl_case, 0.02}, Named{"stretched", stretched, 0.2}, Named{"stretched", stretched, 0.05},
        Named{"sizes", size_field, 3}, Named{"sizes", size_field, 1}, Named{"holes", holes, 0.035},
        Named{"holes", holes, 0.02}, Named{"star", star, 0.1}, Named{"star", star, 0.03},
        Named{"internal", internal_curves, 0.2}, Named{"internal", internal_curves, 0.07},
        Named{"disc", polar_disc, 0.25}, Named{"disc", polar_disc, 0.07}, Named{"cone", cone_case, 0.2},
        Named{"cone", cone_case, 0.05}, Named{"sphere", sphere_two_poles, 0.4}, Named{"sphere", sphere_two_poles, 0.1}),
    [](const auto& info) { return std::string(info.param.name) + std::to_string(info.index); });

TEST(MeshPlane, IsTheSameBitForBit) {
  const PlaneCase c = holes(0.03);
  const PlaneMesh first = mesh_of(c), second = mesh_of(c);
  EXPECT_EQ(first.vertices, second.vertices);
  EXPECT_EQ(first.triangles, second.triangles);
}

// A strip ninety times as long as wide in the metric, in parameters that make it a square, with a cut end: the points
// of that end are Delaunay neighbours of half the strip in (u, v), and of a few edges in the metric. Also where all of
// it is shorter than three sizes.
TEST(MeshPlane, LongStripsAreDelaunayInTheMetric) {
  constexpr int along = 130;
  const double h = 1.0 / along, cut = 0.004;
  PlaneCase c;
  std::vector<Vec2>& p = c.domain.vertices;
  for (int i = 0; i <= along; ++i) p.push_back({i * h, 0});
  for (int i = 1; i < 6; ++i) p.push_back({1 - cut * i / 6, i / 6.0});
  for (int i = along; i >= 0; --i) p.push_back({i * h - cut * i * h, 1});
  for (int i = 0; i < static_cast<int>(p.size()); ++i)
    c.domain.edges.push_back({i, (i + 1) % static_cast<int>(p.size()), PlaneEdgeKind::boundary, 0, i});
  for (const double size : {1., 45., 130.}) {
    SCOPED_TRACE(size);
    const ControlSpace space = ControlSpace::constant(1 / (size * size) * Metric2{along * along, 0, 0.7 * 0.7});
    Monitor monitor;
    const PlaneMesh mesh = mesh_plane(c.domain, space, {}, monitor);
    EXPECT_EQ(find_plane_defects(c.domain, mesh), Defects{});
    double longest = 0;
    for (const auto& t : mesh.triangles)
      for (int i = 0; i < 3; ++i)
        longest = std::max(longest, std::abs(mesh.vertices[t[i]].x() - mesh.vertices[t[(i + 1) % 3]].x()) / h);
    EXPECT_LT(longest, 1.5);
  }
}

// One unit wide and four hundred long, in parameters that make it a square, with a cut end; off its axes the metric
// changes from unit to unit by more than one swap gains where all edges lean over dozens of units.
TEST(MeshPlane, LongStripsOfOneLayerDoNotLean) {
  constexpr int along = 400;
  for (const double cut : {0.09, 0.2}) {
    SCOPED_TRACE(cut);
    PlaneCase c;
    std::vector<Vec2>& p = c.domain.vertices;
    for (int i = 0; i <= along; ++i) p.push_back({static_cast<double>(i) / along, 0});
    const int end = static_cast<int>(cut * along);
    for (int i = 1; i < end; ++i) p.push_back({1 - cut * i / end, static_cast<double>(i) / end});
    const int top = static_cast<int>(along * (1 - cut));
    for (int i = top; i >= 0; --i) p.push_back({(1 - cut) * i / top, 1});
    for (int i = 0; i < static_cast<int>(p.size()); ++i)
      c.domain.edges.push_back({i, (i + 1) % static_cast<int>(p.size()), PlaneEdgeKind::boundary, 0, i});
    SampledDomain sampled{p, {}};
    for (const PlaneEdge& e : c.domain.edges) sampled.edges.emplace_back(e.a, e.b);
    Monitor monitor;
    const auto field = [&](std::span<const Vec2> at, std::span<Metric2> metric) {
      for (std::size_t k = 0; k < at.size(); ++k) {
        const double s = std::sin(2 * along * at[k].x() + 3 * at[k].y());
        metric[k] = {along * along, -0.04 * along * (0.5 + s), 1.2 * (1 + 0.4 * s)};
      }
    };
    const PlaneMesh mesh = mesh_plane(c.domain, ControlSpace::build(sampled, field, {}, monitor), {}, monitor);
    EXPECT_EQ(find_plane_defects(c.domain, mesh), Defects{});
    double longest = 0;
    for (const auto& t : mesh.triangles)
      for (int i = 0; i < 3; ++i)
        longest = std::max(longest, along * std::abs(mesh.vertices[t[i]].x() - mesh.vertices[t[(i + 1) % 3]].x()));
    EXPECT_LT(longest, 1.5);
  }
}

TEST(MeshPlane, DoesNotDependOnTheUnitOfTheParameters) {
  // The same patch in parameters multiplied by powers of two: the same triangles.
  const PlaneCase c = paraboloid(0.3);
  PlaneCase scaled = c;
  const Vec2 k{std::ldexp(1.0, 40), std::ldexp(1.0, -300)};
  for (Vec2& p : scaled.domain.vertices) p = {k.x() * p.x(), k.y() * p.y()};
  const ControlSpace space = ControlSpace::constant({20, 5, 30});
  const ControlSpace scaled_space = ControlSpace::constant({20 / (k.x() * k.x()), 5 / (k.x() * k.y()), 30 / (k.y() * k.y())});
  Monitor monitor;
  const PlaneMesh mesh = mesh_plane(c.domain, space, {}, monitor);
  const PlaneMesh other = mesh_plane(scaled.domain, scaled_space, {}, monitor);
  EXPECT_EQ(mesh.triangles, other.triangles);
}

TEST(MeshPlane, StopsAtTheLimit) {
  const PlaneCase c = paraboloid(0.1);
  PlaneMesherOptions options;
  options.max_triangles = 5000;
  Monitor monitor;
  const ControlSpace space = control_space(c);
  EXPECT_THROW(mesh_plane(c.domain, space, options, monitor), LimitError);
  options.frontal = false;
  EXPECT_THROW(mesh_plane(c.domain, space, options, monitor), LimitError);
  options.max_triangles = 50000;
  EXPECT_NO_THROW(mesh_plane(c.domain, space, options, monitor));
}

// Numbers of sides have 32 bits, whatever is allowed.
TEST(Placement, IsBoundByNumbersOf32Bits) {
  const PlaneCase c = flat_square(0.25);
  const ControlSpace space = control_space(c);
  Monitor monitor;
  plane::BoundaryMesh boundary = plane::triangulate_boundary(c.domain, monitor);
  const plane::Field field(space, boundary.frame, {.bends = false, .triangles = 16});
  plane::PlaneWork work{boundary.mesh, field, monitor};
  EXPECT_EQ(plane::Placement(work, INT32_MAX).max_triangles, 500'000'000);
  EXPECT_EQ(plane::Placement(work, INT64_MAX).max_triangles, 500'000'000);
  EXPECT_EQ(plane::Placement(work, 1000).max_triangles, 1000);
}

class CountingMonitor : public Monitor {
 public:
  long checkpoints = 0, stop_after = -1;
  void checkpoint() override {
    if (++checkpoints == stop_after) request_stop();
    Monitor::checkpoint();
  }
};

TEST(MeshPlane, LooksForAStopThroughout) {
  const PlaneCase c = paraboloid(0.05);
  const ControlSpace space = control_space(c);
  CountingMonitor all;
  const PlaneMesh mesh = mesh_plane(c.domain, space, {}, all);
  // About a microsecond a triangle: 20 ms are 20 000 of them.
  EXPECT_GT(all.checkpoints, static_cast<long>(mesh.triangles.size() / 10000));
  for (long stop = 1; stop <= all.checkpoints; stop += std::max(1L, all.checkpoints / 20)) {
    CountingMonitor monitor;
    monitor.stop_after = stop;
    EXPECT_THROW(mesh_plane(c.domain, space, {}, monitor), Cancelled);
    EXPECT_EQ(monitor.checkpoints, stop);
  }
}

TEST(MeshPlane, KeepsImposedPointsAndCurves) {
  const PlaneCase c = internal_curves(0.05);
  for (const bool frontal : {true, false}) {
    const PlaneMesh mesh = mesh_of(c, frontal);
    ASSERT_EQ(find_plane_defects(c.domain, mesh), Defects{});  // imposed vertices unmoved, edges present
    const PlaneQuality q = measure(c, mesh);
    EXPECT_GT(q.mean, frontal ? 0.985 : 0.95);
  }
}

// Random metrics and polygons: never a crash, a hang or a wrong mesh.
TEST(MeshPlane, RandomDomainsInRandomMetricsGiveValidMeshes) {
  std::mt19937 random(42);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 150; ++trial) {
    PlaneDomain domain;
    const int n = 3 + static_cast<int>(random() % 60);
    for (int i = 0; i < n; ++i) {
      const double r = 0.05 + 0.95 * unit(random), a = 2 * 3.14159265358979 * i / n;
      domain.vertices.push_back({r * std::cos(a), r * std::sin(a)});
      domain.edges.push_back({i, (i + 1) % n});
    }
    // Sheared and stretched up to 1000 : 1, between 1 and 10 000 triangles; boundaries are anything but unit.
    const double stretch = std::pow(10, 3 * unit(random)), angle = 6.3 * unit(random);
    const double density = std::pow(10, 1 + 2.7 * unit(random));
    const double co = std::cos(angle), si = std::sin(angle), l1 = density * stretch, l2 = density / stretch;
    const Metric2 m{l1 * co * co + l2 * si * si, (l1 - l2) * co * si, l1 * si * si + l2 * co * co};
    Monitor monitor;
    PlaneMesherOptions options;
    options.frontal = trial % 3 != 0;
    const PlaneMesh mesh = mesh_plane(domain, ControlSpace::constant(m), options, monitor);
    ASSERT_EQ(find_plane_defects(domain, mesh), Defects{}) << "trial " << trial;
  }
}

TEST(MeshPlane, WildMetricsStillGiveAValidMesh) {
  // Sizes that jump by hundreds within a cell of the control space, tensors that turn at random.
  std::mt19937 random(8);
  for (int trial = 0; trial < 20; ++trial) {
    const PlaneCase c = flat_square(0.2);
    SampledDomain sampled;
    sampled.vertices = c.domain.vertices;
    for (const PlaneEdge& e : c.domain.edges) sampled.edges.emplace_back(e.a, e.b);
    Monitor monitor;
    ControlSpaceOptions options;
    options.max_samples = 400;
    std::uniform_real_distribution<double> unit(0, 1);
    const ControlSpace space = ControlSpace::build(
        sampled,
        [&](std::span<const Vec2>, std::span<Metric2> metric) {
          for (Metric2& m : metric) {
            const double a = std::pow(10, 1 + 3 * unit(random)), cc = std::pow(10, 1 + 3 * unit(random));
            m = {a, (1.98 * unit(random) - 0.99) * std::sqrt(a * cc), cc};
          }
        },
        options, monitor);
    for (const bool frontal : {true, false}) {
      PlaneMesherOptions how;
      how.frontal = frontal;
      const PlaneMesh mesh = mesh_plane(c.domain, space, how, monitor);
      ASSERT_EQ(find_plane_defects(c.domain, mesh), Defects{}) << "trial " << trial;
    }
  }
}

TEST(MeshPlane, SurroundsAnApexWithThreeTriangles) {
  for (const double half_angle : {0.05, 0.25, 0.7, 1.57})
    for (const double h : {0.5, 0.3, 0.1, 0.03}) {
      PlaneCase c = polar_cone(h, half_angle);
      const PlaneMesh mesh = mesh_of(c);
      ASSERT_EQ(find_plane_defects(c.domain, mesh), Defects{});
      const auto apex = [](int v) { return v == 0 || v == 3; };
      int around = 0;
      for (const auto& t : mesh.triangles)
        around += static_cast<int>(apex(t[0])) + static_cast<int>(apex(t[1])) + static_cast<int>(apex(t[2])) == 1;
      EXPECT_GE(around, 3) << "half angle " << half_angle << ", size " << h;
    }
}

}  // namespace
}  // namespace carreau
