// SPDX-License-Identifier: BSD-3-Clause
// Bounds of A0 and A1 of whole meshes, against closed forms and dense samples.
#include "measure/deviation_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "grid_mesh.h"
#include "mesh/triangle_search.h"
#include "metric/chart.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
using testing::Grid;
using testing::grid_mesh;
using Kind = EvaluationKind;

constexpr double pi = std::numbers::pi;

PrescribedMetric unit_metric() {
  return {want_first, [](int, std::span<const Vec2>, std::span<const SurfaceJet> jets, std::span<Metric2> metric) {
            for (std::size_t i = 0; i < jets.size(); ++i) metric[i] = induced_metric(jets[i].su, jets[i].sv, 1);
          }};
}

/// Counts evaluated places.
class CountingCad final : public Cad {
 public:
  explicit CountingCad(AnalyticCad cad) : cad_(std::move(cad)) {}
  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override {
    asked += uv.size();
    cad_.surface(face, want, uv, out);
  }
  Interval curve_interval(int face, int ic) override { return cad_.curve_interval(face, ic); }
  CurveJet curve(int face, int ic, unsigned want, double t) override { return cad_.curve(face, ic, want, t); }
  std::size_t asked = 0;

 private:
  AnalyticCad cad_;
};

AnalyticCad one_face(std::function<SurfaceJet(Vec2)> at) {
  AnalyticCad cad;
  cad.faces[1] = {std::move(at), {}};
  return cad;
}
/// z = f(x, y), with its derivatives.
AnalyticCad height(std::function<Vec3(double, double)> f) {
  return one_face([f = std::move(f)](Vec2 p) {
    const Vec3 z = f(p.x(), p.y());
    SurfaceJet jet{};
    jet.s = {p.x(), p.y(), z.x()}, jet.su = {1, 0, z.y()}, jet.sv = {0, 1, z.z()};
    return jet;
  });
}
/// The unit sphere by longitude and latitude.
SurfaceJet sphere_jet(Vec2 p) {
  const double cu = std::cos(p.x()), su = std::sin(p.x()), cv = std::cos(p.y()), sv = std::sin(p.y());
  SurfaceJet jet{};
  jet.s = {cu * cv, su * cv, sv}, jet.su = {-su * cv, cu * cv, 0}, jet.sv = {-cu * sv, -su * sv, cv};
  return jet;
}

struct Measured {
  SurfaceMesh mesh;
  MeshEvaluation delivered;
  std::size_t asked = 0;
};
Measured measure(const AnalyticCad& given, const Grid& grid, EvaluationOptions options = {}, bool bounds = true) {
  AnalyticCad cad = given;
  Measured made;
  made.mesh = grid_mesh(cad, std::array{grid});
  options.bounds = bounds;
  CountingCad counting(given);
  Monitor quiet;
  made.delivered = evaluate_mesh(made.mesh, counting, unit_metric(), options, quiet);
  made.asked = counting.asked;
  return made;
}

struct Dense {
  double deviation = 0, angle = 0;
};
/// The part of the surface over the triangle of (u, v), and its distance from the whole mesh.
Dense dense(const SurfaceMesh& mesh, std::size_t t, const std::function<SurfaceJet(Vec2)>& at, const TriangleSearch& search, int n) {
  const FaceMesh& face = mesh.faces[0];
  const auto& c = face.triangles[t];
  const Vec3 a = mesh.vertices[face.vertex[c[0]]], ab = mesh.vertices[face.vertex[c[1]]] - a, ac = mesh.vertices[face.vertex[c[2]]] - a;
  const Vec3 normal = cross(ab, ac);
  Dense most;
  for (int j = 0; j <= n; ++j)
    for (int k = 0; j + k <= n; ++k) {
      const double b = static_cast<double>(j) / n, d = static_cast<double>(k) / n;
      const SurfaceJet jet = at((1 - b - d) * face.uv[c[0]] + b * face.uv[c[1]] + d * face.uv[c[2]]);
      most.deviation = std::max(most.deviation, search.nearest(jet.s).distance);
      const Vec3 own = cross(jet.su, jet.sv);
      most.angle = std::max(most.angle, std::atan2(norm(cross(own, normal)), dot(own, normal)) * 180 / pi);
    }
  return most;
}

void expect_bounds(const Measured& made, const std::function<SurfaceJet(Vec2)>& at, double max_of_deviation, double floor) {
  const FaceMesh& face = made.mesh.faces[0];
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const auto& t : face.triangles) triangles.push_back({face.vertex[t[0]], face.vertex[t[1]], face.vertex[t[2]]});
  const TriangleSearch search(made.mesh.vertices, triangles);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Dense most = dense(made.mesh, t, at, search, 24);
    const double deviation = made.delivered[Kind::deviation_bound].values[t], angle = made.delivered[Kind::angle_bound].values[t];
    EXPECT_GE(deviation, most.deviation * (1 - 1e-9)) << t;
    EXPECT_LE(deviation, max_of_deviation * most.deviation + floor) << t;
    EXPECT_GE(angle, most.angle * (1 - 1e-9)) << t;
    EXPECT_LE(angle, 1.3 * most.angle + 0.52) << t;  // a hundredth of 52 degrees is near enough
    EXPECT_GE(deviation, made.delivered[Kind::deviation].values[t]);
    EXPECT_GE(angle, made.delivered[Kind::angle].values[t]);
  }
}

TEST(DeviationBounds, HoldOverASphereBetweenItsPoles) {
  const Grid grid{1, {0, -1.2}, {2, 1.2}, 12, 14};
  const Measured made = measure(one_face(sphere_jet), grid), without = measure(one_face(sphere_jet), grid, {}, false);
  expect_bounds(made, sphere_jet, 1.3, 1e-4);
  // One a vertex, three an edge, three a triangle, and half as many again for parts of triangles that are long, or at the border.
  const std::size_t v = made.mesh.vertices.size(), e = made.delivered.edges.vertices.size(), t = made.delivered.edges.of_triangle.size();
  EXPECT_LE(made.asked - without.asked, (v + 3 * e + 3 * t) * 8 / 5);
}

TEST(DeviationBounds, HoldOverAMonkeySaddle) {
  const auto saddle = height([](double x, double y) {
    return Vec3{x * x * x - 3 * x * y * y, 3 * x * x - 3 * y * y, -6 * x * y};
  });
  // The dense samples are of triangles with straight sides in (u, v): a few percent differ.
  expect_bounds(measure(saddle, {1, {-0.5, -0.5}, {0.5, 0.5}, 7, 7}), saddle.faces.at(1).at, 1.35, 1e-4);
}

// A quarter of a sphere, from pole to pole: triangles with an apex are sectors there.
TEST(DeviationBounds, HoldAtPoles) {
  const Measured made = measure(one_face(sphere_jet), {1, {0, -pi / 2}, {pi / 2, pi / 2}, 6, 12});
  ASSERT_FALSE(made.mesh.faces[0].flattened.empty());
  for (std::size_t t = 0; t < made.delivered.edges.of_triangle.size(); ++t) {
    const FaceMesh& face = made.mesh.faces[0];
    std::array<Vec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = made.mesh.vertices[face.vertex[face.triangles[t][i]]];
    const double height = 1 - nearest_on_triangle({0, 0, 0}, p).distance;  // the farthest place of the triangle
    const Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
    const double angle = std::acos(std::min(1.0, dot(n, p[0]) / norm(n))) * 180 / pi;
    EXPECT_GE(made.delivered[Kind::deviation_bound].values[t], height * (1 - 1e-6));
    EXPECT_LE(made.delivered[Kind::deviation_bound].values[t], 1.5 * height);
    EXPECT_GE(made.delivered[Kind::angle_bound].values[t], angle * (1 - 1e-6));
    EXPECT_LE(made.delivered[Kind::angle_bound].values[t], 1.5 * angle + 0.6);
  }
}

TEST(DeviationBounds, PlanesHaveNoneHoweverTheyAreParametrised) {
  const auto uneven = [](Vec2 p) {
    const double a = 0.06 * std::sin(pi * p.x()) * std::sin(pi * p.y());
    const double au = 0.06 * pi * std::cos(pi * p.x()) * std::sin(pi * p.y()), av = 0.06 * pi * std::sin(pi * p.x()) * std::cos(pi * p.y());
    SurfaceJet jet{};
    jet.s = {p.x() + a, p.y() - a, 0}, jet.su = {1 + au, -au, 0}, jet.sv = {av, 1 - av, 0};
    return jet;
  };
  const Measured made = measure(one_face(uneven), {1, {0, 0}, {1, 1}, 8, 8});
  for (const double bound : made.delivered[Kind::deviation_bound].values) EXPECT_LE(bound, 1e-4);  // .0007 of the sides
  for (const double bound : made.delivered[Kind::angle_bound].values) EXPECT_EQ(bound, 0);
}

// A bump of a sixtieth of a triangle, with its top between all sample points. The samples of A0 see a sixtieth of its height, the bound all
// of it.
TEST(DeviationBounds, NarrowBumpIsFound) {
  constexpr double high = 0.1, width = 0.05;
  const Vec2 top{1. / 3 + 1. / 24, 1. / 12 * std::sqrt(0.75)};  // in an equilateral triangle
  const auto bump = height([&](double x, double y) {
    const double p = x - top.x(), q = y - top.y(), z = high * std::exp(-(p * p + q * q) / (2 * width * width));
    return Vec3{z, -p / (width * width) * z, -q / (width * width) * z};
  });
  SurfaceMesh mesh;
  FaceMesh face;
  face.ref = 1;
  face.uv = {{0, 0}, {1, 0}, {0.5, std::sqrt(0.75)}};
  face.vertex = {0, 1, 2}, face.triangles = {{0, 1, 2}};
  for (const Vec2& p : face.uv) mesh.vertices.emplace_back(p.x(), p.y(), 0), mesh.vertex_ref.push_back(0);
  mesh.faces = {face};
  CountingCad cad(bump);
  Monitor quiet;
  EvaluationOptions options;
  options.bounds = true;
  const MeshEvaluation d = evaluate_mesh(mesh, cad, unit_metric(), options, quiet);
  EXPECT_LE(d[Kind::deviation].values[0], 0.05 * high);
  EXPECT_GE(d[Kind::deviation_bound].values[0], high);
  EXPECT_LE(d[Kind::deviation_bound].values[0], 1.3 * high);
  const double steepest = std::atan(high / width * std::exp(-0.5)) * 180 / pi;
  EXPECT_GE(d[Kind::angle_bound].values[0], steepest);
  EXPECT_LE(d[Kind::angle_bound].values[0], 1.3 * steepest);
  EXPECT_LE(cad.asked, 1000u);
}

TEST(DeviationBounds, SharesAreOfTheTolerances) {
  EvaluationOptions options;
  const Grid grid{1, {0, -0.5}, {1, 0.5}, 4, 4};
  const std::vector<double> size(25, 0.25);
  options.vertex_size = size, options.deviation_share = 0.2, options.angle_tolerance = 40;
  const auto values = [](const Measured& made, Kind kind, std::size_t t) { return made.delivered[kind].values[t]; };
  const Measured by_size = measure(one_face(sphere_jet), grid, options);
  options.deviation_tolerance = 0.001, options.bound_share_limit = 1;
  const Measured asked = measure(one_face(sphere_jet), grid, options);
  for (std::size_t t = 0; t < by_size.delivered.edges.of_triangle.size(); ++t) {
    EXPECT_NEAR(values(by_size, Kind::bound_share, t),
                std::max(values(by_size, Kind::deviation_bound, t) / 0.05, values(by_size, Kind::angle_bound, t) / 40), 1e-12);
    EXPECT_NEAR(values(asked, Kind::bound_share, t),
                std::max(values(asked, Kind::deviation_bound, t) / 0.001, values(asked, Kind::angle_bound, t) / 40), 1e-9);
  }
  EXPECT_EQ(by_size.delivered[Kind::bound_share].beyond, 0);
  EXPECT_EQ(asked.delivered[Kind::bound_share].beyond, 32);
  EXPECT_NE(describe(asked.delivered).not_met.back().find("32 of 32 triangles (100 %) have an upper bound"), std::string::npos);
}

TEST(DeviationBounds, CostNothingByDefault) {
  AnalyticCad cad = one_face(sphere_jet);
  const SurfaceMesh mesh = grid_mesh(cad, std::array{Grid{1, {0, -0.5}, {1, 0.5}, 20, 20}});
  CountingCad counting(cad);
  Monitor quiet;
  const MeshEvaluation d = evaluate_mesh(mesh, counting, unit_metric(), {}, quiet);
  EXPECT_EQ(d[Kind::deviation_bound].spread.count, 0);
  EXPECT_EQ(d[Kind::angle_bound].values.size(), 800u);
  EXPECT_LE(counting.asked, 25 * mesh.vertices.size());
  for (const std::string& line : describe(d).summary) EXPECT_EQ(line.find("upper bound"), std::string::npos);
}

}  // namespace
}  // namespace carreau
