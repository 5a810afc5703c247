// SPDX-License-Identifier: BSD-3-Clause
// Edges prescribed on curves, through a whole run: all faces keep them, the mesh conforms, contradictions are reported.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "common/analytic_cad.h"
#include "session/session.h"
#include "support/error.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
using testing::AnalyticFace;
constexpr double pi = std::numbers::pi;

class Listener final : public Monitor {
 public:
  void message(Level level, std::string_view text) override {
    if (level == Level::warning || level == Level::error) texts.emplace_back(text);
  }
  [[nodiscard]] bool says(const std::string& part) const {
    return std::any_of(texts.begin(), texts.end(), [&](const auto& t) { return t.find(part) != std::string::npos; });
  }
  std::vector<std::string> texts;
};

struct Meshing {
  std::shared_ptr<AnalyticCad> cad;
  Listener monitor;
  Session session{monitor};

  Meshing(AnalyticCad geometry, double size) : cad(std::make_shared<AnalyticCad>(std::move(geometry))) {
    session.set_cad(cad);
    for (const char* name : {"hphydef", "hphymax"}) session.parameters().set(name, size);
    session.parameters().set("hphymin", size / 1000);
    session.parameters().set("verb", 100);
  }
  void make(Model model) {
    session.set_model(std::move(model));
    session.make_mesh();
    EXPECT_EQ(find_defects(session.mesh()), std::vector<std::string>{});
  }
  [[nodiscard]] const CurveMesh& curve(int ref) const {
    const auto& curves = session.mesh().curves;
    return *std::find_if(curves.begin(), curves.end(), [&](const CurveMesh& c) { return c.ref == ref; });
  }
  [[nodiscard]] std::vector<double> lengths(int ref) const {
    std::vector<double> lengths;
    const std::vector<std::int32_t>& chain = curve(ref).vertices;
    for (std::size_t k = 1; k < chain.size(); ++k)
      lengths.push_back(norm(session.mesh().vertices[chain[k]] - session.mesh().vertices[chain[k - 1]]));
    return lengths;
  }
};

std::shared_ptr<const PrescribedEdges> told(Progression kind, int edges, double ratio = 1, std::vector<double> t = {}) {
  PrescribedEdges told;
  told.progression = kind, told.edges = edges, told.ratio = ratio, told.t = std::move(t);
  return std::make_shared<const PrescribedEdges>(std::move(told));
}

SurfaceJet flat_jet(Vec2 p) { return {{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; }

/// [0, 1]^2 and [1, 2] x [0, 1]: curve 2, from point 2 to point 3, is the right side of the first one and, read
/// downwards, the left side of the second.
AnalyticCad two_squares() {
  AnalyticCad cad;
  cad.faces[1] = {flat_jet, testing::rectangle({0, 0}, {1, 1})};
  cad.faces[2] = {flat_jet, testing::rectangle({1, 0}, {2, 1})};
  return cad;
}
Model model_of_two_squares() {
  Model model;
  Face a{.ref = 1, .orientation = 1, .curves = {}, .points = {}},
      b{.ref = 2, .orientation = 1, .curves = {}, .points = {}};
  const auto curve = [](int ref, int end1, int end2) {
    return FaceCurve{.type = CurveType::boundary, .ref = ref, .end1 = end1, .end2 = end2};
  };
  a.curves = {curve(1, 1, 2), curve(2, 2, 3), curve(3, 3, 4), curve(4, 4, 1)};
  b.curves = {curve(5, 2, 5), curve(6, 5, 6), curve(7, 6, 3), curve(2, 3, 2)};
  model.faces = {a, b};
  return model;
}

TEST(PrescribedCurves, TwoFacesKeepThemInBoth) {
  for (const bool by_second : {false, true}) {
    Meshing run(two_squares(), 0.1);
    for (const char* name : {"CheckCloseEdges", "CheckAdjacentEdges"}) run.session.parameters().set(name, 20);
    run.session.parameters().set("stagger_strips", 1);
    Model model = model_of_two_squares();
    model.faces[by_second ? 1 : 0].curves[by_second ? 3 : 1].edges = told(Progression::geometric, 9, 1.5);
    run.make(model);
    std::vector<double> lengths = run.lengths(2);
    ASSERT_EQ(lengths.size(), 9U);
    if (by_second) std::reverse(lengths.begin(), lengths.end());  // along the second one's t
    for (std::size_t k = 0; k < 9; ++k)
      EXPECT_NEAR(lengths[k], 0.5 / (std::pow(1.5, 9) - 1) * std::pow(1.5, double(k)), 1e-10);
    EXPECT_NEAR(summarise_quality(run.session.exported()).area, 2, 1e-12);
    EXPECT_GT(summarise_shapes(run.session.exported(), 1).q2.min, 0.3);  // triangles grow from the short ones
  }
}

TEST(PrescribedCurves, KeepEachGivenParameter) {
  Meshing run(two_squares(), 0.2);
  Model model = model_of_two_squares();
  const std::vector<double> t{0.07, 0.3, 0.31, 0.9};
  model.faces[0].curves[0].edges = told(Progression::given, 0, 1, t);
  run.make(model);
  const std::vector<std::int32_t>& chain = run.curve(1).vertices;
  ASSERT_EQ(chain.size(), 6U);
  for (std::size_t k = 0; k < t.size(); ++k) EXPECT_EQ(run.session.mesh().vertices[chain[k + 1]], Vec3(t[k], 0, 0));
}

TEST(PrescribedCurves, OnASeamHoldOnBothOfItsSides) {
  AnalyticCad cad;
  cad.faces[1] = {[](Vec2 p) {
                    const double c = std::cos(p.x()), s = std::sin(p.x());
                    return SurfaceJet{{c, s, p.y()}, {-s, c, 0}, {0, 0, 1}, {-c, -s, 0}, {}, {}};
                  },
                  testing::rectangle({0, 0}, {2 * pi, 2})};
  Meshing run(cad, 0.3);
  Model model;
  Face face{.ref = 1, .orientation = 1, .curves = {}, .points = {}};
  face.curves = {{.ref = 1, .end1 = 1, .end2 = 1},
                 {.ref = 2, .end1 = 1, .end2 = 2},
                 {.ref = 3, .end1 = 2, .end2 = 2},
                 {.ref = 2, .end1 = 2, .end2 = 1, .edges = told(Progression::arithmetic, 6, 3)}};
  model.faces = {face};
  run.make(model);
  const std::vector<double> lengths = run.lengths(2);  // upwards; t of the fourth curve runs downwards
  ASSERT_EQ(lengths.size(), 6U);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(lengths[5 - k], 2.0 / 12 * (1 + 2 * double(k) / 5), 1e-10);
}

TEST(PrescribedCurves, GluedFacesKeepThemInBoth) {
  Meshing run(two_squares(), 0.1);
  Model model = testing::unglued(*run.cad);
  model.faces[1].curves[3].edges = told(Progression::equal, 3);
  run.make(model);
  EXPECT_EQ(run.lengths(2).size(), 3U);
}

TEST(PrescribedCurves, AreReportedWhereOtherSizesContradict) {
  Meshing run(testing::hemisphere(), 0.5);
  run.session.parameters().set("hgeo_flag", 1);
  run.session.parameters().set("geo_guarantee", 1);
  Model model = testing::unglued(*run.cad);
  model.faces[0].curves[0].edges = told(Progression::equal, 3);
  run.make(model);
  EXPECT_EQ(run.lengths(1).size(), 3U);
  EXPECT_TRUE(run.monitor.says("curve of reference 1: the edges prescribed on it stay, although geo_guarantee") ||
              run.monitor.says("the edges prescribed on it stay, although geo_guarantee"));
}

TEST(PrescribedCurves, AreReportedWhereElementsHalveThem) {
  for (const char* element : {"p2", "q1.0", "q1.1"}) {
    Meshing run(two_squares(), 0.2);
    run.session.parameters().set("element", element);
    Model model = model_of_two_squares();
    model.faces[0].curves[1].edges = told(Progression::equal, 5);
    run.make(model);
    const bool halved = run.lengths(2).size() != 5;
    EXPECT_EQ(run.monitor.says("edges on it, and not the 5 that are prescribed"), halved) << element;
    EXPECT_EQ(halved, std::string(element) == "q1.1") << element;
  }
}

TEST(PrescribedCurves, KeepNarrowFacesFromCollapsing) {
  AnalyticCad cad;
  cad.faces[1] = {flat_jet, testing::rectangle({0, 0}, {1, 1})};
  cad.faces[2] = {flat_jet, testing::rectangle({1, 0}, {1.001, 1})};
  for (const bool prescribed : {false, true}) {
    Meshing run(cad, 0.2);
    run.session.parameters().set("eps_glue", 1e-5);
    run.session.parameters().set("narrow_faces", "collapse");
    Model model = model_of_two_squares();
    if (prescribed) model.faces[0].curves[1].edges = told(Progression::equal, 4);
    run.make(model);
    EXPECT_EQ(run.session.mesh().faces[1].status == FaceStatus::collapsed, !prescribed);
    EXPECT_EQ(run.monitor.says("although narrow_faces requires others"), prescribed);
    if (prescribed) {
      EXPECT_EQ(run.lengths(2).size(), 4U);
    }
  }
}

// A ring whose outer circle is prescribed as a triangle that crosses the inner circle.
TEST(PrescribedCurves, ThatCrossFailTheirFaceWithASentence) {
  AnalyticCad cad;
  AnalyticFace ring{flat_jet, {testing::arc({0, 0}, 1, 0, 2 * pi), testing::arc({0, 0}, 0.8, 0, -2 * pi)}};
  cad.faces[1] = ring;
  Meshing run(cad, 0.2);
  Model model;
  Face face{.ref = 1, .orientation = 1, .curves = {}, .points = {}};
  face.curves = {{.ref = 1, .end1 = 1, .end2 = 1, .edges = told(Progression::equal, 3)},
                 {.ref = 2, .end1 = 2, .end2 = 2}};
  model.faces = {face};
  run.session.set_model(model);
  try {
    run.session.make_mesh();
    FAIL() << "it was meshed";
  } catch (const DomainError& error) {
    EXPECT_NE(std::string(error.what()).find("the discretised boundary crosses itself"), std::string::npos)
        << error.what();
  }
  EXPECT_TRUE(run.monitor.says("the edges prescribed on it stay"));
}

TEST(PrescribedCurves, ThatContradictThemselvesEndTheRunAndLeaveNoFaceOut) {
  Meshing run(two_squares(), 0.2);
  run.session.parameters().set("failing_faces", "leave_out");
  Model model = model_of_two_squares();
  model.faces[0].curves[1].edges = told(Progression::equal, 5);
  model.faces[1].curves[3].edges = told(Progression::equal, 6);
  run.session.set_model(model);
  EXPECT_THROW(run.session.make_mesh(), InvalidModel);
}

TEST(PrescribedCurves, OneEdgeTwiceBetweenTwoPointsIsRejected) {
  AnalyticCad cad;
  cad.faces[1] = {flat_jet, {testing::arc({0, 0}, 1, 0, pi), testing::arc({0, 0}, 1, pi, 2 * pi)}};
  Meshing run(cad, 0.5);
  Model model = testing::unglued(cad);
  model.faces[0].curves[0].edges = model.faces[0].curves[1].edges = told(Progression::equal, 1);
  run.session.set_model(model);
  EXPECT_THROW(run.session.make_mesh(), InvalidModel);
  model.faces[0].curves[1].edges = nullptr;  // the other one gives way
  run.make(model);
  EXPECT_EQ(run.lengths(1).size(), 1U);
}

// ---- wires ----

/// A circle of radius 1 round (2, 0, 1), upright, and a line from the corner (1, 1, 0) of the first square.
AnalyticCad with_wires() {
  AnalyticCad cad = two_squares();
  const testing::AnalyticCurve along{{0, 2 * pi}, [](double t) { return CurveJet{{t, 0}, {1, 0}, {}}; }};
  cad.faces[7] = {[](Vec2 p) {
                    const double c = std::cos(p.x()), s = std::sin(p.x());
                    return SurfaceJet{{2 + c, 0, 1 + s}, {-s, 0, c}, {}, {-c, 0, -s}, {}, {}};
                  },
                  {along}};
  cad.faces[8] = {[](Vec2 p) {
                    return SurfaceJet{{1, 1, p.x()}, {0, 0, 1}, {}, {}, {}, {}};
                  },
                  {{{0, 3}, [](double t) {
                      return CurveJet{{t, 0}, {1, 0}, {}};
                    }}}};
  return cad;
}
Model model_with_wires() {
  Model model = model_of_two_squares();
  Face circle{.ref = 7, .orientation = 0, .curves = {}, .points = {}},
      line{.ref = 8, .orientation = 0, .curves = {}, .points = {}};
  circle.curves = {{.type = CurveType::internal, .ref = 17, .end1 = 17, .end2 = 17}};
  line.curves = {{.type = CurveType::internal, .ref = 18, .end1 = 3, .end2 = 18}};
  model.faces.push_back(circle), model.faces.push_back(line);
  return model;
}

std::int64_t edges_of_reference(const FlatMesh& flat, int ref) {
  return std::count(flat.edge_refs.begin(), flat.edge_refs.end(), ref);
}

TEST(Wires, AreEdgesOfTheMeshAndShareItsVertices) {
  Meshing run(with_wires(), 0.1);
  run.make(model_with_wires());
  const SurfaceMesh& mesh = run.session.mesh();
  EXPECT_EQ(run.curve(17).vertices.size(), 64U);  // 2 pi / 0.1 = 62.8: 63 edges
  EXPECT_EQ(run.curve(17).vertices.front(), run.curve(17).vertices.back());
  for (const std::int32_t v : run.curve(17).vertices)
    EXPECT_NEAR(std::hypot(mesh.vertices[v].x() - 2, mesh.vertices[v].z() - 1), 1, 1e-14);
  for (const double length : run.lengths(17)) EXPECT_NEAR(length, 2 * std::sin(pi / 63), 1e-5);
  EXPECT_EQ(run.lengths(18).size(), 30U);
  EXPECT_EQ(run.curve(18).vertices.front(), run.curve(2).vertices.back());  // point 3
  EXPECT_EQ(mesh.loose_edge_count(), 93U);
  // With and without the export of other edges.
  for (const int flag : {0, 1}) {
    run.session.parameters().set("flag", flag);
    const FlatMesh flat = run.session.exported();
    EXPECT_EQ(edges_of_reference(flat, 17), 63);
    EXPECT_EQ(edges_of_reference(flat, 18), 30);
    EXPECT_EQ(edges_of_reference(flat, 2), flag == 1 ? 10 : 0);
    EXPECT_EQ(flat.faces.size(), 2U);
  }
}

TEST(Wires, FollowTheirCurvature) {
  Meshing run(with_wires(), 0.1);
  run.session.parameters().set("hphy_flag", 0);
  run.session.parameters().set("hgeo_flag", 1);
  run.session.parameters().set("hgeomax", 0.5);
  run.make(model_with_wires());
  // HDR eq. 2.33: 2 sin(8 degrees) = 0.278 of the radius, 22.6 edges; the line has the largest size.
  EXPECT_EQ(run.lengths(17).size(), 23U);
  EXPECT_EQ(run.lengths(18).size(), 6U);
}

/// Sizes that grow with z, in the answer of surfaces alone.
class GrowingWithHeight final : public PrescriptionSource {
 public:
  Prescription on_surface(int, Vec2, Vec3 xyz) override { return Prescription::of_size(0.1 + 0.1 * xyz.z()); }
  Prescription on_curve(int, int, double, Vec2, Vec3) override { return {}; }
  Prescription at_point(int, Vec3) override { return {}; }
};

TEST(Wires, FollowSizesByPlace) {
  Meshing run(with_wires(), 10);
  run.session.set_prescription_source(std::make_shared<GrowingWithHeight>());
  run.make(model_with_wires());
  const std::vector<double> lengths = run.lengths(18);  // from z = 0 to 3: 10 log(4) = 13.9 edges
  ASSERT_EQ(lengths.size(), 14U);
  EXPECT_NEAR(lengths.front(), 0.1 * (std::pow(4, 1 / 14.) - 1) / 0.1, 2e-3);
  for (std::size_t k = 1; k < lengths.size(); ++k) EXPECT_NEAR(lengths[k] / lengths[k - 1], std::pow(4, 1 / 14.), 0.01);
}

TEST(Wires, TakePrescriptionsAndNodes) {
  Meshing run(with_wires(), 0.1);
  run.session.parameters().set("element", "p2");
  Model model = model_with_wires();
  model.faces[2].curves[0].edges = told(Progression::equal, 12);
  run.make(model);
  ASSERT_EQ(run.lengths(17).size(), 12U);
  ASSERT_EQ(run.curve(17).mid.size(), 12U);
  for (const std::int32_t mid : run.curve(17).mid) {
    const Vec3& p = run.session.mesh().mid_vertices[mid];
    EXPECT_NEAR(std::hypot(p.x() - 2, p.z() - 1), 1, 1e-12);
  }
  EXPECT_EQ(edges_of_reference(run.session.exported(), 17), 12);
  EXPECT_EQ(run.session.exported().edge_mids.size(), run.session.exported().edges.size());
}

TEST(Wires, HaveTheirSizesWhateverTheElements) {
  for (const char* element : {"p1", "p2", "q1.0", "q1.1", "q2.1"}) {
    Meshing run(with_wires(), 0.1);
    run.session.parameters().set("element", element);
    run.make(model_with_wires());
    EXPECT_NEAR(double(run.lengths(17).size()), 63, 0.05 * 63) << element;  // halved with the quadrilaterals
    const FlatMesh flat = run.session.exported();
    EXPECT_EQ(edges_of_reference(flat, 17), std::ssize(run.lengths(17))) << element;
  }
}

TEST(Wires, AloneAreAMesh) {
  Meshing run(with_wires(), 0.25);
  Model model = model_with_wires();
  model.faces.erase(model.faces.begin(), model.faces.begin() + 2);
  run.make(model);
  EXPECT_EQ(run.session.mesh().triangle_count(), 0U);
  EXPECT_EQ(run.session.exported().edges.size(), 25U + 12U);
  EXPECT_NEAR(run.session.report().diag, std::sqrt(4 + 1 + 9), 1e-3);  // the box of circle and line: 2 x 1 x 3
}

TEST(Wires, ChangeNothingOfTheFaces) {
  Meshing with(with_wires(), 0.1), without(two_squares(), 0.1);
  for (Meshing* run : {&with, &without}) {
    run->session.parameters().set("gradation", 1.3);
    run->session.parameters().set("CheckCloseEdges", 20);
    run->session.parameters().set("measure", 1);
    run->session.parameters().set("cracks", 1);
    run->make(run == &with ? model_with_wires() : model_of_two_squares());
  }
  EXPECT_EQ(with.session.mesh().triangle_count(), without.session.mesh().triangle_count());
  EXPECT_EQ(with.session.report().diag, without.session.report().diag);
  EXPECT_EQ(with.session.mesh().faces[0].uv, without.session.mesh().faces[0].uv);
}

// The end of the line is glued to the corners of the squares, and cuts nothing.
TEST(Wires, AreGluedAtTheirEnds) {
  Meshing run(with_wires(), 0.1);
  Model model = testing::unglued(*run.cad);
  for (const std::size_t f : {2U, 3U}) {
    model.faces[f].orientation = 0;
    model.faces[f].curves[0].type = CurveType::internal;
  }
  run.make(model);
  const std::vector<CurveMesh>& curves = run.session.mesh().curves;
  EXPECT_EQ(curves.back().vertices.front(), curves[1].vertices.back());
  EXPECT_TRUE(curves.back().loose);
}

TEST(Wires, HaveCurvesAndNeitherBordersNorPoints) {
  Meshing run(with_wires(), 0.1);
  Model model = model_with_wires();
  model.faces[2].curves[0].type = CurveType::boundary;
  EXPECT_THROW(run.session.set_model(model), InvalidModel);
  model = model_with_wires();
  model.faces[2].points.push_back({1, {0.5, 0}});
  EXPECT_THROW(run.session.set_model(model), InvalidModel);
  model = model_with_wires();
  model.faces[2].curves.clear();
  EXPECT_THROW(run.session.set_model(model), InvalidModel);
}

}  // namespace
}  // namespace carreau
