// SPDX-License-Identifier: BSD-3-Clause
// Meshes of quadrilaterals, from a model to the result.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <set>

#include "common/analytic_cad.h"
#include "session/session.h"
#include "session_of_size.h"
#include "surface/elements/quads/quad_shape.h"

namespace carreau {
namespace {

using testing::AnalyticCad;

SurfaceJet plane_jet(Vec2 p) {
  SurfaceJet jet;
  jet.s = {p.x(), p.y(), 0}, jet.su = {1, 0, 0}, jet.sv = {0, 1, 0};
  return jet;
}

/// The unit square without the disc of centre (1, 1) and radius 1/2 (HDR fig. 3.6).
AnalyticCad plate() {
  using namespace testing;
  AnalyticCad cad;
  cad.faces[1] = {plane_jet,
                  {segment({0, 0}, {1, 0}), segment({1, 0}, {1, 0.5}),
                   arc({1, 1}, 0.5, 1.5 * std::numbers::pi, std::numbers::pi), segment({0.5, 1}, {0, 1}),
                   segment({0, 1}, {0, 0})}};
  return cad;
}

struct Figures {
  std::size_t quads = 0, triangles = 0;
  double area = 0, triangle_area = 0, mean = 0, worst = 1, jacobian = 1;
};

Figures figures_of(const SurfaceMesh& mesh) {
  Figures f;
  for (const FaceMesh& face : mesh.faces)
    for (const Cell& cell : cells_of(mesh, face)) {
      const auto at = [&](int k) -> const Vec3& { return mesh.vertices[cell.nodes[k]]; };
      const double half = norm(cross(at(1) - at(0), at(2) - at(0))) / 2;
      if (cell.kind == CellKind::triangle3) {
        ++f.triangles, f.area += half, f.triangle_area += half;
        continue;
      }
      const std::array<Vec3, 4> p{at(0), at(1), at(2), at(3)};
      f.area += half + norm(cross(p[2] - p[0], p[3] - p[0])) / 2;
      const double q = quad_quality(p);
      ++f.quads, f.mean += q, f.worst = std::min(f.worst, q), f.jacobian = std::min(f.jacobian, scaled_jacobian(p));
    }
  f.mean /= static_cast<double>(f.quads);
  return f;
}

long euler(const SurfaceMesh& mesh) {
  std::set<std::array<std::int32_t, 2>> edges;
  long cells = 0;
  for (const FaceMesh& face : mesh.faces)
    for (const Cell& cell : cells_of(mesh, face)) {
      ++cells;
      const int n = corner_count(cell.kind);
      for (int k = 0; k < n; ++k) {
        const std::int32_t a = cell.nodes[k], b = cell.nodes[(k + 1) % n];
        edges.insert({std::min(a, b), std::max(a, b)});
      }
    }
  return static_cast<long>(mesh.vertices.size()) - static_cast<long>(edges.size()) + cells;
}

SurfaceMesh mesh_of(const AnalyticCad& cad, double size, const std::string& element, int threads = 1) {
  Monitor monitor;
  const std::unique_ptr<Session> session = testing::session_of_size(cad, size, monitor);
  session->parameters().set("element", element);
  session->parameters().set("threads", threads);
  session->make_mesh();
  for (const std::string& defect : find_defects(session->mesh())) ADD_FAILURE() << element << ": " << defect;
  return session->mesh();
}

double distance_from(const AnalyticCad& cad, const SurfaceMesh& mesh) {
  double most = 0;
  for (const FaceMesh& face : mesh.faces)
    for (std::size_t v = 0; v < face.uv.size(); ++v)
      most = std::max(most, norm(cad.faces.at(face.ref).at(face.uv[v]).s - mesh.vertices[face.vertex[v]]));
  return most;
}

TEST(Quadrilaterals, ThePlateHasGoodShapes) {
  for (const double h : {0.1, 0.05, 0.02})
    for (const std::string element : {"q1.0", "q1.1"}) {
      const SurfaceMesh mesh = mesh_of(plate(), h, element);
      const Figures f = figures_of(mesh);
      EXPECT_GE(f.mean, 0.85) << element << " " << h;
      EXPECT_GE(f.worst, 0.35) << element << " " << h;
      EXPECT_GT(f.jacobian, 0) << element << " " << h;
      EXPECT_LE(f.triangle_area, 0.05 * f.area) << element << " " << h;
      if (element == "q1.1") {
        EXPECT_EQ(f.triangles, 0U);
      }
      EXPECT_EQ(euler(mesh), 1);
      const double exact = 1 - std::numbers::pi / 16;
      // Chords of length h cut a segment of area h^3 / (12 r) off the arc of length pi r / 2.
      EXPECT_NEAR(f.area, exact, 1.2 * std::numbers::pi / 24 * h * h) << element << " " << h;
      const auto wanted = exact / (h * h);
      EXPECT_NEAR(static_cast<double>(f.quads) + 0.5 * static_cast<double>(f.triangles), wanted, 0.35 * wanted)
          << element << " " << h;
    }
}

// The polygon inside the arc: errors of its area fall by four when h is halved.
TEST(Quadrilaterals, AreaConvergesWithOrderTwo) {
  for (const std::string element : {"q1.0", "q1.1"}) {
    const double exact = 1 - std::numbers::pi / 16;
    const double coarse = figures_of(mesh_of(plate(), 0.1, element)).area - exact,
                 fine = figures_of(mesh_of(plate(), 0.025, element)).area - exact;
    EXPECT_NEAR(coarse / fine, 16, 5) << element;
  }
}

TEST(Quadrilaterals, LieOnCurvedSurfaces) {
  for (const AnalyticCad& cad : {testing::hemisphere(), testing::torus_patch(), testing::paraboloid()})
    for (const std::string element : {"q1.0", "q1.1"}) {
      const SurfaceMesh mesh = mesh_of(cad, 0.1, element);
      const Figures f = figures_of(mesh);
      EXPECT_LT(distance_from(cad, mesh), 1e-9) << element;
      EXPECT_GT(f.jacobian, 0) << element;
      EXPECT_GE(f.mean, 0.8) << element;
      EXPECT_LE(f.triangle_area, 0.05 * f.area) << element;
      EXPECT_EQ(euler(mesh), 1) << element;
      if (element == "q1.1") {
        EXPECT_EQ(f.triangles, 0U);
      }
    }
}

// Right angles must not be bought by long rectangles beside them: where angles alone decide, .004 to .17.
/// The longest edge of a helical ribbon of radius 3, meshed by quadrilaterals. Its lines of v lean by `shear`, its ends do not.
double longest_on_ribbon(double turns, double width, const char* element, double size = 0.7, double shear = 0) {
  const auto ribbon = [width, shear](Vec2 p) {
    const double angle = p.x() + shear * p.y(), c = std::cos(angle), s = std::sin(angle);
    SurfaceJet jet;
    jet.s = {3 * c, 3 * s, 0.16 * angle + width * p.y()}, jet.su = {-3 * s, 3 * c, 0.16}, jet.sv = shear * jet.su + Vec3(0, 0, width);
    jet.suu = {-3 * c, -3 * s, 0}, jet.suv = shear * jet.suu, jet.svv = shear * jet.suv;
    return jet;
  };
  AnalyticCad cad;
  const std::array<Vec2, 4> corners{{{0, 0}, {2 * turns * std::numbers::pi, 0}, {2 * turns * std::numbers::pi - shear, 1}, {-shear, 1}}};
  cad.faces[1] = {ribbon, {}};
  for (std::size_t k = 0; k < 4; ++k) cad.faces[1].curves.push_back(testing::segment(corners[k], corners[(k + 1) % 4]));
  const SurfaceMesh mesh = mesh_of(cad, size, element);
  EXPECT_EQ(euler(mesh), 1);
  double longest = 0;
  for (const Cell& cell : cells_of(mesh, mesh.faces[0]))
    for (int k = 0, n = corner_count(cell.kind); k < n; ++k)
      longest = std::max(longest, norm(mesh.vertices[cell.nodes[(k + 1) % n]] - mesh.vertices[cell.nodes[k]]));
  return longest;
}

TEST(Quadrilaterals, ARibbonHasNoLongOnes) {
  EXPECT_LT(longest_on_ribbon(9, 1.2, "q1.0"), 2 * 0.7);  // 170 long: one row of squares fits
  for (const char* element : {"q1.0", "q1.1"})
    for (const double turns : {0.5, 1., 9.}) EXPECT_LT(longest_on_ribbon(turns, 0.05, element), 2 * 0.7) << element << ", " << turns << " turns";
}

// Edges across the ribbon follow the lines of v until they are Delaunay in the metric: 7 long, but no vertex has a large fan.
TEST(Quadrilaterals, ALeaningRibbonHasNoLongOnes) {
  for (const double shear : {1., 2.}) EXPECT_LT(longest_on_ribbon(0.5, 0.05, "q1.0", 2, shear), 1.5 * 2) << shear;
}

TEST(Quadrilaterals, TheTeapotHasNoLongOnes) {
  for (const double h : {0.3, 0.2, 0.15, 0.1, 0.08})
    EXPECT_GE(figures_of(mesh_of(testing::teapot(), h, "q1.1")).worst, 0.2) << h;
}

TEST(Quadrilaterals, TheTeapotKeepsItsTopology) {
  const long expected = euler(mesh_of(testing::teapot(), 0.2, "p1"));
  for (const std::string element : {"q1.0", "q1.1"}) {
    const SurfaceMesh mesh = mesh_of(testing::teapot(), 0.2, element);
    EXPECT_EQ(euler(mesh), expected) << element;
    EXPECT_GT(figures_of(mesh).jacobian, 0) << element;
  }
}

TEST(Quadrilaterals, AreTheSameForAnyNumberOfThreads) {
  for (const std::string element : {"q1.0", "q1.1"}) {
    const SurfaceMesh one = mesh_of(testing::teapot(), 0.3, element);
    for (const int threads : {2, 8}) {
      const SurfaceMesh more = mesh_of(testing::teapot(), 0.3, element, threads);
      EXPECT_EQ(one.vertices, more.vertices);
      for (std::size_t f = 0; f < one.faces.size(); ++f) EXPECT_EQ(one.faces[f].triangles, more.faces[f].triangles);
    }
  }
}

/// Long along x, five times as long as across.
class Stretched final : public PrescriptionSource {
 public:
  [[nodiscard]] bool needs_position() const noexcept override { return false; }
  Prescription on_surface(int, Vec2, Vec3) override { return answer(); }
  Prescription on_curve(int, int, double, Vec2, Vec3) override { return answer(); }
  Prescription at_point(int, Vec3) override { return answer(); }

 private:
  static Prescription answer() {
    Metric3 m;
    m.xx = 1 / (0.1 * 0.1), m.yy = m.zz = 1 / (0.02 * 0.02);
    return Prescription::of_space(m);
  }
};

TEST(Quadrilaterals, FollowAnAnisotropicMetric) {
  for (const std::string element : {"q1.0", "q1.1"}) {
    Monitor monitor;
    const AnalyticCad cad = plate();
    const std::unique_ptr<Session> session = testing::session_of_size(cad, 0.05, monitor);
    session->parameters().set("element", element);
    session->set_metric_callbacks(std::make_shared<Stretched>());
    session->make_mesh();
    SurfaceMesh mesh = session->mesh();
    for (Vec3& p : mesh.vertices) p = {p.x() / 0.1, p.y() / 0.02, 0};
    const Figures f = figures_of(mesh);
    EXPECT_GE(f.mean, 0.8) << element;
    EXPECT_GT(f.jacobian, 0) << element;
    EXPECT_LE(f.triangle_area, 0.05 * f.area) << element;
    EXPECT_NEAR(static_cast<double>(f.quads), f.area, 0.35 * f.area) << element;
  }
}

/// Counts looks at the stop flag.
class Counting final : public Monitor {
 public:
  void checkpoint() override {
    if (++looks == stop_at) request_stop();
    Monitor::checkpoint();
  }
  long looks = 0, stop_at = -1;
};

TEST(Quadrilaterals, StopAnywhereOnRequest) {
  const AnalyticCad cad = testing::torus_patch();
  Counting all;
  const auto session = [&](Monitor& monitor) {
    auto made = testing::session_of_size(cad, 0.1, monitor);
    made->parameters().set("element", std::string("q1.1"));
    made->parameters().set("threads", 1);
    return made;
  };
  session(all)->make_mesh();
  ASSERT_GT(all.looks, 20);
  for (int k = 1; k <= 10; ++k) {
    Counting monitor;
    monitor.stop_at = all.looks * k / 10;
    EXPECT_THROW(session(monitor)->make_mesh(), Cancelled) << k;
    EXPECT_EQ(monitor.looks, monitor.stop_at);
  }
}

}  // namespace
}  // namespace carreau
