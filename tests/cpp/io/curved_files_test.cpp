// SPDX-License-Identifier: BSD-3-Clause
// Files of elements of order 3 and 4.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <span>

#include "high_order/curved_quality.h"
#include "io/curved_rows.h"
#include "io/files.h"
#include "io/high_order/curved_files.h"
#include "io/high_order/curved_reader.h"
#include "io/mesh_files.h"
#include "io_test_support.h"
#include "support/error.h"

namespace carreau {
namespace {

Vec3 lifted(const Vec2& p) { return {p.x(), p.y(), 0.3 * p.x() * p.x() - 0.2 * p.x() * p.y() * p.y()}; }

/// A unit square as two triangles (face 5), and the square beside it (face 2), on a cubic graph; a curve 3 between them.
HighOrderMesh graph(int order, NodePlaces places) {
  HighOrderMesh mesh;
  mesh.order = order, mesh.places = places, mesh.corners = 6, mesh.corner_refs = {0, 8, 0, 0, 0, 9};
  mesh.face_names = {{2, "right"}};
  const std::vector<Vec2> corner{{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}};
  for (const Vec2& p : corner) mesh.nodes.push_back(lifted(p));
  std::map<std::array<long, 2>, std::int32_t> known;
  const auto number = [&](const Vec2& p) {
    const auto [found, is_new] = known.try_emplace({std::lround(p.x() * 1e6), std::lround(p.y() * 1e6)}, static_cast<std::int32_t>(mesh.nodes.size()));
    if (is_new) mesh.nodes.push_back(lifted(p));
    return found->second;
  };
  for (std::size_t v = 0; v < corner.size(); ++v) known[{std::lround(corner[v].x() * 1e6), std::lround(corner[v].y() * 1e6)}] = static_cast<std::int32_t>(v);
  const auto add = [&](std::vector<std::int32_t> of, std::int32_t ref) {
    const bool quad = of.size() == 4;
    const ElementShape shape(quad, order, places);
    std::vector<std::int32_t> row;
    for (const Vec2& at : shape.reference()) {
      const Vec2 a = corner[of[0]], u = corner[of[1]] - a, v = corner[of[quad ? 3 : 2]] - a;
      row.push_back(number(a + at.x() * u + at.y() * v));
    }
    EXPECT_TRUE(add_curved(mesh, order, static_cast<int>(of.size()), row, ref));
  };
  add({0, 1, 4}, 5), add({0, 4, 3}, 5), add({1, 2, 5, 4}, 2);
  std::vector<std::int32_t> edge{4, 1};
  const std::vector<double> at = places_on_edge(order, places);
  for (int k = 1; k < order; ++k) edge.push_back(number(Vec2(1, 1 - at[static_cast<std::size_t>(k)])));
  EXPECT_TRUE(add_curved(mesh, order, 2, edge, 3));
  return mesh;
}

/// Positions of the nodes of rows.
std::vector<Vec3> places_of(const HighOrderMesh& mesh, const std::vector<std::int32_t>& rows) {
  std::vector<Vec3> all;
  for (const std::int32_t node : rows) all.push_back(mesh.nodes[node]);
  return all;
}

void expect_equal(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT(norm(a[i] - b[i]), 1e-13) << i;
}

MeshOfFile read_back(const std::string& bytes, const std::string& name) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / name;
  write_file(path.string(), bytes);
  MeshOfFile file = read_mesh_of_any_order(path.string());
  std::filesystem::remove(path);
  return file;
}

TEST(CurvedFiles, HoldTheSamePolynomials) {
  for (const int order : {3, 4})
    for (const NodePlaces places : {NodePlaces::equidistant, NodePlaces::gauss_lobatto}) {
      const HighOrderMesh mesh = graph(order, places);
      const std::map<std::string, std::string> files{{"curved_files_test.msh", curved_msh(mesh)},
                                                     {"curved_files_test.msh2", curved_msh(mesh, false, true)},
                                                     {"curved_files_test.vtu", curved_vtu(mesh)},
                                                     {"curved_files_test.mesh", curved_mfem(mesh)}};
      for (const auto& [name, bytes] : files) {
        SCOPED_TRACE(name + " of order " + std::to_string(order));
        const MeshOfFile file = read_back(bytes, name);
        ASSERT_TRUE(file.curved);
        EXPECT_EQ(file.curved->order, order);
        const HighOrderMesh same = with_places(mesh, file.curved->places);
        EXPECT_EQ(file.curved->nodes.size(), mesh.nodes.size());  // shared nodes are one
        EXPECT_EQ(file.curved->triangle_refs, mesh.triangle_refs);
        EXPECT_EQ(file.curved->quad_refs, mesh.quad_refs);
        EXPECT_EQ(file.curved->edge_refs, mesh.edge_refs);
        expect_equal(places_of(*file.curved, file.curved->triangles), places_of(same, same.triangles));
        expect_equal(places_of(*file.curved, file.curved->quads), places_of(same, same.quads));
        expect_equal(places_of(*file.curved, file.curved->edges), places_of(same, same.edges));
        if (name.find(".msh") != std::string::npos) {
          EXPECT_EQ(file.curved->face_names, mesh.face_names);
          EXPECT_EQ(file.flat.vertex_refs[1], 8);
        }
        // The elements of order 2 pass through the middles of the edges.
        EXPECT_EQ(file.flat.cells.size(), 3u);
        EXPECT_EQ(file.flat.vertices.size(), 6u + 8u);
        for (const Cell& cell : file.flat.cells)
          for (int i = 0; i < corner_count(cell.kind); ++i) {
            const Vec3 &p = file.flat.vertices[cell.nodes[i]], &q = file.flat.vertices[cell.nodes[(i + 1) % corner_count(cell.kind)]];
            EXPECT_LT(norm(file.flat.vertices[cell.nodes[corner_count(cell.kind) + i]] - lifted({(p.x() + q.x()) / 2, (p.y() + q.y()) / 2})), 1e-13);
          }
      }
    }
}

TEST(CurvedFiles, MeasuresAreThoseOfTheGraph) {
  // The area of the cubic graph over [0, 2] x [0, 1] by a fine midpoint rule.
  double area = 0;
  constexpr int n = 800;
  for (int i = 0; i < 2 * n; ++i)
    for (int k = 0; k < n; ++k) {
      const double x = (i + 0.5) / n, y = (k + 0.5) / n, u = 0.6 * x - 0.2 * y * y, v = -0.4 * x * y;
      area += std::sqrt(1 + u * u + v * v) / (n * n);
    }
  for (const int order : {3, 4}) {
    HighOrderMesh mesh = graph(order, NodePlaces::gauss_lobatto);
    const CurvedQuality good = measure_curved(mesh);
    EXPECT_NEAR(good.area, area, 1e-6);
    EXPECT_EQ(good.invalid, 0);
    EXPECT_GT(good.least_jacobian_min, 0.5);
    mesh.nodes[mesh.quads.back()] += Vec3{5, 0, 0};  // a node inside the quadrilateral
    EXPECT_EQ(measure_curved(mesh).invalid, 1);
    EXPECT_LT(measure_curved(mesh).least_jacobian_min, 0);
  }
}

TEST(CurvedFiles, ViolationsAreErrors) {
  const std::string mfem = curved_mfem(graph(3, NodePlaces::gauss_lobatto));
  for (std::size_t length = 0; length + 2 < mfem.size(); length += 7) EXPECT_THROW(read_curved_mfem(mfem.substr(0, length), "x.mesh"), FileError) << length;
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = mfem;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  EXPECT_THROW(read_curved_mfem(changed("L2_T1_2D_P3", "H1_2D_P3"), "x.mesh"), FileError);
  EXPECT_THROW(read_curved_mfem(changed("dimension\n2", "dimension\n3"), "x.mesh"), FileError);
  EXPECT_THROW(read_curved_mfem(changed("5 2 0 1 4", "5 2 0 1 6"), "x.mesh"), FileError);
  EXPECT_THROW(read_curved_mfem(changed("5 2 0 1 4", "5 2 0 1 -1"), "x.mesh"), FileError);
  EXPECT_THROW(read_curved_mfem(changed("vertices\n6", "vertices\n2000000000"), "x.mesh"), FileError);
  EXPECT_THROW(read_curved_mfem(changed("elements\n3", "elements\n2000000000"), "x.mesh"), FileError);
  // Readers that know orders 1 and 2 alone, and mixed orders.
  const std::string msh = curved_msh(graph(3, NodePlaces::equidistant), false, true);
  EXPECT_THROW(read_mesh_msh(msh, "x.msh"), FileError);
  EXPECT_THROW(read_mesh_vtu(curved_vtu(graph(3, NodePlaces::equidistant)), "x.vtu"), FileError);
  HighOrderMesh curved;
  std::string mixed = msh;
  const std::size_t at = mixed.find("$Elements\n") + 10, line = mixed.find('\n', at);
  mixed.replace(at, line - at, std::to_string(std::stoi(mixed.substr(at, line - at)) + 1) + "\n99 2 2 5 5 1 2 5");
  EXPECT_THROW(read_mesh_msh(mixed, "x.msh", curved), FileError);
}

}  // namespace
}  // namespace carreau
