// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/discrete/triangulation.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/discrete/sharp_lines.h"
#include "support/error.h"
#include "surfaces.h"

namespace carreau::discrete {
namespace {

std::string refusal(const FlatMesh& mesh) {
  try {
    const Triangulation made(mesh);
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "";
}

TEST(Triangulation, JoinsVerticesAtOnePlace) {
  const FlatMesh loose = cube(3);  // four vertices a square
  const Triangulation mesh(loose);
  EXPECT_EQ(mesh.vertices.size(), 56u);
  EXPECT_EQ(mesh.findings.euler_number, 2);
  EXPECT_EQ(mesh.findings.border_edges, 0);
  EXPECT_EQ(mesh.findings.shells, 1);
  EXPECT_EQ(Triangulation(loose, false).findings.shells, 54);
}

TEST(Triangulation, TurnsTrianglesAsMostOfTheirShellAre) {
  FlatMesh mesh = sphere(3);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 5) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  const Triangulation mended(mesh);
  EXPECT_EQ(mended.findings.turned_triangles, static_cast<std::int64_t>(mesh.triangles.size() / 5));
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mended.triangles.size()); ++t) {
    EXPECT_GT(dot(mended.normal(t), mended.at(mended.corner(t, 0))), 0);
    for (int i = 0; i < 3; ++i) {
      const Side u = mended.beyond(t, i);
      ASSERT_GE(u.triangle, 0);
      EXPECT_EQ(mended.corner(u.triangle, u.side), mended.corner(t, i + 1));
      EXPECT_EQ(mended.edge(u.triangle, u.side), mended.edge(t, i));
      EXPECT_EQ(mended.edges[static_cast<std::size_t>(mended.edge(t, i))],
                edge_of(mended.corner(t, i), mended.corner(t, i + 1)));
    }
  }
}

TEST(Triangulation, DropsRepeatedTrianglesAndThoseWithTwoCornersAtOnePlace) {
  FlatMesh mesh = icosahedron();
  mesh.triangles.push_back({mesh.triangles[3][1], mesh.triangles[3][0], mesh.triangles[3][2]});
  mesh.vertices.push_back(mesh.vertices[5]);
  mesh.triangles.push_back({5, 12, 1});
  const Triangulation mended(mesh);
  EXPECT_EQ(mended.triangles.size(), 20u);
  EXPECT_EQ(mended.findings.repeated_triangles, 1);
  EXPECT_EQ(mended.findings.flat_triangles, 1);
  EXPECT_EQ(mended.findings.euler_number, 2);
  ASSERT_EQ(mended.findings.sentences.size(), 2u);
  EXPECT_NE(mended.findings.sentences[0].find("triangle 21 (from 0)"), std::string::npos);
  EXPECT_NE(mended.findings.sentences[1].find("has the vertices of triangle 3: dropped"), std::string::npos);
}

double area_of(const Triangulation& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += norm(cross(mesh.at(b) - mesh.at(a), mesh.at(c) - mesh.at(a))) / 2;
  return area;
}

/// A square of two triangles whose diagonal from 0 to 2 carries points, closed by flat triangles in two fans.
FlatMesh square_with_seam(int points, std::mt19937& random) {
  FlatMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  std::vector<std::int32_t> chain{0};
  for (int k = 1; k <= points; ++k) {
    const double s = static_cast<double>(k) / (points + 1);
    chain.push_back(static_cast<std::int32_t>(mesh.vertices.size()));
    mesh.vertices.emplace_back(s, s, 0);
  }
  chain.push_back(2);
  // Ears of the flat polygon are cut off by chance, once on each side: together they close the seam.
  for (const bool back : {false, true}) {
    std::vector<std::int32_t> left = chain;
    while (left.size() > 2) {
      const std::size_t k = 1 + random() % (left.size() - 2);
      if (back)
        mesh.triangles.push_back({left[k + 1], left[k], left[k - 1]});
      else
        mesh.triangles.push_back({left[k - 1], left[k], left[k + 1]});
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
    }
  }
  return mesh;
}

TEST(Triangulation, DropsTrianglesWithoutAreaAndDividesTheirNeighbours) {
  // A corner of a tetrahedron lies on an edge of another triangle: the flat triangle between them closes the surface.
  FlatMesh solid;
  solid.vertices = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  solid.triangles = {{1, 0, 2}, {0, 4, 3}, {4, 1, 3}, {1, 4, 0}, {0, 3, 2}, {2, 3, 1}};
  solid.edges = {{1, 0}};
  solid.triangle_refs = {1, 2, 2, 3, 4, 5};
  const Triangulation closed(solid);
  EXPECT_EQ(closed.findings.flat_triangles, 1);
  EXPECT_EQ(closed.findings.border_edges, 0);
  EXPECT_EQ(closed.findings.euler_number, 2);
  EXPECT_EQ(closed.triangles.size(), 6u);
  EXPECT_EQ(closed.refs, (std::vector<std::int32_t>{2, 2, 4, 5, 1, 1}));
  EXPECT_EQ(closed.marked, (std::vector<Edge>{{0, 4}, {1, 4}}));
  EXPECT_NEAR(area_of(closed), 4, 1e-12);

  // Corners nearer to each other than rounding become one.
  FlatMesh needle = solid;
  needle.vertices[4] = {1e-14, 0, 0};
  needle.triangles.erase(needle.triangles.begin() + 3);
  needle.triangles.push_back({1, 4, 0});
  const Triangulation joined(needle);
  EXPECT_EQ(joined.findings.flat_triangles, 2);
  EXPECT_EQ(joined.findings.border_edges, 0);
  EXPECT_EQ(joined.triangles.size(), 4u);

  std::mt19937 random(7);
  for (int run = 0; run < 200; ++run) {
    FlatMesh seam = square_with_seam(1 + run % 9, random);
    std::ranges::shuffle(seam.triangles, random);
    const Triangulation mended(seam);
    EXPECT_EQ(mended.findings.border_edges, 4) << run;
    EXPECT_EQ(mended.findings.manifold_breaks, 0) << run;
    EXPECT_EQ(mended.findings.euler_number, 1) << run;
    EXPECT_NEAR(area_of(mended), 1, 1e-12) << run;
  }
}

TEST(Triangulation, RejectsIrreparableInputWithAPlace) {
  FlatMesh flat;
  flat.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  flat.triangles = {{0, 1, 2}};
  EXPECT_EQ(refusal(flat), "the surface has no triangle");
  flat.triangles = {{0, 1, 7}};
  EXPECT_EQ(refusal(flat), "triangle 0 (from 0) names vertex 7 of 4");
  flat.triangles = {{0, 0, 1}};
  EXPECT_EQ(refusal(flat), "the surface has no triangle");
  flat.vertices[2].y() = std::nan("");
  EXPECT_EQ(refusal(flat), "vertex 2 (from 0) has a coordinate that is not finite");
}

TEST(Triangulation, ReportsBordersBreaksAndPinches) {
  FlatMesh fins;  // three triangles on one edge
  fins.vertices = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}};
  fins.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const Triangulation three(fins);
  EXPECT_EQ(three.findings.manifold_breaks, 1);
  EXPECT_EQ(three.findings.border_edges, 6);
  EXPECT_EQ(three.findings.shells, 3);
  EXPECT_EQ(find_sharp_lines(three).regions, 3);
  FlatMesh bow;  // two triangles at one vertex
  bow.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  bow.triangles = {{0, 1, 2}, {0, 3, 4}};
  const Triangulation two(bow);
  EXPECT_EQ(two.findings.pinched_vertices, 1);
  EXPECT_EQ(two.findings.shells, 2);
  EXPECT_EQ(find_sharp_lines(two).corners.size(), 5u);
}

TEST(Triangulation, AMoebiusStripHasALineOnWhichItTurns) {
  FlatMesh strip;
  const int n = 20;
  for (int i = 0; i < n; ++i)
    for (const double w : {-0.3, 0.3}) {
      const double a = 2 * std::numbers::pi * i / n;
      strip.vertices.emplace_back((1 + w * std::cos(a / 2)) * std::cos(a), (1 + w * std::cos(a / 2)) * std::sin(a),
                                  w * std::sin(a / 2));
    }
  for (int i = 0; i < n; ++i) {
    const std::int32_t a = 2 * i, b = 2 * i + 1;
    const std::int32_t c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? a + 3 : 0;  // turned over at the end
    strip.triangles.push_back({a, c, d});
    strip.triangles.push_back({a, d, b});
  }
  const Triangulation mesh(strip);
  EXPECT_EQ(mesh.findings.one_sided_edges, 1);
  EXPECT_EQ(mesh.findings.euler_number, 0);
  const SharpLines lines = find_sharp_lines(mesh);
  EXPECT_EQ(lines.regions, 1);
  EXPECT_EQ(lines.edges, 2 * n + 1);
}

TEST(SharpLines, ACubeAndACylinder) {
  const SharpLines of_cube = find_sharp_lines(Triangulation(cube(3)));
  EXPECT_EQ(of_cube.lines.size(), 12u);
  EXPECT_EQ(of_cube.corners.size(), 8u);
  EXPECT_EQ(of_cube.edges, 36);
  EXPECT_EQ(of_cube.regions, 6);
  const SharpLines of_cylinder = find_sharp_lines(Triangulation(cylinder(36)));
  ASSERT_EQ(of_cylinder.lines.size(), 2u);
  EXPECT_TRUE(of_cylinder.lines[0].closed() && of_cylinder.lines[1].closed());
  EXPECT_EQ(of_cylinder.edges, 72);
  EXPECT_TRUE(of_cylinder.corners.empty());
  EXPECT_EQ(find_sharp_lines(Triangulation(sphere(4))).edges, 0);
  EXPECT_EQ(find_sharp_lines(Triangulation(torus(24, 12))).edges, 0);
}

/// Two cones over a circle of n sides, whose rim is bent by about `bend` degrees.
FlatMesh two_cones(int n, double bend) {
  FlatMesh mesh;
  const double h = 1 / std::tan(bend / 2 * std::numbers::pi / 180);
  for (int ring = 1; ring <= 3; ++ring)
    for (int i = 0; i < n; ++i)
      for (const double side : {-1.0, 1.0}) {
        const double a = 2 * std::numbers::pi * i / n, r = ring / 3.0;
        mesh.vertices.emplace_back(r * std::cos(a), r * std::sin(a), side * h * (1 - r));
      }
  mesh.vertices.emplace_back(0, 0, -h), mesh.vertices.emplace_back(0, 0, h);
  for (const int side : {0, 1})
    for (int i = 0; i < n; ++i) {
      const int j = (i + 1) % n;
      const auto at = [&](int ring, int k) {
        return ring == 3 ? (2 * n * 2 + 2 * k) : 2 * n * (ring - 1) + 2 * k + side;
      };
      const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
        if (side == 1)
          mesh.triangles.push_back({a, b, c});
        else
          mesh.triangles.push_back({a, c, b});
      };
      add(6 * n + side, at(1, i), at(1, j));
      for (int ring = 1; ring < 3; ++ring) {
        add(at(ring, i), at(ring + 1, i), at(ring + 1, j));
        add(at(ring, i), at(ring + 1, j), at(ring, j));
      }
    }
  return mesh;
}

TEST(SharpLines, GoOnWhereNoiseMakesThemFlatter) {
  FlatMesh mesh = two_cones(36, 46);
  for (int i = 0; i < 36; ++i)  // of the rim, flatter where it is dented
    for (const int side : {0, 1})
      mesh.vertices[static_cast<std::size_t>(4 * 36 + 2 * i + side)] *=
          i % 12 == 5 ? 0.97 : 1 + 0.001 * std::sin(11.0 * i);
  const Triangulation noisy(mesh);
  const SharpLines lines = find_sharp_lines(noisy, {.sharp_angle = 45});
  double least = 180;
  for (std::int32_t e = 0; e < static_cast<std::int32_t>(noisy.edges.size()); ++e)
    if (lines.sharp[static_cast<std::size_t>(e)] != 0) least = std::min(least, noisy.bend(e));
  EXPECT_LT(least, 45);
  EXPECT_GT(lines.prolonged, 0);
  EXPECT_EQ(lines.faded, 0);
  EXPECT_EQ(lines.edges, 36);
  ASSERT_EQ(lines.lines.size(), 1u);
  EXPECT_TRUE(lines.lines[0].closed());
  EXPECT_EQ(lines.regions, 2);
}

/// Points (r, z) turned about the z axis in n steps, closed both ways.
FlatMesh turned(const std::vector<Vec2>& profile, int n) {
  FlatMesh mesh;
  const auto m = static_cast<std::int32_t>(profile.size());
  for (int i = 0; i < n; ++i)
    for (const Vec2& p : profile)
      mesh.vertices.emplace_back(p.x() * std::cos(2 * std::numbers::pi * i / n), p.x() * std::sin(2 * std::numbers::pi * i / n), p.y());
  for (std::int32_t i = 0; i < n; ++i)
    for (std::int32_t k = 0; k < m; ++k) {
      const std::int32_t a = i * m + k, b = i * m + (k + 1) % m, c = (i + 1) % n * m + (k + 1) % m, d = (i + 1) % n * m + k;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}

TEST(SharpLines, ACountersinkHasAnAngleInTheGap) {
  // A washer whose hole has a cone on top.
  for (const int n : {18, 36, 90})
    for (const double slope : {25.0, 30.0, 41.0, 45.0, 60.0}) {
      const Triangulation washer(turned({{1, 0}, {4, 0}, {4, 2}, {2, 2}, {1, 2 - std::tan(slope * std::numbers::pi / 180)}}, n));
      const SharpLines lines = find_sharp_lines(washer);
      EXPECT_EQ(lines.edges, 5 * n) << n << " " << slope;
      EXPECT_EQ(lines.regions, 5) << n << " " << slope;
      EXPECT_TRUE(lines.corners.empty());
      EXPECT_GE(lines.sharp_angle, 20);
      EXPECT_LE(lines.sharp_angle, 45);
    }
}

TEST(SharpLines, AHingeKeepsTheSurfaceAtItsTriangles) {
  // Two plates bent by 30 degrees at their common edge.
  FlatMesh hinge;
  const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
  for (const double y : {0.0, 10.0})
    for (const double z : {0.0, 1.0}) {
      hinge.vertices.emplace_back(-10, y, z);
      hinge.vertices.emplace_back(0, y, z);
      hinge.vertices.emplace_back(10 * c, y, z + 10 * s);
    }
  const auto quad = [&](std::int32_t a, std::int32_t b, std::int32_t d, std::int32_t e) {
    hinge.triangles.push_back({a, b, d});
    hinge.triangles.push_back({a, d, e});
  };
  for (const std::int32_t k : {0, 1}) {
    quad(3 + k, 4 + k, 10 + k, 9 + k);  // top
    quad(k, 6 + k, 7 + k, 1 + k);       // bottom
    quad(k, 1 + k, 4 + k, 3 + k);       // fronts
    quad(6 + k, 9 + k, 10 + k, 7 + k);
  }
  quad(0, 3, 9, 6);
  quad(2, 8, 11, 5);
  const DiscreteSurface surface = surface_of(hinge);
  EXPECT_EQ(surface.lines().regions, 8);
  EXPECT_LT(surface.deviation(), 1e-12);
  EXPECT_GT(surface_of(hinge, {.sharp_angle = 45}).deviation(), 0.3);
}

TEST(SharpLines, StayOutOfCoarseCurvedSurfaces) {
  for (const int n : {8, 9, 12, 16}) {  // bends of 45, 40, 30 and 22.5 degrees
    const SharpLines lines = find_sharp_lines(Triangulation(cylinder(n)));
    EXPECT_EQ(lines.edges, 2 * n);
    EXPECT_EQ(lines.regions, 3);
  }
  EXPECT_EQ(find_sharp_lines(Triangulation(torus(48, 12))).edges, 0);
  // Rows that are shifted by half a step: no edges are parallel.
  FlatMesh shifted = torus(100, 12, 2, 0.8);
  for (std::int32_t i = 0; i < 100; ++i)
    for (std::int32_t j = 0; j < 12; ++j) {
      const double a = 2 * std::numbers::pi * i / 100, b = 2 * std::numbers::pi * (j + 0.5 * (i % 2)) / 12, r = 2 + 0.8 * std::cos(b);
      shifted.vertices[static_cast<std::size_t>(12 * i + j)] = {r * std::cos(a), r * std::sin(a), 0.8 * std::sin(b)};
    }
  shifted.triangles.clear();
  const auto at = [](std::int32_t i, std::int32_t j) { return i % 100 * 12 + (j + 12) % 12; };
  for (std::int32_t i = 0; i < 100; ++i)
    for (std::int32_t j = 0; j < 12; ++j) {
      shifted.triangles.push_back({at(i, j), at(i + 1, j + i % 2), at(i, j + 1)});
      shifted.triangles.push_back({at(i, j), at(i + 1, j + i % 2 - 1), at(i + 1, j + i % 2)});
    }
  EXPECT_EQ(find_sharp_lines(Triangulation(shifted)).edges, 0);
}

TEST(SharpLines, NoiseHasTheLinesOf45Degrees) {
  FlatMesh mesh = sphere(12);
  const Triangulation even(mesh);
  mesh.vertices = even.vertices, mesh.triangles = even.triangles;
  std::mt19937 random(42);
  for (Vec3& p : mesh.vertices) p *= 1 + 0.06 * (static_cast<double>(random()) / std::mt19937::max() - 0.5);
  const Triangulation noisy(mesh);
  const SharpLines found = find_sharp_lines(noisy);
  EXPECT_EQ(found.sharp_angle, 45);
  EXPECT_EQ(found.sharp, find_sharp_lines(noisy, {.sharp_angle = 45}).sharp);
}

TEST(SharpLines, ALineThatFadesOutStopsAndIsReported) {
  // A ridge along x whose bend falls from 80 degrees to nothing.
  FlatMesh mesh;
  const int n = 30;
  for (int i = 0; i <= n; ++i) {
    const double slope = std::tan(40 * std::numbers::pi / 180 * (1 - static_cast<double>(i) / n));
    for (const double y : {-1.0, 0.0, 1.0}) mesh.vertices.emplace_back(0.3 * i, y, -slope * std::abs(y));
  }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2; ++j) {
      const std::int32_t a = 3 * i + j;
      mesh.triangles.push_back({a, a + 3, a + 4});
      mesh.triangles.push_back({a, a + 4, a + 1});
    }
  const SharpLines lines = find_sharp_lines(Triangulation(mesh));
  EXPECT_EQ(lines.faded, 1);
  ASSERT_EQ(lines.sentences.size(), 1u);
  EXPECT_NE(lines.sentences[0].find("a sharp line fades out at ("), std::string::npos);
  EXPECT_EQ(lines.regions, 1);
}

TEST(SharpLines, GivenEdgesAndReferencesAreLines) {
  FlatMesh mesh = sphere(4);
  mesh.triangle_refs.assign(mesh.triangles.size(), 1);
  for (std::size_t t = 0; t < 16; ++t) mesh.triangle_refs[t] = 2;  // one face of the icosahedron
  const SharpLines by_refs = find_sharp_lines(Triangulation(mesh));
  EXPECT_EQ(by_refs.edges, 12);
  EXPECT_EQ(by_refs.regions, 2);
  EXPECT_EQ(by_refs.corners.size(), 3u);  // great circles meet at 72 degrees
  EXPECT_EQ(find_sharp_lines(Triangulation(mesh), {.references = false}).edges, 0);
  FlatMesh box = cube(2);
  const Triangulation whole(box);
  FlatMesh marked{.vertices = whole.vertices,
                  .vertex_refs = {},
                  .triangles = whole.triangles,
                  .triangle_refs = {},
                  .edges = {whole.edges[5]},
                  .edge_refs = {},
                  .fields = {}};
  const SharpLines only = find_sharp_lines(Triangulation(marked), {.marked_only = true});
  EXPECT_EQ(only.edges, 1);
  EXPECT_EQ(only.regions, 1);
}

TEST(SharpLines, RejectsAnglesOutOfRange) {
  EXPECT_THROW(find_sharp_lines(Triangulation(icosahedron()), {.sharp_angle = 0}), InvalidArgument);
  EXPECT_THROW(find_sharp_lines(Triangulation(icosahedron()), {.sharp_angle = 45, .corner_angle = 200}),
               InvalidArgument);
}

}  // namespace
}  // namespace carreau::discrete
