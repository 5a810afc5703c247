// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "io/files.h"
#include "io/mesh_files.h"
#include "io_test_support.h"

namespace carreau {
namespace {

std::string error_of(std::string_view text) {
  return sentence_of<FileError>([&] { read_mesh_text(text, "x.mesh"); });
}

// RT-0232 sec. 4.
constexpr const char* manual_square =
    "MeshVersionFormatted 0\nDimension\n2\nVertices\n9\n"
    "-2.5000000 -2.5000000 1\n 2.5000000 -2.5000000 2\n 2.5000000  2.5000000 4\n-2.5000000  2.5000000 6\n"
    " 0.0000000 -2.5000000 0\n 2.5000000  0.0000000 0\n 0.0000000  2.5000000 0\n-2.5000000  0.0000000 0\n"
    " 0.0000000  0.0000000 1\n"
    "Triangles\n8\n7 4 8 1\n6 9 5 1\n9 8 5 1\n1 5 8 1\n7 8 9 1\n3 7 6 1\n6 5 2 1\n6 7 9 1\nEnd\n";

TEST(Medit, ReadsTheManualsSquare) {
  const FlatMesh mesh = read_mesh_text(manual_square, "x.mesh");
  EXPECT_EQ(mesh.dimension, 2);
  ASSERT_EQ(mesh.vertices.size(), 9u);
  EXPECT_EQ(mesh.vertices[2], (Vec3{2.5, 2.5, 0}));
  EXPECT_EQ(mesh.vertex_refs[3], 6);
  ASSERT_EQ(mesh.triangles.size(), 8u);
  EXPECT_EQ(mesh.triangles[0], (std::array<std::int32_t, 3>{6, 3, 7}));
  EXPECT_EQ(mesh.triangle_refs, std::vector<std::int32_t>(8, 1));
  EXPECT_TRUE(mesh.edges.empty());
}

TEST(Medit, WritesTheFormatOfTheManualWithVersion2) {
  FlatMesh mesh = square();
  EXPECT_EQ(mesh_bytes(mesh, MeshFormat::mesh),
            "MeshVersionFormatted 2\n\nDimension\n3\n\nVertices\n4\n0 0 0 1\n1 0 0 2\n1 1 0.5 0\n0 1 0.5 4\n"
            "\nEdges\n4\n1 2 11\n2 3 12\n3 4 13\n4 1 14\n\nTriangles\n2\n1 2 3 7\n1 3 4 -2\n\nEnd\n");
  mesh.dimension = 2;
  mesh.edges.clear();
  mesh.edge_refs.clear();
  mesh.triangle_refs.clear();  // an empty list stands for zeros
  EXPECT_EQ(mesh_bytes(mesh, MeshFormat::mesh),
            "MeshVersionFormatted 2\n\nDimension\n2\n\nVertices\n4\n0 0 1\n1 0 2\n1 1 0\n0 1 4\n"
            "\nTriangles\n2\n1 2 3 0\n1 3 4 0\n\nEnd\n");
}

TEST(Medit, LayoutCommentsAndOtherSectionsDoNotMatter) {
  const FlatMesh mesh = read_mesh_text(
      "\xEF\xBB\xBF# made by hand\r\n MeshVersionFormatted\n2 Dimension 3 # space\n"
      "Triangles 1 1 2 3 5\nCorners 2\n1 2\nRequiredVertices 0\nNormals 1 0 0 1\n"
      "Geometry \"a name End Vertices\"\nAngleOfCornerBound 30.5\nHexahedra 1 1 2 3 1 1 2 3 1 1\nIdentifier \"x\"\n"
      "Vertices 3\n0 +1.5d0 -2.5E-1 1 1e300 .5 0. 2\n-0 1.D-3 7 -3#end\nEnd\n",
      "x.mesh");
  ASSERT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.vertices[0], (Vec3{0, 1.5, -0.25}));
  EXPECT_EQ(mesh.vertices[1], (Vec3{1e300, 0.5, 0}));
  EXPECT_EQ(mesh.vertices[2], (Vec3{0, 1e-3, 7}));
  EXPECT_TRUE(std::signbit(mesh.vertices[2].x()));
  EXPECT_EQ(mesh.vertex_refs, (std::vector<std::int32_t>{1, 2, -3}));
  EXPECT_EQ(mesh.triangles[0], (std::array<std::int32_t, 3>{0, 1, 2}));
  EXPECT_EQ(mesh.triangle_refs[0], 5);
}

TEST(Medit, ReadsVersions0To4) {
  for (int version = 0; version <= 4; ++version)
    EXPECT_EQ(
        read_mesh_text("MeshVersionFormatted " + std::to_string(version) + " Dimension 2 Vertices 1 3 4 5 End", "x")
            .vertices[0],
        (Vec3{3, 4, 0}));
  EXPECT_EQ(error_of("MeshVersionFormatted 5\n"), "x.mesh, line 1: version 5 is not one of 0, 1, 2, 3, 4");
}

TEST(Medit, EveryTruncationIsAnErrorButOfEnd) {
  const std::string_view text = manual_square;
  const std::size_t end = text.find("End");
  for (std::size_t n = 0; n < text.size() - 1; ++n)
    EXPECT_EQ(error_of(text.substr(0, n)) == "", n == end || n == end + 3) << n;
}

TEST(Medit, ReadsFilesOfCommentsWithoutEnd) {
  const FlatMesh mesh = read_mesh_text(
      "MeshVersionFormatted 1\n\nDimension\n3\n#Mesh made elsewhere (x)\n\nVertices # corners\n3\n0 0 0 6\n1 0 0 4 # one\n"
      "0 1 0.5  3\n\nTriangles\n1\n1 2  3 7\n",
      "x.mesh");
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}}));
  EXPECT_EQ(mesh.vertex_refs, (std::vector<std::int32_t>{6, 4, 3}));
  EXPECT_EQ(mesh.triangle_refs[0], 7);
  // Vertices alone may be a part of a file.
  EXPECT_EQ(error_of("MeshVersionFormatted 2\nDimension 3\nVertices 1\n0 0 0 0\n"),
            "x.mesh, line 5: the file ends without the word End: it may be truncated");
}

TEST(Medit, NamesTheLineOfEveryViolation) {
  const auto with = [](const std::string& part, const std::string& replacement) {
    std::string text = manual_square;
    return error_of(text.replace(text.find(part), part.size(), replacement));
  };
  EXPECT_EQ(error_of(""), "x.mesh, line 1: the file is empty");
  EXPECT_EQ(error_of("\n\nsolid x"), "x.mesh, line 3: a mesh file starts with MeshVersionFormatted, not with 'solid'");
  EXPECT_EQ(with("Vertices\n9", "Vertices\n-9"), "x.mesh, line 5: the number of vertices is negative: -9");
  EXPECT_EQ(with("Vertices\n9", "Vertices\n2000000000").find("x.mesh, line 5: 2000000000 vertices are announced, but "),
            0u);
  EXPECT_EQ(with("Triangles\n8", "Triangles\n2147483647").find("x.mesh, line 16: 2147483647 triangles are announced"),
            0u);
  EXPECT_EQ(with("Vertices\n9", "Vertices\n9.5"),
            "x.mesh, line 5: the number of vertices should be an integer of 32 bits, not '9.5'");
  EXPECT_EQ(with("Vertices\n9", "Vertices\n8"),
            "x.mesh, line 14: the name of a section or End was expected, not '0.0000000'");
  EXPECT_EQ(with("Vertices\n9", "Vertices\n10"),
            "x.mesh, line 15: a coordinate of a vertex should be a number, not 'Triangles'");
  EXPECT_EQ(with("0.0000000  2.5000000", "nan 2.5"), "x.mesh, line 12: a coordinate of a vertex is not finite: 'nan'");
  EXPECT_EQ(with("0.0000000  2.5000000", "-inf 2.5"),
            "x.mesh, line 12: a coordinate of a vertex is not finite: '-inf'");
  EXPECT_EQ(with("0.0000000  2.5000000", "1e999 2.5"),
            "x.mesh, line 12: a coordinate of a vertex should be a number, not '1e999'");
  EXPECT_EQ(with("9 8 5 1", "9 10 5 1"), "x.mesh, line 19: triangle 3 names vertex 10, but there are 9");
  EXPECT_EQ(with("9 8 5 1", "9 0 5 1"), "x.mesh, line 19: triangle 3 names vertex 0, but there are 9");
  EXPECT_EQ(with("9 8 5 1", "9 -2147483648 5 1"),
            "x.mesh, line 19: triangle 3 names vertex -2147483648, but there are 9");
  EXPECT_EQ(with("Triangles", "Triangels"),
            "x.mesh, line 15: the name of a section or End was expected, not 'Triangels'");
  EXPECT_EQ(with("Dimension\n2", "Dimension\n4"), "x.mesh, line 3: the dimension is 4 instead of 2 or 3");
  EXPECT_EQ(with("Dimension\n2", ""), "x.mesh, line 3: Vertices comes before Dimension");
  EXPECT_EQ(with("Triangles\n8", "Vertices\n8"), "x.mesh, line 15: Vertices comes twice");
  EXPECT_EQ(with("End", "Triangles 0\nEnd"), "x.mesh, line 25: triangles come twice");
  EXPECT_EQ(with("End", "Quadrilaterals\n2\n1 2 9 8 1\n1 2 3 10 1\nEnd"),
            "x.mesh, line 28: quadrilateral 2 names vertex 10, but there are 9");
  EXPECT_EQ(with("End", "TrianglesP2 1\n1 2 9 8 5 6 1\nEnd"),
            "x.mesh, line 27: elements of first and of second order are mixed");
  EXPECT_EQ(with("End", "Quadrilaterals 0\nEnd"), "");
  EXPECT_EQ(with("\nEnd\n", ""), "x.mesh, line 24: the file ends without the word End: it may be truncated");
  EXPECT_EQ(with("End", "Ridges ;"), "x.mesh, line 25: a number or the name of a section was expected, not ';'");
  EXPECT_EQ(with("End", "Geometry \"x\n"), "x.mesh, line 25: a quote is not closed on its line");
  EXPECT_EQ(error_of("MeshVersionFormatted 2 Dimension 3 End"), "x.mesh, line 1: the file has no Vertices");
  EXPECT_EQ(error_of("MeshVersionFormatted 2 Dimension 3 Edges 1 1 2 3 Vertices 1 0 0 0 0 End"),
            "x.mesh, line 1: edge 1 names vertex 2, but there are 1");
  EXPECT_EQ(error_of("MeshVersionFormatted 2 Dimension 3 Vertices 1 0 0 0 0\nTetrahedra 1 1 1 1 2 0 End"),
            "x.mesh, line 2: tetrahedron 1 names vertex 2, but there are 1");
}

TEST(Medit, TetrahedraAreReadAndNeverWritten) {
  const FlatMesh mesh = read_mesh_text(
      "MeshVersionFormatted 2 Dimension 3 Vertices 4 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0 Tetrahedra 1 4 2 1 3 5 End", "x");
  EXPECT_EQ(mesh.tetrahedra, (std::vector<std::array<std::int32_t, 4>>{{3, 1, 0, 2}}));
  EXPECT_EQ(mesh.triangles.size(), 4u);  // its outer faces
  EXPECT_EQ(mesh.triangle_refs, (std::vector<std::int32_t>(4, 5)));
  EXPECT_EQ(mesh_bytes(mesh, MeshFormat::mesh).find("Tetra"), std::string::npos);
}

TEST(Medit, IsTheSameInEveryLocale) {
  const CommaLocale locale;
  const std::string text = mesh_bytes(square(), MeshFormat::mesh);
  EXPECT_NE(text.find("1 1 0.5 0\n"), std::string::npos);
  expect_same_geometry(read_mesh_text(text, "x"), square());
}

}  // namespace
}  // namespace carreau
