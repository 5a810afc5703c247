// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/atlas/blended_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "../../atlas/shapes.h"
#include "support/error.h"

namespace carreau::atlas {
namespace {

Vec3 unit_normal(const SurfaceJet& jet) {
  const Vec3 n = cross(jet.su, jet.sv);
  return n / norm(n);
}

TEST(HeightField, ReproducesQuadratics) {
  const auto height = [](double x, double y) { return 1 + 2 * x - y + .5 * x * x - x * y + 3 * y * y; };
  std::vector<Height> points;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j) points.push_back({Vec3(i, j, height(i, j))});
  const HeightField field = fit_heights(points, 2);
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
    const Primitive fitted = primitive_of(coarse_heights(covering, chart), chart.frame);
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
              primitive_of(coarse_heights(surface.covering(), chart), chart.frame).coefficient);
  }
}

TEST(HeightField, ReproducesPolynomialsOfItsDegree) {
  const auto height = [](double x, double y) { return x * x * x * x * x * y - 2 * std::pow(y, 6) + x - 3; };
  std::vector<Height> points;
  for (int i = -5; i <= 5; ++i)
    for (int j = -5; j <= 5; ++j) points.push_back({Vec3(.2 * i, .2 * j, height(.2 * i, .2 * j)), i % 2 == 0 ? 1 : .1});
  const HeightField field = fit_heights(points, 6);
  EXPECT_NEAR(field.at(Pair<double>{.3, -.7}), height(.3, -.7), 1e-5);
}

/// The largest angle between normals of the surface and true ones, over the angle of the longest chord. The principal curvature
/// that 99 of 100 places do not exceed.
struct Faults {
  double worst = 0, curvature = 0;
};

template <typename Normal>
Faults faults_of(const Triangulation& given, Normal&& normal_at) {
  const BlendedSurface surface{Covering(given)};
  const Covering& covering = surface.covering();
  const auto angle = [](const Vec3& a, const Vec3& b) { return std::atan2(norm(cross(a, b)), dot(a, b)); };
  double chord = 0;
  for (const auto& t : covering.surface().triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = [&](std::size_t c) { return covering.surface().vertices[static_cast<std::size_t>(t[c % 3])]; };
      chord = std::max(chord, angle(normal_at(at(k)), normal_at(at(k + 1))));
    }
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> curvatures, angles;
  for (std::size_t i = 0; i < covering.charts().size(); ++i)
    for (int k = 0; k < 100; ++k) {
      const Annulus& a = covering.charts()[i].annulus;
      const SurfaceJet jet = surface.at(i, value_of(a.at(unit(random), a.period() * unit(random))));
      const Vec3 n = unit_normal(jet);
      angles.push_back(angle(n, normal_at(jet.s)) / chord);
      const double e = dot(jet.su, jet.su), f = dot(jet.su, jet.sv), g = dot(jet.sv, jet.sv), d = e * g - f * f;
      const double l = dot(jet.suu, n), m = dot(jet.suv, n), p = dot(jet.svv, n);
      const double mean = (e * p - 2 * f * m + g * l) / (2 * d), gauss = (l * p - m * m) / d;
      curvatures.push_back(std::abs(mean) + std::sqrt(std::max(0., mean * mean - gauss)));
    }
  std::sort(curvatures.begin(), curvatures.end());
  return {*std::max_element(angles.begin(), angles.end()), curvatures[curvatures.size() * 99 / 100]};
}

Vec3 normal_of_sphere(const Vec3& p) { return p / norm(p); }

/// Heights about vertices: neither places where charts squeeze their parameters are exceptions, nor surfaces that turn by 36 degrees along
/// an edge, nor triangles that are 3.5 times longer than wide.
TEST(BlendedSurface, NormalsAreWithinATenthOfTheAngleOfChords) {
  const auto check = [](const Triangulation& given, const auto& normal_at) {
    const Faults faults = faults_of(given, normal_at);
    EXPECT_LT(faults.worst, .1);
  };
  for (const int level : {1, 2, 3}) check(test::icosphere(level), normal_of_sphere);
  const auto normal_of_torus = [](double radius) {
    return [radius](const Vec3& p) -> Vec3 {
      const double inwards = 1 - radius / std::hypot(p.x(), p.y());
      return normal_of_sphere({p.x() * inwards, p.y() * inwards, p.z()});
    };
  };
  check(test::torus(1, .4, 48, 24), normal_of_torus(1));
  check(test::torus(1, .4, 20, 20), normal_of_torus(1));
  check(test::torus(1, .4, 20, 10), normal_of_torus(1));
  check(test::torus(2, .8, 36, 18), normal_of_torus(2));
  Triangulation ellipsoid = test::icosphere(3);
  for (Vec3& p : ellipsoid.vertices) p = Vec3(2 * p.x(), p.y(), .7 * p.z());
  check(ellipsoid, [](const Vec3& p) -> Vec3 { return normal_of_sphere({p.x() / 4, p.y(), p.z() / .49}); });
}

/// Places of T that are not on the grid of the check, also in strips between knots of phi that are narrower than its cells.
/// Looks at random places that charts share.
void expect_no_fold(const BlendedSurface& surface) {
  std::mt19937_64 random(10);
  std::uniform_real_distribution<double> unit(0, 1);
  const Covering& covering = surface.covering();
  for (std::size_t t = 0; t < covering.triples().size(); ++t)
    for (int k = 0; k < 500; ++k) {
      double x = unit(random), y = unit(random);
      if (x + y > 1) x = 1 - x, y = 1 - y;
      const Vec2 place = x * corner_of_t(1) + y * corner_of_t(2);
      const std::array<double, 3> weights = Covering::weights(pair_of(place));
      if (*std::max_element(weights.begin(), weights.end()) == 1) continue;  // in a pure zone
      Vec3 normal(0, 0, 0);
      for (std::size_t c = 0; c < 3; ++c)
        normal += weights[c] * covering.charts()[static_cast<std::size_t>(covering.triples()[t].chart[c])].frame.normal;
      const SurfaceJet jet = surface.at_triple(t, place);
      EXPECT_GT(dot(cross(jet.su, jet.sv), normal), 0) << t << " " << place.transpose();
    }
}

TEST(BlendedSurface, NoPlaceOfAnAcceptedSurfaceIsTurnedOver) {
  for (const Triangulation& given : {test::icosphere(3), test::torus(1, .4, 20, 20), test::torus(2, .8, 36, 18)})
    expect_no_fold(BlendedSurface{Covering(given)});
}

/// The convex hull of points of the unit sphere that are evenly spread along a spiral: fans of five to seven triangles.
Triangulation spiral_sphere(std::int32_t n) {
  Triangulation s;
  for (std::int32_t k = 0; k < n; ++k) {
    const double z = 1 - (2. * k + 1) / n, r = std::sqrt(1 - z * z), turn = std::numbers::pi * (3 - std::sqrt(5.)) * k;
    s.vertices.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
  }
  const auto at = [&](std::int32_t v) -> const Vec3& { return s.vertices[static_cast<std::size_t>(v)]; };
  for (std::int32_t a = 0; a < n; ++a)
    for (std::int32_t b = a + 1; b < n; ++b) {
      if (norm(at(a) - at(b)) > 8 / std::sqrt(n)) continue;  // edges are half as long
      for (std::int32_t c = b + 1; c < n; ++c) {
        Vec3 normal = cross(at(b) - at(a), at(c) - at(a));
        const bool is_turned = dot(normal, at(a)) < 0;
        if (is_turned) normal = -normal;
        bool is_outer = true;
        for (std::int32_t v = 0; v < n && is_outer; ++v)
          is_outer = v == a || v == b || v == c || dot(normal, at(v) - at(a)) < 0;
        if (is_outer) s.triangles.push_back(is_turned ? std::array{a, c, b} : std::array{a, b, c});
      }
    }
  return s;
}

/// Folds of a few thousandths of T lie between the places of the repair's grid: the final check hands them over.
TEST(BlendedSurface, IrregularSpheresAreAccepted) {
  for (const std::int32_t n : {100, 250})
    for (const int hops : {1, 2}) {
      const Triangulation given = spiral_sphere(n);
      ASSERT_EQ(given.triangles.size(), static_cast<std::size_t>(2 * n - 4));
      const BlendedSurface surface{Covering(given, {.hops = hops})};
      expect_no_fold(surface);
      double farthest = 0;
      check_agreement(surface, farthest);
      EXPECT_LT(farthest, 7. / n);  // half of a squared edge: the height of a fan over its border
    }
}

/// The ellipsoid of a vertex holds the fan with a margin of a half.
TEST(LocalHeights, EllipsoidsHoldTheFan) {
  Triangulation ellipsoid = test::icosphere(3);
  for (Vec3& p : ellipsoid.vertices) p = Vec3(8 * p.x(), p.y(), p.z());
  const Covering covering(ellipsoid);
  for (std::int32_t v = 0; v < 642; ++v) {
    const LocalHeights local = local_heights(covering, v);
    EXPECT_EQ(local.frame.origin, covering.surface().vertices[static_cast<std::size_t>(v)]);
    double farthest = 0;
    for (const std::int32_t w : covering.fans().around(v)) {
      const Vec2 q = local.frame.project(covering.surface().vertices[static_cast<std::size_t>(w)]);
      const double form = local.form[0] * q.x() * q.x() + local.form[1] * q.x() * q.y() + local.form[2] * q.y() * q.y();
      farthest = std::max(farthest, form);
      EXPECT_LT(norm(q), local.reach);
    }
    EXPECT_NEAR(farthest, 1 / 2.25, 1e-9) << v;
  }
}

TEST(BlendedSurface, CurvaturesSeeNoWaves) {
  EXPECT_LT(faults_of(test::icosphere(3), normal_of_sphere).curvature, 1.05);
}

/// Charts of large clusters disagree by more than the repair can move them.
TEST(BlendedSurface, FoldsThatRemainAreRejectedWithAPlace) {
  const Triangulation torus = test::torus(2, .8, 40, 36);
  const BlendedSurface repaired{Covering(torus, {.hops = 2})};
  EXPECT_GT(repaired.folds().folded_before, 0u);
  expect_no_fold(repaired);
  try {
    const BlendedSurface surface{Covering(test::torus(2, .8, 20, 10), {.hops = 3})};
    FAIL();
  } catch (const DomainError& e) {
    EXPECT_NE(std::string(e.what()).find("the blended surface is turned over near ("), std::string::npos) << e.what();
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
