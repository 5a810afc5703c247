// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/atlas/blended_surface.h"

#include <gtest/gtest.h>

#include <random>

#include "../../atlas/shapes.h"

namespace carreau::atlas {
namespace {

Vec3 unit_normal(const SurfaceJet& jet) {
  const Vec3 n = cross(jet.su, jet.sv);
  return n / norm(n);
}

TEST(HeightField, ReproducesQuadratics) {
  const auto height = [](double x, double y) { return 1 + 2 * x - y + .5 * x * x - x * y + 3 * y * y; };
  std::vector<Vec3> points;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j) points.emplace_back(i, j, height(i, j));
  const HeightField field = fit_heights(points);
  EXPECT_NEAR(field.at(Pair<double>{.3, -.7}), height(.3, -.7), 1e-6);
}

/// Points and normals of a place are the same in all charts that have it.
void check_agreement(const BlendedSurface& surface, double& farthest_from_sphere) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  const Covering& covering = surface.covering();
  double points = 0, normals = 0;
  for (std::size_t i = 0; i < covering.charts().size(); ++i)
    for (int k = 0; k < 50; ++k) {
      const Annulus& a = covering.charts()[i].annulus;
      const Vec2 m = value_of(a.at(unit(random), a.period() * unit(random)));
      const SurfaceJet here = surface.at(i, m);
      farthest_from_sphere = std::max(farthest_from_sphere, std::abs(norm(here.s) - 1));
      const auto on = covering.on_t(i, pair_of(m));
      for (const std::int32_t chart : covering.triples()[static_cast<std::size_t>(on->corner.triple)].chart) {
        const auto j = static_cast<std::size_t>(chart);
        const auto there = j == i ? std::nullopt : covering.transition(i, j, m);
        if (!there) continue;
        const SurfaceJet other = surface.at(j, *there);
        points = std::max(points, norm(here.s - other.s));
        normals = std::max(normals, norm(unit_normal(here) - unit_normal(other)));
      }
    }
  EXPECT_LT(points, 1e-12);
  EXPECT_LT(normals, 1e-6);
}

TEST(BlendedSurface, SphereOf320TrianglesIsWithinAHundredthOfItsRadius) {
  double farthest = 0;
  check_agreement(BlendedSurface(Covering(test::icosphere(2))), farthest);
  EXPECT_LT(farthest, .01);
}

TEST(BlendedSurface, ChartsOfATorusAgree) {
  double unused = 0;
  check_agreement(BlendedSurface(Covering(test::torus(2, .8, 36, 18))), unused);
}

/// Charts of the sphere of 1280 triangles disagree at some places by more than they are wide.
TEST(BlendedSurface, FoldsAreRepairedAndChartsStillAgree) {
  const BlendedSurface surface(Covering(test::icosphere(3)));
  const Covering& covering = surface.covering();
  EXPECT_GT(surface.folds().folded_before, 0u);
  EXPECT_EQ(surface.folds().folded_after, 0u);
  double farthest = 0;
  check_agreement(surface, farthest);
  EXPECT_LT(farthest, .02);
  std::size_t changed = 0;
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> unit(0, 1);
  for (std::size_t i = 0; i < covering.charts().size(); ++i) {
    const Chart& chart = covering.charts()[i];
    const Primitive fitted = primitive_of(fit_heights(covering.surface(), chart), chart.frame);
    changed += surface.primitive(i).coefficient != fitted.coefficient;
    // At places that are not on the repair's grid.
    for (int k = 0; k < 200; ++k) {
      const SurfaceJet jet =
          surface.at(i, value_of(chart.annulus.at(unit(random), chart.annulus.period() * unit(random))));
      EXPECT_GT(dot(unit_normal(jet), jet.s), 0) << i;
    }
  }
  EXPECT_EQ(changed, surface.folds().mended_charts);
  EXPECT_LT(changed, covering.charts().size() / 2);
}

TEST(BlendedSurface, SurfacesThatDoNotFoldKeepTheirHeightFields) {
  const BlendedSurface surface(Covering(test::icosphere(2)));
  EXPECT_EQ(surface.folds().folded_before, 0u);
  EXPECT_EQ(surface.folds().mended_charts, 0u);
  for (std::size_t i = 0; i < surface.covering().charts().size(); ++i) {
    const Chart& chart = surface.covering().charts()[i];
    EXPECT_EQ(surface.primitive(i).coefficient,
              primitive_of(fit_heights(surface.covering().surface(), chart), chart.frame).coefficient);
  }
}

TEST(BlendedSurface, DerivativesMatchDifferences) {
  const BlendedSurface surface(Covering(test::icosphere(2)));
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  for (std::size_t i = 0; i < surface.covering().charts().size(); ++i) {
    const Annulus& a = surface.covering().charts()[i].annulus;
    const Vec2 m = value_of(a.at(.1 + .8 * unit(random), a.period() * unit(random)));
    const SurfaceJet jet = surface.at(i, m);
    constexpr double h = 1e-6;
    for (const bool x : {true, false}) {
      const Vec2 d = x ? Vec2(h, 0) : Vec2(0, h);
      const Vec3 slope = (surface.at(i, m + d).s - surface.at(i, m - d).s) / (2 * h);
      EXPECT_LT(norm(slope - (x ? jet.su : jet.sv)), 1e-5);
    }
  }
}

TEST(BlendedSurface, LowerOrdersAreTheSameToTheLastBit) {
  const BlendedSurface surface(Covering(test::icosphere(3)));
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(-.2, 1);
  for (std::size_t i = 0; i < surface.covering().charts().size(); ++i) {
    const Annulus& a = surface.covering().charts()[i].annulus;
    const Vec2 m = value_of(a.at(unit(random), a.period() * unit(random)));
    const SurfaceJet all = surface.at(i, m), first = surface.at(i, m, 1);
    EXPECT_EQ(all.s, first.s);
    EXPECT_EQ(all.su, first.su);
    EXPECT_EQ(all.sv, first.sv);
  }
}

/// Triangles of a torus that are two to three times longer than wide: charts disagree by more than they are wide.
TEST(BlendedSurface, FoldsOfUnevenTrianglesAreRepaired) {
  const BlendedSurface surface(Covering(test::torus(2, .8, 40, 36)));
  EXPECT_GT(surface.folds().folded_before, 0u);
  EXPECT_EQ(surface.folds().folded_after, 0u);
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  for (std::size_t i = 0; i < surface.covering().charts().size(); ++i) {
    const Annulus& a = surface.covering().charts()[i].annulus;
    for (int k = 0; k < 200; ++k) {
      const SurfaceJet jet = surface.at(i, value_of(a.at(unit(random), a.period() * unit(random))));
      const double r = std::hypot(jet.s.x(), jet.s.y());
      const Vec3 outwards(jet.s.x() * (1 - 2 / r), jet.s.y() * (1 - 2 / r), jet.s.z());
      EXPECT_GT(dot(unit_normal(jet), outwards), 0) << i;
    }
  }
}

TEST(BlendedSurface, SidesAreOneCurveInBothFaces) {
  const BuiltGeometry built = build_atlas(std::make_shared<BlendedSurface>(Covering(test::icosphere(2))));
  std::map<int, std::vector<std::pair<int, int>>> uses;
  for (const Face& face : built.model.faces)
    for (std::size_t k = 0; k < face.curves.size(); ++k)
      uses[face.curves[k].ref].emplace_back(face.ref, static_cast<int>(k) + 1);
  for (const auto& [ref, two] : uses) {
    ASSERT_EQ(two.size(), 2u) << ref;
    for (int k = 0; k <= 10; ++k) {
      const double t = -1 + .2 * k;
      const auto point = [&](std::pair<int, int> use, double at) -> Vec3 {
        return surface_at(*built.cad, use.first, want_position,
                          built.cad->curve(use.first, use.second, want_position, at).c)
            .s;
      };
      EXPECT_LT(norm(point(two[0], t) - point(two[1], -t)), 1e-12);
    }
  }
}

}  // namespace
}  // namespace carreau::atlas
