// SPDX-License-Identifier: BSD-3-Clause
// Poles and seams at any size: fans of three triangles or more, no torn border, no gap.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numbers>

#include "common/analytic_cad.h"
#include "mesh/quality.h"
#include "session/session.h"
#include "session_of_size.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
using testing::AnalyticFace;
using testing::segment;
constexpr double pi = std::numbers::pi;

/// Half axes a; longitude u, latitude v.
SurfaceJet ellipsoid_jet(Vec2 p, Vec3 a) {
  const double cu = std::cos(p.x()), su = std::sin(p.x()), cv = std::cos(p.y()), sv = std::sin(p.y());
  SurfaceJet j{{cv * cu, cv * su, sv},  {-cv * su, cv * cu, 0}, {-sv * cu, -sv * su, cv},
               {-cv * cu, -cv * su, 0}, {sv * su, -sv * cu, 0}, {-cv * cu, -cv * su, -sv}};
  for (Vec3* v : {&j.s, &j.su, &j.sv, &j.suu, &j.suv, &j.svv}) *v = {a.x() * v->x(), a.y() * v->y(), a.z() * v->z()};
  return j;
}
AnalyticCad ellipsoid(Vec3 a, double phase) {
  AnalyticCad cad;
  cad.faces[1] = {[a](Vec2 p) { return ellipsoid_jet(p, a); },
                  testing::rectangle({phase, -pi / 2}, {phase + 2 * pi, pi / 2})};
  return cad;
}

/// A unit sphere with a round hole on its seam, and the cap that fills it, which has its seam elsewhere.
AnalyticCad sphere_trimmed_across_its_seam(double hole) {
  const auto jet = [](Vec2 p) { return ellipsoid_jet(p, {1, 1, 1}); };
  const double h = pi / 2, far = 2 * pi;
  AnalyticCad cad;
  cad.faces[1] = {
      jet,
      {segment({0, -h}, {far, -h}), segment({far, -h}, {far, -hole}), testing::arc({far, 0}, hole, 3 * pi / 2, pi / 2),
       segment({far, hole}, {far, h}), segment({far, h}, {0, h}), segment({0, h}, {0, hole}),
       testing::arc({0, 0}, hole, pi / 2, -pi / 2), segment({0, -hole}, {0, -h})}};
  cad.faces[2] = {jet,
                  {testing::arc({far, 0}, hole, -pi / 2, pi / 2), testing::arc({far, 0}, hole, pi / 2, 3 * pi / 2)}};
  return cad;
}

/// A cone of radius 1 and height `height` with its base; the base starts at another angle.
AnalyticCad cone(double height, double phase) {
  AnalyticCad cad;
  cad.faces[1] = {[height](Vec2 p) {
                    const double c = std::cos(p.x()), s = std::sin(p.x()), r = 1 - p.y();
                    return SurfaceJet{{r * c, r * s, height * p.y()}, {-r * s, r * c, 0}, {-c, -s, height},
                                      {-r * c, -r * s, 0},          {s, -c, 0},         {}};
                  },
                  testing::rectangle({0, 0}, {2 * pi, 1})};
  cad.faces[2] = {[](Vec2 p) {
                    return SurfaceJet{{p.x(), -p.y(), 0}, {1, 0, 0}, {0, -1, 0}, {}, {}, {}};
                  },
                  {testing::arc({0, 0}, 1, phase, phase + 2 * pi)}};
  return cad;
}

AnalyticCad torus(double small) {
  AnalyticCad cad;
  cad.faces[1] = {[small](Vec2 p) { return testing::torus_jet(p, 2, small); },
                  testing::rectangle({0.4, 1}, {0.4 + 2 * pi, 1 + 2 * pi})};
  return cad;
}

/// An eighth of a unit ball: its round face has a pole where two flat ones have a corner.
AnalyticCad eighth_of_a_ball() {
  const std::vector<testing::AnalyticCurve> quarter = {segment({0, 0}, {1, 0}), testing::arc({0, 0}, 1, 0, pi / 2),
                                                       segment({0, 1}, {0, 0})};
  AnalyticCad cad;
  cad.faces[1] = {[](Vec2 p) { return ellipsoid_jet(p, {1, 1, 1}); }, testing::rectangle({0, 0}, {pi / 2, pi / 2})};
  cad.faces[2] = {[](Vec2 p) { return SurfaceJet{{p.y(), p.x(), 0}, {0, 1, 0}, {1, 0, 0}, {}, {}, {}}; }, quarter};
  cad.faces[3] = {[](Vec2 p) { return SurfaceJet{{0, p.y(), p.x()}, {0, 0, 1}, {0, 1, 0}, {}, {}, {}}; }, quarter};
  cad.faces[4] = {[](Vec2 p) { return SurfaceJet{{p.x(), 0, p.y()}, {1, 0, 0}, {0, 0, 1}, {}, {}, {}}; }, quarter};
  return cad;
}

/// The triangles around each vertex that several local vertices of one face share and that lies at `pole`.
int fan_at(const FlatMesh& mesh, Vec3 pole) {
  int fan = 0;
  for (const auto& t : mesh.triangles)
    for (const std::int32_t v : t) fan += norm(mesh.vertices[static_cast<std::size_t>(v)] - pole) < 1e-9 ? 1 : 0;
  return fan;
}

/// 100 sizes from diag / 5 to diag / 60. `radius`: the smallest one of curvature.
void sweep(const AnalyticCad& cad, double diag, long euler, double volume, double radius,
           const std::vector<Vec3>& poles) {
  for (int i = 0; i < 100; ++i) {
    const double size = diag / 5 * std::pow(5.0 / 60, i / 99.0);
    SCOPED_TRACE(::testing::Message() << "size " << size);
    Monitor monitor;
    Session session(monitor);
    session.set_cad(std::make_shared<AnalyticCad>(cad));
    session.set_model(testing::unglued(cad));
    session.parameters().set("hphydef", size);
    session.parameters().set("hphymin", size / 10);
    session.parameters().set("hphymax", size * 10);
    session.make_mesh();
    EXPECT_EQ(find_defects(session.mesh(), {.closed = true, .limit = 3}), std::vector<std::string>{});
    const FlatMesh mesh = session.exported();
    const QualitySummary q = summarise_quality(mesh);
    EXPECT_EQ(static_cast<long>(q.vertices) - static_cast<long>(q.edges) + static_cast<long>(q.triangles), euler);
    for (const Vec3& pole : poles) EXPECT_GE(fan_at(mesh, pole), 3);
    EXPECT_GT(q.q2.min, 0.02);  // at coarse sizes a small hole stands in triangles four times its own edges
    double enclosed = 0;
    for (const auto& t : mesh.triangles)
      enclosed +=
          dot(mesh.vertices[static_cast<std::size_t>(t[0])],
              cross(mesh.vertices[static_cast<std::size_t>(t[1])], mesh.vertices[static_cast<std::size_t>(t[2])])) /
          6;
    // An inscribed polyhedron of edges e loses about a quarter of (e / radius)^2, when they are short enough for that;
    // edges are up to sqrt(2) sizes long.
    if (size < radius / 2) {
      EXPECT_NEAR(enclosed / volume, 1, 0.5 * (size / radius) * (size / radius));
    }
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(Poles, SphereWithItsSeamAnywhere) {
  for (const double phase : {0.0, 1.3})
    sweep(ellipsoid({1, 1, 1}, phase), 2 * std::sqrt(3.0), 2, 4 * pi / 3, 1, {{0, 0, 1}, {0, 0, -1}});
}
TEST(Poles, FlatAndLongEllipsoids) {
  sweep(ellipsoid({1, 1, 0.4}, 0.7), 2.9, 2, 4 * pi / 3 * 0.4, 0.4, {{0, 0, 0.4}, {0, 0, -0.4}});
  sweep(ellipsoid({1, 0.8, 2}, 0.7), 4.7, 2, 4 * pi / 3 * 1.6, 0.32, {{0, 0, 2}, {0, 0, -2}});
}
TEST(Poles, SphereTrimmedAcrossItsSeam) {
  for (const double hole : {0.1, 0.5, 1.2})
    sweep(sphere_trimmed_across_its_seam(hole), 2 * std::sqrt(3.0), 2, 4 * pi / 3, 1, {{0, 0, 1}, {0, 0, -1}});
}
TEST(Poles, ConeOnABaseThatStartsElsewhere) {
  for (const double phase : {0.0, 2.0}) sweep(cone(1.5, phase), 3, 2, pi * 1.5 / 3, 1, {{0, 0, 1.5}});
}
// With an edge a side it is a tetrahedron of three right-angled triangles and an equilateral one.
TEST(Poles, ShareTheirFanWithFacesThatHaveACornerThere) {
  const AnalyticCad cad = eighth_of_a_ball();
  sweep(cad, std::sqrt(3.0), 2, pi / 6, 1, {{0, 0, 1}});
  Monitor monitor;
  const auto session = testing::session_of_size(cad, 2, monitor);
  session->make_mesh();
  const QualitySummary q = summarise_quality(session->exported());
  EXPECT_EQ(q.triangles, 4);
  EXPECT_NEAR(q.q2.mean, (1 + 3 * std::sqrt(3.0) / 2) / 4, 1e-9);
}
TEST(Seams, ToriThinAndThick) {
  for (const double small : {0.3, 1.2})
    sweep(torus(small), 5.5, 0, 2 * pi * pi * 2 * small * small, std::min(small, 2 - small), {});
}

}  // namespace
}  // namespace carreau
