// SPDX-License-Identifier: BSD-3-Clause
// Plane domains through the ordinary pipeline: figures of HDR and RR-2818.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "curve/unit_discretisation.h"
#include "geometry/plane/plane_geometry.h"
#include "mesh/quality.h"
#include "session/session.h"

namespace carreau {
namespace {

/// A session with the domain and its sizes; nothing narrows sizes.
std::unique_ptr<Session> session_of(const PlaneDomainInput& input, double size, Monitor& monitor) {
  PlaneGeometry plane = build_plane_geometry(input);
  auto session = std::make_unique<Session>(monitor);
  session->set_cad(plane.built.cad);
  session->set_model(plane.built.model);
  session->set_prescription_source(plane.sizes);
  session->parameters().set("hphy_flag", plane.sizes ? 2 : 1);
  session->parameters().set("hphydef", size);
  session->parameters().set("hphymin", 1e-6);
  session->parameters().set("hphymax", 1e6);
  session->parameters().set("flag", 1);
  return session;
}

int add_point(PlaneDomainInput& input, const Vec2& xy, double size = 0) {
  PlanePoint& point = input.points.emplace_back();
  point.xy = xy;
  if (size > 0) point.size = size;
  return static_cast<int>(input.points.size()) - 1;
}

int add_curve(PlaneDomainInput& input, std::vector<int> points, bool smooth, int ref = 0) {
  PlaneCurve& curve = input.curves.emplace_back();
  curve.points = std::move(points), curve.smooth = smooth, curve.ref = ref;
  return static_cast<int>(input.curves.size()) - 1;
}

/// A closed spline through n points of r(angle) around the origin, with one size.
template <typename Radius>
int add_round(PlaneDomainInput& input, int n, double size, Radius&& radius) {
  std::vector<int> points;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n, r = radius(angle);
    points.push_back(add_point(input, {r * std::cos(angle), r * std::sin(angle)}, size));
  }
  points.push_back(points.front());
  return add_curve(input, points, true);
}

struct Shapes {
  double area = 0, q2_mean = 0, q2_min = 1, degree6 = 0;
  std::size_t triangles = 0;
};

Shapes shapes_of(const FlatMesh& mesh) {
  Shapes shapes;
  shapes.triangles = mesh.triangles.size();
  std::vector<int> degree(mesh.vertices.size(), 0);
  std::map<std::pair<int, int>, int> sides;
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const double q2 = quality_q2(a, b, c);
    shapes.q2_mean += q2 / static_cast<double>(shapes.triangles);
    shapes.q2_min = std::min(shapes.q2_min, q2);
    shapes.area += norm(cross(Vec3(b - a), Vec3(c - a))) / 2;
    for (int i = 0; i < 3; ++i) ++degree[t[i]], ++sides[std::minmax(t[i], t[(i + 1) % 3])];
  }
  std::vector<char> border(mesh.vertices.size(), 0);
  for (const auto& [side, count] : sides)
    if (count == 1) border[side.first] = border[side.second] = 1;
  double inner = 0;
  for (std::size_t v = 0; v < degree.size(); ++v)
    if (border[v] == 0) ++inner, shapes.degree6 += degree[v] == 6 ? 1 : 0;
  shapes.degree6 /= std::max(inner, 1.0);
  return shapes;
}

TEST(PlaneMeshes, AnEquilateralDomainHasEquilateralTrianglesOnly) {  // HDR fig. 1.1
  PlaneDomainInput input;
  for (const Vec2& p : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0.5, std::sqrt(0.75)}}) add_point(input, p);
  add_curve(input, {0, 1, 2, 0}, false);
  Monitor silent;
  const auto session = session_of(input, 0.1, silent);
  session->make_mesh();
  const FlatMesh mesh = session->exported();
  EXPECT_EQ(mesh.dimension, 2);
  const Shapes shapes = shapes_of(mesh);
  EXPECT_EQ(shapes.triangles, 100u);
  EXPECT_NEAR(shapes.area, std::sqrt(3) / 4, 1e-14);
  EXPECT_GT(shapes.q2_min, 1 - 1e-9);
}

// RR-2818 sec. 6.1: sizes at five places of a segment of length 10.
TEST(PlaneMeshes, ASegmentWithSizesAtPlacesHasTheEdgesOfTheReport) {
  for (const auto& [law, edges] : {std::pair{0, 17}, {1, 26}, {2, 21}}) {
    PlaneDomainInput input;
    std::vector<int> passed;
    for (const auto& [s, h] : {std::pair{0.0, 1.5}, {3.0, 0.5}, {4.0, 2.0}, {8.0, 0.1}, {10.0, 0.7}})
      passed.push_back(add_point(input, {s, 0}, h));
    const int a = add_point(input, {10, 8}, 2), b = add_point(input, {0, 8}, 2);
    add_curve(input, passed, true, 7);
    add_curve(input, {passed.back(), a, b, passed.front()}, false);
    Monitor silent;
    const auto session = session_of(input, 1, silent);
    session->parameters().set("hinterpol_flag", law);
    session->make_mesh();
    int count = 0;
    for (const CurveMesh& curve : session->mesh().curves)
      if (curve.shown_ref() == 7) count += static_cast<int>(curve.vertices.size()) - 1;
    EXPECT_EQ(count, edges) << "law " << law;
  }
}

/// Length of a segment of the axis y = 0 between metrics at places, by a dense midpoint rule.
double metric_length(const std::vector<std::pair<double, Metric2>>& known, MetricLaw law, double from, double to) {
  constexpr int steps = 2000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double s = from + (to - from) * (i + 0.5) / steps;
    std::size_t k = 0;
    while (k + 2 < known.size() && known[k + 1].first <= s) ++k;
    const double share = (s - known[k].first) / (known[k + 1].first - known[k].first);
    sum += length(interpolate(known[k].second, known[k + 1].second, share, law), Vec2{(to - from) / steps, 0});
  }
  return sum;
}

// RR-2818 sec. 6.2: metrics at five places of a segment of length 7.5, as a side of a domain that is meshed.
TEST(PlaneMeshes, ASegmentWithMetricsAtPlacesHasEdgesOfOneLength) {
  struct Row {
    double s, degrees, h1, h2;
  };
  for (const MetricLaw law : {MetricLaw::linear, MetricLaw::geometric, MetricLaw::sinusoidal}) {
    PlaneDomainInput input;
    std::vector<int> passed;
    std::vector<std::pair<double, Metric2>> known;
    for (const Row& row : {Row{0, 30, 0.70, 0.25}, {2, 90, 1.10, 0.15}, {3, 0, 0.30, 0.30}, {6, -60, 1.50, 0.40},
                           {7.5, -45, 1.00, 0.35}}) {
      const double angle = row.degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
      const double p = 1 / (row.h1 * row.h1), q = 1 / (row.h2 * row.h2);
      known.emplace_back(row.s, Metric2{p * c * c + q * s * s, (p - q) * c * s, p * s * s + q * c * c});
      passed.push_back(add_point(input, {row.s, 0}));
      input.points.back().metric = known.back().second;
    }
    const int a = add_point(input, {7.5, 4}, 1), b = add_point(input, {0, 4}, 1);
    add_curve(input, passed, true, 7);
    add_curve(input, {passed.back(), a, b, passed.front()}, false);
    Monitor silent;
    const auto session = session_of(input, 1, silent);
    session->parameters().set("hinterpol_flag", static_cast<int>(law));
    session->make_mesh();
    std::vector<double> cuts;
    for (const CurveMesh& curve : session->mesh().curves)
      if (curve.shown_ref() == 7)
        for (const auto v : curve.vertices) cuts.push_back(session->mesh().vertices[static_cast<std::size_t>(v)].x());
    std::sort(cuts.begin(), cuts.end());
    ASSERT_GT(cuts.size(), 10u);
    const auto edges = static_cast<double>(cuts.size() - 1);
    const double whole = metric_length(known, law, 0, 7.5);
    EXPECT_EQ(cuts.size() - 1, static_cast<std::size_t>(unit_edge_count(whole)));
    double worst = 0;
    for (std::size_t i = 1; i < cuts.size(); ++i)
      worst = std::max(worst, std::abs(metric_length(known, law, cuts[i - 1], cuts[i]) * edges / whole - 1));
    std::printf("law %d: %.0f edges, within %.3f %% of one length\n", static_cast<int>(law), edges, 100 * worst);
    EXPECT_LT(worst, 0.005) << static_cast<int>(law);
  }
}

// HDR fig. 3.5 with another curve than the @: the frontal placement is better in each respect.
TEST(PlaneMeshes, FrontalPlacementIsBetterThanAlgebraicOne) {
  PlaneDomainInput input;
  input.rest = PlaneRest::outside;
  const int circle = add_round(input, 48, 5, [](double) { return 50.0; });
  const int curve = add_round(input, 48, 0.25, [](double angle) { return 12 + 5 * std::cos(3 * angle); });
  for (const auto& [c, left] : {std::pair{circle, true}, {curve, true}}) {
    PlaneSide& side = input.sides.emplace_back();
    side.curve = c, side.left = left, side.ref = 1;
  }
  Shapes shapes[2];
  for (const int frontal : {0, 1}) {
    Monitor silent;
    const auto session = session_of(input, 5, silent);
    session->parameters().set("gradation", 1.25);
    session->parameters().set("frontal", frontal);
    session->make_mesh();
    shapes[frontal] = shapes_of(session->exported());
    std::printf("%s: %zu triangles, Q2 mean %.4f, worst %.4f, degree 6 %.1f %%\n", frontal ? "frontal" : "algebraic",
                shapes[frontal].triangles, shapes[frontal].q2_mean, shapes[frontal].q2_min,
                100 * shapes[frontal].degree6);
    EXPECT_EQ(find_defects(session->mesh()), std::vector<std::string>{});
    // The circle as a polygon of edges of 5.
    EXPECT_NEAR(shapes[frontal].area, 2500 * std::numbers::pi, 2500 * std::numbers::pi * 0.003);
  }
  EXPECT_GT(shapes[1].q2_mean, shapes[0].q2_mean);
  EXPECT_GT(shapes[1].q2_min, shapes[0].q2_min);
  EXPECT_GT(shapes[1].degree6, shapes[0].degree6);
}

TEST(PlaneMeshes, DanglingCurvesAndPointsAreInTheMesh) {
  PlaneDomainInput input;
  for (const Vec2& p : {Vec2{0, 0}, Vec2{4, 0}, Vec2{4, 4}, Vec2{0, 4}, Vec2{1, 1}, Vec2{2, 3}}) add_point(input, p);
  input.points[add_point(input, {3, 1})].imposed = true;
  input.points.back().ref = 11;
  add_curve(input, {0, 1, 2, 3, 0}, false);
  add_curve(input, {4, 5}, false, 8);
  Monitor silent;
  const auto session = session_of(input, 0.5, silent);
  session->make_mesh();
  const FlatMesh mesh = session->exported();
  double length = 0;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    if (mesh.edge_refs[e] == 8) length += norm(Vec3(mesh.vertices[mesh.edges[e][1]] - mesh.vertices[mesh.edges[e][0]]));
  EXPECT_NEAR(length, std::sqrt(5), 1e-14);
  int found = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (mesh.vertex_refs[v] == 11 && mesh.vertices[v] == Vec3(3, 1, 0)) ++found;
  EXPECT_EQ(found, 1);
  EXPECT_NEAR(shapes_of(mesh).area, 16, 1e-13);
}

TEST(PlaneMeshes, DoNotDependOnTheNumberOfThreads) {
  PlaneDomainInput input;
  add_round(input, 32, 0, [](double) { return 3.0; });
  add_round(input, 16, 0, [](double) { return 1.0; });
  input.rest = PlaneRest::inside;
  std::vector<Vec3> vertices[2];
  for (const int threads : {1, 4}) {
    Monitor silent;
    const auto session = session_of(input, 0.2, silent);
    session->parameters().set("threads", threads);
    session->make_mesh();
    vertices[threads / 4] = session->mesh().vertices;
  }
  EXPECT_EQ(vertices[0], vertices[1]);
}

}  // namespace
}  // namespace carreau
