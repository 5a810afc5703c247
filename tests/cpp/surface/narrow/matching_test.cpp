// SPDX-License-Identifier: BSD-3-Clause
// Vertices of both sides of narrow faces at the same places, and sides that have no such places.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "common/analytic_cad.h"
#include "mesh/quality.h"
#include "session/session.h"
#include "surface/narrow/narrow_faces.h"
#include "surface/supports.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
using testing::AnalyticCurve;

SurfaceJet plane_jet(Vec2 p) { return {{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; }

// The logarithmic spiral r = exp(-slope angle), which shrinks by a fifth in half a turn.
const double slope = std::log(1.25) / std::numbers::pi;
AnalyticCurve spiral(double from, double to) {
  return {{0, 1}, [=](double t) {
            const double w = to - from, a = from + t * w, r = std::exp(-slope * a), c = std::cos(a), s = std::sin(a);
            const Vec2 p{r * c, r * s}, first{r * (-slope * c - s), r * (-slope * s + c)};
            const Vec2 second{r * ((slope * slope - 1) * c + 2 * slope * s), r * ((slope * slope - 1) * s - 2 * slope * c)};
            return CurveJet{p, w * first, w * w * second};
          }};
}

AnalyticCurve scaled(const AnalyticCurve& curve, double share, bool back) {
  return {curve.interval, [=](double t) {
            const CurveJet jet = curve.at(back ? 1 - t : t);
            return CurveJet{share * jet.c, (back ? -share : share) * jet.ct, share * jet.ctt};
          }};
}

/// A strip of the plane that winds inwards, `turns` times, and is as wide as its turns are apart at the inner side. The
/// nearest place on the opposite side lies farther inwards, so images of images follow each other up to the last turn.
std::vector<AnalyticCurve> wound(double turns) {
  const AnalyticCurve outer = spiral(0, 2 * std::numbers::pi * turns), inner = scaled(outer, 0.8, false);
  const Vec2 start = outer.at(0).c, end = outer.at(1).c;
  return {outer, testing::segment(end, 0.8 * end), scaled(outer, 0.8, true), testing::segment(0.8 * start, start)};
}
// Half the integral of r^2 over the angle, outer less inner.
double area_of_wound(double turns) {
  return (1 - 0.8 * 0.8) * (1 - std::exp(-4 * slope * std::numbers::pi * turns)) / (4 * slope);
}

/// A strip from (0, y) to (1, y + width), its upper side at another pace along its curve.
std::vector<AnalyticCurve> straight(double y, double width) {
  std::vector<AnalyticCurve> curves = testing::rectangle({0, y}, {1, y + width});
  curves[2].at = [=](double t) {
    const double bend = 0.5 / std::numbers::pi;
    return CurveJet{{1 - t - bend * std::sin(std::numbers::pi * t), y + width}, {-1 - 0.5 * std::cos(std::numbers::pi * t), 0}, {0.5 * std::numbers::pi * std::sin(std::numbers::pi * t), 0}};
  };
  return curves;
}

/// Faces in the plane with cut curves.
struct Cut {
  AnalyticCad cad;
  Monitor monitor;
  Model model;
  ModelSupports supports;
  Topology topology;
  std::vector<DiscreteCurve> curves;

  Cut(const std::vector<std::vector<AnalyticCurve>>& faces, double size) {
    for (const auto& curves_of_face : faces) {
      const int ref = static_cast<int>(cad.faces.size()) + 1;
      cad.faces[ref] = {plane_jet, curves_of_face};
    }
    const Model given = testing::unglued(cad);
    supports = build_supports(given, cad, 20, 1, monitor);
    model = glue(given, traces_of(supports), 1e-6);
    topology = build_topology(model, traces_of(supports), 1e-6);
    SizeParameters sizes;
    sizes.hphydef = size, sizes.hphymin = sizes.hgeomin = 1e-3, sizes.hphymax = sizes.hgeomax = 10;
    SizeRules rules(model, topology, cad, sizes);
    for (int c = 0; c < static_cast<int>(topology.curves.size()); ++c)
      curves.push_back(discretise_curve(curve_model(), c, rules));
  }
  CurveModel curve_model() { return {model, topology, supports.of_face, cad}; }
  [[nodiscard]] NarrowFace strip(int face, double width) const {
    return {.face = face, .width = width, .side = {Side{{0, false}}, Side{{2, true}}}, .end_cap = {Side{{3, true}}, Side{{1, false}}}};
  }
  [[nodiscard]] const std::vector<double>& fractions(int face, int curve) const {
    return curves[static_cast<std::size_t>(topology.curve_of[static_cast<std::size_t>(face)][static_cast<std::size_t>(curve)])].r;
  }
};

// The images of n vertices on all turns are some n times as many as turns: more than both sides have.
TEST(Matching, LeavesOutFacesWhoseSidesExchangeVerticesWithoutEnd) {
  Cut cut({wound(6), straight(5, 0.01)}, 0.11);
  const std::vector<NarrowFace> strips{cut.strip(0, 0.2), cut.strip(1, 0.01)};
  // Edges of the straight strip are cut on one side.
  for (const int segment : {7, 3, 1}) split_segment(cut.curves[static_cast<std::size_t>(cut.topology.curve_of[1][0])], segment, cut.curve_model());
  for (const bool from_the_start : {false, true}) {
    SCOPED_TRACE(from_the_start);
    const std::vector<DiscreteCurve> given = cut.curves;
    const SidesMatched matched = from_the_start ? match_sides(cut.curve_model(), strips, cut.curves)
                                                : complete_sides(cut.curve_model(), strips, cut.curves);
    EXPECT_EQ(matched.unmatched, std::vector<int>{0});
    for (const int side : {0, 2}) {
      const auto curve = static_cast<std::size_t>(cut.topology.curve_of[0][static_cast<std::size_t>(side)]);
      EXPECT_EQ(cut.curves[curve].r, given[curve].r);
      EXPECT_EQ(std::count(matched.changed.begin(), matched.changed.end(), static_cast<int>(curve)), 0);
    }
    // Lengths of straight sides are abscissas, whatever the pace of their parameters.
    const std::vector<double>&lower = cut.fractions(1, 0), &upper = cut.fractions(1, 2);
    ASSERT_EQ(lower.size(), upper.size());
    for (std::size_t i = 0; i < lower.size(); ++i) EXPECT_NEAR(lower[i], 1 - upper[upper.size() - 1 - i], 0.03);
  }
}

TEST(Matching, OfSidesThatCoincideHasTheVerticesOfBoth) {
  Cut cut({straight(0, 0)}, 0.013);
  for (const int segment : {40, 9, 2}) split_segment(cut.curves[static_cast<std::size_t>(cut.topology.curve_of[0][0])], segment, cut.curve_model());
  const std::size_t vertices = cut.fractions(0, 0).size() + cut.fractions(0, 2).size();
  const SidesMatched matched = complete_sides(cut.curve_model(), std::vector<NarrowFace>{cut.strip(0, 0)}, cut.curves);
  EXPECT_TRUE(matched.unmatched.empty());
  ASSERT_EQ(cut.fractions(0, 0).size(), cut.fractions(0, 2).size());
  EXPECT_LE(cut.fractions(0, 0).size(), vertices);
}

TEST(Matching, StripsThatCannotBeMatchedAreMeshedAsOtherFacesAre) {
  for (const char* mode : {"one_layer", "collapse"}) {
    SCOPED_TRACE(mode);
    AnalyticCad cad;
    cad.faces[1] = {plane_jet, wound(3)};
    Monitor monitor;
    Session session(monitor);
    session.set_cad(std::make_shared<AnalyticCad>(cad));
    session.set_model(testing::unglued(cad));
    session.parameters().set("hphydef", 0.08);
    session.parameters().set("hphymin", 0.01);
    session.parameters().set("hphymax", 1.0);
    session.parameters().set("narrow_faces", mode);
    session.parameters().set("narrow_ratio", 1.0);
    session.make_mesh();
    const SurfaceMesh& mesh = session.mesh();
    EXPECT_EQ(find_defects(mesh, {.closed = false, .limit = 5}), std::vector<std::string>{});
    EXPECT_EQ(mesh.faces.front().status, FaceStatus::meshed) << mesh.faces.front().why;
    const QualitySummary quality = summarise_quality(session.exported());
    EXPECT_NEAR(quality.area, area_of_wound(3), 0.02 * area_of_wound(3));
    EXPECT_GT(quality.q2.mean, 0.85);
  }
}

}  // namespace
}  // namespace carreau
