// SPDX-License-Identifier: BSD-3-Clause
// No triangle of a mesh turns its back on the surface, whatever rule its sizes come from.
#include <gtest/gtest.h>

#include "cad/fundamental_forms.h"
#include "geometric_run.h"

namespace carreau {
namespace {

using namespace testing;
constexpr double pi = std::numbers::pi;

/// z = f(x, y) from f and its derivatives fx, fy, fxx, fxy, fyy.
AnalyticCad graph(std::function<std::array<double, 6>(double, double)> f, Vec2 low, Vec2 high) {
  return one_face(
      [f = std::move(f)](Vec2 p) {
        const auto [z, x, y, xx, xy, yy] = f(p.x(), p.y());
        return SurfaceJet{{p.x(), p.y(), z}, {1, 0, x}, {0, 1, y}, {0, 0, xx}, {0, 0, xy}, {0, 0, yy}};
      },
      rectangle(low, high));
}

// Lines of inflections that cross, an umbilic of index -1/2 that is flat, a cylinder that bends both ways, and a torus
// whose tube is nearly as wide as its hole.
AnalyticCad waves() {
  return graph(
      [](double x, double y) {
        const double sx = std::sin(3 * x), cx = std::cos(3 * x), sy = std::sin(2 * y), cy = std::cos(2 * y);
        return std::array{0.4 * sx * sy, 1.2 * cx * sy, 0.8 * sx * cy, -3.6 * sx * sy, 2.4 * cx * cy, -1.6 * sx * sy};
      },
      {-1, -1}, {2, 2});
}
AnalyticCad monkey_saddle() {
  return graph(
      [](double x, double y) {
        return std::array{x * x * x - 3 * x * y * y, 3 * (x * x - y * y), -6 * x * y, 6 * x, -6 * y, -6 * x};
      },
      {-1, -1}, {1, 1});
}
AnalyticCad gutter() {
  return graph(
      [](double x, double) {
        return std::array{0.5 * std::sin(4 * x), 2 * std::cos(4 * x), 0., -8 * std::sin(4 * x), 0., 0.};
      },
      {0, 0}, {3, 1});
}
AnalyticCad thick_torus() {
  return one_face([](Vec2 p) { return torus_jet(p, 1, 0.9); }, rectangle({0, 0}, {2 * pi, 2 * pi}));
}

const Surface surfaces_that_bend[] = {
    {"sphere", sphere}, {"torus", torus},   {"paraboloid", wide_paraboloid},  {"ellipsoid", ellipsoid},
    {"waves", waves},   {"gutter", gutter}, {"monkey_saddle", monkey_saddle}, {"thick_torus", thick_torus}};

void expect_agreement(const GeometricRun& run, const AnalyticCad& cad) {
  const SurfaceMesh& mesh = run.session->mesh();
  const FaceMesh& face = mesh.faces[0];
  ASSERT_FALSE(face.triangles.empty());
  for (const auto& t : face.triangles) {
    std::array<Vec3, 3> p;
    for (int i = 0; i < 3; ++i) p[i] = mesh.vertices[face.vertex[t[i]]];
    const Vec2 centre = (1. / 3) * (face.uv[t[0]] + face.uv[t[1]] + face.uv[t[2]]);
    const auto normal = unit_normal(cad.faces.at(1).at(centre));
    ASSERT_TRUE(normal);
    ASSERT_GT(dot(cross(p[1] - p[0], p[2] - p[0]), *normal), 0) << "at " << centre.x() << ", " << centre.y();
  }
}

class SurfaceAgreement : public ::testing::TestWithParam<Surface> {};

TEST_P(SurfaceAgreement, WhateverTheGeometricRule) {
  const AnalyticCad cad = GetParam().make();
  for (const char* rule : {"angle", "chord", "both", "radii"})
    for (const int by_direction : {0, 1})
      for (const int guarantee : {0, 1})
        for (const double scale : {0.5, 1., 4.}) {
          SCOPED_TRACE(std::string(rule) + (by_direction != 0 ? " by direction, " : ", ") +
                       (guarantee != 0 ? "guaranteed, " : "") + "scale " + std::to_string(scale));
          const GeometricRun run(GetParam().make(), [&](Parameters& p) {
            p.set("geo_rule", rule);
            p.set("geo_metric", by_direction);
            p.set("geo_guarantee", guarantee);
            p.set("angle_mesh", 8 * scale);
            p.set("eps_chord", 2e-3 * scale * scale);
            p.set("hgeomin", 1e-2);
          });
          expect_agreement(run, cad);
          EXPECT_EQ(run.session->delivered().folded_triangles, 0);  // nor anywhere else
        }
}

TEST_P(SurfaceAgreement, HoldsForOneSize) {
  const AnalyticCad cad = GetParam().make();
  for (const double h : {0.05, 0.2, 0.4, 0.8}) {
    SCOPED_TRACE(h);
    const GeometricRun run(GetParam().make(), [&](Parameters& p) {
      p.set("hgeo_flag", 0);
      p.set("hphy_flag", 1);
      p.set("hphydef", h);
    });
    expect_agreement(run, cad);
  }
}

// Triangles round the apex of a cone exceed any angle, however small they are: they end at hgeomin.
TEST(Guaranteed, NothingIsDividedBelowTheSmallestSize) {
  for (const double smallest : {0.004, 0.008})
    for (const double gradation : {1.05, 1.1, 1.15}) {
      SCOPED_TRACE(::testing::Message() << smallest << ", gradation " << gradation);
      const GeometricRun run(one_face(
                                 [](Vec2 p) {
                                   const double c = std::cos(p.x()), s = std::sin(p.x()), r = 1 - p.y() + 1e-12;
                                   return SurfaceJet{{r * c, r * s, 3 * p.y()}, {-r * s, r * c, 0}, {-c, -s, 3},
                                                     {-r * c, -r * s, 0},       {s, -c, 0},         {}};
                                 },
                                 rectangle({0, 0}, {2 * pi, 1})),
                             [&](Parameters& p) {
                               p.set("geo_rule", "both");
                               p.set("geo_metric", 1);
                               p.set("geo_guarantee", 1);
                               p.set("angle_mesh", 8);
                               p.set("eps_chord", 4e-3);
                               p.set("hgeomin", smallest);
                               p.set("gradation", gradation);
                             });
      const SurfaceMesh& mesh = run.session->mesh();
      double shortest = 1;
      for (const auto& t : mesh.faces[0].triangles)
        for (int i = 0; i < 3; ++i) {
          const Vec3 e =
              mesh.vertices[mesh.faces[0].vertex[t[(i + 1) % 3]]] - mesh.vertices[mesh.faces[0].vertex[t[i]]];
          if (norm(e) > 1e-9) shortest = std::min(shortest, norm(e));
        }
      EXPECT_GT(shortest, smallest / 4);  // medians of divided triangles are shorter than halves
    }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, SurfaceAgreement, ::testing::ValuesIn(surfaces_that_bend),
                         [](const auto& instance) { return std::string(instance.param.name); });

/// A fillet in a corner that turns inwards, of u from 0 to `angle`: edges of `outer` on its outer side, of 1.3 on the
/// others.
struct Fillet {
  Monitor monitor;
  Session session{monitor};

  Fillet(double angle, double outer, const std::function<void(Parameters&)>& more) {
    const auto host = std::make_shared<AnalyticCad>(
        one_face([](Vec2 p) { return torus_jet(p, 7.5, 0.6); }, rectangle({0, pi / 2}, {angle, pi})));
    host->size_on_curve = [outer](int, int ic, double) { return ic == 1 ? outer : 1.3; };
    session.set_cad(host);
    session.set_model(unglued(*host));
    Parameters& p = session.parameters();
    p.set("hphy_flag", 2);
    p.set("hphymin", 0.01);
    p.set("hphymax", 20.0);
    more(p);
    session.make_mesh();
  }
};

void by_direction(Parameters& p, double angle) {
  p.set("hgeo_flag", 1);
  p.set("geo_metric", 1);
  p.set("angle_mesh", angle);
  p.set("hgeomax", 20.0);
}

// One edge on the outer side and seven on the inner one: the chord of that edge passes inside of the inner side, and
// the outer curve outside of it.
TEST(AgreementBesideChords, EdgesThatBulgePastTheOtherSideOfAFillet) {
  for (const bool directed : {false, true}) {
    SCOPED_TRACE(directed ? "by direction" : "one size");
    Fillet run(1.3, 12, [&](Parameters& p) {
      p.set("CheckCloseEdges", 20);
      p.set("CoefRectangle", 0.065);
      if (directed) by_direction(p, 60);
    });
    EXPECT_EQ(find_defects(run.session.mesh()), std::vector<std::string>{});
    EXPECT_EQ(run.session.delivered().folded_triangles, 0);
  }
}

// If such edges are left alone, no division makes the triangles on them agree with the surface, and divisions end
// before vertices coincide. The mesh reports that they are turned over.
TEST(AgreementBesideChords, AreNotDividedForEver) {
  Fillet run(2 * pi, 8.8, [](Parameters& p) {
    by_direction(p, 40);
    p.set("hgeomin", 0.01);
  });
  const FaceMesh& face = run.session.mesh().faces[0];
  EXPECT_EQ(face.status, FaceStatus::mended);
  EXPECT_NE(face.why.find("7 triangles are turned over or stand upright on the surface"), std::string::npos)
      << face.why;
  EXPECT_EQ(find_defects(run.session.mesh()), std::vector<std::string>{});
  EXPECT_LT(face.triangles.size(), 1000U);
}

}  // namespace
}  // namespace carreau
