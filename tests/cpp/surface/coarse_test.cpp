// SPDX-License-Identifier: BSD-3-Clause
// Sizes larger than the surface's own features: patches must not touch each other away from their curves.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numbers>

#include "common/analytic_cad.h"
#include "mesh/quality.h"
#include "session/session.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
constexpr double pi = std::numbers::pi;

std::unique_ptr<Session> meshed(AnalyticCad cad, double size, Monitor& monitor) {
  auto session = std::make_unique<Session>(monitor);
  const Model model = testing::unglued(cad);
  session->set_cad(std::make_shared<AnalyticCad>(std::move(cad)));
  session->set_model(model);
  session->parameters().set("hphydef", size);
  session->parameters().set("hphymin", size / 10);
  session->parameters().set("hphymax", size * 10);
  session->make_mesh();
  return session;
}

/// Numbers of edges with one triangle and with more than two.
std::pair<int, int> odd_edges(const FlatMesh& mesh) {
  std::vector<std::array<std::int32_t, 2>> edges;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) edges.push_back({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
  std::sort(edges.begin(), edges.end());
  int open = 0, crowded = 0;
  for (std::size_t from = 0, to = 0; from < edges.size(); from = to) {
    while (to < edges.size() && edges[to] == edges[from]) ++to;
    open += to - from == 1 ? 1 : 0;
    crowded += to - from > 2 ? 1 : 0;
  }
  return {open, crowded};
}

void expect_closed(const Session& session) {
  EXPECT_EQ(find_defects(session.mesh(), {.closed = true, .limit = 5}), std::vector<std::string>{});
  EXPECT_EQ(odd_edges(session.exported()), (std::pair{0, 0}));
}

// One patch, two seams: at coarse sizes an inner vertex sees both copies of a vertex of the seam.
TEST(Coarse, TorusOfOnePatchIsClosedAtAllSizes) {
  for (const double small : {0.05, 0.3, 1.0})
    for (double size = 0.4; size < 6; size *= 1.3) {
      SCOPED_TRACE(::testing::Message() << "tube " << small << ", size " << size);
      AnalyticCad cad;
      cad.faces[1] = {[=](Vec2 p) { return testing::torus_jet(p, 3, small); },
                      testing::rectangle({0, 0}, {2 * pi, 2 * pi})};
      Monitor monitor;
      expect_closed(*meshed(std::move(cad), size, monitor));
    }
}

SurfaceJet plane_jet(Vec2 p, double z) {
  SurfaceJet j;
  j.s = {p.x(), p.y(), z * (1 - p.x() * p.x()) * (1 - p.y() * p.y())};
  j.su = {1, 0, -2 * z * p.x() * (1 - p.y() * p.y())};
  j.sv = {0, 1, -2 * z * p.y() * (1 - p.x() * p.x())};
  j.suu = {0, 0, -2 * z * (1 - p.y() * p.y())};
  j.suv = {0, 0, 4 * z * p.x() * p.y()};
  j.svv = {0, 0, -2 * z * (1 - p.x() * p.x())};
  return j;
}

// Two sheets over one square, joined along its sides: without new vertices they would be the same two triangles.
TEST(Coarse, TwoSheetsOverOneSquareEncloseAVolume) {
  AnalyticCad cad;
  cad.faces[1] = {[](Vec2 p) { return plane_jet(p, 0.5); }, testing::rectangle({-1, -1}, {1, 1})};
  const auto below = [](Vec2 p) {
    SurfaceJet j = plane_jet({p.y(), p.x()}, -0.5);
    std::swap(j.su, j.sv), std::swap(j.suu, j.svv);
    return j;
  };
  cad.faces[2] = {below, testing::rectangle({-1, -1}, {1, 1})};
  for (const double size : {2.0, 4.0, 20.0}) {
    SCOPED_TRACE(size);
    Monitor monitor;
    const auto session = meshed(cad, size, monitor);
    expect_closed(*session);
    double volume = 0;
    const FlatMesh mesh = session->exported();
    for (const auto& t : mesh.triangles)
      volume += dot(mesh.vertices[t[0]], cross(mesh.vertices[t[1]], mesh.vertices[t[2]])) / 6;
    EXPECT_GT(volume, 0.5);  // exact: 2 * 0.5 * (4/3)^2 = 1.78
    EXPECT_LT(volume, 16.0 / 9);
  }
}

// A crescent between two arcs of one chord: with an edge a curve it is turned inside out, with one edge on the outer
// arc and two on the inner one too.
TEST(Coarse, CrescentIsNotTurnedInsideOut) {
  for (double size = 0.1; size < 20; size *= 1.5) {
    SCOPED_TRACE(size);
    AnalyticCad cad;
    const double tilt = 0.25;
    const double radius = std::hypot(1, tilt), angle = std::atan2(tilt, 1);
    cad.faces[1] = {[](Vec2 p) { return plane_jet(p, 0); },
                    {testing::arc({0, 0}, 1, 0, pi), testing::arc({0, -tilt}, radius, pi - angle, angle)}};
    Monitor monitor;
    const auto session = meshed(std::move(cad), size, monitor);
    EXPECT_EQ(find_defects(session->mesh()), std::vector<std::string>{});
    const QualitySummary quality = summarise_quality(session->exported());
    const double segment = radius * radius * ((pi - 2 * angle) - std::sin(pi - 2 * angle)) / 2;
    EXPECT_GT(quality.area, 0);
    EXPECT_LT(quality.area, 1.5 * (pi / 2 - segment));
  }
}

SurfaceJet helicoid_jet(Vec2 p) {
  const double c = std::cos(p.x()), s = std::sin(p.x()), r = 3 - p.y();
  SurfaceJet j;
  j.s = {r * c, r * s, 0.16 * p.x()};
  j.su = {-r * s, r * c, 0.16};
  j.sv = {-c, -s, 0};
  j.suu = {-r * c, -r * s, 0};
  j.suv = {s, -c, 0};
  return j;
}

// The runout of a thread: a wedge of two degrees that winds about an axis. Swaps judged in space would join vertices
// across the axis.
TEST(Coarse, WindingWedgeStaysOnItsSurface) {
  AnalyticCad cad;
  cad.faces[1] = {
      helicoid_jet,
      {testing::segment({0, 0}, {5, 0}), testing::segment({5, 0}, {0, 0.6}), testing::segment({0, 0.6}, {0, 0})}};
  Monitor monitor;
  const auto session = meshed(std::move(cad), 0.35, monitor);
  const FlatMesh mesh = session->exported();
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) EXPECT_LT(norm(mesh.vertices[t[i]] - mesh.vertices[t[(i + 1) % 3]]), 0.8);
}

}  // namespace
}  // namespace carreau
