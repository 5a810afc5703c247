// SPDX-License-Identifier: BSD-3-Clause
// Vertices of both sides of narrow faces at the same places, and sides that have no such places.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string_view>
#include <vector>

#include "common/analytic_cad.h"
#include "session/session.h"
#include "surface/narrow/narrow_faces.h"
#include "surface/supports.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
using testing::AnalyticCurve;

SurfaceJet plane_jet(Vec2 p) { return {{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; }

// The logarithmic spiral r = exp(-slope angle), which shrinks by `half_turn` in half a turn.
constexpr double half_turn = 0.98;
const double slope = -std::log(half_turn) / std::numbers::pi;
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

/// A strip of the plane that winds inwards, `turns` times, as wide as it is apart from its next turn. The nearest
/// place on the opposite side lies farther inwards: images of images follow each other up to the last turn.
std::vector<AnalyticCurve> wound(double turns) {
  const AnalyticCurve outer = spiral(0, 2 * std::numbers::pi * turns);
  const Vec2 start = outer.at(0).c, end = outer.at(1).c;
  return {outer, testing::segment(end, half_turn * end), scaled(outer, half_turn, true), testing::segment(half_turn * start, start)};
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
  Cut cut({wound(12), straight(5, 0.01)}, 0.3);
  const std::vector<NarrowFace> strips{cut.strip(0, 0.02), cut.strip(1, 0.01)};
  // Edges of the straight strip are cut on one side.
  for (const int segment : {2, 1}) split_segment(cut.curves[static_cast<std::size_t>(cut.topology.curve_of[1][0])], segment, cut.curve_model());
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

TEST(Matching, SidesThatCoincideHaveTheVerticesOfBoth) {
  Cut cut({straight(0, 0)}, 0.013);
  for (const int segment : {40, 9, 2}) split_segment(cut.curves[static_cast<std::size_t>(cut.topology.curve_of[0][0])], segment, cut.curve_model());
  const std::size_t vertices = cut.fractions(0, 0).size() + cut.fractions(0, 2).size();
  const SidesMatched matched = complete_sides(cut.curve_model(), std::vector<NarrowFace>{cut.strip(0, 0)}, cut.curves);
  EXPECT_TRUE(matched.unmatched.empty());
  ASSERT_EQ(cut.fractions(0, 0).size(), cut.fractions(0, 2).size());
  EXPECT_LE(cut.fractions(0, 0).size(), vertices);
}

class Sentences final : public Monitor {
 public:
  void message(Level, std::string_view text) override {
    disagree = disagree || text.find("places along its sides disagree") != std::string_view::npos;
  }
  bool disagree = false;
};

// A strip that is left out is meshed like other faces.
TEST(Matching, StripsThatCannotBeMatchedAreMeshedAsOtherFacesAre) {
  const auto meshed = [](const char* mode, Sentences& sentences) {
    AnalyticCad cad;
    cad.faces[1] = {plane_jet, wound(8)};
    Session session(sentences);
    session.set_cad(std::make_shared<AnalyticCad>(cad));
    session.set_model(testing::unglued(cad));
    session.parameters().set("verb", 100);
    session.parameters().set("hphydef", 0.25);
    session.parameters().set("hphymin", 0.01);
    session.parameters().set("hphymax", 1.0);
    session.parameters().set("narrow_faces", mode);
    session.parameters().set("narrow_ratio", 0.1);
    session.make_mesh();
    EXPECT_EQ(find_defects(session.mesh(), {.closed = false, .limit = 5}), std::vector<std::string>{});
    return session.exported();
  };
  Sentences of_kept;
  const FlatMesh kept = meshed("keep", of_kept);
  EXPECT_FALSE(of_kept.disagree);
  for (const char* mode : {"one_layer", "collapse"}) {
    SCOPED_TRACE(mode);
    Sentences sentences;
    const FlatMesh mesh = meshed(mode, sentences);
    EXPECT_TRUE(sentences.disagree);
    EXPECT_EQ(mesh.vertices, kept.vertices);
    EXPECT_EQ(mesh.triangles, kept.triangles);
  }
}

}  // namespace
}  // namespace carreau
