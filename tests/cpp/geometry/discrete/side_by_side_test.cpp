// SPDX-License-Identifier: BSD-3-Clause
// Several surfaces of triangles, and triangles beside patches.
#include "geometry/discrete/side_by_side.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cad/cad_assembly.h"
#include "geometry/bezier/bezier_geometry.h"
#include "geometry/discrete/discrete_cad.h"
#include "geometry/discrete/refinement.h"
#include "model/geometries.h"
#include "session/session.h"
#include "support/error.h"
#include "surfaces.h"

namespace carreau::discrete {
namespace {

std::shared_ptr<const DiscreteSurface> shared(const FlatMesh& mesh, const SharpOptions& options = {}) {
  return std::make_shared<const DiscreteSurface>(surface_of(mesh, options));
}

/// Triangles of which `keep` holds at the centre, without vertices that are not in use.
template <typename Keep>
FlatMesh part_of(const FlatMesh& mesh, Keep&& keep) {
  FlatMesh part;
  for (const auto& t : mesh.triangles) {
    const auto at = [&](std::size_t k) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    if (!keep(Vec3{(at(0) + at(1) + at(2)) / 3})) continue;
    const auto n = static_cast<std::int32_t>(part.vertices.size());
    for (std::size_t k = 0; k < 3; ++k) part.vertices.push_back(at(k));
    part.triangles.push_back({n, n + 1, n + 2});
  }
  return part;
}

FlatMesh moved(FlatMesh mesh, const Vec3& by) {
  for (Vec3& p : mesh.vertices) p += by;
  return mesh;
}

struct Joined {
  std::shared_ptr<const DiscreteSurface> surface;
  std::vector<std::string> sentences;
};
Joined joined(const std::vector<FlatMesh>& meshes) {
  std::vector<PlacedSurface> placed;
  std::int32_t next = 1;
  for (const FlatMesh& mesh : meshes) {
    placed.push_back({shared(mesh), next});
    next += std::ranges::max(face_refs(*placed.back().surface));
  }
  Joined made;
  made.surface = side_by_side(placed, made.sentences);
  return made;
}

SurfaceMesh meshed(const std::shared_ptr<const DiscreteSurface>& surface, double size, int threads = 1) {
  const BuiltGeometry built = discrete_geometry(surface);
  Monitor silent;
  Session session(silent);
  session.set_cad(built.cad);
  session.set_model(built.model);
  session.parameters().set("hphydef", size);
  session.parameters().set("threads", threads);
  session.make_mesh();
  return session.mesh();
}

TEST(SideBySide, OneSurfaceWithItsNumbersIsItself) {
  const auto one = shared(cube(2));
  std::vector<std::string> sentences;
  EXPECT_EQ(side_by_side(std::vector<PlacedSurface>{{one, 1}}, sentences), one);
  const auto behind = side_by_side(std::vector<PlacedSurface>{{one, 11}}, sentences);
  EXPECT_EQ(behind->triangles(), one->triangles());
  const std::vector<std::int32_t> refs = face_refs(*behind), own = face_refs(*one);
  for (std::size_t t = 0; t < refs.size(); ++t) EXPECT_EQ(refs[t], own[t] + 10);
  EXPECT_EQ(behind->lines().lines.size(), 12u);
  EXPECT_EQ(behind->lines().corners, one->lines().corners);
  EXPECT_TRUE(sentences.empty());
}

TEST(SideBySide, TwoSpheresHaveNothingInCommon) {
  const Joined two = joined({sphere(4), moved(sphere(3), {3, 0, 0})});
  EXPECT_EQ(two.surface->mesh().findings.shells, 2);
  EXPECT_EQ(two.surface->mesh().findings.euler_number, 4);
  EXPECT_EQ(two.surface->lines().edges, 0);
  EXPECT_TRUE(two.sentences.empty());
  const SurfaceMesh mesh = meshed(two.surface, 0.3);
  EXPECT_EQ(find_defects(mesh, {.closed = true}), std::vector<std::string>{});
  ASSERT_EQ(mesh.faces.size(), 2u);
  for (std::size_t f = 0; f < 2; ++f) {
    EXPECT_EQ(mesh.faces[f].ref, static_cast<int>(f) + 1);
    EXPECT_GT(mesh.faces[f].triangles.size(), 160u);  // the area has 322 of the size, of edges sqrt(2) longer half as many
    for (const std::int32_t v : mesh.faces[f].vertex) {
      const Vec3 p = mesh.vertices[static_cast<std::size_t>(v)] - Vec3{3.0 * static_cast<double>(f), 0, 0};
      EXPECT_NEAR(norm(p), 1, 2e-3);
    }
  }
}

// Upper and lower half of a cube, open at the cut: one closed mesh of ten sides, whose loop of four lines both share.
TEST(SideBySide, HalvesThatShareALoopConformThere) {
  const FlatMesh whole = cube(4);
  const auto is_low = [](const Vec3& p) { return p.z() < 0.5; };
  const Joined halves = joined({part_of(whole, is_low), part_of(whole, [&](const Vec3& p) { return !is_low(p); })});
  const Triangulation& mesh = halves.surface->mesh();
  EXPECT_EQ(mesh.findings.border_edges, 0);
  EXPECT_EQ(mesh.findings.shells, 1);
  EXPECT_EQ(mesh.findings.euler_number, 2);
  EXPECT_EQ(mesh.triangles.size(), whole.triangles.size());
  ASSERT_EQ(halves.sentences.size(), 1u);
  EXPECT_EQ(halves.sentences[0], "16 vertices belong to other surfaces of triangles, too: the meshes are joined there");
  EXPECT_EQ(halves.surface->lines().lines.size(), 8u + 8 + 4);
  EXPECT_EQ(halves.surface->lines().corners.size(), 12u);
  EXPECT_EQ(halves.surface->lines().regions, 10);
  const SurfaceMesh made = meshed(halves.surface, 0.1);
  EXPECT_EQ(find_defects(made, {.closed = true}), std::vector<std::string>{});
  EXPECT_EQ(made.faces.size(), 10u);
  for (const FaceMesh& face : made.faces) EXPECT_FALSE(face.triangles.empty()) << face.ref;
  int shared_lines = 0;
  for (const CurveMesh& curve : made.curves) {
    ASSERT_EQ(curve.uses.size(), 2u);
    const bool between = (curve.uses[0].face < 5) != (curve.uses[1].face < 5);
    if (!between) continue;
    ++shared_lines;
    for (const std::int32_t v : curve.vertices) EXPECT_NEAR(made.vertices[static_cast<std::size_t>(v)].z(), 0.5, 1e-12);
  }
  EXPECT_EQ(shared_lines, 4);
}

// A border between two smooth halves is a line, but no crease: the sphere is as round there as elsewhere.
TEST(SideBySide, HalvesOfASphereMeetInOneLine) {
  FlatMesh whole;  // an octahedron has an equator of edges
  whole.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  whole.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  const FlatMesh fine = cut(whole, 8, [](const Vec3& p) -> Vec3 { return p.normalized(); });
  const Joined halves = joined({part_of(fine, [](const Vec3& p) { return p.z() > 0; }),
                                part_of(fine, [](const Vec3& p) { return p.z() < 0; })});
  ASSERT_EQ(halves.surface->lines().lines.size(), 1u);
  EXPECT_TRUE(halves.surface->lines().lines[0].closed());
  EXPECT_EQ(halves.surface->lines().edges, 32);
  const SurfaceMesh one = meshed(halves.surface, 0.15), four = meshed(halves.surface, 0.15, 4);
  EXPECT_EQ(find_defects(one, {.closed = true}), std::vector<std::string>{});
  EXPECT_EQ(one.vertices, four.vertices);
  ASSERT_EQ(one.curves.size(), 1u);
  for (const Vec3& p : one.vertices) EXPECT_NEAR(norm(p), 1, 5e-3);
}

TEST(SideBySide, CommonTrianglesBelongToTheFirst) {
  const FlatMesh base = cube(2);
  const Joined boxes = joined({base, moved(base, {1, 0, 0})});  // a wall in common
  EXPECT_EQ(boxes.surface->mesh().findings.repeated_triangles, 8);
  EXPECT_EQ(boxes.surface->mesh().findings.manifold_breaks, 8);
  EXPECT_EQ(boxes.surface->mesh().triangles.size(), 2 * base.triangles.size() - 8);
  const std::vector<std::int32_t> refs = face_refs(*boxes.surface);
  EXPECT_EQ(std::set<std::int32_t>(refs.begin(), refs.end()).size(), 11u);
  ASSERT_EQ(boxes.sentences.size(), 3u);
  EXPECT_EQ(boxes.sentences[1], "8 triangles belong to earlier surfaces: dropped");
  EXPECT_EQ(boxes.sentences[2], "8 edges have three triangles or more of several surfaces");
  const SurfaceMesh made = meshed(boxes.surface, 0.2);
  EXPECT_EQ(find_defects(made), std::vector<std::string>{});
}

/// z = u v over the square [3, 4] x [0, 1].
BuiltGeometry saddle() {
  return build_bezier({.patches = {{.m = 1, .n = 1, .control = {{3, 0, 0}, {3, 1, 0}, {4, 0, 0}, {4, 1, 1}}}}, .side_refs = {}});
}

struct Beside {
  Monitor silent;
  Session session{silent};
  void set(double size, bool independent) {
    session.parameters().set("hphydef", size);
    session.parameters().set("hphymin", size / 100), session.parameters().set("hphymax", 2 * size);
    session.parameters().set("patches", independent ? "independent" : "dependent");
  }
};

// A cube, whose lines are numbered behind the four of the patch.
TEST(SideBySide, TrianglesBesideAPatchAreMeshedAsEachAlone) {
  const auto own = shared(cube(2));
  for (const bool independent : {false, true})
    for (const bool patch_first : {true, false}) {
      const BuiltGeometry patch = saddle();
      Model model;
      std::vector<std::string> sentences;
      GeometryRange of_patch;
      if (patch_first) of_patch = append_geometry(model, patch.model);
      const int first = largest_references(model).face + 1;
      const auto placed = side_by_side(std::vector<PlacedSurface>{{own, first}}, sentences);
      const auto triangles = std::make_shared<DiscreteCad>(placed);
      const GeometryRange of_cube = append_geometry(model, discrete_geometry(own).model);
      if (!patch_first) of_patch = append_geometry(model, patch.model);
      std::vector<CadAssembly::Part> parts{{patch.cad, of_patch.first_face, of_patch.last_face, of_patch.first_point, of_patch.last_point},
                                           {triangles, of_cube.first_face, of_cube.last_face, 1, 0}};
      if (!patch_first) std::swap(parts[0], parts[1]);
      Beside both, patch_alone, cube_alone;
      for (Beside* each : {&both, &patch_alone, &cube_alone}) each->set(0.2, independent);
      both.session.set_triangles(triangles);
      both.session.set_cad(std::make_shared<CadAssembly>(nullptr, parts));
      both.session.set_model(model);
      both.session.make_mesh();
      patch_alone.session.set_cad(patch.cad);
      patch_alone.session.set_model(patch.model);
      patch_alone.session.make_mesh();
      const BuiltGeometry cube_built = discrete_geometry(own);
      cube_alone.session.set_cad(cube_built.cad);
      cube_alone.session.set_model(cube_built.model);
      cube_alone.session.make_mesh();
      const SurfaceMesh &mesh = both.session.mesh(), &a = patch_alone.session.mesh(), &b = cube_alone.session.mesh();
      EXPECT_EQ(find_defects(mesh), std::vector<std::string>{});
      std::vector<Vec3> vertices = a.vertices;
      vertices.insert(vertices.end(), b.vertices.begin(), b.vertices.end());
      EXPECT_EQ(mesh.vertices, vertices);
      EXPECT_EQ(mesh.triangle_count(), a.triangle_count() + b.triangle_count());
      ASSERT_EQ(mesh.curves.size(), 4u + 12);
      std::set<int> refs;
      for (const CurveMesh& curve : mesh.curves) refs.insert(curve.ref);
      EXPECT_EQ(refs.size(), 16u);
      ASSERT_EQ(mesh.faces.size(), 7u);
      for (std::size_t f = 0; f < 7; ++f) {
        EXPECT_EQ(mesh.faces[f].ref, static_cast<int>(f) + 1);
        EXPECT_EQ(mesh.faces[f].status, FaceStatus::meshed);
      }
      // Points with a reference: four corners and eight, all different.
      std::set<int> points;
      for (const std::int32_t ref : mesh.vertex_ref) points.insert(ref);
      EXPECT_EQ(points.size(), 1u + 12);
      const MeshEvaluation &all = both.session.delivered(), &one = patch_alone.session.delivered(),
                           &other = cube_alone.session.delivered();
      for (const EvaluationKind kind : {EvaluationKind::length, EvaluationKind::q2, EvaluationKind::deviation, EvaluationKind::length_ratio}) {
        std::vector<double> expected = one[kind].values;
        expected.insert(expected.end(), other[kind].values.begin(), other[kind].values.end());
        std::vector<double> found = all[kind].values;
        std::ranges::sort(expected), std::ranges::sort(found);
        EXPECT_EQ(found, expected);
        EXPECT_EQ(all[kind].spread.max, std::max(one[kind].spread.max, other[kind].spread.max));
      }
      EXPECT_EQ(all.short_edges, one.short_edges + other.short_edges);
      EXPECT_EQ(all[EvaluationKind::input_bound].spread.count, static_cast<std::int64_t>(b.triangle_count()));
      EXPECT_LT(all.input.back_bound, 1e-5);  // the mesh of a cube is the cube
    }
}

// The surface over the octahedron is farthest from it over the middles of sides; a mesh of it nearly so.
TEST(SideBySide, BoundsToTheGivenTrianglesAreDelivered) {
  FlatMesh whole;
  whole.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  whole.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  const auto surface = shared(whole, {.sharp_angle = 90});
  const BuiltGeometry built = discrete_geometry(surface);
  const double far = largest(*surface, [](const Vec3& p) { return (p.cwiseAbs().sum() - 1) / std::sqrt(3.0); });
  Monitor silent;
  Session session(silent);
  session.set_cad(built.cad);
  session.set_model(built.model);
  session.parameters().set("hphydef", 0.1);
  session.make_mesh();
  const MeshEvaluation& d = session.delivered();
  const Delivery& bound = d[EvaluationKind::input_bound];
  EXPECT_EQ(bound.spread.count, static_cast<std::int64_t>(session.mesh().triangle_count()));
  EXPECT_EQ(bound.spread.max, d.input.bound);
  EXPECT_NEAR(far, surface->at(0, {1 / 3.0, 1 / 3.0}, want_position).s.norm() - 1 / std::sqrt(3.0), 1e-12);
  EXPECT_LE(d.input.distance, far * (1 + 1e-9));
  EXPECT_GE(d.input.bound, far - 0.003);  // twice the sagitta of edges of .1
  EXPECT_LE(d.input.bound, 1.01 * d.input.distance + 4e-6);
  EXPECT_LE(d.input.back_bound, 1.01 * d.input.back_distance + 4e-6);
  EXPECT_GE(d.input.back_bound, d.input.back_distance);
  for (const std::string& line : describe(d).summary)
    if (line.starts_with("distance to the given triangles")) return;
  ADD_FAILURE() << "no line tells the distance";
}

}  // namespace
}  // namespace carreau::discrete
