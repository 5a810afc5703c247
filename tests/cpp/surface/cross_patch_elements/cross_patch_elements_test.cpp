// SPDX-License-Identifier: BSD-3-Clause
// Elements of all kinds on cross-patch meshes: sound, closed, on the surface, valid, of the expected order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "euler_number.h"
#include "independent/patchworks.h"
#include "mesh/elements/cell_quality.h"
#include "mesh/elements/jacobian.h"
#include "session_of_size.h"
#include "surface/elements/cross_patch/invalid_elements.h"

namespace carreau {
namespace {

using namespace testing;
constexpr double pi = std::numbers::pi;

std::unique_ptr<Session> meshed(const AnalyticCad& cad, double size, const std::string& element, Monitor& monitor,
                                int threads = 1) {
  auto session = session_of_size(cad, size, monitor);
  session->parameters().set("patches", "independent");
  session->parameters().set("element", element);
  session->parameters().set("angle_mesh", 30.);
  session->parameters().set("threads", threads);
  session->make_mesh();
  return session;
}

/// Use(kind, positions of the nodes).
template <typename Use>
void for_elements(const SurfaceMesh& mesh, const Use& use) {
  for (const FaceMesh& face : mesh.faces)
    for (const Cell& cell : cells_of(mesh, face)) {
      std::vector<Vec3> nodes;
      for (int i = 0; i < node_count(cell.kind); ++i) {
        const auto node = static_cast<std::size_t>(cell.nodes[i]), corners = mesh.vertices.size();
        nodes.push_back(node < corners ? mesh.vertices[node] : mesh.mid_vertices[node - corners]);
      }
      use(cell.kind, nodes);
    }
}

double area_of(const SurfaceMesh& mesh) { return summarise_cells(flatten(mesh, true)).area; }

class Counting final : public Monitor {
 public:
  void checkpoint() override {
    if (++looks == stop_at) request_stop();
    Monitor::checkpoint();
  }
  long looks = 0, stop_at = -1;
};

struct Case {
  std::string element;
  bool quads, only, curved;
};
const Case cases[] = {{"p2", false, false, true},   {"q1.0", true, false, false}, {"q1.1", true, true, false},
                      {"q2.0", true, false, true}, {"q2.1", true, true, true}};

/// Sound, valid, of the requested kinds; `off`: distance of a place from the surface.
template <typename Off>
void expect_elements(const SurfaceMesh& mesh, const Case& c, bool closed, const Off& off) {
  const std::vector<std::string> defects = find_defects(mesh, {.closed = closed});
  EXPECT_TRUE(defects.empty()) << c.element << ": " << defects.front();
  double farthest = 0, least = 1, worst = 1, sum = 0;
  std::size_t triangles = 0, quads = 0;
  for_elements(mesh, [&](CellKind kind, const std::vector<Vec3>& nodes) {
    ++(corner_count(kind) == 3 ? triangles : quads);
    EXPECT_EQ(is_quadratic(kind), c.curved);
    for (const Vec3& p : nodes) farthest = std::max(farthest, off(p));
    if (kind != CellKind::triangle3) least = std::min(least, jacobian(kind, nodes).least());
    if (corner_count(kind) == 3) return;
    const double shape = cell_quality(kind, nodes).shape;
    worst = std::min(worst, shape), sum += shape;
  });
  EXPECT_LE(farthest, 1e-12) << c.element;
  EXPECT_GT(least, 0) << c.element;
  if (c.only) {
    EXPECT_EQ(triangles, 0U) << c.element;
  }
  if (!c.quads) {
    EXPECT_EQ(quads, 0U) << c.element;
    return;
  }
  EXPECT_LE(static_cast<double>(triangles), 0.1 * static_cast<double>(quads)) << c.element;
  EXPECT_GE(sum / static_cast<double>(quads), 0.75) << c.element;
  EXPECT_GE(worst, 0.15) << c.element;
}

double off_sphere(const Vec3& p) { return std::abs(norm(p) - 1); }

TEST(CrossPatchElements, SphereOfManyPatches) {
  Monitor quiet;
  const AnalyticCad cad = sphere_of_triangles(1);
  for (const Case& c : cases) {
    const auto session = meshed(cad, 0.25, c.element, quiet);
    expect_elements(session->mesh(), c, true, off_sphere);
    EXPECT_EQ(euler_number(session->mesh()), 2) << c.element;
  }
}

TEST(CrossPatchElements, CylinderOfStrips) {
  Monitor quiet;
  const AnalyticCad cad = cylinder_of_strips(24);
  for (const Case& c : cases) {
    const auto session = meshed(cad, 0.5, c.element, quiet);
    expect_elements(session->mesh(), c, false,
                    [](const Vec3& p) { return std::abs(std::hypot(p.x(), p.y()) - 1); });
    EXPECT_EQ(euler_number(session->mesh()), 0) << c.element;
    // Both rims are kept, and their nodes are in their planes.
    for (const CurveMesh& curve : session->mesh().curves) {
      if (curve.vertices.empty()) continue;
      const double z = session->mesh().vertices[curve.vertices.front()].z();
      EXPECT_TRUE(z == 0 || z == 10);
      for (const std::int32_t v : curve.vertices) EXPECT_EQ(session->mesh().vertices[v].z(), z);
      for (const std::int32_t m : curve.mid) EXPECT_EQ(session->mesh().mid_vertices[m].z(), z);
      EXPECT_EQ(curve.mid.size() + 1, c.curved ? curve.vertices.size() : 1) << c.element;
    }
  }
}

TEST(CrossPatchElements, CubeOfSquares) {
  Monitor quiet;
  for (const Case& c : cases) {
    const auto session = meshed(cube_of_squares(6), 0.1, c.element, quiet);
    expect_elements(session->mesh(), c, true, [](const Vec3& p) {
      double off = 1;
      for (int k = 0; k < 3; ++k) off = std::min({off, std::abs(p[k]), std::abs(p[k] - 1)});
      return off;
    });
    EXPECT_EQ(euler_number(session->mesh()), 2) << c.element;
    EXPECT_NEAR(area_of(session->mesh()), 6, 1e-10) << c.element;  // all twelve edges are exact
  }
}

// The error is h^2 for straight elements, h^4 for curved ones. Eight nodes do not hold all quadratic polynomials on
// quadrilaterals other than parallelograms. Pairs of any triangles (q2.0) fall short of that order; cut ones (q2.1) do not.
TEST(CrossPatchElements, AreaConvergesAsThePolynomialsPromise) {
  Monitor quiet;
  const AnalyticCad cad = sphere_of_triangles(1);
  for (const Case& c : cases) {
    const auto error = [&](double size) {
      return std::abs(area_of(meshed(cad, size, c.element, quiet)->mesh()) - 4 * pi);
    };
    const double order = std::log2(error(0.3) / error(0.15));
    EXPECT_GE(order, c.element == "q2.0" ? 2 : c.curved ? 3.5 : 1.7) << c.element;
  }
}

// Nodes lie in their reported faces.
TEST(CrossPatchElements, NodesKnowTheirPlacesOnTheSurface) {
  Monitor quiet;
  AnalyticCad cad = sphere_of_triangles(1);
  for (const Case& c : cases) {
    const auto session = meshed(cad, 0.25, c.element, quiet);
    const SurfaceMesh& mesh = session->mesh();
    bool several = false;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const FaceMesh& face = mesh.faces[f];
      const auto corners = face.uv.size();
      for (std::size_t k = 0; k < corners + face.mid_uv.size(); ++k) {
        const std::size_t of = session->uv_face(f, static_cast<std::int32_t>(k));
        several = several || (k >= corners && of != f);
        const Vec2 uv = k < corners ? face.uv[k] : face.mid_uv[k - corners];
        const Vec3 p = k < corners ? mesh.vertices[face.vertex[k]] : mesh.mid_vertices[face.mid_vertex[k - corners]];
        EXPECT_LE(norm(surface_at(cad, mesh.faces[of].ref, want_position, uv).s - p), 1e-12) << c.element;
      }
    }
    EXPECT_EQ(several, c.curved) << c.element;
  }
}

TEST(CrossPatchElements, MeasuresAreOfTheElements) {
  Monitor quiet;
  for (const Case& c : cases) {
    const auto session = meshed(sphere_of_triangles(1), 0.25, c.element, quiet);
    const MeshEvaluation& d = session->delivered();
    double deviation = 0;
    for (const double each : d[EvaluationKind::deviation].values) deviation = std::max(deviation, each);
    EXPECT_GT(deviation, 0) << c.element;
    // Below a square of 1.75 sizes the sphere is half the square of its half diagonal away.
    EXPECT_LE(deviation, c.curved ? 0.003 : 0.05) << c.element;
    for (const double angle : d[EvaluationKind::angle].values) EXPECT_LE(angle, c.curved ? 5 : 25) << c.element;
  }
}

TEST(CrossPatchElements, MeshDoesNotDependOnThreads) {
  Monitor quiet;
  for (const Case& c : cases) {
    const FlatMesh one = meshed(sphere_of_triangles(1), 0.3, c.element, quiet)->exported();
    const FlatMesh other = meshed(sphere_of_triangles(1), 0.3, c.element, quiet, 8)->exported();
    EXPECT_TRUE(one.cells == other.cells) << c.element;
    EXPECT_TRUE(one.vertices == other.vertices) << c.element;
  }
}

TEST(CrossPatchElements, StopAnywhereOnRequestAndLeaveNothing) {
  const AnalyticCad cad = sphere_of_triangles(1);
  Counting all;
  (void)meshed(cad, 0.3, "q2.1", all);
  ASSERT_GT(all.looks, 20);
  for (int k = 1; k <= 10; ++k) {
    Counting monitor;
    auto session = session_of_size(cad, 0.3, monitor);
    session->parameters().set("patches", "independent");
    session->parameters().set("element", std::string("q2.1"));
    session->parameters().set("angle_mesh", 30.);
    session->parameters().set("threads", 1);
    monitor.stop_at = all.looks * k / 10;
    EXPECT_THROW(session->make_mesh(), Cancelled) << k;
    EXPECT_FALSE(session->has_mesh()) << k;
  }
}

// Three faces of one triangle; two of them have the same corners.
TEST(CrossPatchElements, FacesWithWrongJointsFail) {
  SizedMesh made;
  made.mesh.independent = true;
  made.mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
  made.mesh.vertex_ref.assign(6, 0);
  for (int ref = 1; ref <= 3; ++ref) {
    const std::int32_t first = ref == 2 ? 3 : 0;
    FaceMesh& face = made.mesh.faces.emplace_back();
    face.ref = ref, face.status = FaceStatus::meshed;
    face.uv = {{0, 0}, {1, 0}, {0, 1}}, face.vertex = {first, first + 1, first + 2}, face.triangles = {{0, 1, 2}};
    made.feet.push_back({0, 0, 0});
  }
  made.mesh.curves = {{1, {0, 1, 2, 0}, {{0, false}, {2, false}}}, {2, {3, 4, 5, 3}, {{1, false}}}};
  fail_wrong_joints(made);
  for (const FaceMesh& face : made.mesh.faces) {
    EXPECT_EQ(face.status, face.ref == 2 ? FaceStatus::meshed : FaceStatus::failed) << face.ref;
    EXPECT_EQ(face.triangles.size(), face.ref == 2 ? 1U : 0U);
    EXPECT_EQ(face.why.find("face " + std::to_string(face.ref)) != std::string::npos, face.ref != 2) << face.why;
  }
  EXPECT_TRUE(find_wrong_joints(made.mesh).empty());
}

}  // namespace
}  // namespace carreau
