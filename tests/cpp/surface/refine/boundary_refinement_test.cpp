// SPDX-License-Identifier: BSD-3-Clause
// Boundaries that no refinement can repair, or that need none: curves are not cut for ever, and not for nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numbers>

#include "common/analytic_cad.h"
#include "mesh/quality.h"
#include "metric/metric3_algebra.h"
#include "metric/prescription.h"
#include "session/session.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
constexpr double pi = std::numbers::pi;

SurfaceJet flat(Vec2 p) { return {{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; }

std::unique_ptr<Session> meshed(const AnalyticCad& cad, const Model& model, int passes, Monitor& monitor) {
  auto session = std::make_unique<Session>(monitor);
  session->set_cad(std::make_shared<AnalyticCad>(cad));
  session->set_model(model);
  session->parameters().set("hphydef", 0.1);
  session->parameters().set("hphymin", 1e-9);
  session->parameters().set("CheckCloseEdges", passes);
  session->make_mesh();
  return session;
}

/// Face `ref` with boundary curves of the given references that join the points in turn, loop by loop.
Face face_of(int ref, const std::vector<std::vector<std::array<int, 2>>>& loops) {
  Face face{.ref = ref, .orientation = 1, .curves = {}, .points = {}};
  for (const auto& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i)
      face.curves.push_back(
          {.type = CurveType::boundary, .ref = loop[i][0], .end1 = loop[i][1], .end2 = loop[(i + 1) % loop.size()][1]});
  return face;
}

std::vector<testing::AnalyticCurve> with_hole(std::vector<testing::AnalyticCurve> outer,
                                              std::vector<testing::AnalyticCurve> hole) {
  outer.insert(outer.end(), hole.begin(), hole.end());
  return outer;
}

std::vector<testing::AnalyticCurve> rectangular_hole(Vec2 low, Vec2 high) {
  return {testing::segment(low, {low.x(), high.y()}), testing::segment({low.x(), high.y()}, high),
          testing::segment(high, {high.x(), low.y()}), testing::segment({high.x(), low.y()}, low)};
}

// A hole lies on the side that face 2 shares with face 1: its edges cross however short they are.
TEST(Refinement, CurvesThatLieOnEachOtherAreNotCutForEverNorForTheNeighbour) {
  AnalyticCad cad;
  cad.faces[1] = {flat, testing::rectangle({-1, 0}, {0, 1})};
  cad.faces[2] = {flat, with_hole(testing::rectangle({0, 0}, {1, 1}), rectangular_hole({0, 0.3}, {0.5, 0.6}))};
  Model model;
  model.faces.push_back(face_of(1, {{{1, 1}, {2, 2}, {3, 3}, {4, 4}}}));
  Monitor monitor;
  const auto alone = meshed(cad, model, 20, monitor);
  model.faces.push_back(face_of(2, {{{5, 2}, {6, 5}, {7, 6}, {2, 3}}, {{11, 11}, {12, 12}, {13, 13}, {14, 14}}}));
  const auto both = meshed(cad, model, 20, monitor);
  EXPECT_EQ(find_defects(both->mesh()), std::vector<std::string>{});
  EXPECT_EQ(both->exported().triangles.size(), alone->exported().triangles.size());
  EXPECT_NE(both->mesh().faces.at(1).why.find("meets itself"), std::string::npos) << both->mesh().faces.at(1).why;
}

/// As the command meshes CAD files, at a size of .1.
std::unique_ptr<Session> meshed_like_files(const AnalyticCad& cad, const Model& model, const char* narrow_faces,
                                           Monitor& monitor) {
  auto session = std::make_unique<Session>(monitor);
  session->set_cad(std::make_shared<AnalyticCad>(cad));
  session->set_model(model);
  session->parameters().set("hphydef", 0.1);
  session->parameters().set("hphymin", 1e-9);
  session->parameters().set("CheckCloseEdges", 20);
  session->parameters().set("CoefRectangle", 0.06);
  session->parameters().set("narrow_faces", narrow_faces);
  session->parameters().set("narrow_ratio", 4e-4);
  session->make_mesh();
  return session;
}

AnalyticCad polygon(const std::vector<Vec2>& corners) {
  AnalyticCad cad;
  cad.faces[1].at = flat;
  for (std::size_t i = 0; i < corners.size(); ++i)
    cad.faces[1].curves.push_back(testing::segment(corners[i], corners[(i + 1) % corners.size()]));
  return cad;
}

// A strip 40 sizes long that no collapse can remove. Edges of 2.9 widths have isosceles triangles of Q2 .70, right ones
// of .54.
TEST(Refinement, StripsWithoutNeighboursAreCutToTheirWidth) {
  const double length = 4, n = length / 0.1;
  for (const double width : {0.02, 0.005, 0.001, 0.0003}) {
    SCOPED_TRACE(width);
    Monitor monitor;
    const AnalyticCad cad = polygon({{0, 0}, {length, 0}, {length, width}, {0, width}});
    const auto run = meshed_like_files(cad, testing::unglued(cad), "collapse", monitor);
    EXPECT_EQ(find_defects(run->mesh()), std::vector<std::string>{});
    const QualitySummary quality = summarise_quality(run->exported());
    EXPECT_LT(static_cast<double>(quality.triangles), 4.1 * n * n);
    EXPECT_GT(quality.q2.mean, 2.9 * width > 0.1 / n ? 0.54 : 0.25);
    const auto kept = meshed_like_files(cad, testing::unglued(cad), "keep", monitor);
    EXPECT_LT(summarise_quality(kept->exported()).q2.mean, quality.q2.mean);
  }
}

// Up to the tips, as far as the number of triangles allows.
TEST(Refinement, NeedlesWithoutNeighboursAreCutToTheirWidth) {
  const double length = 4, n = length / 0.1;
  for (const double height : {0.04, 0.01, 0.004}) {
    SCOPED_TRACE(height);
    Monitor monitor;
    const AnalyticCad cad = polygon({{0, 0}, {length, 0}, {1, height}});
    const auto run = meshed_like_files(cad, testing::unglued(cad), "collapse", monitor);
    EXPECT_EQ(find_defects(run->mesh()), std::vector<std::string>{});
    const QualitySummary quality = summarise_quality(run->exported());
    EXPECT_LT(static_cast<double>(quality.triangles), 4.1 * n * n);
    EXPECT_GT(quality.q2.mean, 0.4);
  }
}

// Short edges would spoil the face beside it.
TEST(Refinement, StripsBesideOtherFacesAreNotCutToTheirWidth) {
  const double length = 4, width = 0.01;
  AnalyticCad cad;
  cad.faces[1] = {flat, testing::rectangle({0, 0}, {length, width})};
  cad.faces[2] = {flat, testing::rectangle({0, width}, {length, 2})};
  Model model;
  model.faces.push_back(face_of(1, {{{1, 1}, {2, 2}, {3, 3}, {4, 4}}}));
  model.faces.push_back(face_of(2, {{{3, 4}, {5, 3}, {6, 5}, {7, 6}}}));
  Monitor monitor;
  const auto run = meshed_like_files(cad, model, "collapse", monitor),
             kept = meshed_like_files(cad, model, "keep", monitor);
  EXPECT_EQ(find_defects(run->mesh()), std::vector<std::string>{});
  EXPECT_EQ(run->exported().triangles, kept->exported().triangles);
}

// Close in space, but the face does not lie between: the two borders of a slit in a tube, and of a slit in a plane.
TEST(Refinement, BordersWithTheOutsideBetweenThemAreNoNarrowZone) {
  for (const double gap : {1e-3, 1e-5}) {
    SCOPED_TRACE(gap);
    AnalyticCad tube, plane;
    tube.faces[1] = {[](Vec2 p) {
                       const double c = std::cos(p.x()), s = std::sin(p.x());
                       return SurfaceJet{{c, s, p.y()}, {-s, c, 0}, {0, 0, 1}, {-c, -s, 0}, {}, {}};
                     },
                     testing::rectangle({gap, 0}, {2 * pi - gap, 2})};
    plane.faces[1] = {flat,
                      with_hole(testing::rectangle({0, 0}, {1, 1}), rectangular_hole({0.3, 0.5}, {0.7, 0.5 + gap}))};
    Model one_loop, two_loops;
    one_loop.faces.push_back(face_of(1, {{{1, 1}, {2, 2}, {3, 3}, {4, 4}}}));
    two_loops.faces.push_back(face_of(1, {{{1, 1}, {2, 2}, {3, 3}, {4, 4}}, {{5, 5}, {6, 6}, {7, 7}, {8, 8}}}));
    Monitor monitor;
    EXPECT_EQ(meshed(tube, one_loop, 20, monitor)->exported().triangles.size(),
              meshed(tube, one_loop, 0, monitor)->exported().triangles.size());
    // Away from the slit's ends: these are short, and refine their neighbours.
    const auto on_slit = [&](int passes) {
      const FlatMesh mesh = meshed(plane, two_loops, passes, monitor)->exported();
      return std::count_if(mesh.vertices.begin(), mesh.vertices.end(),
                           [&](Vec3 p) { return 0.4 < p.x() && p.x() < 0.6 && (p.y() == 0.5 || p.y() == 0.5 + gap); });
    };
    EXPECT_GE(on_slit(0), 2);
    EXPECT_EQ(on_slit(20), on_slit(0));
  }
}

// And where the face does lie between them, edges are no longer than four times the width, in as many passes as that
// takes.
TEST(Refinement, NarrowZonesAreRefinedOnBothSides) {
  const double width = 0.004;
  AnalyticCad cad;
  cad.faces[1] = {flat, testing::rectangle({0, 0}, {1, width})};
  Model model;
  model.faces.push_back(face_of(1, {{{1, 1}, {2, 2}, {3, 3}, {4, 4}}}));
  Monitor monitor;
  const auto session = meshed(cad, model, 20, monitor);
  const FlatMesh mesh = session->exported();
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i)
      EXPECT_LE(norm(mesh.vertices[t[i]] - mesh.vertices[t[(i + 1) % 3]]), 4 * width * (1 + 1e-9) + width);
}

// In each of three faces at a corner the long direction is the short one of the next: whatever their edges are, one
// face has a short edge beside a long one.
class Turning : public PrescriptionSource {
 public:
  Prescription on_surface(int face, Vec2, Vec3) override { return of(face); }
  Prescription on_curve(int face, int, double, Vec2, Vec3) override { return of(face); }
  Prescription at_point(int, Vec3) override { return {}; }

 private:
  static Prescription of(int face) {
    Vec3 is_long{0, 0, 0};
    (face == 1 ? is_long.x() : face == 2 ? is_long.y() : is_long.z()) = 1;
    return Prescription::of_space(metric_of_sizes(is_long, 0.2, 0.02));
  }
};

TEST(Refinement, BalanceOfEdgesAtACornerEndsWhereverMetricsTurn) {
  AnalyticCad cad;
  const auto sides = testing::rectangle({0, 0}, {1, 1});
  cad.faces[1] = {[](Vec2 p) { return SurfaceJet{{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; }, sides};
  cad.faces[2] = {[](Vec2 p) { return SurfaceJet{{0, p.x(), p.y()}, {0, 1, 0}, {0, 0, 1}, {}, {}, {}}; }, sides};
  cad.faces[3] = {[](Vec2 p) { return SurfaceJet{{p.y(), 0, p.x()}, {0, 0, 1}, {1, 0, 0}, {}, {}, {}}; }, sides};
  Monitor monitor;
  Session session(monitor);
  session.set_cad(std::make_shared<AnalyticCad>(cad));
  session.set_model(testing::unglued(cad));
  session.set_prescription_source(std::make_shared<Turning>());
  session.parameters().set("hphymin", 1e-9);
  session.parameters().set("CheckAdjacentEdges", 40);
  session.make_mesh();
  EXPECT_EQ(find_defects(session.mesh()), std::vector<std::string>{});
  double shortest = 1;
  for (const CurveMesh& curve : session.mesh().curves)
    for (std::size_t i = 1; i < curve.vertices.size(); ++i)
      shortest = std::min(
          shortest, norm(session.mesh().vertices[curve.vertices[i]] - session.mesh().vertices[curve.vertices[i - 1]]));
  EXPECT_GE(shortest, 0.02 / 2 / 1.2);  // the size along curves, halved once
}

}  // namespace
}  // namespace carreau
