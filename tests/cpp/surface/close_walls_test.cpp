// SPDX-License-Identifier: BSD-3-Clause
// Coarse chords of surfaces close to each other cross; smaller triangles do not.
#include <gtest/gtest.h>

#include <numbers>

#include "geometric_run.h"
#include "mesh/crossings/intersections.h"
#include "session_of_size.h"

namespace carreau {
namespace {

using std::numbers::pi;
using testing::AnalyticCad;

/// Spheres of radius 1 about 0 and of `radius` about (shift, 0, 0); their triangles are nowhere in step.
AnalyticCad spheres(double radius, double shift) {
  const auto sphere = [](double r, double x) {
    return testing::AnalyticFace{[=](Vec2 p) {
                                   SurfaceJet jet = testing::ellipsoid_jet(p, {r, r, r});
                                   jet.s += Vec3{x, 0, 0};
                                   return jet;
                                 },
                                 testing::rectangle({0, -pi / 2}, {2 * pi, pi / 2})};
  };
  AnalyticCad cad;
  cad.faces[1] = sphere(1, 0);
  cad.faces[2] = sphere(radius, shift);
  return cad;
}

/// Each face glued to itself alone: the seam, and sides that are points.
Model model_of_spheres() {
  Model model;
  for (int f = 0; f < 2; ++f) {
    Face face;
    face.ref = f + 1;
    const int ref = 10 * f, south = 2 * f + 1, north = 2 * f + 2;
    face.curves = {{.ref = ref + 1, .end1 = south, .end2 = south},
                   {.ref = ref + 2, .end1 = south, .end2 = north},
                   {.ref = ref + 3, .end1 = north, .end2 = north},
                   {.ref = ref + 2, .end1 = north, .end2 = south}};
    model.faces.push_back(face);
  }
  return model;
}

std::unique_ptr<Session> meshed(const AnalyticCad& cad, int rounds, int threads, Monitor& monitor) {
  auto session = testing::session_of_command(cad, 0.5, monitor);
  session->set_model(model_of_spheres());
  session->parameters().set("crossing_rounds", rounds);
  session->parameters().set("threads", threads);
  session->make_mesh();
  EXPECT_EQ(find_defects(session->mesh(), {.limit = 5}), std::vector<std::string>{});
  return session;
}

Intersections all_crossings(const SurfaceMesh& mesh) {
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const FaceMesh& face : mesh.faces)
    for (const auto& [a, b, c] : face.triangles) triangles.push_back({face.vertex[a], face.vertex[b], face.vertex[c]});
  Monitor silent;
  return find_intersections(mesh.vertices, triangles, {}, silent);
}
std::int64_t crossings(const SurfaceMesh& mesh) { return all_crossings(mesh).count; }

// The crossings that meshing has found equal the result of a search in its mesh.
void expect_known(const Session& session) {
  const Intersections found = all_crossings(session.mesh());
  ASSERT_TRUE(session.knows_crossings(found.pairs.size()));
  EXPECT_EQ(session.report().crossings, found.count);
  ASSERT_GE(session.crossings().size(), found.pairs.size());
  for (std::size_t i = 0; i < found.pairs.size(); ++i) {
    EXPECT_EQ(session.crossings()[i].triangles, found.pairs[i].triangles);
    EXPECT_EQ(session.crossings()[i].place, found.pairs[i].place);
  }
}

bool equal(const SurfaceMesh& a, const SurfaceMesh& b) {
  if (a.vertices != b.vertices || a.faces.size() != b.faces.size()) return false;
  for (std::size_t f = 0; f < a.faces.size(); ++f)
    if (a.faces[f].triangles != b.faces[f].triangles) return false;
  return true;
}

TEST(CloseWalls, ThatCrossByTheirChordsAreParted) {
  for (const double gap : {0.03, 0.01}) {
    SCOPED_TRACE(gap);
    Monitor monitor;
    const AnalyticCad cad = spheres(1 - gap, 0);
    EXPECT_GT(crossings(meshed(cad, 0, 1, monitor)->mesh()), 50);
    const auto parted = meshed(cad, 10, 1, monitor);
    EXPECT_EQ(crossings(parted->mesh()), 0);
    EXPECT_TRUE(equal(parted->mesh(), meshed(cad, 10, 4, monitor)->mesh()));
    // An edge of length h leaves the sphere by h^2 / 8, a triangle by h^2 / 6: edges need not be below half of the
    // distance of the walls.
    const double h = std::sqrt(6 * gap) / 2, area = 4 * pi * (1 + (1 - gap) * (1 - gap));
    EXPECT_LT(static_cast<double>(parted->mesh().triangle_count()), area / (std::sqrt(3.) / 4 * h * h));
  }
}

TEST(CloseWalls, ThatCrossOrCoincideThemselvesStayAsTheyAre) {
  Monitor monitor;
  for (const double shift : {0.0, 0.4}) {
    SCOPED_TRACE(shift);
    const AnalyticCad cad = spheres(1, shift);
    const auto as_it_is = meshed(cad, 0, 1, monitor), tried = meshed(cad, 10, 1, monitor);
    EXPECT_GT(crossings(as_it_is->mesh()), 0);
    EXPECT_TRUE(equal(as_it_is->mesh(), tried->mesh()));
    EXPECT_FALSE(as_it_is->knows_crossings(0));  // no search yet
    expect_known(*tried);
  }
}

// Points that the host evaluates for a mesh count its work.
TEST(CloseWalls, RoundsCostAtMostAsMuchAsTheFirstMesh) {
  for (const double gap : {1e-2, 1e-3, 1e-4}) {
    SCOPED_TRACE(gap);
    Monitor monitor;
    const auto points = [&](int rounds) {
      auto session = testing::session_of_command(spheres(1 - gap, 0), 0.06, monitor);
      session->set_model(model_of_spheres());
      session->parameters().set("crossing_rounds", rounds);
      session->make_mesh();
      EXPECT_EQ(find_defects(session->mesh(), {.limit = 5}), std::vector<std::string>{});
      return static_cast<double>(session->report().calls.surf0);
    };
    EXPECT_LE(points(20), 2 * points(0));
  }
}

TEST(CloseWalls, EffortBoundsTheWorkOfRounds) {
  for (const double gap : {1e-2, 1e-3, 1e-4}) {
    SCOPED_TRACE(gap);
    Monitor monitor;
    const auto points = [&](int effort) {
      auto session = testing::session_of_command(spheres(1 - gap, 0), 0.06, monitor);
      session->set_model(model_of_spheres());
      session->parameters().set("effort", effort);
      session->parameters().set("shape_trials", 0);
      session->make_mesh();
      return static_cast<double>(session->report().calls.surf0);
    };
    const double first = points(0);
    EXPECT_LE(points(1), 2 * first);
    EXPECT_LE(points(2), 3 * first);
  }
}

TEST(CloseWalls, LevelsOfEffortMatchTheSynonyms) {
  Monitor monitor;
  const AnalyticCad cad = spheres(0.97, 0);
  const auto at = [&](int effort, int rounds, int trials) {
    auto session = testing::session_of_command(cad, 0.5, monitor);
    session->set_model(model_of_spheres());
    if (effort >= 0) session->parameters().set("effort", effort);
    if (effort < 0) session->parameters().set("crossing_rounds", rounds), session->parameters().set("shape_trials", trials);
    session->make_mesh();
    return session;
  };
  EXPECT_TRUE(equal(at(0, 0, 0)->mesh(), at(-1, 0, 0)->mesh()));
  EXPECT_TRUE(equal(at(1, 0, 0)->mesh(), at(-1, 10, 1)->mesh()));
  EXPECT_FALSE(equal(at(0, 0, 0)->mesh(), at(1, 0, 0)->mesh()));
}

}  // namespace
}  // namespace carreau
