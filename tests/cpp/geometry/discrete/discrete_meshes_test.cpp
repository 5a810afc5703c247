// SPDX-License-Identifier: BSD-3-Clause
// Surfaces given as triangles through the session.
#include <gtest/gtest.h>

#include "geometry/discrete/discrete_cad.h"
#include "geometry/discrete/refinement.h"
#include "mesh/quality.h"
#include "mesh/triangle_search.h"
#include "session/session.h"
#include "surfaces.h"

namespace carreau::discrete {
namespace {

BuiltGeometry geometry(const FlatMesh& mesh, const SharpOptions& options = {}) {
  return discrete_geometry(std::make_shared<const DiscreteSurface>(surface_of(mesh, options)));
}

struct Made {
  SurfaceMesh mesh;
  MeshEvaluation delivered;
};

Made mesh_of(const BuiltGeometry& built, double size, double angle, bool closed, int threads = 1,
             double gradation = 0) {
  Monitor silent;
  Session session(silent);
  session.set_cad(built.cad);
  session.set_model(built.model);
  session.parameters().set("threads", threads);
  session.parameters().set("hphy_flag", size > 0 ? 1 : 0);
  if (size > 0) session.parameters().set("hphydef", size);
  if (angle > 0) session.parameters().set("hgeo_flag", 1), session.parameters().set("angle_mesh", angle);
  session.parameters().set("gradation", gradation);
  session.make_mesh();
  EXPECT_EQ(find_defects(session.mesh(), {.closed = closed}), std::vector<std::string>{});
  return {session.mesh(), session.delivered()};
}

std::int64_t euler_number_of(const SurfaceMesh& mesh) {
  return static_cast<std::int64_t>(mesh.vertices.size()) - static_cast<std::int64_t>(mesh.triangle_count() / 2);
}

double mean_quality(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles) {
      const auto at = [&](std::size_t k) {
        return mesh.vertices[static_cast<std::size_t>(face.vertex[static_cast<std::size_t>(t[k])])];
      };
      sum += quality_q2(at(0), at(1), at(2));
    }
  return sum / static_cast<double>(mesh.triangle_count());
}

TEST(DiscreteMeshes, ATorusHasThePrescribedSizesAndLiesOnItsSurface) {
  const BuiltGeometry built = geometry(torus(48, 24));
  for (const double size : {0.12, 0.4}) {  // finer and coarser than the triangles
    const Made made = mesh_of(built, size, 0, true);
    EXPECT_EQ(euler_number_of(made.mesh), 0);
    for (const Vec3& p : made.mesh.vertices) EXPECT_LT(distance_to_torus(p), 2e-4);
    EXPECT_GT(mean_quality(made.mesh), 0.93);
    const Delivery& length = made.delivered[EvaluationKind::length];
    EXPECT_GT(length.spread.mean, 0.9);
    EXPECT_LT(length.spread.mean, 1.15);
    EXPECT_GT(length.spread.p1, 0.6);
    EXPECT_LT(length.spread.p99, 1.5);
    EXPECT_GT(made.delivered[EvaluationKind::metric_quality].spread.min, 0.3);
  }
}

// Halved edges have vertices of six neighbours: irregular ones are a sixth of all at most, and shapes as good as that lets them be. The degrees of a closed
// surface sum up to 6 V - 6 chi.
TEST(DiscreteMeshes, MostVerticesHaveSixNeighbours) {
  for (const auto& [built, size, chi] : {std::tuple{geometry(torus(48, 24)), 0.1, 0}, {geometry(sphere(6)), 0.07, 2}}) {
    const SurfaceMesh mesh = mesh_of(built, size, 0, true).mesh;
    std::vector<int> degree(mesh.vertices.size(), 0);
    for (const FaceMesh& face : mesh.faces)
      for (const auto& t : face.triangles)
        for (const std::int32_t v : t) ++degree[static_cast<std::size_t>(face.vertex[static_cast<std::size_t>(v)])];
    std::int64_t sum = 0, irregular = 0;
    for (const int d : degree) sum += d, irregular += d != 6 ? 1 : 0;
    EXPECT_EQ(sum, 6 * static_cast<std::int64_t>(degree.size()) - 6 * chi);
    EXPECT_LE(static_cast<double>(irregular), static_cast<double>(degree.size()) / 6);
    EXPECT_GE(mean_quality(mesh), 0.98);
  }
}

// Against the smooth surface, cut so fine that its triangles are it: places of a triangle are no farther from it than the bound.
TEST(DiscreteMeshes, BoundsHoldAgainstTheSmoothSurface) {
  const auto surface = std::make_shared<const DiscreteSurface>(surface_of(torus(24, 12), {}));
  Monitor silent;
  const RefinedMesh fine = refine(*surface, wish_of_angle(*surface, 0.7), {}, silent);
  const TriangleSearch search(fine.vertices, fine.triangles);
  const Made made = mesh_of(discrete_geometry(surface), 0.4, 0, true);
  const Delivery &bound = made.delivered[EvaluationKind::deviation_bound], &angle = made.delivered[EvaluationKind::angle_bound];
  double farthest = 0;
  std::size_t t = 0;
  for (const FaceMesh& face : made.mesh.faces)
    for (const auto& c : face.triangles) {
      std::array<Vec3, 3> p;
      for (std::size_t i = 0; i < 3; ++i) p[i] = made.mesh.vertices[static_cast<std::size_t>(face.vertex[static_cast<std::size_t>(c[i])])];
      constexpr int n = 12;
      for (int j = 0; j <= n; ++j)
        for (int k = 0; j + k <= n; ++k) {
          const double b = static_cast<double>(j) / n, d = static_cast<double>(k) / n;
          const double distance = search.nearest((1 - b - d) * p[0] + b * p[1] + d * p[2]).distance;
          ASSERT_GE(bound.values[t], distance - 1e-4) << t;
          farthest = std::max(farthest, distance);
        }
      ASSERT_GE(angle.values[t], made.delivered[EvaluationKind::angle].values[t]);
      ++t;
    }
  EXPECT_GT(farthest, 0.01);
  EXPECT_LE(bound.spread.max, 1.3 * farthest);
  EXPECT_EQ(bound.spread.count, static_cast<std::int64_t>(t));
}

TEST(DiscreteMeshes, TheSameForAnyNumberOfThreads) {
  const BuiltGeometry built = geometry(torus(24, 12));
  const SurfaceMesh one = mesh_of(built, 0.2, 0, true, 1).mesh, four = mesh_of(built, 0.2, 0, true, 4).mesh;
  EXPECT_EQ(one.vertices, four.vertices);
  EXPECT_EQ(one.faces[0].triangles, four.faces[0].triangles);
}

TEST(DiscreteMeshes, ACubeKeepsItsLinesAndCorners) {
  const SurfaceMesh mesh = mesh_of(geometry(cube(3)), 0.1, 0, true).mesh;
  EXPECT_EQ(euler_number_of(mesh), 2);
  ASSERT_EQ(mesh.faces.size(), 6u);
  EXPECT_EQ(mesh.curves.size(), 12u);
  double area = 0;
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles) {
      const auto at = [&](std::size_t k) {
        return mesh.vertices[static_cast<std::size_t>(face.vertex[static_cast<std::size_t>(t[k])])];
      };
      area += norm(cross(at(1) - at(0), at(2) - at(0))) / 2;
    }
  EXPECT_NEAR(area, 6, 1e-12);
  for (const CurveMesh& curve : mesh.curves) {
    EXPECT_EQ(curve.vertices.size(), 11u);
    EXPECT_EQ(curve.uses.size(), 2u);
  }
}

TEST(DiscreteMeshes, AnglesFollowTheCurvature) {
  const Made made = mesh_of(geometry(cylinder(36)), 0, 8, true);
  // Curvature 1: h = 2 sin(8 degrees).
  const Delivery& angle = made.delivered[EvaluationKind::angle];
  EXPECT_LT(angle.spread.p99, 12);
  for (const CurveMesh& curve : made.mesh.curves)
    EXPECT_NEAR(static_cast<double>(curve.vertices.size() - 1),
                2 * std::numbers::pi / (2 * std::sin(8 * std::numbers::pi / 180)), 4);
}

// Quadrilaterals come from triangles that are twice as large: their edges have the sizes of the rule.
TEST(DiscreteMeshes, AnglesOfQuadrilateralsFollowTheCurvature) {
  const BuiltGeometry built = geometry(cylinder(36));
  Monitor silent;
  Session session(silent);
  session.set_cad(built.cad);
  session.set_model(built.model);
  session.parameters().set("hphy_flag", 0);
  session.parameters().set("hgeo_flag", 1);
  session.parameters().set("angle_mesh", 8);
  session.parameters().set("element", "q1.1");
  session.make_mesh();
  for (const CurveMesh& curve : session.mesh().curves)
    EXPECT_NEAR(static_cast<double>(curve.vertices.size() - 1),
                2 * std::numbers::pi / (2 * std::sin(8 * std::numbers::pi / 180)), 4);
}

TEST(DiscreteMeshes, OpenSurfacesKeepTheirBorders) {
  FlatMesh open = cylinder(36);
  std::erase_if(open.triangles, [&](const auto& t) { return std::find(t.begin(), t.end(), 72) != t.end(); });
  const SurfaceMesh mesh = mesh_of(geometry(open), 0.15, 0, false).mesh;
  int borders = 0;
  for (const CurveMesh& curve : mesh.curves) borders += curve.uses.size() == 1 ? 1 : 0;
  EXPECT_EQ(borders, 1);
}

TEST(DiscreteMeshes, EdgesWithThreeTrianglesStay) {
  FlatMesh fins;
  fins.vertices = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}};
  fins.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const SurfaceMesh mesh = mesh_of(geometry(fins), 0.1, 0, false).mesh;
  int threefold = 0;
  for (const CurveMesh& curve : mesh.curves) threefold += curve.uses.size() == 3 ? 1 : 0;
  EXPECT_EQ(threefold, 1);
}

}  // namespace
}  // namespace carreau::discrete
