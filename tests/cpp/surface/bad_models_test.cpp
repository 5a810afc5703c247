// SPDX-License-Identifier: BSD-3-Clause
// Hosts whose faces, curves and references do not fit together: a sentence, or one face that fails alone.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numbers>

#include "cad/difference_cad.h"
#include "common/analytic_cad.h"
#include "mesh/quality.h"
#include "session/session.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
using testing::segment;

SurfaceJet plane(Vec2 p, double z) { return {{p.x(), p.y(), z}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; }

AnalyticCad square(double z = 0) {
  AnalyticCad cad;
  cad.faces[1] = {[z](Vec2 p) { return plane(p, z); }, testing::rectangle({0, 0}, {1, 1})};
  return cad;
}
/// Curves 1 .. 4 from point to point.
Model square_model() {
  Model model = testing::unglued(square());
  for (int c = 0; c < 4; ++c) {
    FaceCurve& curve = model.faces[0].curves[static_cast<std::size_t>(c)];
    curve.ref = c + 1, curve.end1 = c + 1, curve.end2 = (c + 1) % 4 + 1;
  }
  return model;
}

struct Outcome {
  std::string error;     // of make_mesh
  std::string failures;  // of faces
  bool sound = false;
  double area = 0;
};
Outcome try_mesh(const AnalyticCad& cad, const Model& model, double size = 0.2,
                 const std::map<std::string, double>& parameters = {}) {
  Monitor monitor;
  Session session(monitor);
  Outcome outcome;
  try {
    session.set_cad(std::make_shared<AnalyticCad>(cad));
    session.set_model(model);
    session.parameters().set("hphydef", size);
    for (const auto& [name, value] : parameters) session.parameters().set(name, value);
    session.make_mesh();
    outcome.sound = find_defects(session.mesh()).empty();
    outcome.area = summarise_quality(session.exported()).area;
    for (const FaceMesh& face : session.mesh().faces)
      if (face.status == FaceStatus::failed) outcome.failures += face.why + "\n";
  } catch (const Error& error) {
    outcome.error = error.what();
  }
  return outcome;
}
void expect_refused(const Outcome& outcome, const std::string& word) {
  EXPECT_NE(outcome.error.find(word), std::string::npos) << outcome.error << outcome.failures;
}

TEST(BadModels, ASoundOneIsMeshed) {
  const Outcome outcome = try_mesh(square(), square_model());
  EXPECT_EQ(outcome.error + outcome.failures, "");
  EXPECT_TRUE(outcome.sound);
}

// A host's gap does not change when edges become smaller than four times the gap.
TEST(BadModels, CornerWithAGapClosesAtAnySize) {
  AnalyticCad cad = square();
  cad.faces[1].curves[0] = segment({0, 0}, {1, -0.004});
  for (const double size : {0.2, 0.05, 0.016, 0.01, 0.005}) {
    const Outcome outcome = try_mesh(cad, square_model(), size, {{"eps_glue", 0.005}});
    EXPECT_TRUE(outcome.sound) << size << ": " << outcome.error << outcome.failures;
    EXPECT_EQ(outcome.failures, "") << size;
    EXPECT_NEAR(outcome.area, 1, 0.004) << size;
  }
}

// Two ends that are one point within the tolerance, .004 apart: the loop closes also where edges are no longer than
// that.
TEST(BadModels, EndsThatDoNotQuiteMeetAreOneForShortEdgesToo) {
  AnalyticCad cad = square();
  cad.faces[1].curves[2] = segment({0.996, 1}, {0, 1});
  for (const double size : {0.2, 0.02, 0.01, 0.005}) {
    const Outcome outcome = try_mesh(cad, square_model(), size);
    EXPECT_EQ(outcome.error + outcome.failures, "") << size;
    EXPECT_TRUE(outcome.sound) << size;
  }
}

TEST(BadModels, LoopThatDoesNotClose) {
  AnalyticCad cad = square();
  cad.faces[1].curves[2] = segment({1, 1}, {0, 0.7});
  expect_refused(try_mesh(cad, square_model()), "face 1");
  expect_refused(try_mesh(cad, testing::unglued(cad)), "face 1");
}

TEST(BadModels, ReferencesOfOtherCurvesAndPoints) {
  Model model = square_model();
  std::swap(model.faces[0].curves[1].end1, model.faces[0].curves[1].end2);
  expect_refused(try_mesh(square(), model), "face 1");
  model = square_model();
  model.faces[0].curves[2].ref = 1;
  expect_refused(try_mesh(square(), model), "face 1");
  model = square_model();
  model.faces[0].orientation = 7;
  expect_refused(try_mesh(square(), model), "orientation");
}

TEST(BadModels, CurveOfAnotherFaceThatLiesElsewhere) {
  AnalyticCad cad = square();
  cad.faces[2] = {[](Vec2 p) { return plane(p, 0.5); }, testing::rectangle({0, 0}, {1, 1})};
  Model model = square_model();
  model.faces.push_back(model.faces[0]);
  model.faces[1].ref = 2;
  expect_refused(try_mesh(cad, model), "face 2");
}

TEST(BadModels, CurveWithoutLength) {
  AnalyticCad cad = square();
  cad.faces[1].curves.push_back(segment({0, 0}, {0, 0}));
  Model model = square_model();
  model.faces[0].curves.push_back({.ref = 5, .end1 = 1, .end2 = 1});
  const Outcome outcome = try_mesh(cad, model);
  EXPECT_TRUE(outcome.sound || !outcome.error.empty());
  AnalyticCad none = square();
  for (auto& curve : none.faces[1].curves) curve = segment({0.5, 0.5}, {0.5, 0.5});
  expect_refused(try_mesh(none, square_model()), "no extent");
}

// A cylinder whose host declares that it closes after six radians.
TEST(BadModels, PeriodThatIsNotOne) {
  AnalyticCad cad;
  cad.faces[1] = {[](Vec2 p) {
                    const double c = std::cos(p.x()), s = std::sin(p.x());
                    return SurfaceJet{{c, s, p.y()}, {-s, c, 0}, {0, 0, 1}, {-c, -s, 0}, {}, {}};
                  },
                  testing::rectangle({0, 0}, {6, 1})};
  Model model = testing::unglued(cad);
  const int refs[4][3] = {{1, 1, 1}, {2, 1, 2}, {3, 2, 2}, {2, 2, 1}};
  for (std::size_t c = 0; c < 4; ++c) {
    FaceCurve& curve = model.faces[0].curves[c];
    curve.ref = refs[c][0], curve.end1 = refs[c][1], curve.end2 = refs[c][2];
  }
  expect_refused(try_mesh(cad, model), "face 1");
}

// A step of a hundred in the midst of a face: no mesh of the rest of it is a mesh of the face, and others stay.
TEST(BadModels, SurfaceThatJumps) {
  AnalyticCad cad = square();
  cad.faces[2] = {[](Vec2 p) {
                    return plane({p.x() + 2, p.y()}, p.x() > 0.37 && p.x() < 0.61 && p.y() > 0.37 && p.y() < 0.61 ? 1e6 : 0);
                  },
                  testing::rectangle({0, 0}, {1, 1})};
  const Outcome outcome = try_mesh(cad, testing::unglued(cad), 0.1);
  EXPECT_NE((outcome.error + outcome.failures).find("face 2"), std::string::npos);
  EXPECT_NE((outcome.error + outcome.failures).find("the surface jumps"), std::string::npos);
  EXPECT_TRUE(outcome.sound);
}

// Likewise for a step of a few edges through the whole face: triangles without area lay along it.
TEST(BadModels, SurfaceThatJumpsByAFewEdges) {
  AnalyticCad cad = square();
  cad.faces[2] = {[](Vec2 p) {
                    return plane({p.x() + 2, p.y()}, p.x() > 0.6500123 ? 0.25 : 0);
                  },
                  testing::rectangle({0, 0}, {1, 1})};
  for (const double size : {0.025, 0.05}) {
    const Outcome outcome = try_mesh(cad, testing::unglued(cad), size);
    EXPECT_NE((outcome.error + outcome.failures).find("face 2"), std::string::npos) << size;
    EXPECT_TRUE(outcome.sound) << size;
  }
}

// Steps in many places, from a host without derivatives: differences across a step promise triangles without end.
TEST(BadModels, SurfaceThatJumpsInManyPlaces) {
  const auto stairs = [](Vec2 p) { return 0.05 * std::floor(20 * p.x()); };
  const auto both = [](Vec2 p) { return 0.02 * (std::floor(50 * p.x()) + std::floor(50 * p.y())); };
  const auto chequers = [](Vec2 p) { return 0.2 * std::fmod(std::floor(10 * p.x()) + std::floor(10 * p.y()), 2); };
  for (const std::function<double(Vec2)>& height : {std::function<double(Vec2)>(stairs), {both}, {chequers}}) {
    auto cad = std::make_unique<AnalyticCad>(square());
    cad->faces[1].at = [=](Vec2 p) { return plane(p, height(p)); };
    Monitor monitor;
    Session session(monitor);
    session.set_model(testing::unglued(*cad));
    session.set_cad(std::make_shared<DifferenceCad>(std::move(cad), want_position, want_position));
    session.parameters().set("hphydef", 0.03);
    try {
      session.make_mesh();
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find("face 1, u = "), std::string::npos) << what;
      EXPECT_NE(what.find("the surface jumps"), std::string::npos) << what;
    }
  }
}

// Derivatives vanish on one border (a cusp): edges there are many times longer than the derivatives suggest, and the
// surface is continuous.
TEST(BadModels, DerivativesThatVanishOnABorderAreNoJump) {
  AnalyticCad cad;
  cad.faces[1] = {[](Vec2 p) {
                    const double dd = 600 * std::pow(p.x(), 23), d = dd * p.x() / 24;
                    return SurfaceJet{{d * p.x() / 25, p.y(), 0}, {d, 0, 0}, {0, 1, 0}, {dd, 0, 0}, {}, {}};
                  },
                  testing::rectangle({0, 0}, {1, 1})};
  const Outcome outcome = try_mesh(cad, testing::unglued(cad), 0.01);
  EXPECT_EQ(outcome.error + outcome.failures, "");
  EXPECT_TRUE(outcome.sound);
}

// A face that shrinks to a line in space although its curves do not.
TEST(BadModels, SurfaceWithoutArea) {
  AnalyticCad cad = square();
  cad.faces[2] = {[](Vec2 p) {
                    return SurfaceJet{{p.x() + p.y(), 3, 0}, {1, 0, 0}, {1, 0, 0}, {}, {}, {}};
                  },
                  testing::rectangle({0, 0}, {1, 1})};
  const Outcome outcome = try_mesh(cad, testing::unglued(cad));
  EXPECT_TRUE(!outcome.error.empty() || !outcome.failures.empty());
}

// A double cone whose apex lies in the midst of its domain: the line v = 0 is one point of space.
TEST(BadModels, SurfaceThatIsOnePointInside) {
  AnalyticCad cad;
  cad.faces[2] = {
      [](Vec2 p) {
        const double c = std::cos(p.x()), s = std::sin(p.x()), v = p.y();
        return SurfaceJet{{v * c, v * s, 2 * v}, {-v * s, v * c, 0}, {c, s, 2}, {-v * c, -v * s, 0}, {-s, c, 0}, {}};
      },
      testing::rectangle({0, -1}, {2 * std::numbers::pi, 1})};
  Monitor monitor;
  Session session(monitor);
  session.set_cad(std::make_shared<AnalyticCad>(cad));
  session.set_model(testing::unglued(cad));
  session.parameters().set("hphy_flag", 0);
  session.parameters().set("hgeo_flag", 1);
  session.parameters().set("gradation", 1.3);
  try {
    session.make_mesh();
    FAIL() << find_defects(session.mesh()).size() << " defects";
  } catch (const DomainError& error) {
    EXPECT_NE(std::string(error.what()).find("the surface is degenerate inside its domain"), std::string::npos)
        << error.what();
  }
}

// ---- tiny edges (eps_collapse) ----

// A hole that is tangent to a side: CAD systems leave two tiny edges there, one in either loop, on the same place.
TEST(TinyEdges, TwoLoopsOnOnePlaceBecomeOnePoint) {
  constexpr double tiny = 1e-10;
  AnalyticCad cad;
  cad.faces[1] = {
      [](Vec2 p) { return plane(p, 0); },
      {segment({0, 0}, {0.5, 0}), segment({0.5, 0}, {0.5 + tiny, 0}), segment({0.5 + tiny, 0}, {1, 0}),
       segment({1, 0}, {1, 1}), segment({1, 1}, {0, 1}), segment({0, 1}, {0, 0}), segment({0.5, 0}, {0.5 + tiny, 0}),
       segment({0.5 + tiny, 0}, {0.7, 0.4}), segment({0.7, 0.4}, {0.3, 0.4}), segment({0.3, 0.4}, {0.5, 0})}};
  Model model = testing::unglued(cad);
  const std::array<std::array<int, 2>, 10> ends{
      {{1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}, {6, 1}, {2, 3}, {3, 7}, {7, 8}, {8, 2}}};
  for (std::size_t c = 0; c < ends.size(); ++c) {
    FaceCurve& curve = model.faces[0].curves[c];
    curve.ref = static_cast<int>(c) + 1, curve.end1 = ends[c][0], curve.end2 = ends[c][1];
  }
  for (const double size : {0.3, 0.1, 0.02}) {
    const Outcome outcome = try_mesh(cad, model, size);
    EXPECT_TRUE(outcome.sound) << size << ": " << outcome.error << outcome.failures;
    EXPECT_EQ(outcome.failures, "") << size;
    EXPECT_NEAR(outcome.area, 1 - 0.4 * 0.4 / 2, 1e-9) << size;
  }
}

TEST(TinyEdges, InALoopBecomePoints) {
  for (const double tiny : {1e-3, 1e-5, 1e-9}) {
    SCOPED_TRACE(tiny);
    AnalyticCad cad;
    const std::vector<Vec2> corners{{0, 0}, {1, 0}, {1, 1 - tiny}, {1 - tiny, 1}, {tiny, 1}, {0, 1 - tiny}};
    cad.faces[1].at = [](Vec2 p) { return plane(p, 0); };
    for (std::size_t i = 0; i < corners.size(); ++i)
      cad.faces[1].curves.push_back(segment(corners[i], corners[(i + 1) % corners.size()]));
    Model model = testing::unglued(cad);
    for (int c = 0; c < 6; ++c) {
      FaceCurve& curve = model.faces[0].curves[static_cast<std::size_t>(c)];
      curve.ref = c + 1, curve.end1 = c + 1, curve.end2 = (c + 1) % 6 + 1;
    }
    for (const double size : {0.5, 0.1, 0.03}) {
      SCOPED_TRACE(size);
      Monitor monitor;
      Session session(monitor);
      session.set_cad(std::make_shared<AnalyticCad>(cad));
      session.set_model(model);
      session.parameters().set("hphydef", size);
      session.parameters().set("hphymax", size);
      session.parameters().set("eps_collapse", 3 * tiny);
      session.make_mesh();
      EXPECT_EQ(find_defects(session.mesh()), std::vector<std::string>{});
      const QualitySummary q = summarise_quality(session.exported());
      EXPECT_NEAR(q.area, 1, 4 * tiny);
      EXPECT_EQ(static_cast<long>(q.vertices) - static_cast<long>(q.edges) + static_cast<long>(q.triangles), 1);
      EXPECT_GT(q.edge_min, 0.2 * size);  // no edge is tiny any more
    }
  }
}

}  // namespace
}  // namespace carreau
