// SPDX-License-Identifier: BSD-3-Clause
// Files of plane domains: their content, and a sentence with the line for each mistake.
#include "io/plane/plane_files.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/mesh_files.h"
#include "io/mesh_writers.h"
#include "support/error.h"

namespace carreau {
namespace {

constexpr const char* square_poly = R"(# a square with a hole
8 2 1 1
1 0 0 .5 1
2 4 0 .5 1
3 4 4 .5 1
4 0 4 .5 1
11 1 1 0 2
12 2 1 0 2
13 2 2 0 2
14 1 2 0 2
8 1
1 1 2 5
2 2 3 5
3 3 4 5
4 4 1 5
5 11 12 6
6 12 13 6
7 13 14 6
8 14 11 6
1
1 1.5 1.5
2
1 3 3 9 0.1
2 .5 .5 .25
)";

constexpr const char* piece_data = R"(100 -- nombre maximal de points
50
10
A -90 -15   -- un point
E 20 -15 B 20 30
;
E ;
AE NULL A E NULL ;
EB A E B NULL ;
BA E B A NULL;
;
E 20
;
AE 7 ;
AE +1 200
;
isotrope
A 15 E 3
;
)";

template <typename Read>
std::string sentence_of(const Read& read) {
  try {
    (void)read();
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(PolyFile, PointsSegmentsHolesAndRegionsAreRead) {
  const PlaneDomainInput input = read_poly_text(square_poly, "x.poly");
  ASSERT_EQ(input.points.size(), 8u);
  EXPECT_EQ(input.points[4].xy, Vec2(1, 1));
  EXPECT_EQ(input.points[4].ref, 2);
  ASSERT_EQ(input.curves.size(), 8u);
  EXPECT_EQ(input.curves[7].points, (std::vector<int>{7, 4}));
  EXPECT_EQ(input.curves[7].ref, 6);
  EXPECT_EQ(input.curves[0].line, 12);
  ASSERT_EQ(input.seeds.size(), 3u);
  EXPECT_TRUE(input.seeds[0].hole);
  EXPECT_EQ(input.seeds[1].ref, 1);  // the second attribute is no reference: all regions have their numbers
  EXPECT_EQ(input.seeds[2].ref, 2);
  const PlaneDomainInput whole = read_poly_text(replaced(square_poly, "2 .5 .5 .25", "2 .5 .5 4"), "x.poly");
  EXPECT_EQ(whole.seeds[1].ref, 9);
  EXPECT_EQ(whole.seeds[2].ref, 4);
  EXPECT_EQ(input.rest, PlaneRest::inside);
}

TEST(PolyFile, MistakesHaveTheirLines) {
  const auto of = [](const std::string& from, const std::string& to) {
    return sentence_of([&] { return read_poly_text(replaced(square_poly, from, to), "x.poly"); });
  };
  EXPECT_NE(of("8 1\n1 1 2 5", "8 1\n1 1 99 5").find("x.poly, line 12: a segment names the point 99"),
            std::string::npos);
  EXPECT_NE(of("8 2 1 1", "800 2 1 1").find("line 2: the number of points is 800, more than the rest of the file"),
            std::string::npos);
  EXPECT_NE(of("8 2 1 1", "8 3 1 1").find("the dimension is 3"), std::string::npos);
  EXPECT_NE(of("8 2 1 1", "0 2 1 1").find("there is no .node file beside it"), std::string::npos);
  EXPECT_NE(of("2 4 0 .5 1", "1 4 0 .5 1").find("point 1 comes twice"), std::string::npos);
  EXPECT_NE(of("3 4 4 .5 1", "3 4 nan .5 1").find("a coordinate was expected, not 'nan'"), std::string::npos);
}

TEST(Bl2dData, NamesBecomeSplinesSidesAndSizes) {
  const PlaneDomainInput input = read_bl2d_data_text(piece_data, "x.data");
  ASSERT_EQ(input.points.size(), 3u);
  EXPECT_TRUE(input.points[1].imposed);
  EXPECT_EQ(input.points[1].ref, 20);
  EXPECT_EQ(input.points[0].size, 15);
  EXPECT_FALSE(input.points[2].size);
  ASSERT_EQ(input.curves.size(), 3u);
  EXPECT_EQ(input.curves[0].before, -1);
  EXPECT_EQ(input.curves[1].before, 0);
  EXPECT_EQ(input.curves[1].points, (std::vector<int>{1, 2}));
  EXPECT_EQ(input.curves[0].ref, 7);
  ASSERT_EQ(input.sides.size(), 1u);
  EXPECT_EQ(input.sides[0].ref, 200);
  EXPECT_TRUE(input.sides[0].left);
}

TEST(Bl2dData, ArcsOfCirclesAreALineOfTheirOwn) {
  const PlaneDomainInput input = read_bl2d_data_text(
      "9 9 9\nA 1 0 M 0 1 B -1 0 N 0 -1\n;\n;\nC ARC A M B N A ;\nO ARC A B A ;\n;\n;\n;\nC +1 3 ;\n", "x.data");
  ASSERT_EQ(input.curves.size(), 2u);
  EXPECT_TRUE(input.curves[0].arcs);
  EXPECT_FALSE(input.curves[0].smooth);
  EXPECT_EQ(input.curves[0].points, (std::vector<int>{0, 1, 2, 3, 0}));
  EXPECT_EQ(input.curves[1].points, (std::vector<int>{0, 2, 0}));
  const auto of = [](const std::string& points, const std::string& segment) {
    return sentence_of([&] { return read_bl2d_data_text("9 9 9\n" + points + "\n;\n;\n" + segment + "\n;\n;\n;\n;\n", "x.data"); });
  };
  const std::string points = "A 1 0 M 0 1 B -1 0";
  EXPECT_NE(of(points, "C ARC A M ;").find("x.data, line 5: the segment 'C' of arcs has 2 points"), std::string::npos);
  EXPECT_NE(of(points, "C ARC A M B A ;").find("of arcs has 4 points"), std::string::npos);
  EXPECT_NE(of(points, "C ARC A NULL B ;").find("the segment 'C' of arcs has NULL"), std::string::npos);
  EXPECT_NE(of(points, "C ARC A X B ;").find("line 5: there is no point 'X'"), std::string::npos);
  // Files that have a point of this name mean the point.
  const auto old = read_bl2d_data_text("9 9 9\nARC 0 0 A 1 0 B 2 0\n;\n;\nC ARC A B NULL ;\n;\n;\n;\n;\n", "x.data");
  EXPECT_TRUE(old.curves[0].smooth);
  EXPECT_EQ(old.curves[0].before, 0);
}

TEST(Bl2dData, AnAngleAndTwoSizesMakeAMetric) {
  const auto input =
      read_bl2d_data_text(replaced(piece_data, "isotrope\nA 15 E 3", "anisotrope\nA 90 2 0.5"), "x.data");
  ASSERT_TRUE(input.points[0].metric);
  EXPECT_NEAR(input.points[0].metric->a, 4, 1e-12);  // across the direction: size .5 along x
  EXPECT_NEAR(input.points[0].metric->b, 0, 1e-12);
  EXPECT_NEAR(input.points[0].metric->c, 0.25, 1e-12);
}

TEST(Bl2dData, MistakesHaveTheirLines) {
  const auto of = [](const std::string& from, const std::string& to) {
    return sentence_of([&] { return read_bl2d_data_text(replaced(piece_data, from, to), "x.data"); });
  };
  EXPECT_NE(of("A E NULL", "A F NULL").find("x.data, line 8: there is no point 'F'"), std::string::npos);
  EXPECT_NE(of("AE +1 200", "AF +1 200").find("line 15: there is no segment 'AF'"), std::string::npos);
  EXPECT_NE(of("AE +1 200", "AE 2 200").find("it must be +1 or -1"), std::string::npos);
  EXPECT_NE(of("A 15", "A 0").find("a size is not positive"), std::string::npos);
  EXPECT_NE(of("isotrope", "isotropic").find("isotrope or anisotrope was expected"), std::string::npos);
  EXPECT_NE(of("NULL A E NULL", "A E NULL").find("has 3 control points; it needs four"), std::string::npos);
  EXPECT_NE(of("E 20 -15", "A 20 -15").find("the point 'A' comes twice"), std::string::npos);
}

TEST(Bl2dGeometry, TheCompiledFormAgrees) {
  const auto input = read_bl2d_g_text(
      "3 1 1 0 3 1\n-90 -15\n20 -15\n20 30\n2\n2 20\n4 0 1 2 0 7\n4 1 2 3 0 0\n4 2 3 1 0 0\n1 1 200\n", "x.g");
  const auto data = read_bl2d_data_text(piece_data, "x.data");
  ASSERT_EQ(input.curves.size(), data.curves.size());
  for (std::size_t c = 0; c < input.curves.size(); ++c) {
    EXPECT_EQ(input.curves[c].points, data.curves[c].points);
    EXPECT_EQ(input.curves[c].before, data.curves[c].before);
    EXPECT_EQ(input.curves[c].after, data.curves[c].after);
    EXPECT_EQ(input.curves[c].ref, data.curves[c].ref);
  }
  EXPECT_EQ(input.points[1].ref, 20);
  EXPECT_TRUE(input.points[1].imposed);
  EXPECT_EQ(input.sides[0].ref, 200);
  EXPECT_NE(sentence_of([] {
              return read_bl2d_g_text("3 0 0 2 0 0\n0 0 1 0 1 1\n", "x.g");
            }).find("line 1: the fourth number"),
            std::string::npos);
  EXPECT_NE(sentence_of([] {
              return read_bl2d_g_text("3 0 0 0 1 0\n0 0 1 0 1 1\n4 0 1 5 0 0\n", "x.g");
            }).find("line 3: a control point has the number 5"),
            std::string::npos);
}

TEST(Bl2dSizes, ValuesArePositiveAndAsManyAsPoints) {
  const Solution sizes = read_bl2d_sizes_text("2 1\n.5\n2\n", "x.h");
  EXPECT_EQ(sizes.values, (std::vector<double>{0.5, 2}));
  EXPECT_TRUE(read_bl2d_sizes_text("1 3\n4 0 1\n", "x.h").tensor);
  EXPECT_NE(sentence_of([] {
              return read_bl2d_sizes_text("2 1\n.5\n0\n", "x.h");
            }).find("x.h, line 3: a size is not positive"),
            std::string::npos);
  EXPECT_NE(sentence_of([] { return read_bl2d_sizes_text("1 3\n1 2 1\n", "x.h"); }).find("not positive definite"),
            std::string::npos);
  EXPECT_NE(sentence_of([] { return read_bl2d_sizes_text("1 2\n1 2\n", "x.h"); }).find("it must be 1 (sizes) or 3"),
            std::string::npos);
  PlaneDomainInput input = read_bl2d_data_text(piece_data, "x.data");
  EXPECT_NE(sentence_of([&] {
              return set_point_sizes(input, sizes, "x.hg"), 0;
            }).find("x.hg: it has values at 2 points, but x.data has 3"),
            std::string::npos);
}

TEST(PlaneMesh, TrianglesDefineTheDomain) {
  FlatMesh mesh;
  mesh.dimension = 2;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.triangle_refs = {1, 2};
  mesh.edges = {{1, 0}};
  mesh.edge_refs = {7};
  const PlaneDomainInput input = plane_domain_of(mesh, "x.mesh");
  ASSERT_EQ(input.curves.size(), 5u);  // four sides, and the interface of both references
  EXPECT_EQ(input.curves[0].ref, 7);
  ASSERT_EQ(input.sides.size(), 6u);
  EXPECT_EQ(input.sides[0].curve, 0);
  EXPECT_FALSE(input.sides[0].left);  // the edge was given against the triangle
  EXPECT_EQ(input.sides[0].ref, 1);
  mesh.dimension = 3;
  EXPECT_NE(sentence_of([&] { return plane_domain_of(mesh, "x.mesh"); }).find("has dimension 3"), std::string::npos);
}

TEST(SmoothPolygons, ChainsEndAtCornersReferencesAndJunctions) {
  PlaneDomainInput input;
  constexpr int n = 24;
  for (int i = 0; i < n; ++i) {
    PlanePoint& point = input.points.emplace_back();
    point.xy = {std::cos(i * std::acos(-1) * 2 / n), std::sin(i * std::acos(-1) * 2 / n)};
    point.imposed = true;
  }
  for (int i = 0; i < n; ++i) {
    PlaneCurve& curve = input.curves.emplace_back();
    curve.points = {i, (i + 1) % n};
    if (i % 2 == 1) std::swap(curve.points[0], curve.points[1]);
    input.sides.push_back({.curve = i, .left = i % 2 == 0, .ref = 4});
  }
  PlaneDomainInput circle = input;
  smooth_polygons(circle, 50);
  ASSERT_EQ(circle.curves.size(), 1u);
  EXPECT_TRUE(circle.curves[0].smooth);
  EXPECT_EQ(circle.curves[0].points.front(), circle.curves[0].points.back());
  EXPECT_EQ(circle.curves[0].points.size(), std::size_t(n + 1));
  for (const PlaneSide& side : circle.sides) EXPECT_EQ(side.left, circle.sides[0].left);
  PlaneDomainInput halves = input;
  for (int i = 0; i < n / 2; ++i) halves.curves[i].ref = 3;
  smooth_polygons(halves, 50);
  EXPECT_EQ(halves.curves.size(), 2u);
  smooth_polygons(input, 10);  // each corner turns by 15 degrees
  EXPECT_EQ(input.curves.size(), std::size_t(n));
}

TEST(StraightEdges, AreOneCurveBetweenCornersAndReferences) {
  PlaneDomainInput input;
  for (int i = 0; i <= 10; ++i) input.points.push_back({.xy = {0.1 * i, 0.3 * i}});
  for (int i = 0; i < 10; ++i) {
    PlaneCurve& curve = input.curves.emplace_back();
    curve.points = i % 3 == 0 ? std::vector{i + 1, i} : std::vector{i, i + 1};
    curve.ref = i < 6 ? 1 : 2;
  }
  input.points[8].ref = 5;
  join_straight_edges(input);
  std::vector<std::vector<int>> ends;
  for (const PlaneCurve& curve : input.curves) {
    EXPECT_FALSE(curve.smooth);
    ends.push_back(
        {std::min(curve.points.front(), curve.points.back()), std::max(curve.points.front(), curve.points.back())});
    EXPECT_EQ(curve.points.size(), 2u);
  }
  EXPECT_EQ(ends, (std::vector<std::vector<int>>{{0, 6}, {6, 8}, {8, 10}}));
}

TEST(Bl2dMesh, IsReadAsItWasWritten) {
  FlatMesh mesh;
  mesh.dimension = 2;
  mesh.vertices = {{0, 0, 0}, {0.1, 1e-30, 0}, {1, 1, 0}};
  mesh.vertex_refs = {3, 0, -1};
  mesh.triangles = {{0, 1, 2}};
  mesh.triangle_refs = {200};
  mesh.edges = {{0, 1}};
  mesh.edge_refs = {5};
  const std::string text = bl2d_text(mesh);
  EXPECT_EQ(text, "p1\n3 1 1\n0 0 3\n0.1 1e-30 0\n1 1 -1\n1 2 5\n1 2 3 200\n");
  const FlatMesh again = read_mesh_bl2d(text, "x.bl2d");
  EXPECT_EQ(bl2d_text(again), text);
  EXPECT_NE(sentence_of([&] {
              return read_mesh_bl2d(replaced(text, "1 2 5", "1 9 5"), "x.bl2d");
            }).find("x.bl2d, line 6: the vertex 9 does not exist"),
            std::string::npos);
  mesh.vertices[0].z() = 1;
  EXPECT_THROW((void)bl2d_text(mesh), InvalidArgument);
}

TEST(PlaneFiles, EveryTruncationIsAnError) {
  const std::string data = piece_data, poly = square_poly;
  for (std::size_t n = 0; n + 40 < data.size(); ++n)  // without the sizes a file is whole
    EXPECT_THROW((void)read_bl2d_data_text(data.substr(0, n), "x"), FileError) << n;
  for (std::size_t n = 0; n + 60 < poly.size(); ++n)
    EXPECT_THROW((void)read_poly_text(poly.substr(0, n), "x"), FileError) << n;
}

}  // namespace
}  // namespace carreau
