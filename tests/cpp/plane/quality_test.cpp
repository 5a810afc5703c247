// SPDX-License-Identifier: BSD-3-Clause
// The figures that the plane mesher must reach: Q2 in space (HDR eq. 1.6), edge lengths over sizes, degrees.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/plane_mesher.h"
#include "plane_checks.h"

namespace carreau {
namespace {

using namespace testing;

PlaneQuality quality_of(const PlaneCase& c, bool frontal = true) {
  Monitor monitor;
  PlaneMesherOptions options;
  options.frontal = frontal;
  const PlaneMesh mesh = mesh_plane(c.domain, control_space(c, 0.005), options, monitor);
  EXPECT_EQ(find_plane_defects(c.domain, mesh), std::vector<std::string>{});
  return measure(c, mesh);
}

TEST(Quality, TheManualsParaboloid) {
  const PlaneCase c = paraboloid(0.15462);
  EXPECT_EQ(c.domain.edges.size(), 216U);
  const PlaneQuality q = quality_of(c);
  SCOPED_TRACE(to_string(q));
  EXPECT_NEAR(static_cast<double>(q.triangles), 4980, 0.06 * 4980);
  EXPECT_GE(q.mean, 0.989);
  EXPECT_GE(q.p1, 0.92);
  EXPECT_GE(q.worst, 0.6);
  EXPECT_GE(q.degree_six, 0.89);
}

struct Fine {
  const char* name;
  PlaneCase (*make)(double);
  double size;
};
void PrintTo(const Fine& f, std::ostream* out) { *out << f.name; }

class FineQuality : public ::testing::TestWithParam<Fine> {};

TEST_P(FineQuality, MeetsTheFiguresAt100000Triangles) {
  const PlaneQuality q = quality_of(GetParam().make(GetParam().size));
  SCOPED_TRACE(to_string(q));
  EXPECT_NEAR(static_cast<double>(q.triangles), 100000, 5000);
  EXPECT_GE(q.mean, 0.996);
  EXPECT_GE(q.p1, 0.94);
  EXPECT_GE(q.worst, 0.6);
  EXPECT_GE(q.degree_six, 0.96);
  EXPECT_NEAR(q.mean_length, 1, 0.01);
  EXPECT_GE(q.fitting, 0.999);
}

INSTANTIATE_TEST_SUITE_P(Smooth, FineQuality,
                         ::testing::Values(Fine{"paraboloid", paraboloid, 0.03558},
                                           Fine{"hemisphere", hemisphere, 0.01205},
                                           Fine{"torus", torus_patch, 0.02135}),
                         [](const auto& info) { return std::string(info.param.name); });

// Parametrisations that turn and shear, of surfaces meshed uniformly: the field's directions change within an edge.
void expect_in_space(const PlaneCase& c, double mean) {
  const PlaneQuality q = quality_of(c);
  SCOPED_TRACE(to_string(q));
  EXPECT_NEAR(static_cast<double>(q.triangles), 100000, 5000);
  EXPECT_GE(q.mean, mean);
  EXPECT_NEAR(q.mean_length, 1, 0.01);
}

TEST(Turning, SixToOne) { expect_in_space(swirl(0.0089, 2.1), 0.996); }
TEST(Turning, EighteenToOne) { expect_in_space(swirl(0.009, 4), 0.994); }
// Straight edges of the parameter plane are arcs of space whose sagitta is nearly their length.
TEST(Turning, FiftyOneToOne) { expect_in_space(swirl(0.0089, 7), 0.97); }

// Between borders that part from each other at a corner, the width needs one edge, then two: each triangle is as good
// as three in the place of one can be. From 4 sin(a / 2) = sqrt(2) on the second edge is long enough to halve.
TEST(Quality, TrianglesInCorners) {
  for (double degrees = 42; degrees <= 75; degrees += 1) {
    SCOPED_TRACE(degrees);
    const double a = degrees * std::numbers::pi / 180;
    PlaneCase c = flat_square(0.1);
    c.domain = {};
    append_polygon(c, {{0, 0}, {1, 0}, {std::cos(a), std::sin(a)}});
    EXPECT_GE(quality_of(c).worst, 0.7);
  }
}

// Sizes 0.01 to 0.1 with slope 0.26 (gradation 1.3), and the same scaled to a slope of 0.11.
PlaneQuality graded(double scale) {
  const PlaneCase c = size_field(scale);
  Monitor monitor;
  return measure(c, mesh_plane(c.domain, control_space(c, ControlSpaceOptions{}.tolerance), {}, monitor));
}

TEST(Graded, EdgesAreOfUnitLength) {
  for (const double scale : {1.0, 0.42}) {
    const PlaneQuality q = graded(scale);
    SCOPED_TRACE(to_string(q));
    EXPECT_NEAR(q.mean_length, 1, 0.01);
    EXPECT_GE(q.fitting, 0.998);
  }
}

TEST(Graded, QualityAtSlope026) {
  const PlaneQuality q = graded(1);
  SCOPED_TRACE(to_string(q));
  EXPECT_GE(q.mean, 0.985);
  EXPECT_GE(q.p1, 0.90);
  EXPECT_GE(q.degree_six, 0.86);
}

TEST(Graded, QualityAtSlope011) {
  const PlaneQuality q = graded(0.42);
  SCOPED_TRACE(to_string(q));
  EXPECT_GE(q.mean, 0.991);
  EXPECT_GE(q.p1, 0.925);
  EXPECT_GE(q.degree_six, 0.91);
}

// Sizes far below the box's: places of vertices must be as exact as their coordinates.
TEST(Graded, QualityWhereSizesAreAMillionthOfTheBox) {
  constexpr double h0 = 1e-7, slope = 0.11;
  const Vec2 centre{0.53, 0.41};
  PlaneCase c = flat_square(0.1);
  c.size = [=](Vec2 p) { return std::min(0.1, h0 + slope * norm(p - centre)); };
  Monitor monitor;
  const PlaneMesh mesh = mesh_plane(c.domain, control_space(c, ControlSpaceOptions{}.tolerance), {}, monitor);
  EXPECT_EQ(find_plane_defects(c.domain, mesh), std::vector<std::string>{});
  double sum = 0;
  int triangles = 0;
  for (const auto& t : mesh.triangles) {
    const Vec2 p = mesh.vertices[t[0]], u = mesh.vertices[t[1]] - p, v = mesh.vertices[t[2]] - p;
    if (norm(p - centre) > 100 * h0) continue;
    sum += 2 * std::numbers::sqrt3 * cross(u, v) / (dot(u, u) + dot(v, v) + dot(u - v, u - v));
    ++triangles;
  }
  ASSERT_GT(triangles, 100);
  EXPECT_GE(sum / triangles, 0.985);
}

}  // namespace
}  // namespace carreau
