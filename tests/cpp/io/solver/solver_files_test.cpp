// SPDX-License-Identifier: BSD-3-Clause
// Files of solvers: .inp, .bdf, .unv, .su2.
#include <algorithm>
#include <map>
#include <set>

#include "io/mesh_files.h"
#include "io/mesh_writers.h"
#include "io/solver/element_sets.h"
#include "io/solver/narrow_numbers.h"
#include "io_test_support.h"
#include "support/format.h"

namespace carreau {
namespace {

using Read = FlatMesh (*)(std::string_view, const std::string&);

/// Elements with their references, whatever their order: elements of one face and kind stay together.
std::multiset<std::pair<std::int32_t, std::vector<std::int32_t>>> elements_of(const FlatMesh& mesh) {
  std::multiset<std::pair<std::int32_t, std::vector<std::int32_t>>> elements;
  for (const FaceSet& face : sets_of(mesh, 80).faces)
    for (const Cell& cell : face.cells) {
      const int n = corner_count(cell.kind);
      // Readers turn quadrilaterals.
      std::vector<std::int32_t> nodes = around(cell);
      const int step = is_quadratic(cell.kind) ? 2 : 1;
      int first = 0;
      for (int i = 1; i < n; ++i)
        if (nodes[i * step] < nodes[first * step]) first = i;
      if (n == 4) std::rotate(nodes.begin(), nodes.begin() + first * step, nodes.end());
      elements.emplace(face.ref, nodes);
    }
  return elements;
}

/// Two quadrilaterals and a triangle of two faces, order 1 or 2, and an edge of curve 5.
FlatMesh plate(bool quadratic) {
  FlatMesh mesh;
  for (const double y : {0.0, 1.0, 2.0})
    for (const double x : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) mesh.vertices.push_back({x / 3, y / 7, 0.1 * x * y});
  const auto add = [&](CellKind kind, std::array<std::int32_t, 8> nodes, std::int32_t ref) {
    Cell cell;
    cell.kind = kind, cell.nodes = nodes;
    add_cell(mesh, cell, ref);
  };
  if (quadratic) {
    add(CellKind::quad8, {0, 2, 16, 14, 1, 9, 15, 7}, 3);
    add(CellKind::quad8, {2, 4, 18, 16, 3, 11, 17, 9}, 8);
    add(CellKind::triangle6, {4, 6, 20, 5, 13, 12, -1, -1}, 8);
    mesh.edge_mids = {1};
  } else {
    add(CellKind::quad4, {0, 2, 16, 14, -1, -1, -1, -1}, 3);
    add(CellKind::quad4, {2, 4, 18, 16, -1, -1, -1, -1}, 8);
    add(CellKind::triangle3, {4, 6, 20, -1, -1, -1, -1, -1}, 8);
  }
  mesh.edges = {{0, 2}}, mesh.edge_refs = {5};
  mesh.vertex_refs.assign(mesh.vertices.size(), 0);
  mesh.faces = {{.ref = 3, .status = FaceStatus::meshed, .name = "bore left"}, {.ref = 8, .status = FaceStatus::meshed}};
  return mesh;
}

TEST(NarrowNumbers, AreShortestAndNearest) {
  EXPECT_EQ(number_within(0.1, 20), "0.1");
  EXPECT_EQ(number_within(-1e-7, 20), "-1e-7");
  EXPECT_EQ(number_within(1.0 / 3, 20), "0.3333333333333333");
  EXPECT_EQ(nastran_number(0.5, 8), ".5");
  EXPECT_EQ(nastran_number(-0.5, 8), "-.5");
  EXPECT_EQ(nastran_number(3, 8), "3.");
  EXPECT_EQ(nastran_number(0, 8), "0.");
  EXPECT_EQ(nastran_number(1.5e-7, 8), "1.5-7");
  EXPECT_EQ(nastran_number(2e30, 8), "2.+30");
}

TEST(NarrowNumbers, FitAndLoseNoMoreThanTheirDigits) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 20000; ++i) {
    const double x = random_double(random);
    for (const std::size_t width : {8u, 16u, 20u}) {
      const std::string text = number_within(x, width);
      double back = 0;
      ASSERT_LE(text.size(), width) << x;
      ASSERT_TRUE(parse_number(text, back));
      // A sign, a point and e-308 leave so many digits.
      const double digits = static_cast<double>(width) - 7;
      ASSERT_LE(std::abs(back - x), std::abs(x) * 5 * std::pow(10.0, -std::min(digits, 17.0))) << text << ' ' << x;
      ASSERT_LE(nastran_number(x, width).size(), width);
    }
  }
}

TEST(SolverFiles, ElementsSetsAndNodesComeBack) {
  for (const bool quadratic : {false, true}) {
    const FlatMesh mesh = plate(quadratic);
    for (const auto& [format, read] : {std::pair<MeshFormat, Read>{MeshFormat::inp, read_mesh_inp}, {MeshFormat::bdf, read_mesh_bdf}}) {
      const FlatMesh back = read(mesh_bytes(mesh, format), "x");
      EXPECT_EQ(elements_of(back), elements_of(mesh));
      ASSERT_EQ(back.vertices.size(), mesh.vertices.size());
      for (std::size_t v = 0; v < mesh.vertices.size(); ++v) EXPECT_LT(norm(back.vertices[v] - mesh.vertices[v]), 1e-13);
    }
  }
}

TEST(SolverFiles, DoublesOfUsualSizeComeBackExactlyFromInp) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> usual(1, 1000);
  FlatMesh mesh = square();
  for (int i = 0; i < 1000; ++i) mesh.vertices.push_back({usual(random), usual(random), usual(random)});
  mesh.vertex_refs.clear();
  EXPECT_EQ(read_mesh_inp(inp_text(mesh), "x").vertices, mesh.vertices);
}

TEST(SolverFiles, UnvGivesEverythingBack) {
  for (const bool quadratic : {false, true}) {
    FlatMesh mesh = plate(quadratic);
    mesh.edges.push_back({2, 4}), mesh.edge_refs.push_back(-6);
    if (quadratic) mesh.edge_mids.push_back(3);
    const FlatMesh back = read_mesh_unv(unv_text(mesh), "x");
    EXPECT_EQ(elements_of(back), elements_of(mesh));
    EXPECT_EQ(back.vertices, mesh.vertices);
    EXPECT_EQ(std::set(back.edge_refs.begin(), back.edge_refs.end()), (std::set<std::int32_t>{-6, 5}));
    for (std::size_t e = 0; e < 2; ++e) {
      const std::size_t own = back.edge_refs[e] == 5 ? 0 : 1;
      EXPECT_EQ(back.edges[e], mesh.edges[own]);
      if (quadratic) {
        EXPECT_EQ(back.edge_mids.at(e), mesh.edge_mids[own]);
      }
    }
    ASSERT_EQ(back.faces.size(), 1u);
    EXPECT_EQ(back.faces[0].ref, 3);
    EXPECT_EQ(back.faces[0].name, "bore_left");
  }
}

TEST(SolverFiles, InpKeepsNamesOfFaces) {
  const FlatMesh back = read_mesh_inp(inp_text(plate(false)), "x");
  ASSERT_EQ(back.faces.size(), 1u);
  EXPECT_EQ(back.faces[0].ref, 3);
  EXPECT_EQ(back.faces[0].name, "bore_left");
}

TEST(SolverFiles, BdfKeepsEdgesAndLongFields) {
  FlatMesh mesh = plate(false);
  const FlatMesh back = read_mesh_bdf(bdf_text(mesh), "x");
  EXPECT_EQ(back.edges, mesh.edges);
  EXPECT_NE(bdf_text(mesh).find("GRID*"), std::string::npos);  // 1/3
  for (Vec3& p : mesh.vertices) p = {p.x() * 3, p.y() * 7, 0.5};
  EXPECT_EQ(bdf_text(mesh).find("GRID*"), std::string::npos);
  EXPECT_EQ(read_mesh_bdf(bdf_text(mesh), "x").vertices, mesh.vertices);
  std::size_t longest = 0, from = 0;
  for (std::size_t i = 0; i < bdf_text(mesh).size(); ++i)
    if (bdf_text(mesh)[i] == '\n') longest = std::max(longest, i - from), from = i + 1;
  EXPECT_LE(longest, 72u);
}

TEST(SolverFiles, NamesAreUniqueAndCut) {
  FlatMesh mesh = square();
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {1, 2, 3}};
  mesh.triangle_refs = {1, 2, 3, 4};
  const std::string longest(100, 'x');
  mesh.faces = {{.ref = 1, .name = longest + "1"}, {.ref = 2, .name = longest + "2"}, {.ref = 3, .name = "4 #bores"}, {.ref = 4, .name = "FACE_1"}};
  const ElementSets sets = sets_of(mesh, 20);
  ASSERT_EQ(sets.names.size(), 4u);
  EXPECT_EQ(sets.names[0].name, std::string(20, 'x'));
  EXPECT_EQ(sets.names[1].name, std::string(18, 'x') + "_2");
  EXPECT_EQ(sets.names[2].name, "n_4__bores");
  EXPECT_EQ(sets.names[3].name, "FACE_1_2");  // face_1 is a set already
  EXPECT_EQ(sets.faces[3].first, 4u);
}

TEST(SolverFiles, Su2HasMarkersOfThePlaneAndOfSpace) {
  FlatMesh flat = square();
  for (Vec3& p : flat.vertices) p.z() = 0;
  const FlatMesh back = read_mesh_su2(su2_text(flat), "x");
  EXPECT_EQ(back.dimension, 2);
  EXPECT_EQ(back.triangles.size(), 2u);
  EXPECT_EQ(back.edge_refs, flat.edge_refs);
  EXPECT_EQ(back.edges, flat.edges);
  const FlatMesh space = read_mesh_su2(su2_text(plate(false)), "x");
  EXPECT_EQ(space.dimension, 3);
  ASSERT_EQ(space.faces.size(), 1u);
  EXPECT_EQ(space.faces[0].name, "bore_left");
  EXPECT_EQ(space.cells.size(), 3u);
  EXPECT_EQ(std::ranges::count(space.triangle_refs, 8), 3);
}

TEST(SolverFiles, OrderTwoIsRejectedInFormatsWithoutIt) {
  for (const MeshFormat format : {MeshFormat::su2, MeshFormat::off, MeshFormat::obj, MeshFormat::ply})
    EXPECT_NE(sentence_of<InvalidArgument>([&] { mesh_bytes(plate(true), format); }).find("has no elements of order 2"), std::string::npos);
}

TEST(SolverFiles, PolygonsComeBack) {
  const FlatMesh mesh = square();
  EXPECT_EQ(read_mesh_off(off_text(mesh), "x").vertices, mesh.vertices);
  EXPECT_EQ(read_mesh_off(off_text(mesh), "x").triangles, mesh.triangles);
  EXPECT_EQ(read_mesh_ply(ply_bytes(mesh), "x").vertices, mesh.vertices);
  EXPECT_EQ(read_mesh_ply(ply_bytes(mesh), "x").triangles, mesh.triangles);
  const FlatMesh obj = read_mesh_obj(obj_text(mesh), "x");
  EXPECT_EQ(obj.vertices, mesh.vertices);
  EXPECT_EQ(obj.triangles.size(), 2u);
  EXPECT_EQ(obj.edges, mesh.edges);
  ASSERT_EQ(obj.faces.size(), 2u);
  EXPECT_EQ(obj.faces[0].name, "face_7");
  EXPECT_EQ(obj.faces[1].name, "face_m2");
}

TEST(SolverFiles, UnvGoesAroundElementsOfOrderTwo) {
  const std::string text = unv_text(plate(true));
  // The first quadrilateral: 1, 2, 3, 10, 17, 16, 15, 8.
  EXPECT_NE(text.find("         1         2         3        10        17        16        15         8\n"), std::string::npos);
  EXPECT_NE(text.find("         4        24         3         1         7         3\n         0         1         1\n"), std::string::npos);
}

TEST(SolverFiles, InpOfOtherPrograms) {
  const FlatMesh mesh = read_mesh_inp(
      "** made by another program\r\n*Heading\r\n part\r\n*Node\r\n 10, 0., 0., 0.\r\n20, 1.\r\n30, 1., 1.D0\r\n40, 0., 1., 0.\r\n"
      "*Element, type=S8R, elset=curved\r\n*Element, type=CPS3\r\n5, 10, 20, 30\r\n7, 10, 30,\r\n40\r\n*Elset, elset=Left, generate\r\n5, 6, 1\r\n"
      "*Elset, elset=RIGHT\r\n7\r\n*Element, type=C3D4\r\n9, 10, 20, 30, 40\r\n*Material, name=steel\r\n*Elastic\r\n210000., 0.3\r\n",
      "x");
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh.triangle_refs, (std::vector<std::int32_t>{1, 2}));
  ASSERT_EQ(mesh.faces.size(), 2u);
  EXPECT_EQ(mesh.faces[0].name, "Left");
  EXPECT_EQ(mesh.vertices[2], Vec3(1, 1, 0));
}

TEST(SolverFiles, BdfOfOtherPrograms) {
  const FlatMesh mesh = read_mesh_bdf(
      "SOL 101\nCEND\nBEGIN BULK\nGRID,1,,0.,0.,0.\nGRID           2              1.     0.0      0.\n"
      "GRID*                  3                        1.0000+0            1.D0*A1\n*A1                  0.0\ngrid,4,,0.0,1.5-1\n"
      "CTRIA3         1      77       1       2       3\nCTRIA3,2,77,1,3,4\nPSHELL,77,1,0.1\nCBAR,9,5,1,2,0.,0.,1.\nENDDATA\nGRID,1\n",
      "x");
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh.triangle_refs, (std::vector<std::int32_t>{77, 77}));
  EXPECT_EQ(mesh.vertices[2], Vec3(1, 1, 0));
  EXPECT_EQ(mesh.vertices[3], Vec3(0, 0.15, 0));
  EXPECT_EQ(mesh.edge_refs, std::vector<std::int32_t>{5});
}

/// Nodes 10, 20, 30, 40 of a unit square.
const std::string unv_square =
    "    -1\n   164\n         1SI: Meters            2\n    -1\n    -1\n  2411\n"
    "        10         1         1        11\n   0.0000000000000000D+00   0.0000000000000000D+00   0.0000000000000000D+00\n"
    "        20         1         1        11\n   1.0000000000000000D+00   0.0000000000000000D+00   0.0000000000000000D+00\n"
    "        40         1         1        11\n   0.0000000000000000D+00   1.0000000000000000D+00   0.0000000000000000D+00\n"
    "        30         1         1        11\n   1.0000000000000000E+00   1.0000000000000000E+00   0.0000000000000000E+00\n    -1\n";

TEST(SolverFiles, NastranNodesInLocalSystems) {
  // The same three points of z = 0 in each system. System 1 is the basic one turned by a quarter about z and moved by (1, 2, 3);
  // 2 is cylindrical and 3 spherical in it; 4 and 5 are given by nodes.
  const FlatMesh mesh = read_mesh_bdf(
      "CORD2R,1,0,1.,2.,3.,1.,2.,4.\n,1.,3.,3.\n"
      "CORD2C,2,1,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nCORD2S,3,1,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
      "CORD1R,4,101,102,103,5,101,102,103\n"
      "GRDSET,,1\n"
      "GRID,101,0,1.,2.,3.\nGRID,102,0,1.,2.,4.\nGRID,103,0,1.,3.,3.\n"
      "GRID,1,,2.,0.,0.\nGRID,2,2,2.,90.,1.\nGRID,3,3,2.,90.,180.\nGRID,4,4,0.,0.,2.\nGRID,5,5,1.,1.,1.\n"
      "CTRIA3,1,1,1,2,3\nCTRIA3,2,1,1,4,5\nENDDATA\n", "x");
  const std::vector<Vec3> wanted{{1, 4, 3}, {-1, 2, 4}, {1, 0, 3}, {1, 2, 5}, {0, 3, 4}};
  for (std::size_t k = 0; k < wanted.size(); ++k) EXPECT_LT(norm(mesh.vertices[k] - wanted[k]), 1e-14) << k;
  const auto sentence = [](const std::string& text) { return sentence_of<FileError>([&] { read_mesh_bdf(text, "x"); }); };
  EXPECT_EQ(sentence("CORD2R,1,2,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nCORD2R,2,1,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nGRID,1,1,0.,0.,0.\n"),
            "x, line 1: system of coordinates 1 is given in terms of itself");
  EXPECT_EQ(sentence("CORD2R,1,0,0.,0.,0.,0.,0.,1.\n,0.,0.,2.\nGRID,1,1,0.,0.,0.\n"),
            "x, line 1: system of coordinates 1 has no axes: its three points lie on a line");
  EXPECT_EQ(sentence("CORD1R,1,7,8,9\nGRID,1,1,0.,0.,0.\n"), "x, line 1: node 7 is named, and the file does not have it");
}

TEST(SolverFiles, UnvOfOtherProgramsWithoutGroups) {
  const FlatMesh mesh = read_mesh_unv(unv_square +
      "    -1\n  2412\n         1        11         4         1         7         2\n         0         0         0\n        10        20\n"
      "         2        41         7         1         7         3\n        10        20        30\n"
      "         3       111         9         1         7         4\n        10        20        30        40\n"
      "         5        91         8         1         7         3\n        10        30        40\n    -1\n", "x");
  EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh.triangle_refs, (std::vector<std::int32_t>{7, 8}));
  EXPECT_EQ(mesh.edges, (std::vector<std::array<std::int32_t, 2>>{{0, 1}}));
  EXPECT_EQ(mesh.edge_refs, std::vector<std::int32_t>{4});
}

TEST(SolverFiles, UnvGroupsAreFacesAndCurves) {
  const std::string elements = unv_square +
      "    -1\n  2412\n         1        21         1         1         7         2\n         0         1         1\n        10        20\n"
      "         2        91         1         1         7         3\n        10        20        30\n"
      "         3        91         1         1         7         3\n        10        30        40\n    -1\n";
  const FlatMesh mesh = read_mesh_unv(elements +
      "    -1\n  2477\n         1         0         0         0         0         0         0         1\nLeft side\n"
      "         8         3         0         0\n"
      "         2         0         0         0         0         0         0         2\nface_9\n"
      "         8         2         0         0         8         3         0         0\n"
      "         3         0         0         0         0         0         0         2\nrim\n"
      "         8         1         0         0         7        10         0         0\n    -1\n", "x");
  EXPECT_EQ(mesh.triangle_refs, (std::vector<std::int32_t>{9, 10}));  // the first group of an element is its own
  EXPECT_EQ(mesh.edge_refs, std::vector<std::int32_t>{1});
  ASSERT_EQ(mesh.faces.size(), 1u);
  EXPECT_EQ(mesh.faces[0].ref, 10);
  EXPECT_EQ(mesh.faces[0].name, "Left side");
}

TEST(SolverFiles, NameTheLineOfAMistake) {
  const auto sentence = [](Read read, const std::string& text) { return sentence_of<FileError>([&] { read(text, "x"); }); };
  EXPECT_NE(sentence(read_mesh_inp, "*NODE\n1, 0, 0, 0\n1, 0, 0, 0\n").find("x, line 3: node 1 comes twice"), std::string::npos);
  EXPECT_NE(sentence(read_mesh_inp, "*NODE\n1, 0, a, 0\n").find("not 'a'"), std::string::npos);
  EXPECT_NE(sentence(read_mesh_inp, "*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=S3\n1, 1, 1, 9\n").find("node 9"), std::string::npos);
  EXPECT_NE(sentence(read_mesh_inp, "*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=S3\n1, 1, 1\n").find("fewer nodes"), std::string::npos);
  EXPECT_NE(sentence(read_mesh_inp, "*ELEMENT, TYPE=WHAT\n1, 1\n").find("'WHAT'"), std::string::npos);
  EXPECT_NE(sentence(read_mesh_inp, "nothing\n").find("keyword"), std::string::npos);
  EXPECT_NE(sentence(read_mesh_bdf, "GRID,1,,0.,x,0.\n").find("not 'x'"), std::string::npos);
  EXPECT_NE(sentence(read_mesh_bdf, "GRID,1,4,0.,0.,0.\n").find("x, line 1: system of coordinates 4 is named"), std::string::npos);
  EXPECT_NE(sentence(read_mesh_bdf, "GRID,1\nCTRIA3,1,1,1,1\n").find("a node"), std::string::npos);
  EXPECT_NE(sentence(read_mesh_su2, "NDIME= 4\n").find("instead of 2 or 3"), std::string::npos);
  EXPECT_NE(sentence(read_mesh_su2, "NDIME= 2\nNELEM= 1\n5 0 1 2 0\nNPOIN= 2\n0 0 0\n1 0 1\n").find("vertex 2"), std::string::npos);
  EXPECT_NE(sentence(read_mesh_su2, "NDIME= 2\nNELEM= 1\n77 0 1 2 0\n").find("type 77"), std::string::npos);
  EXPECT_NE(sentence(read_mesh_unv, "nothing\n").find("x, line 1: -1, which begins a dataset, was expected"), std::string::npos);
  EXPECT_NE(sentence(read_mesh_unv, unv_square + "    -1\n  2412\n").find("ends inside a dataset"), std::string::npos);
  EXPECT_NE(sentence(read_mesh_unv, unv_square + "    -1\n    58\n1 2\n").find("dataset '58' has no end"), std::string::npos);
  const auto with_element = [](const std::string& lines) { return unv_square + "    -1\n  2412\n" + lines + "    -1\n"; };
  EXPECT_NE(sentence(read_mesh_unv, with_element("1 91 1 1 7 3\n10 20 50\n")).find("line 18: node 50 is named"), std::string::npos);
  EXPECT_NE(sentence(read_mesh_unv, with_element("1 93 1 1 7 9\n1 2 3 4 5 6 7 8 9\n")).find("descriptor 93 has 9 nodes"), std::string::npos);
  EXPECT_NE(sentence(read_mesh_unv, with_element("1 999 1 1 7 1\n10\n")).find("descriptor 999 are not known"), std::string::npos);
  EXPECT_NE(sentence(read_mesh_unv, with_element("1 91 1 1 7 3\n10 20 30\n1 91 1 1 7 3\n10 30 40\n")).find("element 1 comes twice"), std::string::npos);
  EXPECT_NE(sentence(read_mesh_unv, with_element("1 91 1 1 7 x\n")).find("'x'"), std::string::npos);
}

}  // namespace
}  // namespace carreau
