// SPDX-License-Identifier: BSD-3-Clause
// Curves that are common in part only: cut, glued and meshed (HDR sec. 4.5.1, fig. 4.18-4.20).
#include "session/gluing.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>
#include <set>
#include <tuple>

#include "common/analytic_cad.h"
#include "model/splits.h"
#include "session/session.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
using testing::AnalyticFace;

class GluingRecorder final : public Monitor {
 public:
  void message(Level level, std::string_view text) override {
    if (level == Level::summary || level == Level::warning) texts.emplace_back(text);
    if (level == Level::detail) details.emplace_back(text);
  }
  [[nodiscard]] bool says(const std::string& part) const {
    return std::any_of(texts.begin(), texts.end(), [&](const auto& t) { return t.find(part) != std::string::npos; });
  }
  std::vector<std::string> texts, details;
};

/// A plane polygon, counterclockwise, lifted to z.
AnalyticFace polygon(const std::vector<Vec2>& corners, double z) {
  AnalyticFace face{[z](Vec2 p) { return SurfaceJet{{p.x(), p.y(), z}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; }, {}};
  for (std::size_t i = 0; i < corners.size(); ++i)
    face.curves.push_back(testing::segment(corners[i], corners[(i + 1) % corners.size()]));
  return face;
}

struct Patches {
  std::shared_ptr<AnalyticCad> cad;
  GluingRecorder monitor;
  Session session{monitor};

  Patches(AnalyticCad geometry, double size, double eps_glue)
      : cad(std::make_shared<AnalyticCad>(std::move(geometry))) {
    session.set_cad(cad);
    session.set_model(testing::unglued(*cad));
    session.parameters().set("hphydef", size);
    session.parameters().set("hphymin", size / 100);
    session.parameters().set("eps_glue", eps_glue);
    session.parameters().set("verb", 100);
  }
  /// Vertices - edges + triangles.
  [[nodiscard]] long euler() const {
    const QualitySummary q = summarise_quality(session.exported());
    const auto& mesh = session.mesh();
    return static_cast<long>(mesh.vertices.size()) - static_cast<long>(q.edges) + static_cast<long>(q.triangles);
  }
  [[nodiscard]] long open_edges() const { return static_cast<long>(summarise_quality(session.exported()).open_edges); }
};

/// Three patches as in HDR fig. 4.18: two polygons of seven sides that share one, on the upper side of a rectangle.
AnalyticCad three_patches(double gap) {
  AnalyticCad cad;
  cad.faces[1] = polygon({{0, 0}, {6, 0}, {6, 1}, {0, 1}}, 0);
  cad.faces[2] = polygon({{0.8, 1 + gap}, {3, 1 + gap}, {3, 2}, {2.5, 3}, {1.5, 3.4}, {0.6, 3}, {0.3, 2}}, gap);
  cad.faces[3] =
      polygon({{3 + gap, 1 + gap}, {5.2, 1 + gap}, {5.6, 2}, {5.4, 3}, {4.5, 3.4}, {3.5, 3}, {3 + gap, 2}}, -gap);
  return cad;
}

TEST(Gluing, CutsTheRectangleOfFigure418) {
  Patches run(three_patches(1e-3), 0.2, 0.01);
  run.session.make_mesh();
  EXPECT_EQ(find_defects(run.session.mesh()), std::vector<std::string>{});
  const Model& model = run.session.model();
  // 18 curves; points 9, 10 and 24 of the figure cut the upper side of the rectangle into four.
  ASSERT_EQ(model.faces[0].curves.size(), 7U);
  EXPECT_EQ(model.faces[1].curves.size() + model.faces[2].curves.size(), 14U);
  const double expected[][2] = {{0, 0.8 / 6}, {0.8 / 6, 0.5}, {0.5, 5.2 / 6}, {5.2 / 6, 1}};
  const std::size_t parts[] = {2, 6, 5, 4};  // the side runs from x = 6 to x = 0
  for (int i = 0; i < 4; ++i) {
    const FaceCurve& part = model.faces[0].curves[parts[i]];
    EXPECT_EQ(part.part_of, 3);
    EXPECT_EQ(host_rank(model.faces[0], parts[i]), 3);
  }
  EXPECT_NEAR(model.faces[0].curves[2].part_b, 1 - expected[3][0], 1e-3);
  EXPECT_NEAR(model.faces[0].curves[4].part_b, 1 - expected[2][0], 1e-3);
  EXPECT_NEAR(model.faces[0].curves[5].part_b, 1 - expected[1][0], 1e-3);
  EXPECT_EQ(model.faces[0].curves[6].part_b, 1);
  EXPECT_TRUE(run.monitor.says("3 pairs of curves are one"));
  EXPECT_TRUE(run.monitor.says("3 cuts were made"));
  EXPECT_TRUE(run.monitor.says("15 curves are open"));
  // A disc, conforming: free edges only on the 15 free curves, and each edge on them is free.
  EXPECT_EQ(run.euler(), 1);
  long on_free_curves = 0;
  for (const CurveMesh& curve : run.session.mesh().curves)
    if (curve.uses.size() == 1) on_free_curves += static_cast<long>(curve.vertices.size()) - 1;
  EXPECT_EQ(run.open_edges(), on_free_curves);
  // The second mesh uses the interfaces found before.
  run.session.parameters().set("hphydef", 0.3);
  run.session.make_mesh();
  EXPECT_EQ(run.euler(), 1);
}

/// As a host that knows the loops of each face and nothing else.
Model with_references(AnalyticCad& cad) {
  Model model = testing::unglued(cad);
  int next = 0;
  for (Face& face : model.faces) {
    const int n = static_cast<int>(face.curves.size());
    for (int i = 0; i < n; ++i) {
      FaceCurve& curve = face.curves[static_cast<std::size_t>(i)];
      curve.ref = next + i + 1, curve.end1 = next + i + 1, curve.end2 = next + (i + 1) % n + 1;
    }
    next += n;
  }
  return model;
}

TEST(Gluing, OpenCurvesKeepReferences) {
  Patches run(three_patches(1e-3), 0.2, 0.01);
  const Model known = with_references(*run.cad);
  run.session.set_model(known);
  run.session.make_mesh();
  EXPECT_EQ(run.euler(), 3);  // no option is set
  run.session.parameters().set("glue_open", 1);
  run.session.make_mesh();
  EXPECT_EQ(find_defects(run.session.mesh()), std::vector<std::string>{});
  EXPECT_EQ(run.euler(), 1);
  EXPECT_TRUE(run.monitor.says("3 pairs of curves are one"));
  EXPECT_TRUE(run.monitor.says("3 cuts were made"));
  const Model& model = run.session.model();
  std::set<int> refs;
  for (const Face& face : known.faces)
    for (const FaceCurve& curve : face.curves) refs.insert(curve.ref);
  // Only the three parts that were cut off, and their glued partners, have new ones.
  std::set<int> fresh;
  for (const Face& face : model.faces)
    for (const FaceCurve& curve : face.curves)
      if (!refs.contains(curve.ref)) fresh.insert(curve.ref);
  EXPECT_EQ(fresh.size(), 3U);
  long glued = 0;
  for (const Interface& each : run.session.interfaces()) {
    glued += each.glued ? 1 : 0;
    EXPECT_EQ(each.uses, each.glued ? 2 : 1);
    EXPECT_LT(each.gap, 0.003);
  }
  EXPECT_EQ(glued, 3);
  // A second run finds nothing more, and remembers.
  run.session.make_mesh();
  EXPECT_EQ(run.euler(), 1);
  EXPECT_EQ(std::count_if(run.session.interfaces().begin(), run.session.interfaces().end(),
                          [](const Interface& i) { return i.glued; }),
            3);
}

TEST(Gluing, OpenCurvesLeaveSharedOnesAlone) {
  // Two pairs of squares; the sides x = 1 of each pair have one reference, the pairs only touch along y = 1.
  AnalyticCad cad;
  cad.faces[1] = polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0);
  cad.faces[2] = polygon({{1, 0}, {2, 0}, {2, 1}, {1, 1}}, 0);
  cad.faces[3] = polygon({{0, 1}, {1, 1}, {1, 2}, {0, 2}}, 0);
  Patches run(std::move(cad), 0.2, 0.001);
  Model model = with_references(*run.cad);
  FaceCurve& shared = model.faces[1].curves[3];
  const FaceCurve& other = model.faces[0].curves[1];
  // Against the other use: (1, 1) to (1, 0).
  shared.ref = other.ref, shared.end1 = other.end2, shared.end2 = other.end1;
  model.faces[1].curves[0].end1 = other.end1;
  model.faces[1].curves[2].end2 = other.end2;
  run.session.set_model(model);
  run.session.parameters().set("glue_open", 1);
  run.session.make_mesh();
  EXPECT_EQ(run.euler(), 1);
  EXPECT_TRUE(run.monitor.says("1 pair of curves is one"));
  for (const Interface& each : run.session.interfaces()) {
    EXPECT_EQ(each.glued, each.ref == model.faces[0].curves[2].ref);
  }
  EXPECT_EQ(run.session.model().faces[1].curves[3].ref, other.ref);
}

TEST(Gluing, LeavesGapsAboveItsTolerance) {
  Patches run(three_patches(0.05), 0.2, 0.01);
  run.session.make_mesh();
  EXPECT_TRUE(run.monitor.says("0 pairs of curves are one"));
  EXPECT_FALSE(run.monitor.says("cut"));
  EXPECT_EQ(run.euler(), 3);
}

TEST(Gluing, FindsTheCommonPartOfTwoShiftedSides) {
  AnalyticCad cad;
  cad.faces[1] = polygon({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, 0);
  cad.faces[2] = polygon({{1, 1}, {3, 1}, {3, 2}, {1, 2}}, 0);
  Patches run(std::move(cad), 0.1, 0.001);
  run.session.make_mesh();
  EXPECT_TRUE(run.monitor.says("1 pair of curves is one"));
  EXPECT_TRUE(run.monitor.says("2 cuts were made"));
  EXPECT_EQ(find_defects(run.session.mesh()), std::vector<std::string>{});
  EXPECT_EQ(run.euler(), 1);
  EXPECT_NEAR(summarise_quality(run.session.exported()).area, 4, 1e-12);
}

// The smaller tolerance is below the bulge of circles off their polylines: the end of one lies on the other all the
// same.
TEST(Gluing, ClosesACylinderWhoseLidStartsElsewhere) {
  constexpr double two_pi = 2 * std::numbers::pi;
  for (const double eps : {1e-3, 1e-7}) {
    AnalyticCad cad;
    cad.faces[1] = {[](Vec2 p) {
                      const double c = std::cos(p.x()), s = std::sin(p.x());
                      return SurfaceJet{{c, s, p.y()}, {-s, c, 0}, {0, 0, 1}, {-c, -s, 0}, {}, {}};
                    },
                    testing::rectangle({0, 0}, {two_pi, 1})};
    cad.faces[2] = polygon({{0, 0}}, 1);
    cad.faces[2].curves = {testing::arc({0, 0}, 1, 0.9, 0.9 + two_pi)};
    Patches run(std::move(cad), 0.1, eps);
    run.session.make_mesh();
    EXPECT_EQ(find_defects(run.session.mesh()), std::vector<std::string>{});
    EXPECT_EQ(run.euler(), 1);  // a cup
    EXPECT_TRUE(run.monitor.says("1 curve is open"));
    EXPECT_EQ(run.open_edges(), 63);  // the free circle: 2 pi / 0.1
  }
}

// Near the polyline, but farther from the arc than the tolerance.
TEST(Gluing, CutsNoArcWhereOnlyItsChordsAreNear) {
  constexpr double two_pi = 2 * std::numbers::pi;
  AnalyticCad cad;
  cad.faces[1] = polygon({{0, 0}}, 0);
  cad.faces[1].curves = {testing::arc({0, 0}, 1, 0, two_pi)};
  const double angle = 0.7;
  cad.faces[2] = polygon({{(1 + 1e-5) * std::cos(angle), (1 + 1e-5) * std::sin(angle)}, {2, 0.5}, {2, 1}}, 0);
  Patches run(std::move(cad), 0.2, 1e-7);
  run.session.make_mesh();
  EXPECT_FALSE(run.monitor.says("cut"));
  EXPECT_TRUE(run.monitor.says("4 curves are open"));
}

TEST(Gluing, TheReferenceOfTheFirstCurveDecides) {
  // RT-0232 sec. 3.2: it alone is 0, and all are found.
  const auto mesh_of = [](int others, bool& said) {
    Patches run(three_patches(0), 0.2, 0.01);
    Model model = testing::unglued(three_patches(0));
    for (Face& face : model.faces)
      for (FaceCurve& curve : face.curves) curve.ref = others, curve.end1 = others, curve.end2 = -others;
    model.faces[0].curves[0].ref = 0;
    run.session.set_model(model);
    run.session.make_mesh();
    said = run.monitor.says("the first curve of the model has the reference 0: all references are found");
    return run.session.mesh().vertices;
  };
  bool said_of_zeros = true, said_of_others = false;
  EXPECT_EQ(mesh_of(0, said_of_zeros), mesh_of(7, said_of_others));
  EXPECT_FALSE(said_of_zeros);
  EXPECT_TRUE(said_of_others);
}

// RT-0232 sec. 3.2: x.pardom.new "can be used again", also where curves were cut.
TEST(Gluing, WritesPartsIntoTheManualsFileWhichGivesTheSameMesh) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "carreau gluing";
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / "x.pardom", glued = file.string() + ".new";
  std::filesystem::remove(glued);
  Patches run(three_patches(0), 0.2, 0.01);
  {
    std::ofstream out(file);
    out << "3\n";
    for (const auto& [face, curves] : {std::pair{1, 4}, {2, 7}, {3, 7}}) {
      out << face << "\n1\n" << curves << "\n";
      for (int c = 0; c < curves; ++c) out << "1 0 0 0\n";
      out << "0\n";
    }
  }
  run.session.load_pardom(file.string());
  run.session.make_mesh();
  ASSERT_TRUE(std::filesystem::exists(glued));
  EXPECT_EQ(run.euler(), 1);

  Patches again(three_patches(0), 0.2, 0.01);
  again.session.load_pardom(glued.string());
  const std::vector<Face>& before = run.session.model().faces;
  const std::vector<Face>& read = again.session.model().faces;
  std::size_t parts = 0;
  for (std::size_t f = 0; f < before.size(); ++f) {
    ASSERT_EQ(read[f].curves.size(), before[f].curves.size());
    for (std::size_t c = 0; c < before[f].curves.size(); ++c) {
      const FaceCurve &p = before[f].curves[c], &q = read[f].curves[c];
      EXPECT_EQ(std::tie(p.ref, p.end1, p.end2, p.part_of, p.part_a, p.part_b),
                std::tie(q.ref, q.end1, q.end2, q.part_of, q.part_a, q.part_b));
      parts += p.part_of != 0 ? 1 : 0;
    }
  }
  EXPECT_EQ(parts, 4U);  // of the upper side of the rectangle
  again.session.make_mesh();
  EXPECT_EQ(again.session.mesh().vertices, run.session.mesh().vertices);
  for (std::size_t f = 0; f < 3; ++f)
    EXPECT_EQ(again.session.mesh().faces[f].triangles, run.session.mesh().faces[f].triangles);
}

// Two long sides of one face, 0.002 apart: a thousandth of eps_glue keeps them, eps_glue_face = 0.005 makes a seam.
TEST(Gluing, SidesOfOneFaceAreASeamWithinEpsGlueFace) {
  AnalyticCad cad;
  const auto bent = [](Vec2 p) {
    const double a = p.x(), c = std::cos(a), s = std::sin(a);
    return SurfaceJet{{c, s, p.y()}, {-s, c, 0}, {0, 0, 1}, {-c, -s, 0}, {}, {}};
  };
  cad.faces[1] = {bent, testing::rectangle({0, 0}, {2 * std::numbers::pi - 0.002, 2})};
  for (const double eps : {0.0, 0.001, 0.005}) {
    Patches run(cad, 0.2, 0.05);
    run.session.parameters().set("eps_glue_face", eps);
    run.session.make_mesh();
    const std::vector<FaceCurve>& curves = run.session.model().faces[0].curves;
    EXPECT_EQ(curves[1].ref == curves[3].ref, eps == 0.005) << eps;
  }
}

TEST(Splits, NeedAnEndOfAnotherFaceAwayFromTheEndsOfTheCurve) {
  const auto line = [](Vec3 p, Vec3 q) { return std::vector<Vec3>{p, q}; };
  Model model;
  model.faces.resize(2);
  model.faces[0].ref = 1, model.faces[1].ref = 2;
  model.faces[0].curves.resize(2), model.faces[1].curves.resize(1);
  const CurveTraces traces{{line({0, 0, 0}, {10, 0, 0}), line({4, 0, 0}, {4, 1, 0})},
                           {line({3, 0.005, 0}, {9.995, 0.005, 0})}};
  const auto splits = find_splits(model, traces, 0.01);
  ASSERT_EQ(splits.size(), 2U);  // not at 4, of the same face; not at 9.995, which is the end
  EXPECT_EQ(splits[1].face, 1U);
  EXPECT_NEAR(splits[1].arc, 1, 1e-12);
  EXPECT_EQ(splits[0].face, 0U);
  EXPECT_EQ(splits[0].curve, 0U);
  EXPECT_NEAR(splits[0].arc, 3, 1e-12);
  EXPECT_NEAR(splits[0].gap, 0.005, 1e-15);
  EXPECT_TRUE(find_splits(model, traces, 0.004).empty());
  EXPECT_THROW(find_splits(model, traces, 0), InvalidArgument);
  EXPECT_THROW(cut_curves(model, std::vector<CurveCut>{{0, 0, 0, 1, {0.5, 0.5}}}), InvalidArgument);
}

}  // namespace
}  // namespace carreau
