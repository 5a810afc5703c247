// SPDX-License-Identifier: BSD-3-Clause
// Elements beside sharp lines that turn fast, on cross-patch meshes; wires beside such meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "euler_number.h"
#include "free_elements/drilled_plate.h"
#include "mesh/elements/jacobian.h"
#include "session_of_size.h"

namespace carreau {
namespace {

using namespace testing;

const std::array<std::string, 5> kinds{"p2", "q1.0", "q1.1", "q2.0", "q2.1"};

std::unique_ptr<Session> meshed(double radius, const std::string& element, double size, Monitor& monitor, int threads = 1) {
  auto session = session_of_size(drilled_plate(radius), size, monitor);
  session->parameters().set("patches", "independent");
  session->parameters().set("element", element);
  session->parameters().set("threads", threads);
  session->make_mesh();
  return session;
}

Vec3 position_of(const SurfaceMesh& mesh, std::int32_t node) {
  const auto corners = static_cast<std::int32_t>(mesh.vertices.size());
  return node < corners ? mesh.vertices[node] : mesh.mid_vertices[node - corners];
}

// At these sizes an edge of the rim turns by 54 degrees and more. Beside the larger hole p2 and q2.0 are invalid unless its curves are divided.
TEST(FreeElementsAtCurves, AreValidWhereEdgesTurn) {
  Monitor quiet;
  for (const auto& c : {std::pair{0.25, 0.4}, {0.25, 0.7}, {0.95, 0.9}})
    for (const std::string& element : kinds) {
      const double radius = c.first, size = c.second;
      const auto session = meshed(radius, element, size, quiet);
      const SurfaceMesh& mesh = session->mesh();
      EXPECT_TRUE(mesh.independent) << element;
      const std::vector<std::string> defects = find_defects(mesh, {.closed = true});
      EXPECT_TRUE(defects.empty()) << element << ": " << defects.front();
      EXPECT_EQ(euler_number(mesh), 0) << element;  // a torus
      double least = 1, off = 0;
      for (const FaceMesh& face : mesh.faces) {
        EXPECT_EQ(face.why.find("Jacobian"), std::string::npos) << element << ", " << size << ": " << face.why;
        for (const Cell& cell : cells_of(mesh, face)) {
          std::vector<Vec3> nodes;
          for (int i = 0; i < node_count(cell.kind); ++i) nodes.push_back(position_of(mesh, cell.nodes[i]));
          for (const Vec3& p : nodes) off = std::max(off, off_drilled_plate(radius, p));
          least = std::min(least, jacobian(cell.kind, nodes).least());
        }
      }
      EXPECT_GT(least, 0) << element << ", " << size;
      EXPECT_LE(off, 1e-12) << element;
      // Nodes of the rims are on both of their faces.
      for (const CurveMesh& curve : mesh.curves)
        for (std::size_t k = 0; k < curve.mid.size(); ++k) {
          const Vec3 p = mesh.mid_vertices[curve.mid[k]], a = mesh.vertices[curve.vertices[k]];
          if (std::abs(std::hypot(a.x(), a.y()) - radius) > 1e-9) continue;
          EXPECT_NEAR(std::hypot(p.x(), p.y()), radius, 1e-12) << element;
          EXPECT_LE(std::min(std::abs(p.z()), std::abs(p.z() - plate_height)), 1e-12) << element;
        }
    }
}

TEST(FreeElementsAtCurves, MeshDoesNotDependOnThreads) {
  Monitor quiet;
  for (const std::string& element : kinds) {
    const FlatMesh one = meshed(0.95, element, 0.9, quiet)->exported(), two = meshed(0.95, element, 0.9, quiet, 2)->exported();
    EXPECT_TRUE(one.cells == two.cells) << element;
    EXPECT_TRUE(one.vertices == two.vertices) << element;
  }
}

// A quarter of a circle from a corner of the plate, and a line from the border between two faces that is not sharp.
TEST(FreeElementsAtCurves, WiresStay) {
  Monitor quiet;
  AnalyticCad cad = drilled_plate(0.25);
  const auto wire = [](double end) {
    return std::vector<AnalyticCurve>{{{0, end}, [](double t) { return CurveJet{{t, 0}, {1, 0}, {}}; }}};
  };
  cad.faces[101] = {[](Vec2 p) {
                      const double c = std::cos(p.x()), s = std::sin(p.x());
                      return SurfaceJet{{1, 2 - c, plate_height + s}, {0, s, c}, {}, {0, c, -s}, {}, {}};
                    },
                    wire(std::numbers::pi / 2)};
  cad.faces[102] = {[](Vec2 p) {
                      return SurfaceJet{{0, 1, plate_height + p.x()}, {0, 0, 1}, {}, {}, {}, {}};
                    },
                    wire(1)};
  Model model = unglued(cad);
  for (Face& face : model.faces)
    if (face.ref > 100) face.orientation = 0, face.curves.front().type = CurveType::internal;
  for (const std::string& element : {std::string("p1"), std::string("p2"), std::string("q1.1"), std::string("q2.1")}) {
    const auto session = session_of_command(cad, 0.2, quiet);
    session->set_model(model);
    session->parameters().set("patches", "independent");
    session->parameters().set("element", element);
    session->make_mesh();
    const SurfaceMesh& mesh = session->mesh();
    EXPECT_TRUE(mesh.independent) << element;
    EXPECT_EQ(euler_number(mesh), 0) << element;
    EXPECT_TRUE(find_defects(mesh, {.closed = true}).empty()) << element;
    std::set<std::int32_t> of_faces;
    for (const FaceMesh& face : mesh.faces) of_faces.insert(face.vertex.begin(), face.vertex.end());
    std::size_t wires = 0;
    for (const CurveMesh& curve : mesh.curves) {
      if (!curve.loose) continue;
      ++wires;
      const bool is_arc = mesh.vertices[curve.vertices.front()].x() > 0.5;
      const auto off = [&](const Vec3& p) {
        return is_arc ? std::abs(std::hypot(p.y() - 2, p.z() - plate_height) - 1) + std::abs(p.x() - 1)
                      : std::abs(p.x()) + std::abs(p.y() - 1);
      };
      // pi / 2 or 1 by .2, or by .4 and halved.
      const bool halved = element == "q1.1" || element == "q2.1";
      EXPECT_EQ(curve.vertices.size(), is_arc ? 9U : halved ? 7U : 6U) << element;
      EXPECT_EQ(curve.mid.size(), element == "p1" || element == "q1.1" ? 0 : curve.vertices.size() - 1) << element;
      for (const std::int32_t v : curve.vertices) EXPECT_LE(off(mesh.vertices[v]), 1e-12) << element;
      for (const std::int32_t m : curve.mid) EXPECT_LE(off(mesh.mid_vertices[m]), 1e-12) << element;
      EXPECT_TRUE(of_faces.contains(curve.vertices.front())) << element;  // one mesh
    }
    EXPECT_EQ(wires, 2U) << element;
    EXPECT_EQ(mesh.loose_edge_count(), session->exported().edges.size()) << element;
  }
}

}  // namespace
}  // namespace carreau
