// SPDX-License-Identifier: BSD-3-Clause
// Faces that a run goes without (parameter failing_faces).
#include "session/left_out.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "common/analytic_cad.h"
#include "session/session.h"

namespace carreau {
namespace {

using testing::AnalyticCad;

class Recorder final : public Monitor {
 public:
  void message(Level, std::string_view) override {}
  void progress(Phase phase, int, double) override { runs += phase == Phase::model ? 1 : 0; }
  int runs = 0;
};

constexpr int squares = 7;

/// A row of unit squares, faces 1, 2, ...
AnalyticCad row() {
  AnalyticCad cad;
  for (int f = 1; f <= squares; ++f)
    cad.faces[f] = {[](Vec2 p) {
                      return SurfaceJet{{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}};
                    },
                    testing::rectangle({f - 1.0, 0}, {f + 0.0, 1})};
  return cad;
}

void fail_on_a_curve(AnalyticCad& cad, int face) {
  const auto sound = cad.faces[face].curves[0].at;
  cad.faces[face].curves[0].at = [=](double t) {
    if (t > 0.4 && t < 0.6) throw CallbackError(Where{.face = face, .curve_index = 1, .t = t}, "it fails on purpose");
    return sound(t);
  };
}

void fail_inside(AnalyticCad& cad, int face) {
  const auto sound = cad.faces[face].at;
  cad.faces[face].at = [=](Vec2 p) {
    if (p.x() > face - 0.9 && p.x() < face - 0.1 && p.y() > 0.1 && p.y() < 0.9)
      throw CallbackError(Where{.face = face, .uv = p}, "it fails inside");
    return sound(p);
  };
}

struct Row {
  Recorder monitor;
  Session session{monitor};

  explicit Row(const AnalyticCad& cad) {
    session.set_cad(std::make_shared<AnalyticCad>(cad));
    session.set_model(testing::unglued(cad));
    session.parameters().set("hphydef", 0.25);
    session.parameters().set("hphymin", 0.01);
    session.parameters().set("failing_faces", "leave_out");
  }
  /// References of the faces that failed. The others have the area of a square each, and every face is there.
  std::set<int> failed() {
    std::set<int> refs;
    const SurfaceMesh& mesh = session.mesh();
    EXPECT_EQ(mesh.faces.size(), std::size_t{squares});
    for (const FaceMesh& face : mesh.faces) {
      double area = 0;
      for (const auto& t : face.triangles) {
        const auto at = [&](int k) { return mesh.vertices[face.vertex[t[k]]]; };
        area += norm(cross(at(1) - at(0), at(2) - at(0))) / 2;
      }
      if (face.status == FaceStatus::failed) {
        refs.insert(face.ref);
        EXPECT_TRUE(face.why.starts_with("face " + std::to_string(face.ref))) << face.why;
      }
      EXPECT_NEAR(area, face.status == FaceStatus::failed ? 0 : 1, 1e-12);
    }
    return refs;
  }
};

TEST(FailingFaces, EndARunUnlessTheyAreLeftOut) {
  AnalyticCad cad = row();
  fail_inside(cad, 3);
  Row run(cad);
  run.session.parameters().set("failing_faces", "stop");
  EXPECT_THROW(run.session.make_mesh(), CallbackError);
  EXPECT_FALSE(run.session.has_mesh());
}

TEST(FailingFaces, InsideLeaveTheOthersAsTheyAre) {
  AnalyticCad cad = row();
  for (const int face : {1, 3, 4}) fail_inside(cad, face);
  Row run(cad);
  run.session.make_mesh();
  EXPECT_EQ(run.failed(), (std::set<int>{1, 3, 4}));
  EXPECT_EQ(run.monitor.runs, 1);
  EXPECT_NE(run.session.mesh().faces[2].why.find("it fails inside"), std::string::npos);
  Row whole(row());
  whole.session.make_mesh();
  for (const std::size_t f : {1, 4, 5, 6})
    EXPECT_EQ(run.session.mesh().faces[f].triangles.size(), whole.session.mesh().faces[f].triangles.size());
}

// Before anything is glued, cut or meshed, whatever their number.
TEST(FailingFaces, OnCurvesAreFoundTogether) {
  AnalyticCad cad = row();
  for (const int face : {1, 2, 5}) fail_on_a_curve(cad, face);
  fail_inside(cad, 7);
  Row run(cad);
  run.session.make_mesh();
  EXPECT_EQ(run.failed(), (std::set<int>{1, 2, 5, 7}));
  EXPECT_EQ(run.monitor.runs, 1);
  // Faces are left out of one run, not of the model.
  EXPECT_EQ(run.session.model().faces[0].curves.size(), 4U);
  EXPECT_EQ(run.session.model().faces[0].left_out, "");
  run.session.set_cad(std::make_shared<AnalyticCad>(row()));
  run.session.set_model(testing::unglued(row()));
  run.session.make_mesh();
  EXPECT_EQ(run.failed(), std::set<int>{});
}

// A surf1 that contradicts surf0 is reported for its face, and all such faces are left out at once.
TEST(FailingFaces, WithWrongDerivativesAreFoundTogether) {
  AnalyticCad cad = row();
  for (const int face : {2, 5, 6}) {
    const auto sound = cad.faces[face].at;
    cad.faces[face].at = [=](Vec2 p) {
      SurfaceJet jet = sound(p);
      jet.su = 3 * jet.su;
      return jet;
    };
  }
  Row run(cad);
  run.session.make_mesh();
  EXPECT_EQ(run.failed(), (std::set<int>{2, 5, 6}));
  EXPECT_EQ(run.monitor.runs, 2);
  EXPECT_NE(run.session.mesh().faces[4].why.find("surf1 gives Su = (3, 0, 0)"), std::string::npos);
}

TEST(FailingFaces, LeftOutFacesAreNotEvaluated) {
  AnalyticCad cad = row();
  for (const int face : {2, 6}) cad.faces.erase(face);  // std::map::at throws
  Row run(row());
  Model model = testing::unglued(row());
  for (const std::size_t f : {1, 5}) model.faces[f].left_out = "face " + std::to_string(f + 1) + ": not wanted";
  model.faces[5].curves.clear();
  run.session.set_model(model);
  run.session.set_cad(std::make_shared<AnalyticCad>(cad));
  run.session.parameters().set("failing_faces", "stop");
  for (int round = 0; round < 2; ++round) {
    run.session.make_mesh();
    EXPECT_EQ(run.failed(), (std::set<int>{2, 6}));
  }
  EXPECT_EQ(run.session.mesh().faces[1].why, "face 2: not wanted");
  EXPECT_EQ(run.session.model().faces[1].curves.size(), 4U);
  run.session.parameters().set("option", "onesurf2d");
  run.session.parameters().set("refs", 2);
  EXPECT_THROW((void)run.session.exported(), InvalidArgument);
  run.session.parameters().set("refs", 3);
  EXPECT_NO_THROW((void)run.session.exported());
  EXPECT_NO_THROW((void)run.session.delivered());
}

TEST(FailingFaces, ThatBreakARuleAreLeftOutTogether) {
  Row run(row());
  Model model = testing::unglued(row());
  model.faces[1].curves.clear();
  model.faces[3].orientation = 9;
  run.session.set_model(model);
  run.session.make_mesh();
  EXPECT_EQ(run.failed(), (std::set<int>{2, 4}));
  model.faces[6].ref = 1;  // of two faces: neither is meant alone
  run.session.parameters().set("failing_faces", "stop");
  EXPECT_THROW(run.session.set_model(model), InvalidModel);
}

TEST(FailingFaces, AllOfThemLeaveNoMesh) {
  AnalyticCad cad = row();
  for (int face = 1; face <= squares; ++face) fail_on_a_curve(cad, face);
  Row run(cad);
  try {
    run.session.make_mesh();
    FAIL();
  } catch (const DomainError& error) {
    EXPECT_NE(std::string(error.what()).find("no face could be meshed: face 1"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("it fails on purpose"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace carreau
