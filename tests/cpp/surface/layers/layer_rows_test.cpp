// SPDX-License-Identifier: BSD-3-Clause
// Rows of cells along curves: heights, growth, corners, rows that meet.
#include "surface/layers/layer_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "mesh/elements/jacobian.h"
#include "model/topology.h"
#include "pipeline/base/run.h"
#include "session_of_size.h"
#include "support/error.h"

namespace carreau {
namespace {

using namespace testing;

constexpr double pi = std::numbers::pi;

SurfaceJet flat(Vec2 p) { return {{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; }
SurfaceJet cylinder(Vec2 p) {
  constexpr double radius = 2;
  const double c = std::cos(p.x()), s = std::sin(p.x());
  return {{radius * c, radius * s, p.y()}, {-radius * s, radius * c, 0}, {0, 0, 1}, {-radius * c, -radius * s, 0}, {}, {}};
}

AnalyticCad plane_of(std::vector<AnalyticCurve> curves) {
  AnalyticCad cad;
  cad.faces[1] = {flat, std::move(curves)};
  return cad;
}

std::vector<AnalyticCurve> polygon(const std::vector<Vec2>& corners) {
  std::vector<AnalyticCurve> sides;
  for (std::size_t k = 0; k < corners.size(); ++k) sides.push_back(segment(corners[k], corners[(k + 1) % corners.size()]));
  return sides;
}

/// One side of NACA 0012 with a sharp trailing edge, from the leading edge: x = t^2 (NACA Report 460).
AnalyticCurve naca0012(double side, Vec2 at, Vec2 scale) {
  return {{0, 1}, [=](double t) {
            const double t2 = t * t, t4 = t2 * t2;
            const double y = 0.6 * (0.2969 * t - 0.126 * t2 - 0.3516 * t4 + 0.2843 * t4 * t2 - 0.1036 * t4 * t4);
            const double dy = 0.6 * (0.2969 - 0.252 * t - 1.4064 * t2 * t + 1.7058 * t4 * t - 0.8288 * t4 * t2 * t);
            return CurveJet{at + Vec2(scale.x() * t2, scale.y() * side * y), {scale.x() * 2 * t, scale.y() * side * dy}, {}};
          }};
}

AnalyticCad wing(std::function<SurfaceJet(Vec2)> surface, Vec2 low, Vec2 high, Vec2 at, Vec2 scale) {
  AnalyticCad cad;
  std::vector<AnalyticCurve> curves = rectangle(low, high);
  curves.push_back(naca0012(1, at, scale));
  curves.push_back(naca0012(-1, at, scale));
  cad.faces[1] = {std::move(surface), std::move(curves)};
  return cad;
}

struct Layered {
  /// The last `inner` curves of face 1 lie inside it.
  Layered(const AnalyticCad& cad, double size, const std::vector<CurveLayers>& layers, const char* element = "p1", int threads = 1,
          std::size_t inner = 0)
      : session(session_of_command(cad, size, monitor)) {
    if (inner > 0) {
      Model model = unglued(cad);
      std::vector<FaceCurve>& curves = model.faces[0].curves;
      for (std::size_t c = curves.size() - inner; c < curves.size(); ++c) curves[c].type = CurveType::internal;
      session->set_model(model);
    }
    session->parameters().set("element", element);
    session->parameters().set("threads", threads);
    for (const CurveLayers& each : layers) session->add_layers(each);
    session->make_mesh();
    EXPECT_EQ(find_defects(session->mesh()), std::vector<std::string>{});
    EXPECT_EQ(session->mesh().faces[0].status, FaceStatus::meshed) << session->mesh().faces[0].why;
    figures = session->layer_figures();
  }
  Monitor monitor;
  std::unique_ptr<Session> session;
  std::vector<LayerFigures> figures;
};

/// Heights and growth as given, within 5 % or less.
void expect_as_given(const LayerFigures& figures, const CurveLayers& layers, double tolerance = 0.05) {
  EXPECT_NEAR(figures.first_min / layers.first, 1, tolerance);
  EXPECT_NEAR(figures.first_mean / layers.first, 1, tolerance);
  EXPECT_NEAR(figures.first_max / layers.first, 1, tolerance);
  EXPECT_NEAR(figures.growth_min / layers.ratio, 1, tolerance);
  EXPECT_NEAR(figures.growth_max / layers.ratio, 1, tolerance);
}

TEST(LayerRows, ACircleHasItsRowsAtTheHeights) {
  std::vector<AnalyticCurve> curves = rectangle({-2, -2}, {2, 2});
  curves.push_back(arc({0, 0}, 0.5, 0, pi));
  curves.push_back(arc({0, 0}, 0.5, pi, 2 * pi));
  const CurveLayers layers{.curves = {5, 6}, .first = 0.001, .ratio = 1.2, .count = 20};
  const Layered run(plane_of(curves), 0.05, {layers});
  ASSERT_EQ(run.figures.size(), 1U);
  EXPECT_EQ(run.figures[0].rows, 20);
  EXPECT_EQ(run.figures[0].fewest_rows, 20);
  expect_as_given(run.figures[0], layers, 1e-6);
  // Vertices near the circle lie at the height of a row, but for the bisectors of its edges.
  std::int64_t in_first = 0;
  for (const Vec3& p : run.session->mesh().vertices) {
    const double d = norm(p) - 0.5;
    if (d > 1e-9 && d < 0.0018) {
      EXPECT_NEAR(d, 0.001, 1e-5);
      ++in_first;
    }
  }
  EXPECT_EQ(20 * in_first, run.figures[0].cells);
}

TEST(LayerRows, AnAerofoilHasAFanAtItsTrailingEdge) {
  const CurveLayers layers{.curves = {5, 6}, .first = 0.002, .ratio = 1.2, .count = 10};
  const Layered run(wing(flat, {-1.5, -1.5}, {2.5, 1.5}, {0, 0}, {1, 1}), 0.04, {layers});
  EXPECT_EQ(run.figures[0].rows, 10);
  EXPECT_EQ(run.figures[0].fewest_rows, 10);
  expect_as_given(run.figures[0], layers);
  // The fan surrounds the trailing edge: a vertex lies behind it, in each row.
  for (int k = 1; k <= 10; ++k) {
    const double height = layers.first * (std::pow(1.2, k) - 1) / 0.2;
    double nearest = 1;
    for (const Vec3& p : run.session->mesh().vertices) nearest = std::min(nearest, norm(p - Vec3(1 + height, 0, 0)));
    EXPECT_LT(nearest, 0.3 * height) << k;
  }
}

TEST(LayerRows, AWingRootOnACylinderHasItsRowsAtTheHeights) {
  const CurveLayers layers{.curves = {5, 6}, .first = 0.001, .ratio = 1.25, .count = 12};
  const Layered run(wing(cylinder, {-0.8, -1}, {0.8, 2}, {0, 0}, {0.2, 1}), 0.03, {layers});
  EXPECT_EQ(run.figures[0].rows, 12);
  EXPECT_EQ(run.figures[0].fewest_rows, 12);
  expect_as_given(run.figures[0], layers);
  for (const Vec3& p : run.session->mesh().vertices) EXPECT_NEAR(std::hypot(p.x(), p.y()), 2, 1e-9);
}

TEST(LayerRows, SidesHaveTheirVerticesAtTheHeights) {
  const CurveLayers layers{.curves = {1}, .first = 0.01, .ratio = 1.3, .count = 8};
  const Layered run(plane_of(rectangle({0, 0}, {2, 1})), 0.1, {layers});
  EXPECT_EQ(run.figures[0].fewest_rows, 8);
  EXPECT_EQ(run.figures[0].cells, 8 * 20);
  expect_as_given(run.figures[0], layers, 1e-6);
  for (int k = 1; k <= 8; ++k) {
    const double height = 0.01 * (std::pow(1.3, k) - 1) / 0.3;
    std::int64_t found = 0;
    for (const Vec3& p : run.session->mesh().vertices)
      if (std::abs(p.y() - height) < 1e-6) ++found;
    EXPECT_EQ(found, 21) << k;
  }
}

TEST(LayerRows, CornersHaveFansAndMerge) {
  const AnalyticCad ell = plane_of(polygon({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}));
  const CurveLayers layers{.curves = {1, 2, 3, 4, 5, 6}, .first = 0.005, .ratio = 1.2, .count = 12};
  const Layered run(ell, 0.1, {layers});
  EXPECT_EQ(run.figures[0].rows, 12);
  EXPECT_GE(run.figures[0].fewest_rows, 11);
  expect_as_given(run.figures[0], layers);
  // Rows meet on the bisector of a right angle, and turn around the corner of 270 degrees by three steps.
  const double height = 0.005;
  double bisector = 1, around = 1;
  for (const Vec3& p : run.session->mesh().vertices) {
    bisector = std::min(bisector, norm(p - Vec3(height, height, 0)));
    around = std::min(around, norm(p - Vec3(1 - height * std::cos(pi / 6), 1 - height * std::sin(pi / 6), 0)));
  }
  EXPECT_LT(bisector, 1e-9);
  EXPECT_LT(around, 1e-9);
}

std::int64_t count_at(const SurfaceMesh& mesh, const std::function<double(const Vec3&)>& distance, double height, double tolerance = 1e-9) {
  return std::count_if(mesh.vertices.begin(), mesh.vertices.end(), [&](const Vec3& p) { return std::abs(distance(p) - height) < tolerance; });
}

TEST(LayerRows, AnInnerCurveHasRowsOnBothSidesAndFansAtItsEnds) {
  std::vector<AnalyticCurve> curves = rectangle({0, 0}, {3, 2});
  curves.push_back(segment({1, 1}, {2, 1}));
  const CurveLayers layers{.curves = {5}, .first = 0.01, .ratio = 1.2, .count = 6};
  const Layered run(plane_of(curves), 0.1, {layers}, "p1", 1, 1);
  EXPECT_EQ(run.figures[0].rows, 6);
  EXPECT_EQ(run.figures[0].fewest_rows, 6);
  expect_as_given(run.figures[0], layers);
  // Ten edges on each side, and six steps of 30 degrees at each end.
  EXPECT_EQ(run.figures[0].cells, 6 * (2 * 10 + 2 * 6));
  const auto distance = [](const Vec3& p) { return norm(p - Vec3(std::clamp(p.x(), 1., 2.), 1, 0)); };
  for (int k = 1; k <= 6; ++k)
    EXPECT_EQ(count_at(run.session->mesh(), distance, layers.first * (std::pow(1.2, k) - 1) / 0.2), 2 * 11 + 2 * 5) << k;
}

TEST(LayerRows, AClosedInnerCurveHasRowsOnBothSides) {
  std::vector<AnalyticCurve> curves = rectangle({-2, -2}, {2, 2});
  curves.push_back(arc({0, 0}, 1, 0, pi));
  curves.push_back(arc({0, 0}, 1, pi, 2 * pi));
  const CurveLayers layers{.curves = {5, 6}, .first = 0.005, .ratio = 1.2, .count = 8};
  const Layered run(plane_of(curves), 0.1, {layers}, "p1", 1, 2);
  EXPECT_EQ(run.figures[0].fewest_rows, 8);
  expect_as_given(run.figures[0], layers);
  const auto radius = [](const Vec3& p) { return norm(p); };
  const std::int64_t edges = count_at(run.session->mesh(), radius, 1);
  EXPECT_EQ(run.figures[0].cells, 2 * 8 * edges);
  for (const double side : {-1, 1}) EXPECT_EQ(count_at(run.session->mesh(), radius, 1 + side * 0.005, 1e-5), edges);
}

TEST(LayerRows, InnerCurvesThatMeetTheBoundaryMergeWithItsRows) {
  std::vector<AnalyticCurve> curves{segment({0, 0}, {1, 0}), segment({1, 0}, {2, 0}), segment({2, 0}, {2, 1}), segment({2, 1}, {0, 1}),
                                    segment({0, 1}, {0, 0})};
  curves.push_back(segment({1, 0}, {1, 0.6}));
  const CurveLayers layers{.curves = {1, 2, 6}, .first = 0.01, .ratio = 1.2, .count = 5};
  const Layered both(plane_of(curves), 0.1, {layers}, "p1", 1, 1);
  EXPECT_EQ(both.figures[0].fewest_rows, 5);
  expect_as_given(both.figures[0], layers);
  EXPECT_EQ(count_at(both.session->mesh(), [](const Vec3& p) { return norm(p - Vec3(1 + 0.01, 0.01, 0)); }, 0), 1);
  // Without layers, both parts of the boundary have vertices at the heights.
  const CurveLayers alone{.curves = {6}, .first = 0.01, .ratio = 1.2, .count = 5};
  const Layered one(plane_of(curves), 0.1, {alone}, "p1", 1, 1);
  EXPECT_EQ(one.figures[0].fewest_rows, 5);
  expect_as_given(one.figures[0], alone);
  for (const double x : {0.99, 1.01}) EXPECT_EQ(count_at(one.session->mesh(), [x](const Vec3& p) { return norm(p - Vec3(x, 0, 0)); }, 0), 1);
}

AnalyticCad two_walls() {
  AnalyticCad cad = plane_of(rectangle({0, 0}, {2, 1}));
  cad.faces[2] = {[](Vec2 p) { return SurfaceJet{{p.x(), 0, -p.y()}, {1, 0, 0}, {0, 0, -1}, {}, {}, {}}; }, rectangle({0, 0}, {2, 1})};
  return cad;
}

TEST(LayerRows, ACurveOfTwoFacesHasRowsOnBoth) {
  const CurveLayers layers{.curves = {1}, .first = 0.01, .ratio = 1.3, .count = 8};
  const Layered run(two_walls(), 0.1, {layers});
  EXPECT_EQ(run.figures[0].fewest_rows, 8);
  EXPECT_EQ(run.figures[0].cells, 2 * 8 * 20);
  expect_as_given(run.figures[0], layers, 1e-6);
}

TEST(LayerRows, RowsThatMeetEnd) {
  const CurveLayers layers{.curves = {1, 3}, .first = 0.01, .ratio = 1.3, .count = 30};
  const Layered run(plane_of(rectangle({0, 0}, {2, 0.3})), 0.1, {layers});
  EXPECT_GE(run.figures[0].fewest_rows, 3);
  EXPECT_LE(run.figures[0].rows, 6);  // .01 + .013 + ... = .15 after six rows
  expect_as_given(run.figures[0], layers, 1e-6);
  // A wall without layers ends them, too.
  const Layered wall(plane_of(rectangle({0, 0}, {2, 0.3})), 0.1, {{.curves = {1}, .first = 0.01, .ratio = 1.3, .count = 30}});
  EXPECT_LE(wall.figures[0].rows, 9);
}

// In the plane the corner's columns lie on the bisectors. A cylinder is developable: its rows have the same heights.
TEST(LayerRows, CornersOnACylinderKeepTheGrowth) {
  AnalyticCad cad;
  cad.faces[1] = {cylinder, rectangle({0, 0}, {1.4, 2.8})};
  const CurveLayers layers{.curves = {1, 2, 3, 4}, .first = 0.3, .ratio = 1.2, .count = 3};
  const Layered run(cad, 0.55, {layers});
  EXPECT_GE(run.figures[0].rows, 2);
  EXPECT_NEAR(run.figures[0].growth_min / layers.ratio, 1, 0.02);
  EXPECT_NEAR(run.figures[0].growth_max / layers.ratio, 1, 0.02);
}

/// Chords of a ring that is narrower than their sagittas.
TEST(LayerRows, RowsOnCoarseFlanksDoNotTurnOver) {
  const auto ring = [](Vec2 p) -> SurfaceJet {
    const double c = std::cos(p.x()), s = std::sin(p.x());
    return {{p.y() * c, p.y() * s, 0}, {-p.y() * s, p.y() * c, 0}, {c, s, 0}, {-p.y() * c, -p.y() * s, 0}, {-s, c, 0}, {}};
  };
  for (const double size : {0.3, 0.45, 0.6})
    for (const double width : {0.1, 0.2, 0.3}) {
      AnalyticCad cad;
      cad.faces[1] = {ring, rectangle({0, 2}, {2, 2 + width})};
      const CurveLayers layers{.curves = {1, 3}, .first = 0.02, .ratio = 1.2, .count = 6};
      const Layered run(cad, size, {layers});
      const SurfaceMesh& mesh = run.session->mesh();
      for (const auto& [a, b, c] : mesh.faces[0].triangles) {
        const auto at = [&](std::int32_t v) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(mesh.faces[0].vertex[static_cast<std::size_t>(v)])]; };
        EXPECT_LT(cross(at(b) - at(a), at(c) - at(a)).z(), 0) << size << ' ' << width;  // S_u x S_v points down
      }
    }
}

TEST(LayerRows, EdgesThatBendBulgeByTheSagittasOfTheirArcs) {
  Monitor monitor;
  AnalyticCad cad = plane_of({arc({1, 2}, 3, 0, 2 * pi)});
  const ModelSupports supports = build_supports(unglued(cad), cad, 0.5, 1, monitor);
  const Model model = glue(unglued(cad), traces_of(supports), 1e-9);
  const Topology topology = build_topology(model, traces_of(supports), 1e-9);
  CompositeOptions options;
  options.size = {.physical = PhysicalSizes::uniform, .hphydef = 2, .hphymin = 1e-3, .hphymax = 10};
  CompositeRun run(model, topology, supports, cad, options, PeriodicModel{}, monitor);
  discretise_curves(run);
  const std::vector<CurveLayers> given{{.curves = {1}, .first = 0.1, .ratio = 1.2, .count = 3}};
  const DiscreteCurve& circle = run.curves[0];
  for (const bool bent : {false, true}) {
    LayerCurves layers(model, topology, given, false, bent);
    layers.find_bulges(run.curve_model, run.curves);
    for (int k = 0; k < circle.segments(); ++k) {
      const Vec3 &a = circle.xyz[static_cast<std::size_t>(k)], &b = circle.xyz[static_cast<std::size_t>(k) + 1];
      const Vec3 middle = 0.5 * (a + b), out = middle - Vec3(1, 2, 0);
      const Vec3 sagitta = bent ? Vec3((3 / norm(out) - 1) * out) : Vec3(0, 0, 0);
      EXPECT_LT(norm(layers.bulge({.a = k, .b = k + 1, .curve = 0, .segment = k}) - sagitta), 1e-3);
    }
    EXPECT_EQ(layers.bulge({.a = 0, .b = 1}), Vec3(0, 0, 0));
  }
}

TEST(LayerRows, RowsBesideAFaultLoseHalf) {
  const std::vector<Vec3> at{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {0, 2, 0}, {1, 2, 0}};
  const std::vector<LayerCell> cells{{.corners = {0, 1, 4, 3}, .layers = 0, .row = 0}, {.corners = {3, 4, 7, 6}, .layers = 0, .row = 1},
                                     {.corners = {1, 2, 5, 4}, .layers = 0, .row = 0}};
  std::vector<RowLimit> limits;
  const auto place = [&](std::int32_t v) { return at[static_cast<std::size_t>(v)]; };
  EXPECT_TRUE(limit_rows_at(7, std::vector<Vec3>{{0, 2, 0}, {0, 3, 0}}, 2, cells, place, false, limits));
  ASSERT_EQ(limits.size(), 1U);
  EXPECT_EQ(limits[0].face, 7);
  EXPECT_EQ(limits[0].rows, 1);
  EXPECT_LE(norm(limits[0].place - at[0]), limits[0].reach);
  EXPECT_LE(norm(limits[0].place - at[1]), limits[0].reach);
  EXPECT_GT(norm(limits[0].place - at[2]), limits[0].reach);
  EXPECT_TRUE(limit_rows_at(7, std::vector<Vec3>{{2, 1, 0}}, 2, cells, place, false, limits));
  ASSERT_EQ(limits.size(), 2U);
  EXPECT_EQ(limits[1].rows, 0);
  EXPECT_FALSE(limit_rows_at(7, std::vector<Vec3>{{2, 1.01, 0}}, 2, cells, place, false, limits));
  EXPECT_EQ(limits.size(), 2U);
}

TEST(LayerRows, QuadrilateralsComeInRows) {
  const CurveLayers layers{.curves = {1}, .first = 0.01, .ratio = 1.3, .count = 8};
  const Layered run(plane_of(rectangle({0, 0}, {2, 1})), 0.1, {layers}, "q1.0");
  EXPECT_EQ(run.figures[0].fewest_rows, 8);
  expect_as_given(run.figures[0], layers, 1e-6);
  const FaceMesh& face = run.session->mesh().faces[0];
  std::int64_t rows = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(face.quads); ++k) {
    double low = 1, high = 0;
    for (const std::int32_t v : face.quad(k)) {
      const double y = run.session->mesh().vertices[static_cast<std::size_t>(face.vertex[static_cast<std::size_t>(v)])].y();
      low = std::min(low, y), high = std::max(high, y);
    }
    if (high < 0.2385 + 0.01) ++rows;  // .01 (1.3^8 - 1) / .3
  }
  EXPECT_GE(rows, 8 * 20);
}

/// The smallest Jacobian of an element over its mean; straight elements have 1, or less with four corners.
double least_jacobian(const SurfaceMesh& mesh) {
  double least = 1;
  for (const FaceMesh& face : mesh.faces)
    for (const Cell& cell : cells_of(mesh, face)) {
      std::vector<Vec3> nodes;
      for (int k = 0; k < node_count(cell.kind); ++k) {
        const auto v = static_cast<std::size_t>(cell.nodes[static_cast<std::size_t>(k)]);
        nodes.push_back(v < mesh.vertices.size() ? mesh.vertices[v] : mesh.mid_vertices[v - mesh.vertices.size()]);
      }
      least = std::min(least, jacobian(cell.kind, nodes).least());
    }
  return least;
}

class EachElement : public ::testing::TestWithParam<const char*> {};

/// Sixteen edges on the circle lie up to 0.0096 from it: their middles would lie behind five rows.
TEST_P(EachElement, HasItsRowsAtTheHeights) {
  std::vector<AnalyticCurve> curves = rectangle({-2, -2}, {2, 2});
  curves.push_back(arc({0, 0}, 0.5, 0, pi));
  curves.push_back(arc({0, 0}, 0.5, pi, 2 * pi));
  const CurveLayers layers{.curves = {5, 6}, .first = 0.001, .ratio = 1.2, .count = 10};
  const Layered run(plane_of(curves), 0.2, {layers}, GetParam());
  const SurfaceMesh& mesh = run.session->mesh();
  EXPECT_EQ(run.figures[0].rows, 10);
  EXPECT_EQ(run.figures[0].fewest_rows, 10);
  expect_as_given(run.figures[0], layers);
  EXPECT_GT(least_jacobian(mesh), 0);
  // Nodes near the circle lie on rows or halfway between two.
  const double second = 0.001 + 0.0012;
  for (const std::vector<Vec3>& nodes : {mesh.vertices, mesh.mid_vertices})
    for (const Vec3& p : nodes) {
      const double d = norm(p) - 0.5;
      if (!(d < 1.02 * second)) continue;
      double nearest = 1;
      for (const double at : {0., 0.0005, 0.001, 0.0016, second}) nearest = std::min(nearest, std::abs(d - at));
      EXPECT_LT(nearest, 0.05 * 0.001) << d;
    }
}

TEST_P(EachElement, FillsCornersAndSides) {
  const AnalyticCad ell = plane_of(polygon({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}));
  const CurveLayers layers{.curves = {1, 3, 4, 6}, .first = 0.005, .ratio = 1.2, .count = 12};
  const Layered run(ell, 0.1, {layers}, GetParam());
  EXPECT_EQ(run.figures[0].rows, 12);
  EXPECT_GE(run.figures[0].fewest_rows, 11);
  expect_as_given(run.figures[0], layers);
  EXPECT_GT(least_jacobian(run.session->mesh()), 0);
}

/// Columns of elements that are cut stand by chords of twice the length, which differ at the leading edge.
TEST_P(EachElement, GrowsOnAWingRoot) {
  const bool cut = std::string(GetParam()).ends_with(".1");
  const CurveLayers layers{.curves = {5, 6}, .first = 0.001, .ratio = 1.25, .count = 12};
  const Layered run(wing(cylinder, {-0.8, -1}, {0.8, 2}, {0, 0}, {0.2, 1}), 0.03, {layers}, GetParam());
  EXPECT_EQ(run.figures[0].fewest_rows, 12);
  expect_as_given(run.figures[0], layers, cut ? 0.06 : 0.05);
  EXPECT_GT(least_jacobian(run.session->mesh()), 0);
}

/// Columns of both corners lean over wide arcs, whose edges have other lengths in the rows above. Elements that are cut begin
/// with three chords on the arc, which leave room for two rows.
TEST_P(EachElement, FillsTheCornersOfAHalfDisc) {
  const bool cut = std::string(GetParam()).ends_with(".1");
  const AnalyticCad half = plane_of({segment({-1, 0}, {1, 0}), arc({0, 0}, 1, 0, pi)});
  const CurveLayers layers{.curves = {1, 2}, .first = 0.01, .ratio = 1.2, .count = 10};
  const Layered run(half, 0.5, {layers}, GetParam());
  EXPECT_GE(run.figures[0].rows, cut ? 2 : 8);
  EXPECT_GT(least_jacobian(run.session->mesh()), 0);
}

INSTANTIATE_TEST_SUITE_P(LayerRows, EachElement, ::testing::Values("p2", "q1.0", "q1.1", "q2.0", "q2.1"), [](const auto& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
});

TEST(LayerRows, TheMeshDoesNotDependOnThreads) {
  const CurveLayers layers{.curves = {5, 6}, .first = 0.002, .ratio = 1.2, .count = 10};
  const AnalyticCad cad = wing(flat, {-1.5, -1.5}, {2.5, 1.5}, {0, 0}, {1, 1});
  const Layered one(cad, 0.08, {layers}), four(cad, 0.08, {layers}, "p1", 4);
  EXPECT_EQ(one.session->mesh().vertices, four.session->mesh().vertices);
  EXPECT_EQ(one.session->mesh().faces[0].triangles, four.session->mesh().faces[0].triangles);
}

TEST(LayerRows, UnusableLayersAreRejected) {
  Monitor monitor;
  const auto session = session_of_size(plane_of(rectangle({0, 0}, {1, 1})), 0.1, monitor);
  EXPECT_THROW(session->add_layers({.curves = {}, .first = 0.1}), InvalidArgument);
  EXPECT_THROW(session->add_layers({.curves = {1}, .first = -0.1}), InvalidArgument);
  EXPECT_THROW(session->add_layers({.curves = {1}, .first = 0.1, .ratio = 0.5}), InvalidArgument);
  EXPECT_THROW(session->add_layers({.curves = {1}, .first = 0.1, .ratio = 1.2, .count = 0}), InvalidArgument);
  session->add_layers({.curves = {1}, .first = 0.01});
  session->add_layers({.curves = {1}, .first = 0.02});
  EXPECT_THROW(session->make_mesh(), InvalidArgument);
  session->clear_layers();
  session->add_layers({.curves = {9}, .first = 0.02});
  EXPECT_THROW(session->make_mesh(), InvalidArgument);
  session->clear_layers();
  EXPECT_NO_THROW(session->make_mesh());
}

}  // namespace
}  // namespace carreau
