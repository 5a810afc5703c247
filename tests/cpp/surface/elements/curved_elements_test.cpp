// SPDX-License-Identifier: BSD-3-Clause
// Elements of second order: on the surface, shared, valid, and of the order that they promise.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "mesh/elements/cell_quality.h"
#include "mesh/elements/jacobian.h"
#include "session_of_size.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
constexpr double pi = std::numbers::pi;

SurfaceJet plane_jet(Vec2 p) { return {{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; }

AnalyticCad square() {
  AnalyticCad cad;
  cad.faces[1] = {plane_jet, testing::rectangle({0, 0}, {1, 1})};
  return cad;
}

/// [0, 1]^2 without the disc of centre (1, 1) and radius 1/2 (HDR fig. 3.6): area 1 - pi / 16.
AnalyticCad quarter_plate() {
  AnalyticCad cad;
  using testing::segment;
  cad.faces[1] = {plane_jet,
                  {segment({0, 0}, {1, 0}), segment({1, 0}, {1, 0.5}), testing::arc({1, 1}, 0.5, 1.5 * pi, pi),
                   segment({0.5, 1}, {0, 1}), segment({0, 1}, {0, 0})}};
  return cad;
}

/// A square of side 2 about a round hole.
AnalyticCad plate_with_hole(double radius) {
  AnalyticCad cad;
  std::vector<testing::AnalyticCurve> curves = testing::rectangle({-1, -1}, {1, 1});
  curves.push_back(testing::arc({0, 0}, radius, 2 * pi, pi));
  curves.push_back(testing::arc({0, 0}, radius, pi, 0));
  cad.faces[1] = {plane_jet, curves};
  return cad;
}

struct Curved {
  AnalyticCad cad;
  Monitor monitor;
  std::unique_ptr<Session> session;

  Curved(const AnalyticCad& geometry, double size, const std::string& element, double angle = 30) : cad(geometry) {
    session = testing::session_of_size(geometry, size, monitor);
    session->parameters().set("element", element);
    session->parameters().set("angle_mesh", angle);
    session->make_mesh();
  }
  [[nodiscard]] const SurfaceMesh& mesh() const { return session->mesh(); }
  [[nodiscard]] FlatMesh flat() const { return flatten(mesh(), true); }
  [[nodiscard]] double area() const { return summarise_cells(flat()).area; }
};

/// Largest difference between a function of space and its interpolation, over all elements; exact points of the surface
/// are at (u, v) interpolated in the same way.
double interpolation_error(const Curved& run, const std::function<double(const Vec3&)>& field) {
  double worst = 0;
  for (const FaceMesh& face : run.mesh().faces)
    for (const Cell& cell : local_cells(face)) {
      const auto n = static_cast<std::size_t>(node_count(cell.kind));
      const auto corners = static_cast<std::int32_t>(face.uv.size());
      std::vector<Vec3> uv, values;
      for (std::size_t i = 0; i < n; ++i) {
        const std::int32_t node = cell.nodes[i];
        const Vec2 p = node < corners ? face.uv[node] : face.mid_uv[node - corners];
        const Vec3 xyz = node < corners ? run.mesh().vertices[face.vertex[node]]
                                        : run.mesh().mid_vertices[face.mid_vertex[node - corners]];
        uv.push_back({p.x(), p.y(), 0});
        values.push_back({field(xyz), 0, 0});
      }
      for (double s = 0.1; s < 1; s += 0.2)
        for (double t = 0.1; s + t < 1; t += 0.2) {
          const Vec3 p = point_of_cell(cell.kind, uv, s, t);
          const Vec3 exact = run.cad.faces.at(face.ref).at({p.x(), p.y()}).s;
          worst = std::max(worst, std::abs(field(exact) - point_of_cell(cell.kind, values, s, t).x()));
        }
    }
  return worst;
}

TEST(CurvedElements, AQuadraticFieldIsExactOnAPlaneMesh) {
  const Curved run(square(), 0.1, "p2");
  EXPECT_EQ(find_defects(run.mesh()), std::vector<std::string>{});
  const auto field = [](const Vec3& p) {
    return 1 + p.x() - 2 * p.y() + 3 * p.x() * p.x() - p.x() * p.y() + 2 * p.y() * p.y();
  };
  EXPECT_LT(interpolation_error(run, field), 1e-13);
  EXPECT_GT(interpolation_error(Curved(square(), 0.1, "p1"), field), 1e-3);
}

TEST(CurvedElements, HaveNoSearchForCrossings) {
  // Crossings of the preceding straight triangles are known if crossing_rounds is positive.
  const auto crossings = [](const char* element) {
    Monitor monitor;
    const AnalyticCad cad = square();
    const std::unique_ptr<Session> session = testing::session_of_size(cad, 0.25, monitor);
    session->parameters().set("element", element);
    session->parameters().set("crossing_rounds", 2);
    session->make_mesh();
    return session->report().crossings;
  };
  EXPECT_EQ(crossings("p1"), 0);
  for (const char* element : {"p2", "q1.0", "q1.1", "q2.0"}) EXPECT_EQ(crossings(element), -1) << element;
}

TEST(CurvedElements, TheAreaOfTheQuarterPlateIsOfOrderFour) {
  const double exact = 1 - pi / 16;
  const auto error = [&](double h, const char* element) {
    return std::abs(Curved(quarter_plate(), h, element).area() - exact);
  };
  // The arc has 2, 4, 8 and 16 edges or so; three halvings.
  EXPECT_NEAR(std::log2(error(0.2, "p2") / error(0.025, "p2")) / 3, 4, 0.3);
  EXPECT_NEAR(std::log2(error(0.2, "p1") / error(0.025, "p1")) / 3, 2, 0.3);
  EXPECT_LT(error(0.1, "p2"), error(0.1, "p1") / 200);
}

TEST(CurvedElements, NodesLieOnTheSurfaceAndFacesShareThem) {
  for (const AnalyticCad& cad : {testing::hemisphere(), testing::torus_patch(), testing::teapot()}) {
    const Curved run(cad, 0.25, "p2");
    EXPECT_EQ(find_defects(run.mesh()), std::vector<std::string>{});
    double off = 0;
    for (const FaceMesh& face : run.mesh().faces)
      for (std::size_t m = 0; m < face.mid_uv.size(); ++m)
        off = std::max(off, norm(cad.faces.at(face.ref).at(face.mid_uv[m]).s -
                                 run.mesh().mid_vertices[face.mid_vertex[m]]));
    EXPECT_LT(off, 2e-3 * 0.25);  // curves of two faces: the tolerance of carrying them
    for (const CurveMesh& curve : run.mesh().curves)
      EXPECT_EQ(curve.mid.size() + 1, std::max<std::size_t>(curve.vertices.size(), 1));
  }
}

// Nodes of a face without neighbours are exact.
TEST(CurvedElements, NodesOfOneFaceAreExact) {
  const Curved run(testing::hemisphere(), 0.2, "p2");
  for (const Vec3& p : run.mesh().mid_vertices) EXPECT_NEAR(norm(p), 1, 1e-14);
}

TEST(CurvedElements, InterpolationIsOfOrderThree) {
  const auto field = [](const Vec3& p) { return std::sin(2 * p.x() + p.y()) * std::exp(p.z()); };
  for (const AnalyticCad& cad : {testing::hemisphere(), testing::torus_patch()}) {
    const auto error = [&](double h, const char* element) {
      return interpolation_error(Curved(cad, h, element), field);
    };
    EXPECT_NEAR(std::log2(error(0.2, "p2") / error(0.05, "p2")) / 2, 3, 0.35);
    EXPECT_NEAR(std::log2(error(0.2, "p1") / error(0.05, "p1")) / 2, 2, 0.35);
  }
}

TEST(CurvedElements, TheMeshOfStraightTrianglesMatchesP1) {
  const Curved straight(testing::torus_patch(), 0.2, "p1"), curved(testing::torus_patch(), 0.2, "p2");
  EXPECT_EQ(straight.mesh().vertices, curved.mesh().vertices);
  ASSERT_EQ(straight.mesh().faces.size(), curved.mesh().faces.size());
  EXPECT_EQ(straight.mesh().faces[0].triangles, curved.mesh().faces[0].triangles);
  EXPECT_TRUE(straight.mesh().mid_vertices.empty());
}

// HDR fig. 3.6.
TEST(CurvedElements, TheSixKindsOfTheQuarterPlate) {
  const double exact = 1 - pi / 16;
  for (const std::string element : {"p1", "p2", "q1.0", "q1.1", "q2.0", "q2.1"}) {
    const auto error = [&](double h) { return std::abs(Curved(quarter_plate(), h, element).area() - exact); };
    const bool curved = element[0] == 'q' ? element[1] == '2' : element == "p2", quads = element[0] == 'q';
    // Numbers of edges of the arc are not multiples: orders over three halvings.
    EXPECT_NEAR(std::log2(error(0.2) / error(0.025)) / 3, curved ? 4 : 2, 0.4) << element;
    const Curved run(quarter_plate(), 0.05, element);
    EXPECT_EQ(find_defects(run.mesh()), std::vector<std::string>{}) << element;
    const CellSummary summary = summarise_cells(run.flat());
    EXPECT_EQ(summary.invalid, 0U) << element;
    EXPECT_GE(summary.shape.mean, 0.85) << element;
    EXPECT_GE(summary.shape.min, 0.35) << element;
    if (!quads) continue;
    if (element.ends_with(".1")) {
      EXPECT_EQ(summary.triangles3 + summary.triangles6, 0U) << element;
    }
    EXPECT_LE(summary.triangle_share, 0.05) << element;
  }
}

TEST(CurvedElements, CurvedQuadrilateralsLieOnSurfaces) {
  for (const AnalyticCad& cad : {testing::hemisphere(), testing::torus_patch(), testing::teapot()})
    for (const char* element : {"q2.0", "q2.1"}) {
      const Curved run(cad, 0.2, element);
      EXPECT_EQ(find_defects(run.mesh()), std::vector<std::string>{}) << element;
      EXPECT_EQ(summarise_cells(run.flat()).invalid, 0U) << element;
    }
}

// Measured with the element's own map, A0 is of a higher order.
TEST(CurvedElements, MeasuresAreOfTheCurvedElement) {
  const auto deviation = [](double h, const char* element) {
    Curved run(testing::hemisphere(), h, element);
    return run.session->delivered()[EvaluationKind::deviation].spread;
  };
  // The sagitta of a chord of length l is l^2 / 8, times 4 / 3 in the middle of an equilateral triangle.
  EXPECT_NEAR(deviation(0.1, "p1").mean, 0.1 * 0.1 / 6, 0.1 * 0.01 / 6);
  EXPECT_LT(deviation(0.1, "p2").max, deviation(0.1, "p1").max / 100);
  EXPECT_GT(std::log2(deviation(0.2, "p2").max / deviation(0.05, "p2").max) / 2, 2.6);
  // Eight nodes have no third order on quadrilaterals that are no parallelograms: in the mean only.
  EXPECT_GT(std::log2(deviation(0.2, "q2.0").mean / deviation(0.05, "q2.0").mean) / 2, 2.6);
  EXPECT_LT(deviation(0.1, "q2.0").max, deviation(0.1, "q1.0").max / 15);
  EXPECT_NEAR(std::log2(deviation(0.2, "q1.0").max / deviation(0.05, "q1.0").max) / 2, 2, 0.4);
}

// HDR sec. 5.2: an inner edge of a triangle that the curved border crosses.
TEST(CurvedElements, InnerEdgesBendBeforeACurvedBorder) {
  for (const double radius : {0.3, 0.6, 0.9, 0.98})
    for (const double size : {0.4, 0.8, 2.0}) {
      const Curved run(plate_with_hole(radius), size, "p2", 89);
      EXPECT_EQ(find_defects(run.mesh()), std::vector<std::string>{}) << radius << " " << size;
      const double exact = 4 - pi * radius * radius;
      EXPECT_NEAR(run.area(), exact, 0.05 * exact) << radius << " " << size;
    }
}

// Some elements of the coarse teapot are invalid without finer meshes.
TEST(CurvedElements, WithoutEffortAreMadeOfTheFirstMesh) {
  const auto vertices = [](const char* element, int effort) {
    Monitor monitor;
    const AnalyticCad cad = testing::teapot();
    const std::unique_ptr<Session> session = testing::session_of_size(cad, 0.6, monitor);
    session->parameters().set("element", element);
    session->parameters().set("effort", effort);
    session->make_mesh();
    return session->mesh().vertices.size();
  };
  EXPECT_EQ(vertices("p2", 0), vertices("p1", 0));  // a mender moves vertices, and makes none
  EXPECT_GT(vertices("p2", 1), vertices("p2", 0));
}

// Below y = (x^2 + x^3) / 2: the parabola through the middle of the first edge leaves the corner below the axis.
TEST(CurvedElements, AreValidAtACusp) {
  AnalyticCad horn;
  const testing::AnalyticCurve upper{{0, 1}, [](double t) {
                                       const double x = 1 - t;
                                       return CurveJet{{x, x * x * (1 + x) / 2}, {-1, -x - 1.5 * x * x}, {0, 1 + 3 * x}};
                                     }};
  horn.faces[1] = {plane_jet, {testing::segment({0, 0}, {1, 0}), testing::segment({1, 0}, {1, 1}), upper}};
  for (const char* element : {"p2", "q2.0", "q2.1"})
    for (const double size : {0.2, 0.1, 0.05}) {
      const Curved run(horn, size, element);
      EXPECT_EQ(find_defects(run.mesh()), std::vector<std::string>{}) << element << " of size " << size;
      EXPECT_NEAR(run.area(), 7. / 24, 1e-4) << element << " of size " << size;
      EXPECT_LT(run.mesh().triangle_count(), 4 * 7. / 24 / (size * size) + 100) << "divided for it";
    }
}

TEST(CurvedElements, PolesAndSeamsHaveOneNodeAnEdge) {
  // A sphere by latitude and longitude: two poles, one seam.
  AnalyticCad cad;
  const auto jet = [](Vec2 p) {
    const double cu = std::cos(p.x()), su = std::sin(p.x()), cv = std::cos(p.y()), sv = std::sin(p.y());
    return SurfaceJet{{cv * cu, cv * su, sv},   {-cv * su, cv * cu, 0},  {-sv * cu, -sv * su, cv},
                      {-cv * cu, -cv * su, 0}, {sv * su, -sv * cu, 0}, {-cv * cu, -cv * su, -sv}};
  };
  cad.faces[1] = {jet, testing::rectangle({0, -pi / 2}, {2 * pi, pi / 2})};
  const Curved run(cad, 0.3, "p2");
  EXPECT_EQ(find_defects(run.mesh(), {.closed = true}), std::vector<std::string>{});
  for (const Vec3& p : run.mesh().mid_vertices) EXPECT_NEAR(norm(p), 1, 1e-12);
  EXPECT_NEAR(run.area(), 4 * pi, 1e-3 * 4 * pi);
}

// Sizes at which a lip of the spout turns by half a circle within one edge, and the rim of the lid is one element wide.
TEST(CurvedElements, NoneOfTheTeapotIsInvalid) {
  for (const char* element : {"q2.0", "q2.1"})
    for (const double h : {0.4, 0.3, 0.2}) {
      const Curved run(testing::teapot(), h, element);
      std::size_t invalid = 0;
      for (const std::string& defect : find_defects(run.mesh()))
        if (defect.find("Jacobian") != std::string::npos) ++invalid;
      EXPECT_EQ(invalid, 0U) << element << " of size " << h;
      for (const FaceMesh& face : run.mesh().faces) EXPECT_EQ(face.why.find("Jacobian"), std::string::npos) << face.why;
    }
}

// Corners between two edges of one circle have 180 degrees, whatever their chords: no element may have one.
TEST(CurvedElements, NoQuadrilateralHasTwoSidesOnOneCircle) {
  AnalyticCad disc;
  disc.faces[1] = {plane_jet, {testing::arc({0, 0}, 1, 0, pi), testing::arc({0, 0}, 1, pi, 2 * pi)}};
  for (const char* element : {"q1.0", "q1.1", "q2.0", "q2.1"})
    for (const double h : {0.5, 0.3, 0.1}) {
      const Curved run(disc, h, element);
      EXPECT_EQ(find_defects(run.mesh()), std::vector<std::string>{}) << element << " of size " << h;
      std::set<std::pair<std::int32_t, std::int32_t>> on_circle;
      for (const CurveMesh& curve : run.mesh().curves)
        for (std::size_t k = 1; k < curve.vertices.size(); ++k)
          on_circle.insert(std::minmax(curve.vertices[k - 1], curve.vertices[k]));
      int flat = 0;
      for (const Cell& cell : cells_of(run.mesh(), run.mesh().faces[0])) {
        const int n = corner_count(cell.kind);
        for (int i = 0; n == 4 && i < n; ++i)
          if (on_circle.contains(std::minmax(cell.nodes[i], cell.nodes[(i + 1) % n])) &&
              on_circle.contains(std::minmax(cell.nodes[(i + 1) % n], cell.nodes[(i + 2) % n])))
            ++flat;
      }
      EXPECT_EQ(flat, 0) << element << " of size " << h;
    }
}

}  // namespace
}  // namespace carreau
