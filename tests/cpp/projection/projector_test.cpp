// SPDX-License-Identifier: BSD-3-Clause
#include "projection/projector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>
#include <random>

#include "common/analytic_cad.h"
#include "cpp/geometry/discrete/surfaces.h"
#include "geometry/discrete/discrete_cad.h"
#include "support/error.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
constexpr double pi = std::numbers::pi;

/// The faces of a geometry; each curve has a different reference.
Model model_of(const AnalyticCad& cad) {
  Model model = testing::unglued(cad);
  int ref = 0;
  for (Face& face : model.faces)
    for (FaceCurve& curve : face.curves) curve.ref = ++ref, curve.end1 = 2 * ref - 1, curve.end2 = 2 * ref;
  return model;
}

std::vector<ProjectedPoint> project(const AnalyticCad& cad, const std::vector<Vec3>& x, int dimension = 2, int ref = 0, int threads = 1) {
  Monitor monitor;
  Projector projector(std::make_shared<AnalyticCad>(cad), nullptr, model_of(cad));
  std::vector<ProjectedPoint> out(x.size());
  projector.project(dimension, ref, x, out, threads, monitor);
  return out;
}

std::vector<Vec3> random_points(int n, double reach) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(-reach, reach);
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    const double x = at(random), y = at(random), z = at(random);
    points.emplace_back(x, y, z);
  }
  return points;
}

SurfaceJet sphere_jet(Vec2 p, double r) {
  const double cu = std::cos(p.x()), su = std::sin(p.x()), cv = std::cos(p.y()), sv = std::sin(p.y());
  SurfaceJet j;
  j.s = r * Vec3(cu * cv, su * cv, sv);
  j.su = r * Vec3(-su * cv, cu * cv, 0), j.sv = r * Vec3(-cu * sv, -su * sv, cv);
  j.suu = r * Vec3(-cu * cv, -su * cv, 0), j.suv = r * Vec3(su * sv, -cu * sv, 0), j.svv = -j.s;
  return j;
}

AnalyticCad sphere(double r) {
  AnalyticCad cad;
  cad.faces[1] = {[r](Vec2 p) { return sphere_jet(p, r); }, testing::rectangle({0, -pi / 2}, {2 * pi, pi / 2})};
  return cad;
}

/// Two unit squares at a right angle: points of one of them near their edge are not nearer to the other.
TEST(Projector, PointsBesideAnEdgeHaveTheNearerFace) {
  AnalyticCad cad;
  for (const int face : {1, 2})
    cad.faces[face] = {[face](Vec2 p) {
                         SurfaceJet j;
                         j.s[face] = p.x(), j.s[0] = p.y(), j.su[face] = 1, j.sv[0] = 1;
                         return j;
                       },
                       testing::rectangle({0, 0}, {1, 1})};
  std::vector<Vec3> x;
  for (double d = 1e-9; d < 0.1; d *= 3)
    for (const double along : {0.0, 0.2, 0.5, 1.0}) x.emplace_back(along, d, 0), x.emplace_back(along, 0, d);
  const std::vector<ProjectedPoint> found = project(cad, x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_LT(found[i].distance, 1e-14) << x[i].transpose();
    EXPECT_EQ(found[i].ref, i % 2 == 0 ? 1 : 2);
  }
}

/// A corner of a flat leaf is a corner of its box: rounding must not exclude the leaf.
TEST(Projector, FarPointsOfATiltedPlane) {
  AnalyticCad cad;
  const Vec3 e = Vec3(3, 1, -2) / std::sqrt(14), f = Vec3(1, 1, 2) / std::sqrt(6);
  cad.faces[1] = {[e, f](Vec2 p) {
                    SurfaceJet j;
                    j.s = Vec3(0.1, 0.7, -0.3) + p.x() * e + p.y() * f, j.su = e, j.sv = f;
                    return j;
                  },
                  testing::rectangle({0, 0}, {1, 1})};
  const std::vector<Vec3> x = random_points(5000, 40);
  const std::vector<ProjectedPoint> found = project(cad, x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 r = x[i] - Vec3(0.1, 0.7, -0.3);
    EXPECT_NEAR(found[i].parameters.x(), std::clamp(dot(r, e), 0.0, 1.0), 1e-12);
    EXPECT_NEAR(found[i].parameters.y(), std::clamp(dot(r, f), 0.0, 1.0), 1e-12);
  }
}

TEST(Projector, FaceThatFailsLeavesTheOthers) {
  AnalyticCad cad;
  for (const int face : {1, 2, 3})
    cad.faces[face] = {[face](Vec2 p) {
                         if (face == 2 && p.x() > 0.3 && p.x() < 0.6) throw CallbackError(Where{.face = face, .uv = p}, "it fails on purpose");
                         SurfaceJet j;
                         j.s = {p.x(), p.y(), double(face)}, j.su[0] = 1, j.sv[1] = 1;
                         return j;
                       },
                       {testing::segment({0, 0}, {0.2, 0}), testing::segment({0.2, 0}, {0.2, 1}), testing::segment({0.2, 1}, {0, 1}), testing::segment({0, 1}, {0, 0})}};
  cad.faces[2].curves = testing::rectangle({0, 0}, {1, 1});
  cad.faces[2].curves[0] = cad.faces[2].curves[2] = testing::segment({0, 0}, {0.2, 0});  // the host can evaluate its sides
  Monitor monitor;
  Projector projector(std::make_shared<AnalyticCad>(cad), nullptr, model_of(cad));
  const std::vector<Vec3> x{{0.1, 0.5, 1.2}, {0.1, 0.4, 2.8}, {0.1, 0.3, 2.1}};
  std::vector<ProjectedPoint> found(x.size());
  const std::map<int, std::string> failed = projector.project(2, 0, x, found, 1, monitor);
  ASSERT_EQ(failed.size(), 1U);
  EXPECT_NE(failed.at(2).find("on purpose"), std::string::npos);
  EXPECT_NEAR(found[0].distance, 0.2, 1e-14);
  EXPECT_NEAR(found[1].distance, 0.2, 1e-14);
  EXPECT_NEAR(found[2].distance, 0.9, 1e-14);
  EXPECT_THROW(projector.project(2, 2, x, found, 1, monitor), CallbackError);
  EXPECT_TRUE(projector.project(2, 3, x, found, 1, monitor).empty());
}

TEST(Projector, Sphere) {
  const double r = 2;
  std::vector<Vec3> x = random_points(2000, 5);
  for (const Vec3& special : {Vec3(0, 0, 3), Vec3(0, 0, -1e-3), Vec3(1e-9, 0, 5), Vec3(3, 0, 0), Vec3(3, -1e-12, 0), Vec3(0.1, 0, 0)}) x.push_back(special);
  const std::vector<ProjectedPoint> found = project(sphere(r), x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double d = norm(x[i]);
    EXPECT_NEAR(found[i].distance, std::abs(d - r), 4e-12) << x[i].transpose();
    EXPECT_NEAR(norm(found[i].xyz - (r / d) * x[i]), 0, 4e-12) << x[i].transpose();
    EXPECT_NEAR(norm(sphere_jet(found[i].parameters, r).s - found[i].xyz), 0, 4e-12);
  }
}

TEST(Projector, CentreOfASphereHasTheRadiusAsDistance) {
  const ProjectedPoint found = project(sphere(2), {{0, 0, 0}})[0];
  EXPECT_NEAR(found.distance, 2, 1e-12);
}

AnalyticCad torus() {
  AnalyticCad cad;
  cad.faces[1] = {[](Vec2 p) { return testing::torus_jet(p, 3, 1); }, testing::rectangle({0, 0}, {2 * pi, 2 * pi})};
  return cad;
}

TEST(Projector, Torus) {
  const std::vector<Vec3> x = random_points(2000, 5);
  const std::vector<ProjectedPoint> found = project(torus(), x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double around = std::hypot(x[i].x(), x[i].y()), d = std::hypot(around - 3, x[i].z());
    EXPECT_NEAR(found[i].distance, std::abs(d - 1), 1e-11) << x[i].transpose();
    const Vec3 centre{3 * x[i].x() / around, 3 * x[i].y() / around, 0};
    EXPECT_NEAR(norm(found[i].xyz - (centre + (1 / d) * (x[i] - centre))), 0, 1e-11) << x[i].transpose();
  }
}

TEST(Projector, TorusFromItsAxis) {
  // All points of a circle are closest.
  const std::vector<Vec3> x{{0, 0, 0}, {0, 0, 0.5}, {0, 0, -4}};
  const std::vector<ProjectedPoint> found = project(torus(), x), again = project(torus(), x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(found[i].distance, std::hypot(3, x[i].z()) - 1, 1e-12);
    EXPECT_EQ(found[i].xyz, again[i].xyz);
  }
}

/// Bisection on the condition of a closest point: x_i = a_i^2 p_i / (a_i^2 + t), sum (a_i p_i / (a_i^2 + t))^2 = 1.
double distance_to_ellipsoid(const Vec3& axes, const Vec3& p) {
  double smallest = 1e300, reach = 0;
  for (int i = 0; i < 3; ++i) smallest = std::min(smallest, axes[i] * axes[i]), reach += std::abs(axes[i] * p[i]);
  double low = -smallest, high = reach + 1;
  const auto sum = [&](double t) {
    double s = 0;
    for (int i = 0; i < 3; ++i) s += std::pow(axes[i] * p[i] / (axes[i] * axes[i] + t), 2);
    return s;
  };
  for (int k = 0; k < 200; ++k) {
    const double t = (low + high) / 2;
    (sum(t) > 1 ? low : high) = t;
  }
  Vec3 foot;
  for (int i = 0; i < 3; ++i) foot[i] = axes[i] * axes[i] * p[i] / (axes[i] * axes[i] + low);
  return norm(foot - p);
}

TEST(Projector, Ellipsoid) {
  const Vec3 axes{3, 2, 1};
  AnalyticCad cad;
  const auto jet = [axes](Vec2 p) {
    SurfaceJet j = sphere_jet(p, 1);
    for (Vec3* v : {&j.s, &j.su, &j.sv, &j.suu, &j.suv, &j.svv}) *v = Vec3(v->cwiseProduct(axes));
    return j;
  };
  cad.faces[1] = {jet, testing::rectangle({0, -pi / 2}, {2 * pi, pi / 2})};
  const std::vector<Vec3> x = random_points(3000, 4);
  const std::vector<ProjectedPoint> found = project(cad, x);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(found[i].distance, distance_to_ellipsoid(axes, x[i]), 1e-11) << x[i].transpose();
}

/// The smallest distance of a fine grid, which a finer grid around it follows.
double sampled_distance(const std::function<Vec3(Vec2)>& s, Vec2 low, Vec2 high, const Vec3& x) {
  double least = 1e300;
  for (int round = 0; round < 12; ++round) {
    constexpr int n = 60;
    Vec2 best = low;
    const Vec2 size = high - low;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        const Vec2 uv = low + Vec2(i * size.x() / n, j * size.y() / n);
        if (const double d = norm(s(uv) - x); d < least || (i == 0 && j == 0 && round == 0)) least = std::min(d, least), best = uv;
      }
    if (round > 0 && best == low) best = (low + high) / 2;
    low = (best - 2.0 / n * size).cwiseMax(round == 0 ? low : Vec2(0, 0)).cwiseMax(Vec2(0, 0));
    high = (best + 2.0 / n * size).cwiseMin(Vec2(1, 1));
  }
  return least;
}

TEST(Projector, FoldedPatchHasTwoMinimaAndTheNearerOneWins) {
  std::array<Vec3, 16> control;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) control[4 * i + k] = {(i == 1 || i == 2) ? 4.0 : 0, k / 3.0, i < 2 ? 0.0 : 1.0};
  AnalyticCad cad;
  const auto jet = [control](Vec2 p) { return testing::bezier_jet(control, p); };
  cad.faces[1] = {jet, testing::rectangle({0, 0}, {1, 1})};
  // Between both legs, nearer to the one or the other.
  const std::vector<Vec3> x{{1, 0.5, 0.45}, {1, 0.5, 0.55}, {1, 0.2, 0.4999}, {1, 0.2, 0.5001}, {5, 0.5, 0.5}, {2, 3, 0.6}, {-1, 0.5, 0.6}};
  const std::vector<ProjectedPoint> found = project(cad, x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double expected = sampled_distance([&](Vec2 p) { return jet(p).s; }, {0, 0}, {1, 1}, x[i]);
    EXPECT_LE(found[i].distance, expected + 1e-9) << x[i].transpose();
    EXPECT_NEAR(found[i].distance, norm(jet(found[i].parameters).s - x[i]), 1e-12);
  }
  EXPECT_LT(found[2].parameters.x(), 0.5);
  EXPECT_GT(found[3].parameters.x(), 0.5);
}

TEST(Projector, TrimmedPlane) {
  // A disc of radius 2 with a hole of radius 1, in the plane z = 1.
  AnalyticCad cad;
  const auto plane = [](Vec2 p) { return SurfaceJet{{p.x(), p.y(), 1}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; };
  cad.faces[1] = {plane, {testing::arc({0, 0}, 2, 0, pi), testing::arc({0, 0}, 2, pi, 2 * pi), testing::arc({0, 0}, 1, 0, 2 * pi)}};
  std::vector<Vec3> x = random_points(1000, 3);
  for (const double r : {0.5, 1 - 1e-6, 1 + 1e-6, 1 - 1e-4, 1 + 1e-4, 2 - 1e-6, 2 + 1e-6, 2.5})  // beside the arcs and their chords
    for (int k = 0; k < 50; ++k) x.emplace_back(r * std::cos(0.1 + k), r * std::sin(0.1 + k), 1);
  const std::vector<ProjectedPoint> found = project(cad, x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double r = std::hypot(x[i].x(), x[i].y()), to = std::clamp(r, 1.0, 2.0);
    EXPECT_NEAR(norm(found[i].xyz - Vec3(to * x[i].x() / r, to * x[i].y() / r, 1)), 0, 4e-12) << x[i].transpose();
    EXPECT_NEAR(found[i].distance, std::hypot(to - r, x[i].z() - 1), 4e-12) << x[i].transpose();
    EXPECT_NEAR(norm(found[i].parameters - Vec2(found[i].xyz.x(), found[i].xyz.y())), 0, 4e-12);
  }
}

TEST(Projector, ConeAndItsApex) {
  // z = 2 - r, 0 <= r <= 2; the apex is a side of the domain.
  AnalyticCad cad;
  const auto cone = [](Vec2 p) {
    const double c = std::cos(p.x()), s = std::sin(p.x()), r = p.y();
    return SurfaceJet{{r * c, r * s, 2 - r}, {-r * s, r * c, 0}, {c, s, -1}, {-r * c, -r * s, 0}, {-s, c, 0}, {}};
  };
  cad.faces[1] = {cone, testing::rectangle({0, 0}, {2 * pi, 2})};
  std::vector<Vec3> x = random_points(1000, 4);
  for (const Vec3& special : {Vec3(0, 0, 3), Vec3(0.1, 0.2, 4), Vec3(0, 0, 2), Vec3(0.01, -0.03, 2.5)}) x.push_back(special);
  const std::vector<ProjectedPoint> found = project(cad, x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double r = std::hypot(x[i].x(), x[i].y()), along = std::clamp((r + 2 - x[i].z()) / 2, 0.0, 2.0);
    EXPECT_NEAR(found[i].distance, std::hypot(r - along, x[i].z() - 2 + along), 1e-11) << x[i].transpose();
  }
}

TEST(Projector, CurvesAndPoints) {
  const AnalyticCad cad = testing::hemisphere();  // both curves are halves of the unit circle z = 0
  const std::vector<Vec3> x = random_points(500, 2);
  const std::vector<ProjectedPoint> any = project(cad, x, 1), second = project(cad, x, 1, 2), corner = project(cad, x, 0), first = project(cad, x, 0, 1);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double r = std::hypot(x[i].x(), x[i].y());
    EXPECT_NEAR(any[i].distance, std::hypot(r - 1, x[i].z()), 1e-12);
    EXPECT_EQ(any[i].ref, x[i].y() > 0 ? 1 : 2);
    const double below = x[i].y() < 0 ? std::hypot(r - 1, x[i].z()) : norm(Vec3(std::abs(x[i].x()) - 1, x[i].y(), x[i].z()));
    EXPECT_NEAR(second[i].distance, below, 1e-12);
    EXPECT_EQ(second[i].ref, 2);
    EXPECT_NEAR(corner[i].distance, norm(Vec3(std::abs(x[i].x()) - 1, x[i].y(), x[i].z())), 1e-12);
    EXPECT_EQ(first[i].ref, 1);
    EXPECT_NEAR(first[i].distance, norm(x[i] - Vec3(1, 0, 0)), 1e-12);
  }
}

TEST(Projector, ThreadsDoNotChangeTheResult) {
  struct Reentrant : AnalyticCad {
    explicit Reentrant(const AnalyticCad& other) : AnalyticCad(other) {}
    void surface(int face, unsigned, std::span<const Vec2> uv, std::span<SurfaceJet> out) override {
      for (std::size_t i = 0; i < uv.size(); ++i) out[i] = faces.at(face).at(uv[i]);
    }
    [[nodiscard]] bool reentrant() const noexcept override { return true; }
  };
  const AnalyticCad teapot = testing::teapot();
  const std::vector<Vec3> x = random_points(5000, 4);
  const auto run = [&](int threads) {
    Monitor monitor;
    Projector projector(std::make_shared<Reentrant>(teapot), nullptr, model_of(teapot));
    std::vector<ProjectedPoint> out(x.size());
    projector.project(2, 0, x, out, threads, monitor);
    return out;
  };
  const std::vector<ProjectedPoint> one = run(1), four = run(4);
  for (std::size_t i = 0; i < x.size(); ++i) {
    ASSERT_EQ(one[i].ref, four[i].ref);
    ASSERT_EQ(one[i].xyz, four[i].xyz);
    ASSERT_EQ(one[i].parameters, four[i].parameters);
    ASSERT_EQ(one[i].distance, four[i].distance);
  }
}

TEST(Projector, TeapotAgreesWithEachFaceAlone) {
  const AnalyticCad teapot = testing::teapot();
  const std::vector<Vec3> x = random_points(200, 4);
  const std::vector<ProjectedPoint> any = project(teapot, x);
  std::vector<double> least(x.size(), 1e300);
  for (const auto& [ref, face] : teapot.faces) {
    const std::vector<ProjectedPoint> one = project(teapot, x, 2, ref);
    for (std::size_t i = 0; i < x.size(); ++i) {
      least[i] = std::min(least[i], one[i].distance);
      if (i % 20 != 0) continue;
      const double sampled = sampled_distance([&, at = &face.at](Vec2 p) { return (*at)(p).s; }, {0, 0}, {1, 1}, x[i]);
      EXPECT_LE(one[i].distance, sampled + 1e-9) << "face " << ref << " from " << x[i].transpose();
    }
  }
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(any[i].distance, least[i], 1e-11);
}

TEST(Projector, NoPlaceNearAPoleIsMissed) {
  // Above the bottom of the teapot, where four patches have a common pole: descents on their leaves are long.
  const AnalyticCad teapot = testing::teapot();
  std::vector<Vec3> x = random_points(4000, 0.9);
  for (Vec3& p : x) p.z() = 0.13 + 0.12 / 0.9 * p.z();
  const std::vector<ProjectedPoint> any = project(teapot, x);
  std::vector<double> least(x.size(), 1e300);
  for (const auto& [ref, face] : teapot.faces) {
    if (!(norm(face.at({0, 0}).s) < 0.2)) continue;
    const std::vector<ProjectedPoint> one = project(teapot, x, 2, ref);
    for (std::size_t i = 0; i < x.size(); ++i) least[i] = std::min(least[i], one[i].distance);
  }
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_LE(any[i].distance, least[i] + 1e-11) << x[i].transpose();
}

TEST(Projector, HostThatFailsBeyondItsDomain) {
  // The upper half of the unit sphere as a height over the disc, which is NaN outside.
  AnalyticCad cad;
  const auto height = [](Vec2 p) {
    const double z = std::sqrt(1.21 - p.x() * p.x() - p.y() * p.y()), z3 = z * z * z;
    SurfaceJet j;
    j.s = {p.x(), p.y(), z}, j.su = {1, 0, -p.x() / z}, j.sv = {0, 1, -p.y() / z};
    j.suu = {0, 0, -1 / z - p.x() * p.x() / z3}, j.suv = {0, 0, -p.x() * p.y() / z3}, j.svv = {0, 0, -1 / z - p.y() * p.y() / z3};
    return j;
  };
  cad.faces[1] = {height, {testing::arc({0, 0}, 1, 0, pi), testing::arc({0, 0}, 1, pi, 2 * pi)}};
  const std::vector<Vec3> x = random_points(500, 2);
  const std::vector<ProjectedPoint> found = project(cad, x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double r = std::hypot(x[i].x(), x[i].y()), rim = std::sqrt(0.21);
    const double slope = x[i].z() / norm(x[i]);
    const double expected = slope > rim / 1.1 ? std::abs(norm(x[i]) - 1.1) : std::hypot(r - 1, x[i].z() - rim);
    EXPECT_NEAR(found[i].distance, expected, 1e-11) << x[i].transpose();
  }
}

TEST(Projector, TrianglesOfASurface) {
  const discrete::Triangulation mesh(discrete::sphere(3));
  const auto surface = std::make_shared<const discrete::DiscreteSurface>(mesh, discrete::find_sharp_lines(mesh));
  const BuiltGeometry built = discrete::discrete_geometry(surface);
  Monitor monitor;
  Projector projector(built.cad, std::dynamic_pointer_cast<const discrete::DiscreteCad>(built.cad), built.model);
  const std::vector<Vec3> x = random_points(100, 1.5);
  std::vector<ProjectedPoint> out(x.size());
  projector.project(2, 0, x, out, 1, monitor);
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(norm(surface_at(*built.cad, 1, want_position, out[i].parameters).s - out[i].xyz), 0, 1e-13);
    double sampled = 1e300;
    constexpr int n = 16;
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(surface->triangles()); ++t)
      for (int a = 0; a <= n; ++a)
        for (int b = 0; a + b <= n; ++b) sampled = std::min(sampled, norm(surface->at(t, {a / double(n), b / double(n)}, want_position).s - x[i]));
    EXPECT_LE(out[i].distance, sampled + 1e-13) << x[i].transpose();
  }
}

TEST(Projector, PlacesOnEdgesOfFlatTrianglesHaveNoDistance) {
  const discrete::Triangulation mesh(discrete::cube(3));
  const auto surface = std::make_shared<const discrete::DiscreteSurface>(mesh, discrete::find_sharp_lines(mesh));
  const BuiltGeometry built = discrete::discrete_geometry(surface);
  Monitor monitor;
  Projector projector(built.cad, std::dynamic_pointer_cast<const discrete::DiscreteCad>(built.cad), built.model);
  std::vector<Vec3> x;
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(surface->triangles()); ++t)
    for (const double w : {0.0, 0.18, 0.3, 0.5, 0.77})
      for (const Vec2& uv : {Vec2(w, 0), Vec2(0, w), Vec2(w, 1 - w)}) x.push_back(surface->at(t, uv, want_position).s);
  std::vector<ProjectedPoint> out(x.size());
  projector.project(2, 0, x, out, 1, monitor);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_LT(out[i].distance, 1e-14) << x[i].transpose();
}

TEST(Projector, EvaluatesCurvesByTheChainRule) {
  const AnalyticCad cad = testing::hemisphere();
  Monitor monitor;
  Projector projector(std::make_shared<AnalyticCad>(cad), nullptr, model_of(cad));
  const std::vector<Vec2> t{{0, 0}, {0.25, 0}, {1, 0}};
  std::vector<SurfaceJet> out(3);
  projector.evaluate(1, 1, want_position | want_first | want_second, t, out, 1, monitor);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double a = pi * t[i].x();
    EXPECT_NEAR(norm(out[i].s - Vec3(std::cos(a), std::sin(a), 0)), 0, 1e-14);
    EXPECT_NEAR(norm(out[i].su - pi * Vec3(-std::sin(a), std::cos(a), 0)), 0, 1e-13);
    EXPECT_NEAR(norm(out[i].suu + pi * pi * Vec3(std::cos(a), std::sin(a), 0)), 0, 1e-12);
  }
}

TEST(Projector, NamesUnknownEntities) {
  const AnalyticCad cad = testing::paraboloid();
  Monitor monitor;
  Projector projector(std::make_shared<AnalyticCad>(cad), nullptr, model_of(cad));
  const std::vector<Vec3> x(1);
  std::vector<ProjectedPoint> out(1);
  for (const int dimension : {0, 1, 2}) {
    try {
      projector.project(dimension, 77, x, out, 1, monitor);
      ADD_FAILURE();
    } catch (const InvalidArgument& error) {
      EXPECT_NE(std::string(error.what()).find("77"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace carreau
