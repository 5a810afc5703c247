// SPDX-License-Identifier: BSD-3-Clause
// Whole surfaces: conformity, the papers' figures, quality, calls.
#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "common/analytic_cad.h"
#include "session/session.h"

namespace carreau {
namespace {

using testing::AnalyticCad;

struct MeshedCase {
  std::shared_ptr<AnalyticCad> cad;
  Monitor monitor;
  std::unique_ptr<Session> session;
  FlatMesh mesh;
  QualitySummary quality;

  MeshedCase(AnalyticCad geometry, double size, const std::function<void(Parameters&)>& more = {})
      : cad(std::make_shared<AnalyticCad>(std::move(geometry))) {
    session = std::make_unique<Session>(monitor);
    session->set_cad(cad);
    session->set_model(testing::unglued(*cad));
    Parameters& p = session->parameters();
    if (size > 0) {
      p.set("hphydef", size);
      p.set("hphymin", size / 10);
      p.set("hphymax", size * 10);
    }
    if (more) more(p);
    session->make_mesh();
    EXPECT_EQ(find_defects(session->mesh()), std::vector<std::string>{});
    mesh = session->exported();
    quality = summarise_quality(mesh);
  }

  // Share of edges whose length over the size lies in [1/sqrt 2, sqrt 2], and the mean of that ratio.
  std::pair<double, double> lengths(double size) const {
    std::size_t in_range = 0, count = 0;
    double sum = 0;
    for (const auto& t : mesh.triangles)
      for (int i = 0; i < 3; ++i) {
        const double l = norm(mesh.vertices[t[i]] - mesh.vertices[t[(i + 1) % 3]]) / size;
        sum += l;
        ++count;
        in_range += l >= std::numbers::sqrt2 / 2 && l <= std::numbers::sqrt2 ? 1 : 0;
      }
    return {static_cast<double>(in_range) / static_cast<double>(count), sum / static_cast<double>(count)};
  }
  [[nodiscard]] double calls_per_vertex() const {
    return static_cast<double>(cad->calls.surface()) / static_cast<double>(mesh.vertices.size());
  }
};

TEST(Paraboloid, DefaultMeshIsTheManuals) {
  const MeshedCase run(testing::paraboloid(), 0);
  EXPECT_EQ(run.session->mesh().edge_count(), 216U);
  EXPECT_EQ(run.quality.open_edges, 216U);
  EXPECT_NEAR(static_cast<double>(run.quality.triangles), 4980, 0.06 * 4980);
  EXPECT_NEAR(run.session->report().diag, 7.7, 0.05);
  EXPECT_GE(run.quality.q2.mean, 0.989);
  EXPECT_GE(run.quality.q2.p1, 0.92);
  EXPECT_GE(run.quality.q2.min, 0.6);
  EXPECT_GE(run.quality.degree6, 0.89);
}

TEST(Paraboloid, CoarseMeshHoldsTheImposedPoint) {
  auto cad = testing::paraboloid();
  Monitor monitor;
  Session session(monitor);
  Model model = testing::unglued(cad);
  model.faces[0].points.push_back({77, {0, 0}});
  session.set_cad(std::make_shared<AnalyticCad>(std::move(cad)));
  session.set_model(model);
  session.parameters().set("hphydef", 1.5);
  session.parameters().set("hphymax", 1.5);
  session.make_mesh();
  EXPECT_EQ(find_defects(session.mesh()), std::vector<std::string>{});
  EXPECT_EQ(session.mesh().edge_count(), 24U);
  EXPECT_NEAR(static_cast<double>(session.mesh().triangle_count()), 64, 0.08 * 64);
  bool found = false;
  for (std::size_t v = 0; v < session.mesh().vertices.size(); ++v)
    if (session.mesh().vertex_ref[v] == 77) found = session.mesh().vertices[v] == Vec3{0, 0, 0};
  EXPECT_TRUE(found);
}

struct PatchCase {
  const char* name;
  AnalyticCad (*make)();
  double size;
};
class SmoothPatch : public ::testing::TestWithParam<PatchCase> {};

TEST_P(SmoothPatch, Near100000TrianglesMeetsTheQuality) {
  const PatchCase& c = GetParam();
  const MeshedCase run(c.make(), c.size);
  EXPECT_NEAR(static_cast<double>(run.quality.triangles), 100000, 30000);
  EXPECT_GE(run.quality.q2.mean, 0.996);
  EXPECT_GE(run.quality.q2.p1, 0.94);
  EXPECT_GE(run.quality.q2.min, 0.6);
  EXPECT_GE(run.quality.degree6, 0.96);
  const auto [in_range, mean] = run.lengths(c.size);
  EXPECT_NEAR(mean, 1, 0.01);
  EXPECT_GE(in_range, 0.999);
}

INSTANTIATE_TEST_SUITE_P(Uniform, SmoothPatch,
                         ::testing::Values(PatchCase{"paraboloid", testing::paraboloid, 0.03558},
                                           PatchCase{"hemisphere", testing::hemisphere, 0.0121},
                                           PatchCase{"torus", [] { return testing::torus_patch(); }, 0.0127}),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(Calls, AreAtMostThreeAVertexWhenUniform) {
  for (const auto& cad : {testing::paraboloid(), testing::hemisphere(), testing::torus_patch()}) {
    const MeshedCase run(cad, 0.035);
    ASSERT_GE(run.quality.triangles, 10000U);
    EXPECT_LE(run.calls_per_vertex(), 3);
  }
}

TEST(Calls, AreAtMostFiveAVertexWhenGeometric) {
  for (const auto& cad : {testing::paraboloid(), testing::hemisphere(), testing::torus_patch()}) {
    const MeshedCase run(cad, 0, [](Parameters& p) {
      p.set("hphy_flag", 0);
      p.set("hgeo_flag", 1);
      p.set("angle_mesh", 1.0);
      p.set("hgeomin", 1e-4);
    });
    ASSERT_GE(run.quality.triangles, 10000U);
    EXPECT_LE(run.calls_per_vertex(), 5);
  }
}

TEST(Teapot, IsConformingWithTheManualsCurves) {
  const MeshedCase run(testing::teapot(), 0.1);
  int shared = 0, free = 0, degenerate = 0;
  for (const CurveMesh& curve : run.session->mesh().curves) {
    if (curve.vertices.size() < 2)
      ++degenerate;
    else
      ++(curve.uses.size() == 2 ? shared : free);
  }
  EXPECT_EQ(shared, 52);
  EXPECT_EQ(free, 16);
  EXPECT_EQ(degenerate, 8);
  EXPECT_NEAR(static_cast<double>(run.quality.triangles), 11658, 0.06 * 11658);
  EXPECT_NEAR(run.quality.area, 52.8833, 0.01 * 52.8833);
  EXPECT_GE(run.quality.q2.mean, 0.98);
  EXPECT_GE(run.quality.q2.p1, 0.80);
  EXPECT_GE(run.quality.q2.min, 0.3);
}

TEST(Teapot, BordersAreNoWorseThanTheMiddle) {
  const MeshedCase run(testing::teapot(), 0.1);
  std::vector<char> on_curve(run.mesh.vertices.size(), 0);
  for (const CurveMesh& curve : run.session->mesh().curves)
    for (const auto v : curve.vertices) on_curve[v] = 1;
  std::vector<double> q2;
  for (const auto& t : run.mesh.triangles)
    if (on_curve[t[0]] + on_curve[t[1]] + on_curve[t[2]] > 0)
      q2.push_back(quality_q2(run.mesh.vertices[t[0]], run.mesh.vertices[t[1]], run.mesh.vertices[t[2]]));
  std::sort(q2.begin(), q2.end());
  EXPECT_GE(q2[q2.size() / 100], 0.7);
}

TEST(Teapot, FineMeshMeetsTheQuality) {
  const MeshedCase run(testing::teapot(), 0.035);
  EXPECT_GE(run.quality.q2.mean, 0.990);
  EXPECT_GE(run.quality.q2.p1, 0.89);
  EXPECT_GE(run.quality.q2.min, 0.4);
}

TEST(Teapot, GeometricMeshMeetsTheQuality) {
  const MeshedCase run(testing::teapot(), 0, [](Parameters& p) {
    p.set("hphy_flag", 0);
    p.set("hgeo_flag", 1);
  });
  EXPECT_GE(run.quality.q2.mean, 0.93);
  EXPECT_GE(run.quality.q2.p1, 0.6);
  EXPECT_GE(run.quality.q2.min, 0.15);
}

TEST(Torus, OneFaceWithTwoSeamsIsClosed) {
  constexpr double pi = std::numbers::pi;
  AnalyticCad cad;
  cad.faces[1] = {[](Vec2 p) { return testing::torus_jet(p, 2, 0.7); }, testing::rectangle({0, 0}, {2 * pi, 2 * pi})};
  const MeshedCase run(cad, 0.2);
  EXPECT_EQ(find_defects(run.session->mesh(), {.closed = true}), std::vector<std::string>{});
  const auto euler = static_cast<std::ptrdiff_t>(run.quality.vertices + run.quality.triangles) -
                     static_cast<std::ptrdiff_t>(run.quality.edges);
  EXPECT_EQ(euler, 0);
  EXPECT_NEAR(run.quality.area, 4 * pi * pi * 2 * 0.7, 0.01 * 4 * pi * pi * 2 * 0.7);
}

TEST(Cone, HasAtLeastThreeTrianglesAtItsApex) {
  constexpr double pi = std::numbers::pi;
  for (const double size : {0.7, 0.3, 0.1, 0.03}) {
    AnalyticCad cad;  // u the angle, v from the apex
    cad.faces[1] = {[](Vec2 p) {
                      const double c = std::cos(p.x()), s = std::sin(p.x()), v = p.y();
                      return SurfaceJet{{v * c, v * s, 2 * v}, {-v * s, v * c, 0}, {c, s, 2},
                                        {-v * c, -v * s, 0},   {-s, c, 0},         {0, 0, 0}};
                    },
                    testing::rectangle({0, 0}, {2 * pi, 1})};
    const MeshedCase run(cad, size);
    std::vector<int> around(run.mesh.vertices.size(), 0);
    for (const auto& t : run.mesh.triangles)
      for (const auto v : t) ++around[v];
    for (std::size_t v = 0; v < around.size(); ++v)
      if (norm(run.mesh.vertices[v]) == 0) {
        EXPECT_GE(around[v], 3) << "size " << size;
      }
    EXPECT_GE(run.quality.q2.min, 0.2) << "size " << size;
  }
}

// Three edges around an apex make a cross-section of a better shape than the triangles beside it.
TEST(Cone, IsNotCutAcross) {
  constexpr double pi = std::numbers::pi;
  for (double slope = 0.8; slope < 6; slope *= 1.09) {
    AnalyticCad cad;  // u the angle, v from the apex
    cad.faces[1] = {[slope](Vec2 p) {
                      const double c = std::cos(p.x()), s = std::sin(p.x()), v = p.y();
                      return SurfaceJet{{v * c, v * s, slope * v}, {-v * s, v * c, 0}, {c, s, slope},
                                        {-v * c, -v * s, 0},       {-s, c, 0},         {0, 0, 0}};
                    },
                    testing::rectangle({0, 0}, {2 * pi, 1})};
    for (const double size : {0.4, 0.1, 0.04}) {
      SCOPED_TRACE(::testing::Message() << "slope " << slope << ", size " << size);
      const MeshedCase run(cad, size);
      EXPECT_GE(run.quality.q2.min, 0.2);
      for (const auto& t : run.mesh.triangles) {
        const Vec3 a = run.mesh.vertices[t[0]], b = run.mesh.vertices[t[1]], c = run.mesh.vertices[t[2]];
        const Vec3 middle = (1.0 / 3) * (a + b + c), n = cross(b - a, c - a);
        // Outwards: the surface's normal is (slope cos u, slope sin u, -1).
        EXPECT_GT(slope * (n.x() * middle.x() + n.y() * middle.y()) - n.z() * std::hypot(middle.x(), middle.y()), 0);
      }
    }
  }
}

TEST(VertexSizes, AreThePrescribedOneWhenItIsConstant) {
  const MeshedCase bowl(testing::paraboloid(), 0.3), teapot(testing::teapot(), 0.4);
  for (const double h : bowl.session->vertex_sizes()) EXPECT_EQ(h, 0.3);
  for (const double h : teapot.session->vertex_sizes()) EXPECT_EQ(h, 0.4);
  EXPECT_EQ(bowl.session->vertex_sizes().size(), bowl.session->mesh().vertices.size());
  const MeshedCase clamped(testing::paraboloid(), 0.3, [](Parameters& p) { p.set("hphymin", 0.35); });
  for (const double h : clamped.session->vertex_sizes()) EXPECT_EQ(h, 0.35);
}

TEST(Mesh, IsTheSameTwice) {
  const MeshedCase first(testing::teapot(), 0.15), second(testing::teapot(), 0.15);
  EXPECT_EQ(first.mesh.vertices, second.mesh.vertices);
  EXPECT_EQ(first.mesh.triangles, second.mesh.triangles);
}

/// A cylinder of radius 1 with a slanted end, in other units: u is a length, v the angle.
AnalyticCad slanted_cylinder(double unit) {
  AnalyticCad cad;
  const auto slanted = [unit](double t) {
    const double a = 2 * std::numbers::pi * t;
    const double k = 2 * std::numbers::pi;
    return CurveJet{{unit * (3 + std::sin(a)), a}, {unit * k * std::cos(a), k}, {-unit * k * k * std::sin(a), 0}};
  };
  const double around = 2 * std::numbers::pi, end = 3 * unit;
  cad.faces[1] = {[unit](Vec2 p) {
                    const double c = unit * std::cos(p.y()), s = unit * std::sin(p.y());
                    return SurfaceJet{{c, s, p.x()}, {0, 0, 1}, {-s, c, 0}, {}, {}, {-c, -s, 0}};
                  },
                  {testing::segment({0, 0}, {end, 0}),
                   {{0, 1}, slanted},
                   testing::segment({end, around}, {0, around}),
                   testing::segment({0, around}, {0, 0})}};
  return cad;
}

// The two ends of a seam are a whole turn apart, also where a turn is 1e-7 of the other parameter's edges.
TEST(SlantedCylinder, IsTheSameInAnyUnitOfLength) {
  const MeshedCase one(slanted_cylinder(1), 0.3);
  EXPECT_EQ(one.session->mesh().faces[0].status, FaceStatus::meshed);
  for (const double unit : {1e-7, 1e7}) {
    SCOPED_TRACE(unit);
    const MeshedCase other(slanted_cylinder(unit), 0.3 * unit);
    EXPECT_NEAR(static_cast<double>(other.mesh.triangles.size()), static_cast<double>(one.mesh.triangles.size()),
                0.02 * static_cast<double>(one.mesh.triangles.size()));
    EXPECT_NEAR(other.quality.q2.mean, one.quality.q2.mean, 0.005);
  }
}

}  // namespace
}  // namespace carreau
