// SPDX-License-Identifier: BSD-3-Clause
// Boundary edges that are shorter than the size: triangles grow from them inside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

#include "mesh/quality.h"
#include "session_of_size.h"

namespace carreau {
namespace {

using testing::AnalyticCad;

SurfaceJet flat(Vec2 p) { return {{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; }

// z = x y / 4
SurfaceJet saddle(Vec2 p) {
  return {{p.x(), p.y(), p.x() * p.y() / 4}, {1, 0, p.y() / 4}, {0, 1, p.x() / 4}, {}, {0, 0, 0.25}, {}};
}

/// A square of 10, its lower side in `pieces` curves.
AnalyticCad comb(SurfaceJet (*surface)(Vec2), int pieces) {
  std::vector<testing::AnalyticCurve> curves;
  const double l = 10. / pieces;
  for (int k = 0; k < pieces; ++k) curves.push_back(testing::segment({k * l, 0}, {(k + 1) * l, 0}));
  curves.push_back(testing::segment({10, 0}, {10, 10}));
  curves.push_back(testing::segment({10, 10}, {0, 10}));
  curves.push_back(testing::segment({0, 10}, {0, 0}));
  AnalyticCad cad;
  cad.faces[1] = {surface, curves};
  return cad;
}

std::unique_ptr<Session> meshed(const AnalyticCad& cad, double size, double ratio, Monitor& monitor) {
  auto session = testing::session_of_size(cad, size, monitor);
  session->parameters().set("CheckAdjacentEdges", 20);
  session->parameters().set("edge_gradation", ratio);
  session->make_mesh();
  return session;
}

struct Shapes {
  double mean = 0, worst = 1;
  std::size_t count = 0;
};
Shapes shapes_of(const SurfaceMesh& mesh) {
  Shapes s;
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles) {
      const auto at = [&](int i) { return mesh.vertices[face.vertex[t[i]]]; };
      const double q = quality_q2(at(0), at(1), at(2));
      s.mean += q, s.worst = std::min(s.worst, q), ++s.count;
    }
  s.mean /= static_cast<double>(s.count);
  return s;
}

// HDR sec. 3.3.3. The lower side has edges of 0.1, the others of 2: halvings bring the ratio below adjacent_ratio.
TEST(ShortEdges, AdjacentRatioLimitsTheRatioOfNeighbours) {
  double before = 1;
  for (const double ratio : {2.0, 4.0, 1e6}) {
    Monitor monitor;
    const auto session = testing::session_of_size(comb(flat, 100), 2, monitor);
    session->parameters().set("CheckAdjacentEdges", 20);
    session->parameters().set("adjacent_ratio", ratio);
    session->make_mesh();
    const SurfaceMesh& mesh = session->mesh();
    std::map<std::int32_t, std::vector<double>> at;  // by vertex, lengths of edges of curves
    for (const CurveMesh& curve : mesh.curves)
      for (std::size_t k = 1; k < curve.vertices.size(); ++k)
        for (const std::int32_t v : {curve.vertices[k - 1], curve.vertices[k]})
          at[v].push_back(norm(mesh.vertices[curve.vertices[k]] - mesh.vertices[curve.vertices[k - 1]]));
    double largest = 1;
    for (const auto& [v, lengths] : at) {
      const auto [low, high] = std::minmax_element(lengths.begin(), lengths.end());
      largest = std::max(largest, *high / *low);
    }
    EXPECT_LE(largest, ratio * (1 + 1e-8));
    EXPECT_GT(largest, before * (1 + 1e-8)) << "the parameter does nothing";
    before = largest;
  }
  EXPECT_NEAR(before, 20, 1e-9);
}

TEST(ShortEdges, LetTrianglesGrow) {
  for (const auto surface : {flat, saddle})
    for (const int pieces : {20, 60, 150}) {
      SCOPED_TRACE(pieces);
      Monitor monitor;
      const AnalyticCad cad = comb(surface, pieces);
      const Shapes abrupt = shapes_of(meshed(cad, 2, 0, monitor)->mesh());
      const auto session = meshed(cad, 2, 1.5, monitor);
      const Shapes grown = shapes_of(session->mesh());
      EXPECT_EQ(find_defects(session->mesh(), {.limit = 5}), std::vector<std::string>{});
      EXPECT_GT(grown.mean, 0.9);
      EXPECT_GT(grown.worst, 0.5);
      EXPECT_GT(grown.mean, abrupt.mean);
      EXPECT_GE(grown.worst, abrupt.worst);
      // The area over the area of triangles whose sizes grow from 10 / pieces by ln 1.5 times the distance: 1 / (l s)
      // for each unit of the comb, and triangles of size 2 beyond. Twice as many are too many.
      const double l = 10. / pieces, s = std::log(1.5);
      const double expected = 4 / std::sqrt(3.) * (10 * (1 / l - 0.5) / s + 100 / 4.);
      EXPECT_LT(static_cast<double>(grown.count), 2 * expected);
    }
}

// Sizes are never below the shortest edge's, nor above the prescribed size.
TEST(ShortEdges, SizesStayBetweenTheirsAndThePrescribedOne) {
  Monitor monitor;
  const auto session = meshed(comb(flat, 40), 2, 1.5, monitor);
  ASSERT_EQ(session->mesh().vertices.size(), session->vertex_sizes().size());
  double smallest = 2, largest = 0;
  for (const double h : session->vertex_sizes()) smallest = std::min(smallest, h), largest = std::max(largest, h);
  EXPECT_GE(smallest, 0.25 * (1 - 1e-9));
  EXPECT_LE(largest, 2);
}

// Without short edges the meshes are identical.
TEST(ShortEdges, WithoutThemNothingChanges) {
  Monitor monitor;
  const auto positions = [&](double ratio) {
    std::vector<double> all;
    const auto session = meshed(comb(saddle, 12), 0.8, ratio, monitor);
    for (const auto& v : session->mesh().vertices) all.insert(all.end(), {v.x(), v.y(), v.z()});
    return all;
  };
  EXPECT_EQ(positions(0), positions(1.2));
}

}  // namespace
}  // namespace carreau
