// SPDX-License-Identifier: BSD-3-Clause
// Cross-patch meshes are within the tolerances of A0 and A1, by upper bounds, also if sizes are as large as the surface bends.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "euler_number.h"
#include "independent/patchworks.h"
#include "mesh/surface_mesh.h"
#include "session_of_size.h"
#include "surface/remesh/base/sharp_edges.h"
#include "surface/remesh/certify/certification.h"
#include "surface/remesh/edits/remeshing.h"

namespace carreau {
namespace {

using namespace testing;

constexpr double pi = std::numbers::pi;

std::unique_ptr<Session> meshed(const AnalyticCad& cad, double size, int certify, int threads = 1) {
  static Monitor quiet;
  auto session = session_of_size(cad, size, quiet);
  session->parameters().set("patches", "independent");
  session->parameters().set("certify", certify);
  session->parameters().set("threads", threads);
  session->make_mesh();
  return session;
}

const Delivery& shares(Session& session) { return session.delivered()[EvaluationKind::bound_share]; }

void expect_no_worse(const Session& made, const Session& before) {
  EXPECT_TRUE(find_defects(made.mesh()).empty());
  EXPECT_EQ(euler_number(made.mesh()), euler_number(before.mesh()));
}

/// A torus of radius 1 around the axis, cut into 12 by 8 patches.
AnalyticCad torus_of_patches(double tube) {
  AnalyticCad cad;
  add_grid(
      cad, 1,
      [tube](Vec2 p) {
        const double c = std::cos(p.x()), s = std::sin(p.x()), a = tube * std::cos(p.y()), b = tube * std::sin(p.y()), r = 1 + a;
        return SurfaceJet{{r * c, r * s, b}, {-r * s, r * c, 0}, {-b * c, -b * s, a}, {-r * c, -r * s, 0}, {b * s, -b * c, 0}, {-a * c, -a * s, -b}};
      },
      {0, 0}, {2 * pi, 2 * pi}, 12, 8);
  return cad;
}

/// Apex at the origin, height 4, open; cut from the apex on.
AnalyticCad cone_of_strips(double radius, int strips) {
  AnalyticCad cad;
  const double k = radius / 4;
  add_grid(
      cad, 1,
      [k](Vec2 p) {
        const double c = k * std::cos(p.x()), s = k * std::sin(p.x()), v = p.y();
        return SurfaceJet{{v * c, v * s, v}, {-v * s, v * c, 0}, {c, s, 1}, {-v * c, -v * s, 0}, {-s, c, 0}, {0, 0, 0}};
      },
      {0, 0}, {2 * pi, 4}, strips, 1);
  return cad;
}

// The tube bends by more than the size lets triangles: without edits some lean too much.
TEST(Certification, ThinTorusIsWithinItsTolerances) {
  const AnalyticCad cad = torus_of_patches(0.2);
  for (const double size : {0.25, 0.35}) {
    const auto before = meshed(cad, size, 0), made = meshed(cad, size, 1);
    EXPECT_GT(shares(*before).beyond, 0);
    EXPECT_EQ(shares(*made).beyond, 0) << size << ": " << shares(*made).spread.max;
    EXPECT_TRUE(beyond_in_faces(made->mesh(), made->delivered()).empty());
    expect_no_worse(*made, *before);
  }
}

// A mean shape above .95 would fall below it for seven triangles that are half a per cent beyond: they stay, and are
// reported.
TEST(Certification, KeepsAGoodMeanShape) {
  const AnalyticCad cad = torus_of_patches(0.2);
  const auto before = meshed(cad, 0.3, 0), made = meshed(cad, 0.3, 1);
  EXPECT_GT(shares(*before).beyond, 0);
  EXPECT_GE(made->quality().q2.mean, 0.95);
  EXPECT_EQ(shares(*made).beyond, shares(*before).beyond);
  EXPECT_FALSE(beyond_in_faces(made->mesh(), made->delivered()).empty());
  EXPECT_EQ(before->exported().triangles, made->exported().triangles);
}

// Remaining tolerance violations are reported by face.
TEST(Certification, FacesReportToleranceViolations) {
  const auto before = meshed(torus_of_patches(0.2), 0.3, 0);
  const std::vector<BeyondInFace> beyond = beyond_in_faces(before->mesh(), before->delivered());
  ASSERT_FALSE(beyond.empty());
  std::int64_t sum = 0;
  for (const BeyondInFace& face : beyond) {
    sum += face.triangles;
    EXPECT_GT(face.worst, 1);
    EXPECT_GE(face.ref, 1);
    EXPECT_LE(face.ref, 96);
  }
  EXPECT_EQ(sum, shares(*before).beyond);
  EXPECT_EQ(beyond.front().worst, shares(*before).spread.max);
}

// On both sides of the seam, triangles at the apex agree with the normals of the cone, and they are many enough.
TEST(Certification, ApexOfACone) {
  std::int64_t beyond = 0;
  for (const double radius : {1.2, 2.})
    for (const int strips : {1, 2, 4}) {
      const AnalyticCad cad = cone_of_strips(radius, strips);
      const auto before = meshed(cad, 0.3, 0), made = meshed(cad, 0.3, 1);
      beyond += shares(*before).beyond;
      EXPECT_EQ(before->delivered().folded_triangles, 0);
      EXPECT_EQ(shares(*made).beyond, 0) << radius << " " << strips << ": " << shares(*made).spread.max;
      expect_no_worse(*made, *before);
    }
  EXPECT_GT(beyond, 0);
}

// If the size alone keeps the tolerances nothing is edited.
TEST(Certification, SizesWithinTolerancesStay) {
  for (const AnalyticCad& cad : {cylinder_of_strips(24), sphere_of_triangles(2)}) {
    const auto before = meshed(cad, 0.8, 0), made = meshed(cad, 0.8, 2);
    EXPECT_EQ(shares(*made).beyond, 0);
    EXPECT_EQ(before->exported().vertices, made->exported().vertices);
    EXPECT_EQ(before->exported().triangles, made->exported().triangles);
  }
}

// Edits that made the mesh stay, and vertices are where they were.
TEST(Certification, UndoesItsOwnEditsAlone) {
  Monitor quiet;
  AnalyticCad cad = torus_of_patches(0.2);
  auto session = session_of_size(cad, 0.25, quiet);
  session->make_mesh();
  const SurfaceMesh& mesh = session->mesh();
  const std::vector<double>& sizes = session->vertex_sizes();
  const Charts charts(mesh, {}, sizes, {}, quiet);
  const SurfaceTolerances tolerances{.angle_deg = 30, .deviation = 0, .share_of_size = 0.3};
  CrossPatchMesh free(mesh, evaluate_vertices(mesh, cad, quiet), sizes, {}, {}, tolerances, charts, cad);
  (void)remesh(free, quiet, true, false);
  ASSERT_GT(free.edits(), 0u);
  const auto triangles = free.triangles();
  std::vector<Vec3> places;
  for (std::size_t v = 0; v < free.vertices(); ++v) places.push_back(free.position(static_cast<std::int32_t>(v)));
  Certifier certifier(free, true, {}, quiet);
  ASSERT_TRUE(certifier.run().has_edits());
  EXPECT_NE(free.triangles(), triangles);
  certifier.undo();
  EXPECT_EQ(free.triangles(), triangles);
  ASSERT_EQ(free.vertices(), places.size());
  for (std::size_t v = 0; v < places.size(); ++v) EXPECT_EQ(free.position(static_cast<std::int32_t>(v)), places[v]);
}

TEST(Certification, MeshDoesNotDependOnThreads) {
  const AnalyticCad cad = torus_of_patches(0.2);
  const auto one = meshed(cad, 0.25, 1, 1), several = meshed(cad, 0.25, 1, 4);
  EXPECT_EQ(one->exported().vertices, several->exported().vertices);
  EXPECT_EQ(one->exported().triangles, several->exported().triangles);
}

}  // namespace
}  // namespace carreau
