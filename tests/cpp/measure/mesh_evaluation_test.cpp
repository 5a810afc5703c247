// SPDX-License-Identifier: BSD-3-Clause
// Measures against closed forms, on meshes whose vertices are known.
#include "measure/mesh_evaluation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "grid_mesh.h"
#include "mesh/distance/triangle_distance.h"
#include "mesh/quality.h"
#include "support/gauss.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
using testing::Grid;
using testing::grid_mesh;
using Kind = EvaluationKind;

constexpr double pi = std::numbers::pi;
double degrees(double radians) { return radians * 180 / pi; }

/// An isotropic size h(face, uv).
PrescribedMetric isotropic(std::function<double(int, Vec2)> h) {
  return {want_first, [h = std::move(h)](int face, std::span<const Vec2> uv, std::span<const SurfaceJet> jets,
                                         std::span<Metric2> metric) {
            for (std::size_t i = 0; i < uv.size(); ++i)
              metric[i] = induced_metric(jets[i].su, jets[i].sv, h(face, uv[i]));
          }};
}
PrescribedMetric uniform(double h) {
  return isotropic([h](int, Vec2) { return h; });
}

AnalyticCad one_face(std::function<SurfaceJet(Vec2)> at) {
  AnalyticCad cad;
  cad.faces[1] = {std::move(at), {}};
  return cad;
}
SurfaceJet plane_jet(Vec2 p) { return {{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; }
SurfaceJet cylinder_jet(Vec2 p, double r) {
  const double c = std::cos(p.x()), s = std::sin(p.x());
  return {{r * c, r * s, p.y()}, {-r * s, r * c, 0}, {0, 0, 1}, {-r * c, -r * s, 0}, {}, {}};
}
/// Longitude, latitude.
SurfaceJet sphere_jet(Vec2 p, double r) {
  const double cu = std::cos(p.x()), su = std::sin(p.x()), cv = std::cos(p.y()), sv = std::sin(p.y());
  return {r * Vec3{cu * cv, su * cv, sv},  r * Vec3{-su * cv, cu * cv, 0}, r * Vec3{-cu * sv, -su * sv, cv},
          r * Vec3{-cu * cv, -su * cv, 0}, r * Vec3{su * sv, -cu * sv, 0}, r * Vec3{-cu * cv, -su * cv, -sv}};
}
/// The unit sphere seen from its centre: (u, v, 1) / |(u, v, 1)|.
SurfaceJet gnomonic_jet(Vec2 p) {
  const double n = std::sqrt(1 + p.x() * p.x() + p.y() * p.y()), n3 = n * n * n;
  const Vec3 q{p.x(), p.y(), 1};
  return {(1 / n) * q, (1 / n) * Vec3{1, 0, 0} - (p.x() / n3) * q, (1 / n) * Vec3{0, 1, 0} - (p.y() / n3) * q, {}, {},
          {}};
}

struct Case {
  AnalyticCad cad;
  SurfaceMesh mesh;
  Monitor monitor;
  MeshEvaluation measure(const PrescribedMetric& prescribed, const EvaluationOptions& options = {}) {
    return evaluate_mesh(mesh, cad, prescribed, options, monitor);
  }
};

/// One triangle of face 1.
SurfaceMesh single(AnalyticCad& cad, std::array<Vec2, 3> uv) {
  SurfaceMesh mesh;
  FaceMesh face;
  face.ref = 1;
  for (const Vec2& p : uv) {
    face.uv.push_back(p);
    face.vertex.push_back(static_cast<std::int32_t>(mesh.vertices.size()));
    mesh.vertices.push_back(surface_at(cad, 1, want_position, p).s);
    mesh.vertex_ref.push_back(0);
  }
  face.triangles = {{0, 1, 2}};
  mesh.faces = {face};
  return mesh;
}

TEST(DistanceToTriangle, MatchesTheNearestPlace) {
  const Vec3 a{0, 0, 0}, b{2, 0, 0}, c{0, 2, 0};
  EXPECT_DOUBLE_EQ(distance_to_triangle({0.5, 0.5, 3}, a, b, c), 3);  // above it
  EXPECT_DOUBLE_EQ(distance_to_triangle({1, -4, 3}, a, b, c), 5);     // beside a side
  EXPECT_DOUBLE_EQ(distance_to_triangle({-3, -4, 0}, a, b, c), 5);    // beyond a corner
  EXPECT_DOUBLE_EQ(distance_to_triangle({2, 2, 0}, a, b, c), std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(distance_to_triangle({5, 4, 0}, a, {1, 0, 0}, b), 5);  // without area
}

TEST(GaussRule, IsExactUpToItsDegree) {
  for (int n = 1; n <= 20; ++n) {
    const GaussRule rule = gauss_rule(n);
    const auto moment = [&](int degree) {
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += rule.weight[i] * std::pow(rule.node[i], degree);
      return sum;
    };
    for (int degree = 0; degree < 2 * n; ++degree) EXPECT_NEAR(moment(degree), 1.0 / (degree + 1), 1e-14);
    if (n < 8) {
      EXPECT_GT(std::abs(moment(2 * n) - 1.0 / (2 * n + 1)), 1e-10);
    }
  }
  EXPECT_THROW(gauss_rule(0), InvalidArgument);
  EXPECT_THROW(gauss_rule(65), InvalidArgument);
}

TEST(DeliveredPlane, UniformLengthsAreExact) {
  Case run{one_face(plane_jet), {}, {}};
  run.mesh = grid_mesh(run.cad, std::array{Grid{1, {0, 0}, {4, 3}, 8, 5}});
  const double h = 0.3;
  const MeshEvaluation d = run.measure(uniform(h));
  ASSERT_EQ(d.edges.vertices.size(), 8U * 6 + 9 * 5 + 8 * 5);
  for (std::size_t e = 0; e < d.edges.vertices.size(); ++e) {
    const auto [a, b] = d.edges.vertices[e];
    EXPECT_LT(a, b);
    EXPECT_NEAR(d[Kind::length].values[e], norm(run.mesh.vertices[b] - run.mesh.vertices[a]) / h, 1e-14);
    EXPECT_EQ(d[Kind::edge_angle].values[e], 0);
    EXPECT_NEAR(d[Kind::gradation].values[e], 1, 1e-14);
  }
  for (std::size_t t = 0; t < d.edges.of_triangle.size(); ++t) {
    EXPECT_NEAR(d[Kind::metric_quality].values[t], d[Kind::q2].values[t], 1e-14);
    EXPECT_NEAR(d[Kind::deviation].values[t], 0, 1e-15);
    EXPECT_EQ(d[Kind::angle].values[t], 0);
  }
  // Cells of 0.5 by 0.6: at an inner vertex the diagonal is the longest edge, the horizontal one the shortest.
  EXPECT_NEAR(d[Kind::length_ratio].spread.max, std::hypot(0.5, 0.6) / 0.5, 1e-14);
  EXPECT_TRUE(describe(run.measure(uniform(0.6))).not_met.empty());
}

TEST(DeliveredPlane, QuadratureHasItsOrder) {
  // Along x the speed 1 / h is a polynomial: exact up to degree 2 n - 1, and not beyond.
  for (int n = 1; n <= 5; ++n)
    for (int degree = 0; degree <= 2 * n; ++degree) {
      Case run{one_face(plane_jet), {}, {}};
      run.mesh = single(run.cad, {{{0, 0}, {1, 0}, {0, 1}}});
      EvaluationOptions options;
      options.gauss_points = n;
      const MeshEvaluation d =
          run.measure(isotropic([=](int, Vec2 p) { return 1 / (1 + std::pow(p.x(), degree)); }), options);
      const double error = std::abs(d[Kind::length].values[0] - (1 + 1.0 / (degree + 1)));
      if (degree < 2 * n) {
        EXPECT_LT(error, 1e-14) << n << " points, degree " << degree;
      } else {
        EXPECT_GT(error, 1e-7) << n << " points, degree " << degree;
      }
    }
}

TEST(DeliveredPlane, LinearSizeHasItsClosedForms) {
  // h = a + b x: length log(h2 / h1) / b, and a gradation of exp(b), along x.
  const double a = 0.5, b = 0.26;
  Case run{one_face(plane_jet), {}, {}};
  run.mesh = grid_mesh(run.cad, std::array{Grid{1, {0, 0}, {5, 1}, 10, 1}});
  EvaluationOptions options;
  options.gradation_limit = 1.25;
  const MeshEvaluation d = run.measure(isotropic([=](int, Vec2 p) { return a + b * p.x(); }), options);
  int along = 0;
  for (std::size_t e = 0; e < d.edges.vertices.size(); ++e) {
    const Vec3 p = run.mesh.vertices[d.edges.vertices[e][0]], q = run.mesh.vertices[d.edges.vertices[e][1]];
    if (p.y() != q.y()) continue;
    ++along;
    EXPECT_NEAR(d[Kind::length].values[e], std::abs(std::log((a + b * q.x()) / (a + b * p.x()))) / b, 1e-6);
    EXPECT_NEAR(d[Kind::gradation].values[e], std::exp(b), 1e-6);
  }
  EXPECT_EQ(along, 20);
  EXPECT_EQ(d[Kind::gradation].beyond, along);  // exp(0.26) is 1.297
  bool said = false;
  for (const std::string& sentence : describe(d).not_met)
    said = said || sentence.find(
                       "20 of 41 edges (48.78 %) have a gradation of sizes of more than the 1.25 prescribed; the "
                       "worst has 1.297") == 0;
  EXPECT_TRUE(said);
}

// Across the strip: the edges inside join the curves on both its sides, those at its ends lie on curves.
TEST(DeliveredPlane, GradationsBetweenTwoCurvesAreForced) {
  const double a = 0.5, b = 0.26;
  Case run{one_face(plane_jet), {}, {}};
  run.mesh = grid_mesh(run.cad, std::array{Grid{1, {0, 0}, {5, 1}, 10, 1}});
  CurveMesh loop;
  for (std::int32_t v = 0; v < 22; ++v) loop.vertices.push_back(v);
  const auto before = [&](std::int32_t v, std::int32_t w) {  // counterclockwise around the middle
    const Vec3 p = run.mesh.vertices[v], q = run.mesh.vertices[w];
    return std::atan2(p.y() - 0.5, p.x() - 2.5) < std::atan2(q.y() - 0.5, q.x() - 2.5);
  };
  std::sort(loop.vertices.begin(), loop.vertices.end(), before);
  loop.vertices.push_back(loop.vertices.front());
  run.mesh.curves.push_back(loop);
  EvaluationOptions options;
  options.gradation_limit = 1.25;
  const MeshEvaluation d = run.measure(isotropic([=](int, Vec2 p) { return a + b * p.y(); }), options);
  EXPECT_EQ(d[Kind::gradation].beyond, 11);
  EXPECT_EQ(d[Kind::gradation].forced, 9);
  const auto said = describe(d).not_met;
  EXPECT_TRUE(std::any_of(said.begin(), said.end(), [](const std::string& sentence) {
    return sentence.find("the worst has 1.297; 9 of them cross a face from curve to curve") != std::string::npos;
  }));
}

TEST(DeliveredPlane, GradationOfTinyEdgesIsOverATenthOfAUnit) {
  // Cells of 0.01 by 1, sizes that differ by a tenth from one column to the next: 1.1^105 over their own lengths.
  Case run{one_face(plane_jet), {}, {}};
  run.mesh = grid_mesh(run.cad, std::array{Grid{1, {0, 0}, {0.03, 1}, 3, 1}});
  const auto size = [](double x) { return std::pow(1.1, 100 * x); };
  const MeshEvaluation d = run.measure(isotropic([=](int, Vec2 p) { return size(p.x()); }), {});
  int along = 0;
  for (std::size_t e = 0; e < d.edges.vertices.size(); ++e) {
    const Vec3 p = run.mesh.vertices[d.edges.vertices[e][0]], q = run.mesh.vertices[d.edges.vertices[e][1]];
    if (p.y() != q.y()) continue;
    ++along;
    EXPECT_NEAR(d[Kind::gradation].values[e], std::pow(1.1, 10), 1e-12);
  }
  EXPECT_EQ(along, 6);
}

TEST(DeliveredPlane, AnisotropicMetricBelongsToTheStretchedTriangle) {
  // Sizes 2 along a direction and 0.1 across: the quality is Q2 of the image, and edges compare through it.
  const double angle = 0.4, h1 = 2, h2 = 0.1;
  const Vec2 x{std::cos(angle), std::sin(angle)}, y{-x.y(), x.x()};
  const Metric2 m{x.x() * x.x() / (h1 * h1) + y.x() * y.x() / (h2 * h2),
                  x.x() * x.y() / (h1 * h1) + y.x() * y.y() / (h2 * h2),
                  x.y() * x.y() / (h1 * h1) + y.y() * y.y() / (h2 * h2)};
  const auto image = [&](Vec2 p) { return Vec3{dot(p, x) / h1, dot(p, y) / h2, 0}; };
  const PrescribedMetric prescribed{
      want_first, [m](int, auto, auto, std::span<Metric2> metric) { std::fill(metric.begin(), metric.end(), m); }};
  Case run{one_face(plane_jet), {}, {}};
  // Equilateral in the metric, then a little off.
  for (const double more : {0.0, 0.3}) {
    const Vec2 b = h1 * (1 + more) * x, c = 0.5 * h1 * x + std::sqrt(0.75) * h2 * y;
    run.mesh = single(run.cad, {{{0, 0}, b, c}});
    const MeshEvaluation d = run.measure(prescribed);
    EXPECT_NEAR(d[Kind::metric_quality].values[0], quality_q2(image({0, 0}), image(b), image(c)), 1e-12);
    EXPECT_NEAR(d[Kind::length].values[0], 1 + more, 1e-12);
    EXPECT_LT(d[Kind::q2].values[0], 0.15);
    const double ab = 1 + more, bc = norm(image(c) - image(b)), ca = 1;
    EXPECT_NEAR(d[Kind::length_ratio].values[0], std::max(ab, ca) / std::min(ab, ca), 1e-12);
    EXPECT_NEAR(d[Kind::length_ratio].values[1], std::max(ab, bc) / std::min(ab, bc), 1e-12);
  }
}

TEST(DeliveredSphere, EquilateralTriangleHasItsClosedForms) {
  Case run{one_face(gnomonic_jet), {}, {}};
  for (const double r : {0.02, 0.1, 0.5}) {
    std::array<Vec2, 3> uv;
    for (int i = 0; i < 3; ++i) uv[i] = {r * std::cos(2 * pi * i / 3), r * std::sin(2 * pi * i / 3)};
    run.mesh = single(run.cad, uv);
    const Vec3 a = run.mesh.vertices[0], b = run.mesh.vertices[1];
    const double chord = norm(b - a), radius = std::hypot(a.x(), a.y());
    EvaluationOptions options;
    const double edge_angle = degrees(std::asin(chord / 2)), deviation = 1 - a.z();
    for (const bool met : {true, false}) {
      options.edge_angle_limit = edge_angle * (met ? 1 + 1e-12 : 1 - 1e-6);
      options.deviation_limit = deviation * (met ? 1 + 1e-12 : 1 - 1e-6);
      options.gauss_points = 12;
      const MeshEvaluation d = run.measure(uniform(chord), options);
      for (int e = 0; e < 3; ++e) {
        EXPECT_NEAR(d[Kind::edge_angle].values[e], edge_angle, 1e-10);
        EXPECT_NEAR(d[Kind::length].values[e], 2 * std::asin(chord / 2) / chord, 1e-12);
      }
      // The sphere is farthest above the centre; the normal is farthest off at the vertices.
      EXPECT_NEAR(d[Kind::deviation].values[0], deviation, 1e-14);
      EXPECT_NEAR(d[Kind::angle].values[0], degrees(std::asin(radius)), 1e-10);
      // HDR eq. 4.13 for two edges of one angle: sin(phi) = sin(theta) / cos(alpha / 2).
      EXPECT_NEAR(std::sin(d[Kind::angle].values[0] * pi / 180), chord / 2 / std::cos(pi / 6), 1e-12);
      EXPECT_EQ(d[Kind::edge_angle].beyond, met ? 0 : 3);
      EXPECT_EQ(d[Kind::edge_angle].forced, 0);
      EXPECT_EQ(d[Kind::deviation].beyond, met ? 0 : 1);
      // The angle that edges keep is exceeded by an equilateral triangle on them: by 2 / sqrt 3.
      EXPECT_EQ(d[Kind::vertex_angle].values[0], d[Kind::angle].values[0]);
      EXPECT_EQ(d[Kind::vertex_angle].beyond, 1);
      EXPECT_EQ(describe(d).not_met.size(), met ? 1U : 3U);
      // The smallest size allows no shorter edges.
      options.shortest_for_angle = chord * (1 + 1e-12);
      const MeshEvaluation coarse = run.measure(uniform(chord), options);
      EXPECT_EQ(coarse[Kind::edge_angle].beyond, met ? 0 : 3);
      EXPECT_EQ(coarse[Kind::edge_angle].forced, met ? 0 : 3);
      EXPECT_EQ(coarse[Kind::vertex_angle].forced, 1);
      for (const std::string& sentence : describe(coarse).not_met)
        EXPECT_EQ(sentence.find(" of them are as short as hgeomin") != std::string::npos,
                  sentence.find("an angle with") != std::string::npos)
            << sentence;
      options.shortest_for_angle = 0;
      EXPECT_EQ(d.folded_triangles, 0);
    }
  }
}

TEST(DeliveredSphere, WholeSphereWithSeamAndPoles) {
  const double r = 3;
  Case run{one_face([=](Vec2 p) { return sphere_jet(p, r); }), {}, {}};
  const int columns = 24, rows = 12;
  run.mesh = grid_mesh(run.cad, std::array{Grid{1, {0, -pi / 2}, {2 * pi, pi / 2}, columns, rows}});
  const std::size_t m = run.mesh.triangle_count();
  EXPECT_EQ(m, static_cast<std::size_t>(2 * columns * (rows - 1)));
  const MeshEvaluation d = run.measure(uniform(0.8));
  // Closed: three edges for two triangles, each once, and Euler's relation.
  EXPECT_EQ(2 * d.edges.vertices.size(), 3 * m);
  EXPECT_EQ(run.mesh.vertices.size() + m, d.edges.vertices.size() + 2);
  for (std::size_t e = 0; e < d.edges.vertices.size(); ++e) {
    const double chord = norm(run.mesh.vertices[d.edges.vertices[e][1]] - run.mesh.vertices[d.edges.vertices[e][0]]);
    EXPECT_NEAR(d[Kind::edge_angle].values[e], degrees(std::asin(chord / (2 * r))), 1e-9);
    EXPECT_GE(d[Kind::length].values[e], chord / 0.8);
    EXPECT_LE(d[Kind::length].values[e], 1.02 * chord / 0.8);
  }
  const std::int64_t at_poles = 2 * columns;
  EXPECT_EQ(d[Kind::gradation].spread.count, static_cast<std::int64_t>(d.edges.vertices.size()) - at_poles);
  EXPECT_EQ(d[Kind::length_ratio].spread.count, static_cast<std::int64_t>(run.mesh.vertices.size()));
  // All edges of a pole are as long.
  const auto pole = std::min_element(run.mesh.vertices.begin(), run.mesh.vertices.end(),
                                     [](Vec3 p, Vec3 q) { return p.z() < q.z(); });
  EXPECT_NEAR(d[Kind::length_ratio].values[pole - run.mesh.vertices.begin()], 1, 1e-9);
  // The sphere is farthest from a triangle above the centre of its circle: no sample is farther, whichever of the
  // triangle and its neighbours it lies above; the normal is farthest off at the vertices.
  const auto& triangles = run.mesh.faces[0].triangles;
  std::vector<double> height(d.edges.vertices.size(), r);  // of the lowest plane beside an edge
  const auto height_of = [&](std::size_t t) {
    std::array<Vec3, 3> p;
    for (int i = 0; i < 3; ++i) p[i] = run.mesh.vertices[run.mesh.faces[0].vertex[triangles[t][i]]];
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    return std::abs(dot(p[0], normal)) / norm(normal);
  };
  for (std::size_t t = 0; t < m; ++t)
    for (const std::int32_t e : d.edges.of_triangle[t]) height[e] = std::min(height[e], height_of(t));
  for (std::size_t t = 0; t < m; ++t) {
    const auto& e = d.edges.of_triangle[t];
    EXPECT_LE(d[Kind::deviation].values[t], r - std::min({height[e[0]], height[e[1]], height[e[2]]}) + 1e-12);
    EXPECT_NEAR(d[Kind::angle].values[t], degrees(std::acos(height_of(t) / r)), 1e-9);
  }
  EXPECT_EQ(d.folded_triangles, 0);
}

// As meshes have it: of the local vertices of a grid's degenerate side, from `first` on, only its two ends stand for
// the apex.
void keep_ends_of_apex(FaceMesh& face, std::int32_t first, std::int32_t columns) {
  const std::int32_t last = first + columns;
  for (auto& t : face.triangles)
    for (std::int32_t& v : t)
      if (v >= first && v <= last) v = 2 * (v - first) < columns ? first : last;
  std::erase_if(face.flattened, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(), [&](std::int32_t v) { return v >= first && v <= last; });
  });
  face.flattened.push_back({first, last, first == 0 ? last + 1 : first - 1});
}

// The normal is undefined at an apex: the normals of a triangle's own sector count, whichever end of the degenerate
// side stands for the apex in (u, v).
TEST(DeliveredCone, TrianglesAtTheApexHaveTheNormalsOfTheirSectors) {
  const double height = 2;
  Case run{one_face([=](Vec2 p) {
             const double c = std::cos(p.x()), s = std::sin(p.x());
             return SurfaceJet{
                 {p.y() * c, p.y() * s, height * p.y()}, {-p.y() * s, p.y() * c, 0}, {c, s, height}, {}, {}, {}};
           }),
           {},
           {}};
  const int columns = 12;
  run.mesh = grid_mesh(run.cad, std::array{Grid{1, {0, 0}, {2 * pi, 1}, columns, 6}});
  keep_ends_of_apex(run.mesh.faces[0], 0, columns);
  const MeshEvaluation d = run.measure(uniform(0.3));
  EXPECT_EQ(d.folded_triangles, 0);
  // A triangle between two generators: its plane holds the apex and their chord; normals are farthest off at the ends.
  const double cosine = std::cos(pi / columns), h2 = height * height;
  const double farthest = degrees(std::acos((h2 + 1) * cosine / std::sqrt((h2 + 1) * (h2 + cosine * cosine))));
  int at_apex = 0;
  const FaceMesh& face = run.mesh.faces[0];
  for (std::size_t t = 0; t < face.triangles.size(); ++t)
    for (const std::int32_t v : face.triangles[t]) {
      if (norm(run.mesh.vertices[face.vertex[v]]) > 1e-12) continue;
      ++at_apex;
      EXPECT_NEAR(d[Kind::angle].values[t], farthest, 1e-9);
    }
  EXPECT_EQ(at_apex, columns);
}

// Also where the way that is shortest in the metric is not the straight one: round the pole of an ellipsoid of three
// axes meridians are not orthogonal to parallels.
TEST(DeliveredEllipsoid, EdgesToAPoleAreMeridians) {
  const Vec3 axes{1, 5, 5};
  const auto jet = [=](Vec2 p) {
    const double cu = std::cos(p.x()), su = std::sin(p.x()), cv = std::cos(p.y()), sv = std::sin(p.y());
    return SurfaceJet{{axes.x() * cu * cv, axes.y() * su * cv, axes.z() * sv},
                      {-axes.x() * su * cv, axes.y() * cu * cv, 0},
                      {-axes.x() * cu * sv, -axes.y() * su * sv, axes.z() * cv},
                      {},
                      {},
                      {}};
  };
  Case run{one_face(jet), {}, {}};
  const int columns = 24, rows = 48;
  run.mesh = grid_mesh(run.cad, std::array{Grid{1, {0, -pi / 2}, {2 * pi, pi / 2}, columns, rows}});
  keep_ends_of_apex(run.mesh.faces[0], 0, columns);
  keep_ends_of_apex(run.mesh.faces[0], rows * (columns + 1), columns);
  const MeshEvaluation d = run.measure(uniform(1));
  int at_poles = 0;
  for (std::size_t e = 0; e < d.edges.vertices.size(); ++e) {
    const Vec3 p = run.mesh.vertices[d.edges.vertices[e][0]], q = run.mesh.vertices[d.edges.vertices[e][1]];
    const Vec3 pole = std::abs(p.z()) > std::abs(q.z()) ? p : q, other = std::abs(p.z()) > std::abs(q.z()) ? q : p;
    if (std::hypot(pole.x(), pole.y()) > 1e-9) continue;
    ++at_poles;
    // Simpson's rule on the meridian.
    const double u = std::atan2(other.y() / axes.y(), other.x() / axes.x()), step = pi / rows, from = pi / 2 - step;
    double length = 0;
    for (const auto& [s, weight] : {std::pair{0.0, 1.0}, std::pair{0.5, 4.0}, std::pair{1.0, 1.0}})
      length += weight / 6 * step * norm(jet({u, from + s * step}).sv);
    EXPECT_NEAR(d[Kind::length].values[e], length, 1e-3 * length);
  }
  EXPECT_EQ(at_poles, 2 * columns);
}

TEST(DeliveredSphere, TrianglesTurnedAgainstTheSurfaceAreCounted) {
  Case run{one_face([](Vec2 p) { return sphere_jet(p, 1); }), {}, {}};
  run.mesh = grid_mesh(run.cad, std::array{Grid{1, {0, 0}, {1, 1}, 8, 8}});
  auto& triangles = run.mesh.faces[0].triangles;
  for (std::size_t t = 0; t < 5; ++t) std::swap(triangles[7 * t][1], triangles[7 * t][2]);
  const MeshEvaluation d = run.measure(uniform(0.15));
  EXPECT_EQ(d.folded_triangles, 5);
  EXPECT_GT(d[Kind::angle].spread.max, 170);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    EXPECT_EQ(d[Kind::angle].values[t] > 90, t % 7 == 0 && t < 35) << t;
  EXPECT_EQ(describe(d).not_met.back(),
            "5 of 128 triangles (3.91 %) have a normal turned by more than 90 degrees against the surface");
}

TEST(DeliveredCylinder, AnglesAndDeviationsMatchTheChord) {
  const double r = 2;
  Case run{one_face([=](Vec2 p) { return cylinder_jet(p, r); }), {}, {}};
  const int columns = 18;
  run.mesh = grid_mesh(run.cad, std::array{Grid{1, {0, 0}, {2 * pi, 3}, columns, 4}});
  const double step = 2 * pi / columns, chord = 2 * r * std::sin(step / 2);
  const MeshEvaluation d = run.measure(uniform(0.7));
  EXPECT_EQ(run.mesh.vertices.size(), static_cast<std::size_t>(5 * columns));  // the seam is closed
  for (std::size_t e = 0; e < d.edges.vertices.size(); ++e) {
    const Vec3 p = run.mesh.vertices[d.edges.vertices[e][0]], q = run.mesh.vertices[d.edges.vertices[e][1]];
    const double height = std::abs(q.z() - p.z()), across = std::hypot(q.x() - p.x(), q.y() - p.y()) > 1e-9 ? 1 : 0;
    const double own = across * chord;
    EXPECT_NEAR(d[Kind::edge_angle].values[e], degrees(std::asin(own * std::sin(step / 2) / std::hypot(own, height))),
                1e-10);
    EXPECT_NEAR(d[Kind::length].values[e], std::hypot(across * r * step, height) / 0.7, 1e-12);
  }
  for (std::size_t t = 0; t < d.edges.of_triangle.size(); ++t) {
    EXPECT_NEAR(d[Kind::angle].values[t], degrees(step / 2), 1e-10);
    EXPECT_NEAR(d[Kind::deviation].values[t], r * (1 - std::cos(step / 2)), 1e-12);
  }
}

TEST(DeliveredTorus, LengthsConvergeWithTheirOrder) {
  // Against 20 points; the error of 2 points falls as the fourth power of the lengths, relative to them.
  const auto error = [](int n, int cells) {
    Case run{one_face([](Vec2 p) { return testing::torus_jet(p, 2, 0.7); }), {}, {}};
    run.mesh = grid_mesh(run.cad, std::array{Grid{1, {0, 0}, {1, 2}, cells, cells}});
    const PrescribedMetric prescribed =
        isotropic([](int, Vec2 p) { return 0.1 * (1.5 + std::sin(p.x() + 2 * p.y())); });
    EvaluationOptions few, many;
    few.gauss_points = n, many.gauss_points = 20;
    const std::vector<double> p = run.measure(prescribed, few)[Kind::length].values,
                              q = run.measure(prescribed, many)[Kind::length].values;
    double worst = 0;
    for (std::size_t e = 0; e < p.size(); ++e) worst = std::max(worst, std::abs(p[e] / q[e] - 1));
    return worst;
  };
  for (const int n : {1, 2, 3}) {
    const double order = std::log2(error(n, 8) / error(n, 16));
    EXPECT_NEAR(order, 2 * n, 0.35) << n << " points";
  }
  EXPECT_LT(error(3, 16), 1e-6);
}

TEST(DeliveredFaces, EdgeBetweenFacesHasTheLargerAngleAndOneLength) {
  // Half a cylinder and a flat lid on it: to the lid the arc's chords are flat, to the cylinder they are not.
  AnalyticCad cad;
  cad.faces[1] = {[](Vec2 p) {
                    return SurfaceJet{{p.y() * std::cos(p.x()), p.y() * std::sin(p.x()), 0},
                                      {-p.y() * std::sin(p.x()), p.y() * std::cos(p.x()), 0},
                                      {std::cos(p.x()), std::sin(p.x()), 0},
                                      {},
                                      {},
                                      {}};
                  },
                  {}};  // polar coordinates of the lid
  cad.faces[2] = {[](Vec2 p) { return cylinder_jet(p, 1); }, {}};
  Case run{std::move(cad), {}, {}};
  const int columns = 9;
  const double step = pi / columns;
  run.mesh =
      grid_mesh(run.cad, std::array{Grid{1, {0, 0.5}, {pi, 1}, columns, 2}, Grid{2, {0, -1}, {pi, 0}, columns, 3}});
  CurveMesh curve;
  curve.ref = 7;
  for (int i = 0; i <= columns; ++i) curve.vertices.push_back(run.mesh.faces[0].vertex[2 * (columns + 1) + i]);
  curve.uses = {{0, false}, {1, false}};
  run.mesh.curves = {curve};
  // The faces prescribe 0.3, the curve 0.2 to 0.4 along it.
  std::vector<std::vector<double>> sizes(1);
  for (int i = 0; i <= columns; ++i) sizes[0].push_back(0.2 + 0.2 * i / columns);
  EvaluationOptions options;
  options.curve_size = sizes;
  options.gauss_points = 8;
  const MeshEvaluation d = run.measure(uniform(0.3), options);
  ASSERT_EQ(d.edges.segments.size(), static_cast<std::size_t>(columns));
  for (std::size_t e = 0; e < d.edges.vertices.size(); ++e) {
    if (d.edges.segment[e] < 0) continue;
    const CurveSegment segment = d.edges.segments[d.edges.segment[e]];
    const double h1 = sizes[0][segment.rank], h2 = sizes[0][segment.rank + 1];
    EXPECT_NEAR(d[Kind::edge_angle].values[e], degrees(step / 2), 1e-10);
    const double length = step * std::log(h2 / h1) / (h2 - h1);
    EXPECT_NEAR(d[Kind::length].values[e], length, 1e-12);
    EXPECT_NEAR(d[Kind::gradation].values[e], std::pow(h2 / h1, 1 / length), 1e-12);
  }
  // Above the arc the cylinder is a sagitta away from its triangles, and so is the rim of the lid from the lid's.
  std::size_t place = 0;
  for (const FaceMesh& face : run.mesh.faces)
    for (const auto& t : face.triangles) {
      int on_arc = 0;
      for (const std::int32_t v : t) on_arc += std::count(curve.vertices.begin(), curve.vertices.end(), face.vertex[v]);
      if (face.ref == 2 || on_arc == 2) {
        EXPECT_NEAR(d[Kind::deviation].values[place], 1 - std::cos(step / 2), 2e-3);
      }
      ++place;
    }
}

TEST(DeliveredCalls, AreCountedApartAndAsReported) {
  Case run{one_face([](Vec2 p) { return testing::torus_jet(p, 2, 0.7); }), {}, {}};
  run.mesh = grid_mesh(run.cad, std::array{Grid{1, {0, 0}, {1, 1}, 20, 20}});
  const CallCounts before = run.cad.calls;
  const MeshEvaluation d = run.measure(uniform(0.1));
  EXPECT_EQ(d.calls.surf0 + before.surf0, run.cad.calls.surf0);
  EXPECT_EQ(d.calls.surf1 + before.surf1, run.cad.calls.surf1);
  const auto n = static_cast<std::int64_t>(run.mesh.vertices.size()),
             k = static_cast<std::int64_t>(d.edges.vertices.size()),
             m = static_cast<std::int64_t>(run.mesh.triangle_count());
  EXPECT_EQ(d.calls.surf0, 3 * k + 7 * m);
  EXPECT_EQ(d.calls.surf1, n + 3 * k + 7 * m);
  EXPECT_EQ(d.calls.surf2, 0);
}

TEST(DeliveredStop, IsHeardAtOnce) {
  Case run{one_face([](Vec2 p) { return testing::torus_jet(p, 2, 0.7); }), {}, {}};
  run.mesh = grid_mesh(run.cad, std::array{Grid{1, {0, 0}, {1, 1}, 60, 60}});
  run.cad.calls = {};
  run.monitor.request_stop();
  EXPECT_THROW(run.measure(uniform(0.1)), Cancelled);
  EXPECT_LE(run.cad.calls.surface(), 4096);
}

TEST(SpreadOf, CountsEveryValueThatIsOne) {
  std::vector<double> values{std::nan(""), 3, 1, 2, 2, 10};
  const std::vector<double> inner{1, 2, 5};
  const Spread s = spread_of(values, inner);
  EXPECT_EQ(s.count, 5);
  EXPECT_DOUBLE_EQ(s.mean, 3.6);
  EXPECT_EQ(s.min, 1);
  EXPECT_EQ(s.max, 10);
  EXPECT_EQ(s.histogram.count, (std::vector<std::int64_t>{0, 1, 3, 1}));
  EXPECT_EQ(s.histogram.bound.size(), 5U);
  values.clear();
  for (int i = 1; i <= 1000; ++i) values.push_back(i);
  EXPECT_EQ(spread_of(values, inner).p1, 11);
  EXPECT_EQ(spread_of(values, inner).p99, 990);
  EXPECT_EQ(spread_of({}, inner).count, 0);
  EXPECT_EQ(spread_of({}, inner).histogram.count, (std::vector<std::int64_t>{0, 0, 0, 0}));
}

TEST(SpreadOf, NoMeshHasNothingToReport) {
  Case run{one_face(plane_jet), {}, {}};
  const MeshEvaluation d = run.measure(uniform(1));
  for (const EvaluatedMeasure& measure : delivered_measures()) EXPECT_EQ(d[measure.kind].spread.count, 0);
  EXPECT_EQ(d.share_in_range(), 0);
  EXPECT_TRUE(describe(d).not_met.empty());
}

}  // namespace
}  // namespace carreau
