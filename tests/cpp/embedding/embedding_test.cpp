// SPDX-License-Identifier: BSD-3-Clause
// Points and polylines of space in the mesh: great circles, lines across seams and edges, crossings.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <set>

#include "common/analytic_cad.h"
#include "session/session.h"
#include "support/error.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
constexpr double pi = std::numbers::pi;

SurfaceJet sphere_jet(Vec2 p) {
  const double cu = std::cos(p.x()), su = std::sin(p.x()), cv = std::cos(p.y()), sv = std::sin(p.y());
  SurfaceJet j;
  j.s = Vec3(cu * cv, su * cv, sv);
  j.su = Vec3(-su * cv, cu * cv, 0), j.sv = Vec3(-cu * sv, -su * sv, cv);
  j.suu = Vec3(-cu * cv, -su * cv, 0), j.suv = Vec3(su * sv, -cu * sv, 0), j.svv = -j.s;
  return j;
}

AnalyticCad sphere() {
  AnalyticCad cad;
  cad.faces[1] = {sphere_jet, testing::rectangle({0, -pi / 2}, {2 * pi, pi / 2})};
  return cad;
}

/// Radius 1, height 2, one face with a seam at angle 0; faces 2 and 3 are its discs.
AnalyticCad cylinder() {
  AnalyticCad cad;
  cad.faces[1] = {[](Vec2 p) {
                    const double c = std::cos(p.x()), s = std::sin(p.x());
                    return SurfaceJet{{c, s, p.y()}, {-s, c, 0}, {0, 0, 1}, {-c, -s, 0}, {}, {}};
                  },
                  testing::rectangle({0, 0}, {2 * pi, 2})};
  for (const double z : {0.0, 2.0})
    cad.faces[z > 0 ? 2 : 3] = {[z](Vec2 p) {
                                  return SurfaceJet{{p.x(), p.y(), z}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}};
                                },
                                {testing::arc({0, 0}, 1, 0, 2 * pi)}};
  return cad;
}

/// The unit cube; face 2k + 1 at x_k = 0 and 2k + 2 at x_k = 1.
AnalyticCad cube() {
  AnalyticCad cad;
  for (int k = 0; k < 3; ++k)
    for (const int side : {0, 1})
      cad.faces[2 * k + side + 1] = {[k, side](Vec2 p) {
                                       SurfaceJet j;
                                       j.s[k] = side, j.s[(k + 1) % 3] = p.x(), j.s[(k + 2) % 3] = p.y();
                                       j.su[(k + 1) % 3] = 1, j.sv[(k + 2) % 3] = 1;
                                       return j;
                                     },
                                     testing::rectangle({0, 0}, {1, 1})};
  return cad;
}

struct Embedded {
  Monitor monitor;
  Session session{monitor};

  explicit Embedded(const AnalyticCad& cad, double size = 0.2) {
    session.set_cad(std::make_shared<AnalyticCad>(cad));
    session.set_model(testing::unglued(cad));
    session.parameters().set("hphydef", size);
    session.make_mesh();  // finds the references
  }

  /// The mesh is sound, and the edges with this reference are returned.
  std::vector<std::array<Vec3, 2>> edges(int ref, bool closed = true) {
    session.make_mesh();
    const SurfaceMesh& mesh = session.mesh();
    EXPECT_EQ(find_defects(mesh, {.closed = closed}), std::vector<std::string>{});
    for (const FaceMesh& face : mesh.faces) EXPECT_NE(face.status, FaceStatus::failed) << face.why;
    std::vector<std::array<Vec3, 2>> edges;
    for (const CurveMesh& curve : mesh.curves)
      if (curve.shown_ref() == ref)
        for (std::size_t i = 1; i < curve.vertices.size(); ++i)
          edges.push_back({mesh.vertices[static_cast<std::size_t>(curve.vertices[i - 1])], mesh.vertices[static_cast<std::size_t>(curve.vertices[i])]});
    return edges;
  }

  [[nodiscard]] std::size_t vertices_at(const Vec3& x) const {
    const auto& all = session.mesh().vertices;
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [&](const Vec3& p) { return norm(p - x) < 1e-9; }));
  }
};

double length_of(const std::vector<std::array<Vec3, 2>>& edges) {
  double length = 0;
  for (const auto& [a, b] : edges) length += norm(b - a);
  return length;
}

std::vector<Vec3> circle(const Vec3& e, const Vec3& f, int n) {
  std::vector<Vec3> points;
  for (int k = 0; k < n; ++k) points.emplace_back(std::cos(2 * pi * k / n + 0.3) * e + std::sin(2 * pi * k / n + 0.3) * f);
  points.push_back(points.front());
  return points;
}

TEST(Embedding, GreatCircle) {
  for (const int n : {4, 100}) {
    Embedded sphere_mesh(sphere());
    const Vec3 normal = Vec3(0.3, -0.2, 1) / norm(Vec3(0.3, -0.2, 1)), e = Vec3(1, 0, -0.3) / norm(Vec3(1, 0, -0.3)), f = cross(normal, e);
    const int ref = sphere_mesh.session.embed_polyline(circle(e, f, n), "ring");
    const auto edges = sphere_mesh.edges(ref);
    for (const auto& edge : edges)
      for (const Vec3& p : edge) {
        EXPECT_NEAR(dot(p, normal), 0, 1e-7);
        EXPECT_NEAR(norm(p), 1, 1e-12);
      }
    EXPECT_NEAR(length_of(edges), 2 * pi, 0.02);
    EXPECT_EQ(sphere_mesh.session.names().curves.at(ref), "ring");
  }
}

TEST(Embedding, LineAcrossTheSeamOfACylinder) {
  Embedded mesh(cylinder());
  // A helix of slope 1 / 2 that crosses the seam at height 1.
  std::vector<Vec3> points;
  for (int k = -10; k <= 10; ++k) points.emplace_back(std::cos(0.1 * k), std::sin(0.1 * k), 1 + 0.05 * k);
  const int ref = mesh.session.embed_polyline(points, "");
  const auto edges = mesh.edges(ref);
  for (const auto& edge : edges)
    for (const Vec3& p : edge) EXPECT_NEAR(p.z(), 1 + 0.5 * std::atan2(p.y(), p.x()), 1e-3);  // chords of 0.1 replace the helix
  EXPECT_NEAR(length_of(edges), 2 * std::sqrt(1.25), 0.01);
  EXPECT_EQ(mesh.vertices_at({1, 0, 1}), 1U);
  EXPECT_GE(edges.size(), 4U);
}

TEST(Embedding, ShortestWayOverAnEdgeOfACube) {
  Embedded mesh(cube());
  // Unfolded, the way from (0.5, 0.2, 1) over the edge x = z = 1 to (1, 0.8, 0.7) is a line: it crosses the edge at y = 0.2 + 0.6 * 5 / 8.
  const std::vector<Vec3> points{{0.5, 0.2, 1}, {1, 0.8, 0.7}};
  const int ref = mesh.session.embed_polyline(points, "strip");
  const auto edges = mesh.edges(ref);
  EXPECT_NEAR(length_of(edges), std::hypot(0.8, 0.6), 1e-9);
  EXPECT_EQ(mesh.vertices_at({1, 0.575, 1}), 1U);
  for (const auto& edge : edges)
    for (const Vec3& p : edge) {
      if (p.z() > 1 - 1e-9)
        EXPECT_NEAR(p.y(), 0.2 + 0.75 * (p.x() - 0.5), 1e-7);
      else
        EXPECT_NEAR(p.y(), 0.575 + 0.75 * (1 - p.z()), 1e-7);
    }
  // The edge of the cube keeps its reference in both parts.
  std::map<int, double> lengths;
  for (const CurveMesh& curve : mesh.session.mesh().curves)
    for (std::size_t i = 1; i < curve.vertices.size(); ++i)
      lengths[curve.shown_ref()] += norm(mesh.session.mesh().vertices[static_cast<std::size_t>(curve.vertices[i])] -
                                         mesh.session.mesh().vertices[static_cast<std::size_t>(curve.vertices[i - 1])]);
  EXPECT_EQ(lengths.size(), 13U);
  for (const auto& [curve, length] : lengths) EXPECT_NEAR(length, curve == ref ? 1.0 : 1.0, 1e-9) << curve;
}

TEST(Embedding, VerticesOnEdgesAndAcrossThreeFaces) {
  Embedded mesh(cube());
  const std::vector<Vec3> points{{0.5, 0.5, 1}, {1, 0.5, 1}, {1, 0.5, 0}, {0.5, 0.4, 0}};
  const auto edges = mesh.edges(mesh.session.embed_polyline(points, ""));
  EXPECT_NEAR(length_of(edges), 1.5 + std::hypot(0.5, 0.1), 1e-9);
  for (const Vec3& p : points) EXPECT_EQ(mesh.vertices_at(p), 1U);
}

TEST(Embedding, WayAroundACube) {
  Embedded mesh(cube());
  EXPECT_NEAR(length_of(mesh.edges(mesh.session.embed_polyline(std::vector<Vec3>{{0.2, 0.5, 1}, {0.2, 0.5, 0}}, ""))), 1.4, 1e-9);
}

TEST(Embedding, CornersBecomePoints) {
  Embedded mesh(cube());
  const std::vector<Vec3> square{{0.3, 0.3, 1}, {0.7, 0.3, 1}, {0.7, 0.7, 1}, {0.3, 0.7, 1}, {0.3, 0.3, 1}};
  const auto edges = mesh.edges(mesh.session.embed_polyline(square, ""));
  EXPECT_NEAR(length_of(edges), 1.6, 1e-9);
  for (const Vec3& p : square) EXPECT_EQ(mesh.vertices_at(p), 1U);
}

TEST(Embedding, CrossingCurvesShareAVertex) {
  Embedded mesh(cube());
  const std::vector<Vec3> one{{0.2, 0.2, 1}, {0.8, 0.8, 1}}, other{{0.2, 0.8, 1}, {0.8, 0.2, 1}}, touching{{0.35, 0.35, 1}, {0.6, 0.2, 1}},
      figure_of_eight{{0.1, 0.1, 0}, {0.9, 0.9, 0}, {0.9, 0.1, 0}, {0.1, 0.9, 0}};
  std::vector<int> refs;
  for (const auto& points : {one, other, touching, figure_of_eight}) refs.push_back(mesh.session.embed_polyline(points, ""));
  EXPECT_EQ(std::set<int>(refs.begin(), refs.end()).size(), 4U);
  EXPECT_NEAR(length_of(mesh.edges(refs[0])), std::hypot(0.6, 0.6), 1e-9);
  EXPECT_NEAR(length_of(mesh.edges(refs[1])), std::hypot(0.6, 0.6), 1e-9);
  EXPECT_NEAR(length_of(mesh.edges(refs[3])), 2 * std::hypot(0.8, 0.8) + 0.8, 1e-9);
  EXPECT_EQ(mesh.vertices_at({0.5, 0.5, 1}), 1U);
  EXPECT_EQ(mesh.vertices_at({0.35, 0.35, 1}), 1U);
  EXPECT_EQ(mesh.vertices_at({0.5, 0.5, 0}), 1U);
}

TEST(Embedding, CurveTwiceIsRejected) {
  Embedded mesh(cube());
  const std::vector<Vec3> line{{0.2, 0.2, 1}, {0.8, 0.8, 1}};
  mesh.session.embed_polyline(line, "");
  mesh.session.embed_polyline(line, "");
  mesh.session.parameters().set("failing_faces", "stop");
  bool failed = false;
  try {
    mesh.session.make_mesh();
    for (const FaceMesh& face : mesh.session.mesh().faces) failed = failed || face.status == FaceStatus::failed;
  } catch (const Error&) {
    failed = true;
  }
  EXPECT_TRUE(failed);
}

TEST(Embedding, Points) {
  Embedded mesh(cube());
  const Vec3 inside{0.31, 0.42, 1}, on_edge{1, 0.3, 1}, above{0.6, 0.6, 1.001};
  std::set<int> refs;
  refs.insert(mesh.session.embed_point(inside, "probe"));
  refs.insert(mesh.session.embed_point(on_edge, ""));
  refs.insert(mesh.session.embed_point(above, ""));
  const int corner = mesh.session.embed_point({1, 1, 1}, "");
  EXPECT_EQ(refs.size(), 3U);
  EXPECT_FALSE(refs.contains(corner));
  mesh.edges(0);
  for (const Vec3& p : {inside, on_edge, Vec3(0.6, 0.6, 1), Vec3(1, 1, 1)}) EXPECT_EQ(mesh.vertices_at(p), 1U) << p.transpose();
  EXPECT_EQ(mesh.session.names().points.at(*refs.begin()), "probe");
  // A line through the points.
  const std::vector<Vec3> line{inside, {0.6, 0.6, 1}};
  EXPECT_NEAR(length_of(mesh.edges(mesh.session.embed_polyline(line, ""))), norm(line[1] - line[0]), 1e-9);
}

/// Sheets of wakes that stand on a body: their lower sides are edges of both.
TEST(Embedding, CurvesJoinSheets) {
  AnalyticCad cad = cube();
  // One within the upper face, and one that leaves the cube over its edge x = z = 1.
  for (const int sheet : {7, 8})
    cad.faces[sheet] = {[sheet](Vec2 p) {
                          SurfaceJet j;
                          j.s = {(sheet == 7 ? 0.2 : 0.6) + p.x(), sheet == 7 ? 0.3 : 0.6, 1 + p.y()};
                          j.su[0] = 1, j.sv[2] = 1;
                          return j;
                        },
                        testing::rectangle({0, 0}, {sheet == 7 ? 0.5 : 1.0, 0.4})};
  Embedded mesh(cad);
  const std::vector<Vec3> inside{{0.2, 0.3, 1}, {0.7, 0.3, 1}}, over_edge{{0.6, 0.6, 1}, {1, 0.6, 1}};
  const int one = mesh.session.embed_polyline(inside, ""), other = mesh.session.embed_polyline(over_edge, "");
  const auto edges = mesh.edges(one, false);
  EXPECT_NEAR(length_of(edges), 0.5, 1e-9);
  EXPECT_NEAR(length_of(mesh.edges(other, false)), 1, 1e-9);  // on the body, and beyond it
  for (const Vec3& p : {inside[0], inside[1], over_edge[0], over_edge[1]}) EXPECT_EQ(mesh.vertices_at(p), 1U) << p.transpose();
  double joined = 0;
  for (const CurveMesh& curve : mesh.session.mesh().curves) {
    const auto internal = std::count_if(curve.uses.begin(), curve.uses.end(), [](const CurveMeshUse& use) { return use.internal; });
    if (curve.uses.size() != 2 || internal != 1) continue;
    for (std::size_t i = 1; i < curve.vertices.size(); ++i)
      joined += norm(mesh.session.mesh().vertices[static_cast<std::size_t>(curve.vertices[i])] -
                     mesh.session.mesh().vertices[static_cast<std::size_t>(curve.vertices[i - 1])]);
  }
  EXPECT_NEAR(joined, 0.9, 1e-9);
}

TEST(Embedding, WiresThatLieOnFaces) {
  AnalyticCad cad = cube();
  // A line over the edge x = z = 1 cannot be a curve of one surface: two wires, and one that leaves the cube.
  const std::array<Vec3, 6> ends{Vec3(0.5, 0.5, 1), Vec3(1, 0.5, 1), Vec3(1, 0.5, 1), Vec3(1, 0.5, 0.4), Vec3(0.2, 0.2, 1), Vec3(0.2, 0.2, 2)};
  for (std::size_t w = 0; w < 3; ++w)
    cad.faces[7 + static_cast<int>(w)] = {[a = ends[2 * w], b = ends[2 * w + 1]](Vec2 p) {
                                            SurfaceJet j;
                                            j.s = a + p.x() * (b - a), j.su = b - a;
                                            return j;
                                          },
                                          {testing::segment({0, 0}, {1, 0})}};
  Monitor monitor;
  Session session(monitor);
  session.set_cad(std::make_shared<AnalyticCad>(cad));
  Model model = testing::unglued(cad);
  for (Face& face : model.faces)
    if (face.ref > 6) face.orientation = 0, face.name = "wire", face.curves.front().type = CurveType::internal;
  session.set_model(model);
  session.parameters().set("hphydef", 0.2);
  EXPECT_EQ(session.embed_wires(), 2);
  EXPECT_EQ(session.model().faces.size(), 7U);
  session.make_mesh();
  EXPECT_EQ(find_defects(session.mesh(), {}), std::vector<std::string>{});
  double length = 0;
  for (const CurveMesh& curve : session.mesh().curves) {
    const auto name = session.names().curves.find(curve.shown_ref());
    if (name == session.names().curves.end() || name->second != "wire") continue;
    EXPECT_FALSE(curve.loose);
    length += norm(session.mesh().vertices[static_cast<std::size_t>(curve.vertices.front())] - session.mesh().vertices[static_cast<std::size_t>(curve.vertices.back())]);
  }
  EXPECT_NEAR(length, 1.1, 1e-9);
}

TEST(Embedding, NamesMistakes) {
  Embedded mesh(cube());
  const auto sentence = [&](const std::vector<Vec3>& points) -> std::string {
    const Model before = mesh.session.model();
    try {
      mesh.session.embed_polyline(points, "");
    } catch (const InvalidArgument& error) {
      EXPECT_EQ(mesh.session.model().faces.front().curves.size(), before.faces.front().curves.size());
      return error.what();
    }
    return "";
  };
  EXPECT_NE(sentence({{0.2, 0.2, 1}, {0.5, 0.5, 1.25}}).find("point 1 of the polyline, (0.5, 0.5, 1.25), is 0.25"), std::string::npos);
  EXPECT_NE(sentence({{0.2, 0, 0}, {0.7, 0, 0}}).find("runs along curve"), std::string::npos);
  EXPECT_NE(sentence({{0.2, 0, 0}}).find("at least two points"), std::string::npos);
  EXPECT_NE(sentence({{0.2, 0.5, 1}, {0.2, 0.5, 1}}).find("are one"), std::string::npos);
  AnalyticCad apart = cube();
  for (const int face : {1, 2, 3, 4}) apart.faces.erase(face);
  Embedded two(apart);
  const std::vector<Vec3> through{{0.2, 0.5, 1}, {0.2, 0.5, 0}};
  try {
    two.session.embed_polyline(through, "");
    ADD_FAILURE();
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find("leaves the surface"), std::string::npos) << error.what();
  }
  Embedded ball(sphere());
  EXPECT_THROW(ball.session.embed_polyline(circle({1, 0, 0}, {0, 0, 1}, 8), ""), InvalidArgument);
}

}  // namespace
}  // namespace carreau
