// SPDX-License-Identifier: BSD-3-Clause
// Fields from mesh to mesh where elements are of second order: exactness and orders.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "adapt/transfer.h"
#include "mesh/elements/over_nodes.h"
#include "session_of_size.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
using Field = std::function<double(const Vec3&)>;

AnalyticCad unit_square() {
  AnalyticCad cad;
  const auto jet = [](Vec2 p) -> SurfaceJet { return {{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; };
  cad.faces[1] = {jet, testing::rectangle({0, 0}, {1, 1})};
  return cad;
}

SurfaceMesh mesh_of(const AnalyticCad& cad, double size, const char* element) {
  Monitor monitor;
  const std::unique_ptr<Session> session = testing::session_of_size(cad, size, monitor);
  session->parameters().set("element", element);
  session->make_mesh();
  return session->mesh();
}

std::vector<double> at_vertices(const SurfaceMesh& mesh, const Field& f) {
  std::vector<double> values;
  for (const Vec3& p : mesh.vertices) values.push_back(f(p));
  return values;
}

std::vector<double> at_nodes(const SurfaceMesh& mesh, const Field& f) {
  std::vector<double> values = at_vertices(mesh, f);
  for (const Vec3& p : mesh.mid_vertices) values.push_back(f(p));
  return values;
}

double largest_difference(const std::vector<double>& p, const std::vector<double>& q) {
  EXPECT_EQ(p.size(), q.size());
  double largest = 0;
  for (std::size_t i = 0; i < std::min(p.size(), q.size()); ++i) largest = std::max(largest, std::abs(p[i] - q[i]));
  return largest;
}

/// The mesh with faces that another mesh does not know: fields are looked up in space.
SurfaceMesh renamed(SurfaceMesh mesh) {
  for (FaceMesh& face : mesh.faces) face.ref += 100;
  return mesh;
}

TEST(CurvedTransfer, IsExactForQuadraticsInAPlane) {
  const Field f = [](const Vec3& p) { return 1 + 2 * p.x() - p.y() + 3 * p.x() * p.x() - p.x() * p.y() + 5 * p.y() * p.y(); };
  const SurfaceMesh from = mesh_of(unit_square(), 0.2, "p2");
  for (const char* element : {"p1", "p2", "q2.0"}) {
    const SurfaceMesh to = mesh_of(unit_square(), 0.13, element);
    for (const SurfaceMesh& one : {to, renamed(to)}) {
      const TransferredField moved = transfer_field(from, one, at_nodes(from, f), 1);
      EXPECT_EQ(moved.outside, 0);
      EXPECT_LT(largest_difference(moved.values, at_nodes(one, f)), 1e-12) << element;
    }
  }
}

TEST(CurvedTransfer, ComponentsStayTogetherAndQuadrilateralsAreExactForLinearFields) {
  const Field f = [](const Vec3& p) { return 3 * p.x() - p.y(); }, g = [](const Vec3& p) { return 7 + p.y(); };
  for (const char* element : {"q2.0", "q2.1"}) {
    const SurfaceMesh from = mesh_of(unit_square(), 0.2, element), to = mesh_of(unit_square(), 0.13, "p2");
    std::vector<double> both, expected;
    for (const SurfaceMesh* mesh : {&from, &to}) {
      const std::vector<double> p = at_nodes(*mesh, f), q = at_nodes(*mesh, g);
      for (std::size_t i = 0; i < p.size(); ++i) (mesh == &from ? both : expected).insert((mesh == &from ? both : expected).end(), {p[i], q[i]});
    }
    EXPECT_LT(largest_difference(transfer_field(from, to, both, 2).values, expected), 1e-12) << element;
  }
}

// Over all nodes the straight mesh has the same area, each node as a vertex, and no defect.
TEST(CurvedTransfer, StraightTrianglesOverAllNodesCoverTheMesh) {
  for (const char* element : {"p2", "q2.0", "q2.1"}) {
    const SurfaceMesh mesh = mesh_of(unit_square(), 0.2, element), straight = straight_over_nodes(mesh);
    EXPECT_EQ(find_defects(straight), std::vector<std::string>{}) << element;
    EXPECT_EQ(straight.vertices.size(), node_count(mesh));
    EXPECT_TRUE(straight.mid_vertices.empty());
    EXPECT_FALSE(straight.cells_are_not_triangles());
    EXPECT_EQ(straight.edge_count(), 2 * mesh.edge_count());
    const FlatMesh flat = straight_over_nodes(flatten(mesh, true)), same = flatten(straight, true);
    EXPECT_EQ(flat.triangles, same.triangles);
    EXPECT_EQ(flat.triangle_refs, same.triangle_refs);
    EXPECT_EQ(flat.edges, same.edges);
    EXPECT_FALSE(flat.is_quadratic());
    double area = 0;
    for (const auto& [a, b, c] : flat.triangles) {
      const Vec3 d = flat.vertices[b] - flat.vertices[a], e = flat.vertices[c] - flat.vertices[a];
      area += cross(d, e).z() / 2;
    }
    EXPECT_NEAR(area, 1, 1e-12) << element;
  }
}

TEST(CurvedTransfer, FieldsOfShapeFunctionsHaveRoundingErrors) {
  const Field f = [](const Vec3& p) { return 1 + p.x() * p.x() - 3 * p.x() * p.y(); };
  const FieldFunction exact = [&](std::span<const Vec3> points, std::span<double> values) {
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = f(points[i]);
  };
  const SurfaceMesh mesh = mesh_of(unit_square(), 0.2, "p2");
  EXPECT_LT(interpolation_error(mesh, at_nodes(mesh, f), exact).largest, 1e-14);
  EXPECT_THROW(interpolation_error(mesh, at_vertices(mesh, f), exact), InvalidArgument);
  std::vector<double> wrong = at_nodes(mesh, f);
  wrong.back() += 1;  // a node on an edge: its shape function is 1 there, 3/4 halfway to a corner and 1/3 at a third
  const InterpolationError error = interpolation_error(mesh, wrong, exact);
  EXPECT_NEAR(error.largest, 0.75, 1e-12);
  EXPECT_LT(error.rms, 0.2);
}

TEST(CurvedTransfer, ValuesAtVerticesAloneStayThere) {
  const Field f = [](const Vec3& p) { return p.x() - 4 * p.y(); };
  const SurfaceMesh from = mesh_of(unit_square(), 0.2, "p2"), to = mesh_of(unit_square(), 0.13, "p2");
  ASSERT_FALSE(to.mid_vertices.empty());
  EXPECT_LT(largest_difference(transfer_field(from, to, at_vertices(from, f), 1).values, at_vertices(to, f)), 1e-13);
}

TEST(CurvedTransfer, IsOfThirdOrderOnSurfaces) {
  const Field f = [](const Vec3& p) { return std::sin(3 * p.x()) * std::cos(2 * p.y() + 1) + std::exp(p.z()); };
  for (const AnalyticCad& cad : {testing::hemisphere(), testing::torus_patch()}) {
    const SurfaceMesh to = mesh_of(cad, 0.17, "p2");
    const std::vector<double> exact = at_nodes(to, f);
    const auto error = [&](double h, const char* element) {
      const SurfaceMesh from = mesh_of(cad, h, element);
      return largest_difference(transfer_field(from, to, at_nodes(from, f), 1).values, exact);
    };
    EXPECT_NEAR(std::log2(error(0.4, "p2") / error(0.05, "p2")) / 3, 3, 0.35);
    EXPECT_NEAR(std::log2(error(0.4, "p1") / error(0.05, "p1")) / 3, 2, 0.35);
  }
}

}  // namespace
}  // namespace carreau
