// SPDX-License-Identifier: BSD-3-Clause
// Large domains are meshed in pieces: no measure tells where these have met.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "metric_cases.h"
#include "plane/division/coarse_domain.h"
#include "plane/division/divided_mesh.h"
#include "plane/plane_mesher.h"
#include "plane/thresholds.h"
#include "plane/undivided.h"
#include "plane_checks.h"

namespace carreau {
namespace {

using namespace testing;
using Defects = std::vector<std::string>;

plane::Field::Known known_of(const ControlSpace& space) {
  return {.bends = plane::Field::may_bend(space), .triangles = space.measure()};
}
PlaneMesh uncut(const PlaneDomain& domain, const ControlSpace& space) {
  Monitor monitor;
  return plane::mesh_undivided(domain, space, known_of(space), {}, monitor).mesh;
}
std::optional<PlaneMesh> cut(const PlaneDomain& domain, const ControlSpace& space, int threads = 1) {
  Monitor monitor;
  PlaneMesherOptions options;
  options.threads = threads;
  return plane::mesh_divided(domain, space, known_of(space), options, monitor);
}
void expect_same(const PlaneMesh& one, const PlaneMesh& other) {
  EXPECT_EQ(one.vertices, other.vertices);
  EXPECT_EQ(one.triangles, other.triangles);
}

struct Large {
  const char* name;
  PlaneCase (*make)(double);
  double size;
};
void PrintTo(const Large& l, std::ostream* out) { *out << l.name; }

PlaneCase turning(double h) { return swirl(h); }
/// Two squares that share nothing.
PlaneCase two_squares(double h) {
  PlaneCase c = flat_square(h), other = c;
  const auto n = static_cast<int>(c.domain.vertices.size());
  for (const Vec2& p : other.domain.vertices) c.domain.vertices.push_back(p + Vec2{1.5, 0.25});
  for (PlaneEdge e : other.domain.edges) {
    e.a += n, e.b += n;
    c.domain.edges.push_back(e);
  }
  c.high = c.high + Vec2{1.5, 0.25};
  return c;
}

class Divided : public ::testing::TestWithParam<Large> {};

// Half a point of a percent of degrees, a thousandth of mean shape and length: what another seed of the boundary does.
TEST_P(Divided, IsAsGoodAsInOnePiece) {
  const PlaneCase c = GetParam().make(GetParam().size);
  const ControlSpace space = control_space(c);
  ASSERT_GT(space.measure(), plane::least_divided);
  const auto mesh = cut(c.domain, space);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(find_plane_defects(c.domain, *mesh), Defects{});
  const PlaneQuality q = measure(c, *mesh), whole = measure(c, uncut(c.domain, space));
  SCOPED_TRACE(to_string(q) + "\n" + to_string(whole));
  EXPECT_NEAR(q.mean, whole.mean, 0.001);
  EXPECT_GT(q.p1, whole.p1 - 0.01);
  EXPECT_GT(q.worst, 0.9 * whole.worst);
  EXPECT_NEAR(q.mean_length, whole.mean_length, 0.001);
  EXPECT_GT(q.fitting, whole.fitting - 0.0005);
  EXPECT_LT(q.longest, 1.1 * whole.longest);
  EXPECT_GT(q.degree_six, whole.degree_six - 0.005);
  EXPECT_NEAR(static_cast<double>(q.triangles), static_cast<double>(whole.triangles), 0.005 * static_cast<double>(whole.triangles));
}

TEST_P(Divided, IsTheSameForAnyNumberOfThreads) {
  const PlaneCase c = GetParam().make(GetParam().size);
  const ControlSpace space = control_space(c);
  const auto one = cut(c.domain, space, 1);
  ASSERT_TRUE(one);
  for (const int threads : {2, 3, 7}) {
    const auto several = cut(c.domain, space, threads);
    ASSERT_TRUE(several);
    expect_same(*one, *several);
  }
}

INSTANTIATE_TEST_SUITE_P(Large, Divided,
                         ::testing::Values(Large{"square", flat_square, 0.003}, Large{"paraboloid", paraboloid, 0.022},
                                           Large{"hemisphere", hemisphere, 0.0075}, Large{"torus", torus_patch, 0.0078},
                                           Large{"holes", holes, 0.0055}, Large{"internal", internal_curves, 0.0058},
                                           Large{"stretched", stretched, 0.02}, Large{"sizes", size_field, 0.09},
                                           Large{"swirl", turning, 0.0055}, Large{"sphere", sphere_two_poles, 0.01},
                                           Large{"squares", two_squares, 0.004}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(Division, LeavesSmallDomainsAlone) {
  const PlaneCase c = holes(0.012);
  const ControlSpace space = control_space(c);
  ASSERT_LT(space.measure(), 60'000);
  Monitor monitor;
  PlaneMesherOptions options;
  options.threads = 7;
  expect_same(mesh_plane(c.domain, space, options, monitor), uncut(c.domain, space));
}

}  // namespace
}  // namespace carreau
