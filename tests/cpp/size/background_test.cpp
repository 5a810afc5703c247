// SPDX-License-Identifier: BSD-3-Clause
#include "size/background.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>

#include "common/kuhn_cube.h"
#include "mesh/triangle_search.h"
#include "metric/metric3_algebra.h"
#include "support/error.h"

namespace carreau {
namespace {

/// n x n squares of two triangles over [0, 1]^2, lifted.
BackgroundMesh grid(int n, const std::function<Vec3(double, double)>& lift, int dimension = 3) {
  BackgroundMesh mesh;
  mesh.dimension = dimension;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.vertices.push_back(lift(double(i) / n, double(j) / n));
  const auto at = [n](int i, int j) { return static_cast<std::int32_t>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}
Vec3 flat(double x, double y) { return {x, y, 0}; }
Vec3 sphere(double x, double y) {
  const double u = 2 * x, v = 2 * y - 1;
  return {std::cos(u) * std::cos(v), std::sin(u) * std::cos(v), std::sin(v)};
}

std::string sentence_of(const BackgroundMesh& mesh) {
  try {
    BackgroundField field(mesh);
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "";
}

TEST(TriangleSearch, MatchesAllTrianglesTogether) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int round = 0; round < 30; ++round) {
    std::vector<Vec3> vertices;
    std::vector<std::array<std::int32_t, 3>> triangles;
    for (int i = 0; i < 40; ++i) vertices.push_back({number(random), number(random), number(random)});
    for (int i = 0; i < 60; ++i) {
      const auto v = [&] { return static_cast<std::int32_t>(random() % 40); };
      triangles.push_back({v(), v(), v()});  // some of them flat
    }
    const TriangleSearch tree(vertices, triangles);
    for (int k = 0; k < 50; ++k) {
      const Vec3 p{2 * number(random), 2 * number(random), 2 * number(random)};
      const NearestOnMesh found = tree.nearest(p, static_cast<std::int32_t>(random() % 60));
      double least = 1e9;
      for (std::size_t i = 0; i < triangles.size(); ++i)
        least = std::min(least, TriangleSearch(vertices, {&triangles[i], 1}).nearest(p).distance);
      EXPECT_EQ(found.distance, least);
      EXPECT_EQ(norm(found.point - p), found.distance);
      // Nothing on a fine sample of the triangle that was found is nearer.
      const auto& t = triangles[static_cast<std::size_t>(found.triangle)];
      for (int i = 0; i <= 10; ++i)
        for (int j = 0; i + j <= 10; ++j) {
          const Vec3 q =
              0.1 * (i * vertices[static_cast<std::size_t>(t[0])] + j * vertices[static_cast<std::size_t>(t[1])] +
                     (10 - i - j) * vertices[static_cast<std::size_t>(t[2])]);
          EXPECT_GE(norm(q - p), found.distance * (1 - 1e-12));
        }
      EXPECT_EQ(tree.nearest(p).triangle, found.triangle) << "a guess changes the answer";
    }
  }
}

TEST(BackgroundField, IsLinearInTheTriangleThatHoldsThePoint) {
  BackgroundMesh mesh = grid(7, flat, 2);
  for (const Vec3& p : mesh.vertices) mesh.values.sizes.push_back(1 + 2 * p.x() + 3 * p.y());
  BackgroundField field(mesh);
  EXPECT_FALSE(field.needs_position());
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> number(0, 1);
  for (int k = 0; k < 1000; ++k) {
    const Vec2 p{number(random), number(random)};
    const Prescription h = field.on_surface(k, p, {});
    ASSERT_EQ(h.kind, Prescription::Kind::size);
    EXPECT_NEAR(h.size, 1 + 2 * p.x() + 3 * p.y(), 1e-13);
  }
  EXPECT_EQ(field.report(), (BackgroundReport{.asked = 1000, .outside = 0, .farthest = 0}));
  EXPECT_EQ(field.at_point(1, {}).kind, Prescription::Kind::none);
}

TEST(BackgroundField, PointsOutsideTakeTheNearestValueAndAreCounted) {
  BackgroundMesh mesh = grid(4, flat, 2);
  for (const Vec3& p : mesh.vertices) mesh.values.sizes.push_back(1 + p.x());
  BackgroundField field(mesh);
  EXPECT_DOUBLE_EQ(field.on_surface(1, {3, 0.3}, {}).size, 2);
  EXPECT_DOUBLE_EQ(field.on_surface(1, {0.4, -2.5}, {}).size, 1.4);
  EXPECT_DOUBLE_EQ(field.on_curve(1, 1, 0, {-1, -1}, {}).size, 1);
  EXPECT_DOUBLE_EQ(field.on_surface(1, {0.4, 0.4}, {}).size, 1.4);
  EXPECT_EQ(field.report(), (BackgroundReport{.asked = 4, .outside = 3, .farthest = 2.5}));
  EXPECT_EQ(field.remarks(), (std::vector<std::string>{"3 of 4 points lie outside of the background mesh and have the "
                                                       "nearest value; the farthest is 2.5 away"}));
  field.begin_run(MetricLaw::linear);
  EXPECT_EQ(field.report(), BackgroundReport{});
}

TEST(BackgroundField, LooksUpTheNearestPointOfASurfaceInSpace) {
  BackgroundMesh mesh = grid(24, sphere);
  for (const Vec3& p : mesh.vertices) mesh.values.sizes.push_back(2 + p.z());
  BackgroundField field(mesh);
  EXPECT_TRUE(field.needs_position());
  for (int i = 1; i < 50; ++i)
    for (int j = 1; j < 50; ++j) {
      const Vec3 p = sphere(i / 50.0, j / 50.0);
      // Triangles of size d lie d^2 / 8 below the sphere, d = 0.14 at most.
      EXPECT_NEAR(field.on_surface(1, {}, p).size, 2 + p.z(), 0.004);
    }
  EXPECT_EQ(field.report().outside, 0) << "the bow of the surface is no distance outside";
  EXPECT_NEAR(field.at_point(7, {0, 0, 5}).size, 2 + std::sin(1), 1e-12);
  EXPECT_EQ(field.report().outside, 1);
}

TEST(BackgroundField, LawsMatchTheInterpolationAlongEdges) {
  BackgroundMesh mesh;
  mesh.dimension = 2;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.values.sizes = {1, 4, 9};
  BackgroundField field(mesh);
  for (const MetricLaw law : {MetricLaw::linear, MetricLaw::geometric, MetricLaw::sinusoidal}) {
    field.begin_run(law);
    for (double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      EXPECT_NEAR(field.on_surface(1, {t, 0}, {}).size, size_between(4, t, law), 1e-14);
      EXPECT_NEAR(field.on_surface(1, {0, t}, {}).size, size_between(9, t, law), 1e-14);
      EXPECT_NEAR(field.on_surface(1, {1 - t, t}, {}).size, 4 * size_between(9.0 / 4, t, law), 1e-14);
    }
  }
}

TEST(BackgroundField, MetricsOfAPlaneAndOfSpaceKeepTheirPrincipalDirections) {
  // The same eigenvectors everywhere: sizes along them vary linearly (RR-2818 sec. 4.3.2).
  const double c = std::cos(0.3), s = std::sin(0.3);
  BackgroundMesh mesh = grid(3, flat, 2);
  for (const Vec3& p : mesh.vertices) {
    const double h1 = 1 + p.x(), h2 = 0.01 * (1 + p.y());
    mesh.values.space.push_back(
        compose(Eigen3{{1 / (h2 * h2), 1 / (h1 * h1), 0.25}, {{{-s, c, 0}, {c, s, 0}, {0, 0, 1}}}}));
  }
  BackgroundField field(mesh);
  const Prescription at = field.on_surface(1, {0.45, 0.7}, {});
  ASSERT_EQ(at.kind, Prescription::Kind::space);
  EXPECT_NEAR(1 / length(at.space, {c, s, 0}), 1.45, 1e-9);
  EXPECT_NEAR(1 / length(at.space, {-s, c, 0}), 0.017, 1e-12);
  EXPECT_NEAR(1 / length(at.space, {0, 0, 1}), 2, 1e-9);

  mesh.values.space.clear();
  for (const Vec3& p : mesh.vertices) mesh.values.parameter.push_back({1 / ((1 + p.x()) * (1 + p.x())), 0, 4});
  BackgroundField plane(mesh);
  const Prescription in_plane = plane.on_surface(1, {0.45, 0.7}, {});
  ASSERT_EQ(in_plane.kind, Prescription::Kind::parameter);
  EXPECT_NEAR(in_plane.parameter.a, 1 / (1.45 * 1.45), 1e-12);
  EXPECT_NEAR(in_plane.parameter.c, 4, 1e-12);
}

TEST(BackgroundField, EachFaceHasTheTrianglesThatNameIt) {
  BackgroundMesh mesh = grid(1, flat, 2);
  mesh.vertices.insert(mesh.vertices.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  mesh.triangles.push_back({4, 5, 6});
  mesh.faces = {0, 0, 12};
  mesh.values.sizes = {1, 1, 1, 1, 5, 5, 5};
  BackgroundField field(mesh);
  EXPECT_EQ(field.on_surface(12, {0.2, 0.2}, {}).size, 5);
  EXPECT_EQ(field.on_surface(3, {0.2, 0.2}, {}).size, 1);
  mesh.faces = {4, 4, 12};
  BackgroundField named(mesh);
  EXPECT_EQ(named.on_surface(3, {0.2, 0.2}, {}).kind, Prescription::Kind::none);
}

TEST(BackgroundField, LooksUpASessionsMeshInEachParameterPlane) {
  // Two faces that lie on each other in space, and differ by their parameters.
  SurfaceMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.vertex_ref.resize(6);
  FaceMesh one, two;
  one.ref = 1, two.ref = 2;
  one.uv = two.uv = {{0, 0}, {10, 0}, {0, 10}};
  one.vertex = {0, 1, 2}, two.vertex = {3, 4, 5};
  one.triangles = two.triangles = {{0, 1, 2}};
  mesh.faces = {one, two};
  BackgroundField field(mesh, {.sizes = {1, 2, 3, 4, 5, 6}, .space = {}, .parameter = {}});
  EXPECT_FALSE(field.needs_position());
  EXPECT_DOUBLE_EQ(field.on_surface(1, {5, 0}, {}).size, 1.5);
  EXPECT_DOUBLE_EQ(field.on_surface(2, {5, 0}, {}).size, 4.5);
  EXPECT_DOUBLE_EQ(field.at_point(9, {1, 0, 0}).size, 2);
}

TEST(BackgroundField, SteepPlacesAreWhereTheFieldJumps) {
  BackgroundMesh mesh = grid(10, flat, 2);
  for (const Vec3& p : mesh.vertices) mesh.values.sizes.push_back(p.x() < 0.45 ? 1 : 5);
  const BackgroundField field(mesh);
  const std::vector<Vec2> places = field.steep_places(1);
  EXPECT_EQ(places.size(), 22u);
  for (const Vec2& p : places) EXPECT_NEAR(p.x(), 0.45, 0.0501);
  for (double& h : mesh.values.sizes) h = h > 1 ? 1.4 : h;
  EXPECT_TRUE(BackgroundField(mesh).steep_places(1).empty());
}

TEST(BackgroundField, SteepPlacesOfSpaceAreWhereItChangesWithinAUnitEdge) {
  BackgroundMesh mesh = grid(10, flat);
  for (const Vec3& p : mesh.vertices) mesh.values.sizes.push_back(p.x() < 0.45 ? 1 : 1.4);
  const BackgroundField field(mesh);
  EXPECT_TRUE(field.steep_places(1).empty());
  EXPECT_EQ(field.steep_in_space().size(), 22u);
  for (const SteepPlace& place : field.steep_in_space()) {
    EXPECT_NEAR(place.at.x(), 0.45, 0.0501);
    EXPECT_NEAR(place.reach, 0.1 * std::sqrt(2), 1e-12);
  }
  for (double& h : mesh.values.sizes) h = h > 1 ? 1.02 : h;  // grows by 1.22 on a unit edge, of ten of the mesh
  EXPECT_TRUE(BackgroundField(mesh).steep_in_space().empty());
}

BackgroundMesh cube_mesh(int n) {
  testing::Tetrahedra cube = testing::kuhn_cube(n);
  BackgroundMesh mesh;
  mesh.vertices = std::move(cube.vertices);
  mesh.tetrahedra = std::move(cube.tetrahedra);
  return mesh;
}

TEST(BackgroundField, InTetrahedraSizesAreLinear) {
  BackgroundMesh mesh = cube_mesh(4);
  const auto wanted = [](const Vec3& p) { return 1 + 2 * p.x() + 3 * p.y() + 4 * p.z(); };
  for (const Vec3& p : mesh.vertices) mesh.values.sizes.push_back(wanted(p));
  BackgroundField field(mesh);
  EXPECT_FALSE(field.curves_only());
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> number(0, 1);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 p{number(random), number(random), number(random)};
    EXPECT_NEAR(field.on_surface(1, {}, p).size, wanted(p), 1e-13);
    EXPECT_NEAR(field.at_point(1, p + Vec3{1, 0, 0}).size, wanted({1, p.y(), p.z()}), 1e-13) << "outside: the nearest";
  }
  EXPECT_GT(field.report().outside, 900);
  EXPECT_LE(field.report().farthest, 1);
}

TEST(BackgroundField, MetricsInTetrahedraAreOneOnTheFacesBetween) {
  // Two tetrahedra beside the triangle 0, 1, 2, whichever comes first and however their corners are counted.
  BackgroundMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.values.space = {
      {9, 2, 0, 4, 0, 1}, {1, 0, 0.3, 25, 1, 2}, {4, -1, 0, 1, 0.5, 9}, {1, 0, 0, 1, 0, 1}, {100, 0, 0, 100, 0, 100}};
  mesh.tetrahedra = {{3, 2, 0, 1}, {1, 4, 2, 0}};
  BackgroundField one(mesh);
  mesh.tetrahedra = {{4, 0, 1, 2}, {0, 3, 1, 2}};
  BackgroundField two(mesh);
  for (const MetricLaw law : {MetricLaw::linear, MetricLaw::geometric}) {
    one.begin_run(law), two.begin_run(law);
    for (const Vec3& p : {Vec3{0.2, 0.3, 0}, Vec3{0.5, 0.25, 0}, Vec3{0, 0.5, 0}})
      EXPECT_EQ(one.on_surface(1, {}, p).space, two.on_surface(1, {}, p).space);
  }
  EXPECT_EQ(one.at_point(1, mesh.vertices[2]).space, mesh.values.space[2]);
}

TEST(BackgroundField, EdgesOfCurvesGovernCurvesAlone) {
  BackgroundMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}};
  mesh.values.sizes = {1, 4, 2};
  mesh.edges = {{0, 1}, {1, 2}};
  for (const int dimension : {2, 3}) {
    mesh.dimension = dimension;
    BackgroundField field(mesh);
    EXPECT_TRUE(field.curves_only());
    EXPECT_EQ(field.on_surface(1, {0.5, 0}, {0.5, 0, 0}).kind, Prescription::Kind::none);
    EXPECT_DOUBLE_EQ(field.on_curve(1, 1, 0, {0.5, 0}, {0.5, 0, 0}).size, 2.5);
    EXPECT_DOUBLE_EQ(field.on_curve(1, 2, 0, {1, 0.5}, {1, 0.5, 0}).size, 3.5);
    field.begin_run(MetricLaw::geometric);
    EXPECT_DOUBLE_EQ(field.on_curve(1, 1, 0, {0.5, 0}, {0.5, 0, 0}).size, 2);
  }
  EXPECT_DOUBLE_EQ(BackgroundField(mesh).at_point(1, {1, 2, 0}).size, 2);
}

TEST(BackgroundField, SidesOfTrianglesAreNoEdgesOfTheirOwn) {
  BackgroundMesh mesh = grid(6, sphere);
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> number(1, 2);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) mesh.values.sizes.push_back(number(random));
  BackgroundField bare(mesh);
  for (const auto& t : mesh.triangles) mesh.edges.push_back({t[2], t[0]});
  BackgroundField field(mesh);
  EXPECT_FALSE(field.curves_only());
  for (int k = 0; k < 500; ++k) {
    const Vec3 p = sphere(number(random) - 1, number(random) - 1);
    EXPECT_EQ(field.on_surface(1, {}, p).size, bare.on_surface(1, {}, p).size);
  }
}

TEST(BackgroundField, RejectsUnusableInput) {
  BackgroundMesh sound = grid(1, flat);
  sound.values.sizes = {1, 1, 1, 1};
  EXPECT_EQ(sentence_of(sound), "");
  BackgroundMesh mesh = sound;
  mesh.triangles.clear();
  EXPECT_EQ(sentence_of(mesh), "the background mesh has no triangle, no tetrahedron and no edge");
  EXPECT_EQ(sentence_of(BackgroundMesh{}), "the background mesh has no triangle, no tetrahedron and no edge");
  mesh.tetrahedra = {{0, 1, 2, 9}};
  EXPECT_EQ(sentence_of(mesh), "the background mesh: tetrahedron 0 (from 0) names vertex 9, but there are 4");
  mesh.tetrahedra.clear();
  mesh.edges = {{0, 1}, {-1, 2}};
  EXPECT_EQ(sentence_of(mesh), "the background mesh: edge 1 (from 0) names vertex -1, but there are 4");
  mesh = sound;
  mesh.dimension = 2;
  mesh.tetrahedra = {{0, 1, 2, 3}};
  EXPECT_EQ(sentence_of(mesh), "the background mesh lies in parameter planes, which hold no tetrahedra");
  mesh = sound;
  mesh.triangles[1][2] = 4;
  EXPECT_EQ(sentence_of(mesh), "the background mesh: triangle 1 (from 0) names vertex 4, but there are 4");
  mesh = sound;
  mesh.vertices[2].y() = std::nan("");
  EXPECT_EQ(sentence_of(mesh), "the background mesh: vertex 2 (from 0) has a coordinate that is not finite");
  mesh = sound;
  mesh.values.sizes.pop_back();
  EXPECT_EQ(sentence_of(mesh), "the background mesh has 4 vertices, but 3 sizes or metrics are given");
  for (const double size : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    mesh = sound;
    mesh.values.sizes[3] = size;
    EXPECT_NE(sentence_of(mesh).find("vertex 3 (from 0) has the size"), std::string::npos) << size;
  }
  mesh = sound;
  mesh.values.sizes.clear();
  mesh.values.space.resize(4);
  mesh.values.space[1].xy = 2;
  EXPECT_EQ(sentence_of(mesh), "the background mesh: vertex 1 (from 0) has a metric that is not positive definite");
  mesh.values.space.clear();
  mesh.values.parameter.resize(4);
  EXPECT_EQ(sentence_of(mesh), "the background mesh is a surface in space, but its metrics belong to a plane");
  mesh.dimension = 2;
  mesh.values.parameter[0].c = -1;
  EXPECT_EQ(sentence_of(mesh), "the background mesh: vertex 0 (from 0) has a metric that is not positive definite");
  mesh = sound;
  mesh.faces = {1};
  EXPECT_EQ(sentence_of(mesh), "the background mesh has 2 triangles, but 1 references of faces");
}

}  // namespace
}  // namespace carreau
