// SPDX-License-Identifier: BSD-3-Clause
// Every format is read back as it was written; files of other programs, and broken ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "io/mesh_files.h"
#include "io_test_support.h"

namespace carreau {
namespace {

FlatMesh back(const FlatMesh& mesh, MeshFormat format, const MeshFileOptions& options = {}) {
  const std::string bytes = mesh_bytes(mesh, format, options);
  switch (format) {
    case MeshFormat::bl2d:
      return read_mesh_bl2d(mesh_bytes(mesh, format, options), "x.bl2d");
    case MeshFormat::vtu:
      return read_mesh_vtu(bytes, "x.vtu");
    case MeshFormat::stl:
      return read_mesh_stl(bytes, "x.stl");
    case MeshFormat::msh:
    case MeshFormat::msh2:
      return read_mesh_msh(bytes, "x.msh");
    case MeshFormat::mesh:
      return read_mesh_text(bytes, "x.mesh");
    case MeshFormat::meshb:
      return read_mesh_binary(bytes, "x.meshb");
    default:
      throw std::logic_error("solver/ and polygons/ have tests of their own");
  }
}

/// As other formats than Medit's hold it: in space.
FlatMesh in_space(FlatMesh mesh) {
  if (mesh.dimension == 2)
    for (Vec3& p : mesh.vertices) p.z() = 0;
  mesh.dimension = 3;
  return mesh;
}

FlatMesh named_square() {
  FlatMesh mesh = square();
  mesh.triangle_refs = {7, 9};
  mesh.faces = {{7, FaceStatus::meshed, "bore & <rim>"}, {9, FaceStatus::mended, ""}};
  return mesh;
}

void expect_same_faces(const FlatMesh& a, const FlatMesh& b) {
  ASSERT_EQ(a.faces.size(), b.faces.size());
  for (std::size_t f = 0; f < a.faces.size(); ++f) {
    EXPECT_EQ(a.faces[f].ref, b.faces[f].ref);
    EXPECT_EQ(a.faces[f].name, b.faces[f].name);
    EXPECT_EQ(a.faces[f].status, b.faces[f].status);
    EXPECT_EQ(a.faces[f].why, b.faces[f].why);
    EXPECT_EQ(a.faces[f].rgb, b.faces[f].rgb);
  }
}

TEST(MeshReaders, VtuGivesEverythingBack) {
  std::mt19937_64 random(12);
  for (int run = 0; run < 200; ++run) {
    const FlatMesh mesh = random_mesh(random);
    expect_same_geometry(back(mesh, MeshFormat::vtu), in_space(mesh));
  }
  FlatMesh mesh = named_square();
  mesh.faces.push_back({12, FaceStatus::failed, "lost", "its boundary crosses itself at (1, 2)"});
  mesh.faces[1].rgb = 0xFF8000;
  mesh.fields = {{"a", false, 2, {1, 2, 3, 4}, {5, 6, 7, 8, 9, 10, 11, 12}},
                 {"b", false, 1, {}, {1, 2, 3, 4}},
                 {"c & <d>", false, 1, {1, 2}},
                 {"e", true, 1, {0.1, 0.2, 0.3, 0.4}}};
  const FlatMesh found = back(mesh, MeshFormat::vtu);
  expect_same_geometry(found, mesh);
  expect_same_faces(found, mesh);
  ASSERT_EQ(found.fields.size(), 4u);
  for (const MeshField& field : found.fields) {
    const auto same = std::find_if(mesh.fields.begin(), mesh.fields.end(),
                                   [&](const MeshField& each) { return each.name == field.name; });
    ASSERT_NE(same, mesh.fields.end()) << field.name;
    EXPECT_EQ(field.on_vertices, same->on_vertices);
    EXPECT_EQ(field.components, same->components);
    EXPECT_EQ(field.values, same->values);
    EXPECT_EQ(field.edge_values, same->edge_values);
  }
}

/// Triangles and edges of ascending positive references, and corners with separate references: the content that Gmsh
/// holds.
FlatMesh random_gmsh_mesh(std::mt19937_64& random) {
  FlatMesh mesh = in_space(random_mesh(random));
  const auto ascending = [&](std::vector<std::int32_t>& refs) {
    for (std::int32_t& ref : refs) ref = static_cast<std::int32_t>(1 + random() % 9);
    std::sort(refs.begin(), refs.end());
  };
  ascending(mesh.triangle_refs);
  ascending(mesh.edge_refs);
  for (std::size_t v = 0; v < mesh.vertex_refs.size(); ++v)
    mesh.vertex_refs[v] = random() % 3 == 0 ? static_cast<std::int32_t>(v + 1) : 0;
  return mesh;
}

TEST(MeshReaders, GmshGivesPointsAndReferencesBack) {
  std::mt19937_64 random(13);
  for (const MeshFormat format : {MeshFormat::msh, MeshFormat::msh2})
    for (int run = 0; run < 200; ++run) {
      FlatMesh mesh = random_gmsh_mesh(random);
      if (mesh.triangles.empty()) continue;  // then 4.1 has no place for points that nothing holds
      expect_same_geometry(back(mesh, format), mesh);
    }
}

TEST(MeshReaders, GmshGivesNamesBack) {
  for (const MeshFormat format : {MeshFormat::msh, MeshFormat::msh2}) {
    FlatMesh mesh = named_square();
    FlatMesh found = back(mesh, format);
    ASSERT_EQ(found.faces.size(), 1u);
    EXPECT_EQ(found.faces[0].ref, 7);
    EXPECT_EQ(found.faces[0].name, "bore & <rim>");
    mesh.faces[1].name = mesh.faces[0].name;  // two faces of one name are one group
    found = back(mesh, format);
    ASSERT_EQ(found.faces.size(), 2u);
    EXPECT_EQ(found.faces[1].ref, 9);
    EXPECT_EQ(found.faces[1].name, "bore & <rim>");
  }
}

/// Corners of all triangles, in order.
std::vector<Vec3> corners_of(const FlatMesh& mesh) {
  std::vector<Vec3> corners;
  for (const auto& triangle : mesh.triangles)
    for (const std::int32_t v : triangle) corners.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
  return corners;
}

TEST(MeshReaders, StlTextGivesPointsExactlyAndSolidsAsFaces) {
  std::mt19937_64 random(14);
  for (int run = 0; run < 200; ++run) {
    FlatMesh mesh = in_space(random_mesh(random));
    std::sort(mesh.triangle_refs.begin(), mesh.triangle_refs.end());
    const FlatMesh found = back(mesh, MeshFormat::stl, {.ascii_stl = true});
    EXPECT_EQ(corners_of(found), corners_of(mesh));
    EXPECT_EQ(found.triangle_refs, mesh.triangle_refs);
    std::vector<Vec3> unique = corners_of(mesh);
    std::sort(unique.begin(), unique.end(),
              [](Vec3 a, Vec3 b) { return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z()); });
    unique.erase(std::unique(unique.begin(), unique.end()), unique.end());
    EXPECT_EQ(found.vertices.size(), unique.size());
  }
  const FlatMesh found = back(named_square(), MeshFormat::stl, {.ascii_stl = true});
  EXPECT_EQ(found.triangles, square().triangles);
  EXPECT_EQ(found.triangle_refs, (std::vector<std::int32_t>{1, 9}));  // a name stands in place of the reference
  ASSERT_EQ(found.faces.size(), 1u);
  EXPECT_EQ(found.faces[0].name, "bore & <rim>");
}

TEST(MeshReaders, BinaryStlGivesPointsBackInSinglePrecision) {
  FlatMesh mesh = square();
  mesh.vertices[2].z() = 0.1;
  const FlatMesh found = back(mesh, MeshFormat::stl);
  EXPECT_EQ(found.triangles, mesh.triangles);
  EXPECT_EQ(found.triangle_refs, (std::vector<std::int32_t>{0, 0}));
  EXPECT_EQ(found.vertices[2], (Vec3{1, 1, static_cast<double>(0.1f)}));
  std::string bytes = mesh_bytes(mesh, MeshFormat::stl);
  bytes.replace(0, 11, "solid block");  // some programs write this in front of binary data
  EXPECT_EQ(read_mesh_stl(bytes, "x").triangles, mesh.triangles);
}

TEST(MeshReaders, StlOfOtherPrograms) {
  const FlatMesh mesh = read_mesh_stl(
      "SOLID  the  part \r\n FACET NORMAL nan nan nan\r\n OUTER LOOP\r\n VERTEX 0 0 -0\r\n vertex 1. 0 0\r\nvertex 0 "
      "+1E0 0\r\nENDLOOP\r\nENDFACET\r\nfacet normal 0 0 1 outer loop vertex 0 1 0 vertex 1 0 0 vertex 0 0 0 endloop "
      "endfacet ENDSOLID the  part\r\nsolid\nendsolid\nsolid surface_1\nendsolid surface_1\n",
      "x");
  EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {2, 1, 0}}));
  EXPECT_EQ(mesh.triangle_refs, (std::vector<std::int32_t>{2, 2}));
  ASSERT_EQ(mesh.faces.size(), 1u);
  EXPECT_EQ(mesh.faces[0].name, "the  part");
}

TEST(MeshReaders, StlWithoutNormalsOrNamesOfEnds) {
  const FlatMesh wanted = read_mesh_stl("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                                        "endloop\nendfacet\nendsolid a\n", "x");
  for (const char* facet : {"facet\nouter loop\n", "facet normal\nouter loop\n", "facet normal 0 0\n outer loop\n"})
    for (const char* ends : {"endloop\nendfacet\nendsolid\n", "end loop\nend facet\nend solid a\n", "end\nend\nend\n"}) {
      const FlatMesh mesh = read_mesh_stl(
          "solid a\n" + std::string(facet) + "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n" + ends, "x");
      EXPECT_EQ(mesh.vertices, wanted.vertices) << facet << ends;
      EXPECT_EQ(mesh.triangles, wanted.triangles) << facet << ends;
      EXPECT_EQ(mesh.faces[0].name, "a");
    }
}

TEST(MeshReaders, GmshQuadrilateralsOfNineNodesLoseTheirCentre) {
  const FlatMesh mesh = read_mesh_msh(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n9\n1 0 0 0\n2 2 0 0\n3 2 2 0\n4 0 2 0\n5 1 0 0\n6 2 1 0\n7 1 2 0\n"
      "8 0 1 0\n9 1 1 0.1\n$EndNodes\n$Elements\n1\n1 10 2 4 4 1 2 3 4 5 6 7 8 9\n$EndElements\n", "x");
  ASSERT_EQ(mesh.cells.size(), 1u);
  EXPECT_EQ(mesh.cells[0].kind, CellKind::quad8);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.triangle_refs, (std::vector<std::int32_t>{4, 4}));
}

TEST(MeshReaders, VtuPixelsPolygonsStripsAndBiquadraticCells) {
  // Nine points of a square grid; each file covers the area 4.
  const auto area = [](const std::string& connectivity, const std::string& offsets, const std::string& types, int cells) {
    const FlatMesh mesh = read_mesh_vtu(
        "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece NumberOfPoints='9' NumberOfCells='" + std::to_string(cells) +
            "'><Points><DataArray type='Float32' NumberOfComponents='3' format='ascii'>0 0 0 1 0 0 2 0 0 0 1 0 1 1 0 2 1 0 0 2 0 "
            "1 2 0 2 2 0</DataArray></Points><Cells><DataArray type='Int32' Name='connectivity' format='ascii'>" +
            connectivity + "</DataArray><DataArray type='Int32' Name='offsets' format='ascii'>" + offsets +
            "</DataArray><DataArray type='UInt8' Name='types' format='ascii'>" + types +
            "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>", "x");
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles)
      sum += cross(mesh.vertices[std::size_t(b)] - mesh.vertices[std::size_t(a)],
                   mesh.vertices[std::size_t(c)] - mesh.vertices[std::size_t(a)]).z() / 2;
    return sum;
  };
  EXPECT_DOUBLE_EQ(area("0 1 3 4 1 2 4 5 3 4 6 7 4 5 7 8", "4 8 12 16", "8 8 8 8", 4), 4);
  EXPECT_DOUBLE_EQ(area("0 1 2 5 8 7 6 3", "8", "7", 1), 4);
  EXPECT_DOUBLE_EQ(area("3 0 4 1 5 2 6 3 7 4 8 5", "6 12", "6 6", 2), 4);
  EXPECT_DOUBLE_EQ(area("0 2 8 6 1 5 7 3 4", "9", "28", 1), 4);
  EXPECT_DOUBLE_EQ(area("0 2 8 6 1 5 7 3 4", "9", "70", 1), 4);
  EXPECT_DOUBLE_EQ(area("0 2 6 1 4 3 2 8 6 5 7 4", "6 12", "69 22", 2), 4);
}

constexpr const char* gmsh_22 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 5 \"the \"bore\" \"\n$EndPhysicalNames\n"
    "$Nodes\n4\n30 0 0 0\n10 1 0 0\n20 0 1 0\n99 0 0 1\n$EndNodes\n$Periodic\n0\n$EndPeriodic\n"
    "$Elements\n4\n1 15 2 0 4 20\n2 1 3 0 6 9 10 20\n3 2 2 5 8 30 10 20\n4 4 2 1 1 10 20 30 99\n$EndElements\n";

TEST(MeshReaders, GmshFilesMayNumberNodesAsTheyLike) {
  const FlatMesh mesh = read_mesh_msh(gmsh_22, "x");
  EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 1}}));
  EXPECT_EQ(mesh.vertex_refs, (std::vector<std::int32_t>{0, 4, 0, 0}));
  EXPECT_EQ(mesh.edges, (std::vector<std::array<std::int32_t, 2>>{{0, 1}}));
  EXPECT_EQ(mesh.edge_refs, std::vector<std::int32_t>{6});
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::int32_t, 3>>{{2, 0, 1}}));
  EXPECT_EQ(mesh.triangle_refs, std::vector<std::int32_t>{8});
  EXPECT_EQ(mesh.tetrahedra, (std::vector<std::array<std::int32_t, 4>>{{0, 1, 2, 3}}));
  ASSERT_EQ(mesh.faces.size(), 1u);
  EXPECT_EQ(mesh.faces[0].name, "the \"bore\" ");
}

/// The same mesh in each binary form, as the manual of Gmsh describes them.
std::string binary_gmsh(bool big_endian, bool version_2) {
  Bytes one(big_endian), nodes(big_endian), elements(big_endian), entities(big_endian);
  one.i32(1);
  const double x[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.1}};
  const std::string head = std::string("$MeshFormat\n") + (version_2 ? "2.2" : "4.1") + " 1 8\n" + one.text() +
                           "\n$EndMeshFormat\n$PhysicalNames\n1\n2 5 \"dish\"\n$EndPhysicalNames\n";
  const auto reals = [](Bytes& to, const double* values, int n) {
    for (int k = 0; k < n; ++k) to.f64(values[k]);
  };
  if (version_2) {
    for (int v = 0; v < 3; ++v) nodes.i32(v + 1), reals(nodes, x[v], 3);
    elements.i32(1).i32(1).i32(2).i32(1).i32(0).i32(6).i32(1).i32(2);
    elements.i32(2).i32(1).i32(2).i32(2).i32(5).i32(8).i32(1).i32(2).i32(3);
    return head + "$Nodes\n3\n" + nodes.text() + "\n$EndNodes\n$Elements\n2\n" + elements.text() + "\n$EndElements\n";
  }
  const double box[6] = {};
  entities.i64(1).i64(1).i64(1).i64(0);
  entities.i32(4), reals(entities, box, 3), entities.i64(0);
  entities.i32(6), reals(entities, box, 6), entities.i64(0).i64(2).i32(4).i32(-4);
  entities.i32(8), reals(entities, box, 6), entities.i64(1).i32(5).i64(1).i32(6);
  nodes.i64(1).i64(3).i64(1).i64(3).i32(2).i32(8).i32(1).i64(3).i64(1).i64(2).i64(3);
  for (const auto& p : x) reals(nodes, p, 3), nodes.f64(0.5).f64(0.25);  // with (u, v)
  elements.i64(2).i64(2).i64(1).i64(2);
  elements.i32(1).i32(6).i32(1).i64(1).i64(1).i64(1).i64(2);
  elements.i32(2).i32(8).i32(2).i64(1).i64(2).i64(1).i64(2).i64(3);
  return head + "$Entities\n" + entities.text() + "\n$EndEntities\n$Nodes\n" + nodes.text() +
         "\n$EndNodes\n$Elements\n" + elements.text() + "\n$EndElements\n";
}

TEST(MeshReaders, GmshBinaryInBothByteOrders) {
  for (const bool version_2 : {false, true})
    for (const bool big_endian : {false, true}) {
      const std::string bytes = binary_gmsh(big_endian, version_2);
      const FlatMesh mesh = read_mesh_msh(bytes, "x");
      EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.1}}));
      EXPECT_EQ(mesh.edge_refs, std::vector<std::int32_t>{6});
      EXPECT_EQ(mesh.triangle_refs, std::vector<std::int32_t>{8});
      ASSERT_EQ(mesh.faces.size(), 1u);
      EXPECT_EQ(mesh.faces[0].name, "dish");
      for (std::size_t n = 0; n + 1 < bytes.size(); ++n)  // without the last line's end it is whole
        EXPECT_NE(sentence_of<FileError>([&] { read_mesh_msh(bytes.substr(0, n), "x"); }), "") << n;
    }
}

TEST(MeshReaders, EveryTruncationIsFound) {
  for (const MeshFormat format : {MeshFormat::msh, MeshFormat::msh2, MeshFormat::vtu, MeshFormat::stl}) {
    const std::string bytes = mesh_bytes(named_square(), format, {.ascii_stl = true});
    const std::string last = format == MeshFormat::vtu   ? "\n</AppendedData>"
                             : format == MeshFormat::stl ? " surface_9"
                                                         : "\n";
    // A .stl file may end after any solid.
    const std::size_t second = format == MeshFormat::stl ? bytes.rfind("\nsolid") : bytes.size();
    for (std::size_t n = 0; n < bytes.rfind(last); ++n) {
      if (format == MeshFormat::stl && n >= bytes.find("endsolid") + 8 && n <= second + 1) continue;
      const std::string start = bytes.substr(0, n);
      EXPECT_NE(sentence_of<FileError>([&] {
                  if (format == MeshFormat::vtu)
                    read_mesh_vtu(start, "x");
                  else if (format == MeshFormat::stl)
                    read_mesh_stl(start, "x");
                  else
                    read_mesh_msh(start, "x");
                }),
                "")
          << n << " of " << bytes.size() << " bytes: ..." << start.substr(n > 30 ? n - 30 : 0);
    }
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(MeshReaders, GmshErrorsNameTheLine) {
  const auto sentence = [](const std::string& from, const std::string& to) {
    return sentence_of<FileError>([&] { read_mesh_msh(replaced(gmsh_22, from, to), "x.msh"); });
  };
  EXPECT_EQ(sentence("$MeshFormat", "MeshVersionFormatted 2"),
            "x.msh, line 1: the name of a section was expected, not 'MeshVersionFormatted'");
  EXPECT_EQ(sentence("2.2 0 8", "3 0 8"), "x.msh, line 2: version 3 of the format is neither 4.1 nor 2.2");
  EXPECT_EQ(sentence("4\n30 0", "5000\n30 0"),
            "x.msh, line 9: 5000 nodes are announced, but the rest of the file has room for at most 21");
  EXPECT_EQ(sentence("20 0 1 0", "20 0 nan 0"), "x.msh, line 12: a coordinate of a node is not finite: 'nan'");
  EXPECT_EQ(sentence("99 0 0 1", "10 0 0 1"), "x.msh, line 9: node 10 is given twice");
  EXPECT_EQ(sentence("30 10 20\n", "30 11 20\n"), "x.msh, line 22: an element names node 11, which does not exist");
  EXPECT_EQ(sentence("3 2 2 5 8 30 10 20", "3 21 2 5 8 30 10 20 99 1 2 3 4 5"),
            "x.msh, line 22: an element has type 21; surfaces of triangles and quadrilaterals of order 1 and 2 (types 2, "
            "3, 9, 10, 16) and solids are read only");
  EXPECT_EQ(sentence("$Elements\n4", "$Elements\n3"), "x.msh, line 23: $EndElements was expected, not '4'");
  EXPECT_EQ(sentence("\"the \"bore\" \"", "bore"),
            "x.msh, line 6: the name of a physical group should stand between quotation marks, not 'bore'");
  EXPECT_EQ(sentence_of<FileError>([] { read_mesh_msh("", "x.msh"); }), "x.msh, line 1: the file is empty");
}

TEST(MeshReaders, StlErrorsNameTheLine) {
  const std::string text = mesh_bytes(square(), MeshFormat::stl, {.ascii_stl = true});
  const auto sentence = [&](const std::string& from, const std::string& to) {
    return sentence_of<FileError>([&] { read_mesh_stl(replaced(text, from, to), "x.stl"); });
  };
  EXPECT_EQ(sentence("vertex 0 0 0", "vertex 0 0"),
            "x.stl, line 5: a coordinate of a vertex should be a number, not "
            "'vertex'");
  EXPECT_EQ(sentence("vertex 0 0 0", "vertex 0 0 inf"), "x.stl, line 4: a coordinate of a vertex is not finite: 'inf'");
  EXPECT_EQ(sentence("endloop", "vertex 0 0 0"), "x.stl, line 7: endloop was expected, not 'vertex'");
  EXPECT_EQ(sentence("solid", "mesh"),
            "x.stl: the file does not start with solid, as STL text does, and binary STL of 1919251978 triangles has "
            "95962598984 bytes instead of 319");
  EXPECT_EQ(sentence_of<FileError>([] { read_mesh_stl("", "x.stl"); }), "x.stl, line 1: the file is empty");
  EXPECT_EQ(sentence_of<FileError>([] { read_mesh_stl("part", "x.stl"); }),
            "x.stl: the file is neither STL text, which starts with solid, nor binary STL");
  std::string bytes = mesh_bytes(square(), MeshFormat::stl);
  bytes.replace(96, 4, Bytes().f32(std::numeric_limits<float>::infinity()).text());
  EXPECT_EQ(sentence_of<FileError>([&] { read_mesh_stl(bytes, "x.stl"); }),
            "x.stl: byte 96: a coordinate is not finite");
}

constexpr const char* vtu_text =
    "<?xml version='1.0'?>\n<!-- by hand -->\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n<UnstructuredGrid>"
    "\n<Piece NumberOfPoints='4' NumberOfCells='3'>\n<PointData>\n"
    "<DataArray type='Float32' Name='heat' format='ascii'>1 2 nan 4</DataArray>\n</PointData>\n<CellData/>\n<Points>\n"
    "<DataArray type='Float64' NumberOfComponents='3' format='ascii'>\n0 0 0 1 0 0\n0 1 0 0 0 1</DataArray>\n</Points>"
    "\n<Cells>\n<DataArray type='Int32' Name='connectivity' format='ascii'>0 1 2 3 0 1 2 2 1 0</DataArray>\n"
    "<DataArray type='Int32' Name='offsets' format='ascii'>3 7 10</DataArray>\n"
    "<DataArray type='UInt8' Name='types' format='ascii'>5 10 4</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n"
    "</VTKFile>\n";

TEST(MeshReaders, VtuTextOfOtherPrograms) {
  const FlatMesh mesh = read_mesh_vtu(vtu_text, "x");
  EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}}));
  EXPECT_EQ(mesh.edges, (std::vector<std::array<std::int32_t, 2>>{{2, 1}, {1, 0}}));
  EXPECT_EQ(mesh.triangle_refs, std::vector<std::int32_t>{0});
  EXPECT_EQ(mesh.tetrahedra, (std::vector<std::array<std::int32_t, 4>>{{3, 0, 1, 2}}));
  ASSERT_EQ(mesh.fields.size(), 1u);
  EXPECT_EQ(mesh.fields[0].values[3], 4);
}

TEST(MeshReaders, VtuArraysInOneTagAreEmpty) {
  const FlatMesh none = read_mesh_vtu(
      "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece NumberOfPoints='0' NumberOfCells='0'><Points>"
      "<DataArray type='Float64' NumberOfComponents='3' format='ascii'/></Points><Cells>"
      "<DataArray type='Int32' Name='connectivity' format='ascii'/><DataArray type='Int32' Name='offsets' "
      "format='ascii'/><DataArray type='UInt8' Name='types' format='ascii'/></Cells></Piece></UnstructuredGrid>"
      "</VTKFile>",
      "x");
  EXPECT_TRUE(none.vertices.empty() && none.triangles.empty());
}

TEST(MeshReaders, VtuInBase64WithTheLengthApartOrNot) {
  // 32 bits of length, then 0 1 2 as Int32: together, and each ended by its own padding.
  for (const char* corners : {"DAAAAAAAAAABAAAAAgAAAA==", "DAAAAA==AAAAAAEAAAACAAAA"}) {
    std::string text = replaced(vtu_text, "'connectivity' format='ascii'>0 1 2 3 0 1 2 2 1 0",
                                std::string("'connectivity' format='binary'>\n") + corners + "\n");
    text = replaced(replaced(text, "3 7 10", "3"), "5 10 4", "5");
    text = replaced(text, "NumberOfCells='3'", "NumberOfCells='1'");
    EXPECT_EQ(read_mesh_vtu(text, "x").triangles, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}}));
  }
}

TEST(MeshReaders, VtuArraysMayHoldTagsBehindTheirNumbers) {
  // As VTK writes ranges of norms.
  const std::string key = "<InformationKey name=\"L2_NORM_RANGE\" location=\"vtkDataArray\" length=\"2\">\n"
                          "<Value index=\"0\">\n0\n</Value>\n<Value index=\"1\">4.24</Value></InformationKey>\n"
                          "<InformationKey name='UNITS_LABEL' location='vtkDataArray'/>\n";
  const FlatMesh plain = read_mesh_vtu(vtu_text, "x");
  std::string text = vtu_text;
  for (std::size_t at = text.find("</DataArray>"); at != std::string::npos; at = text.find("</DataArray>", at + key.size() + 1))
    text.insert(at, key);
  const FlatMesh mesh = read_mesh_vtu(text, "x");
  EXPECT_EQ(mesh.vertices, plain.vertices);
  EXPECT_EQ(mesh.triangles, plain.triangles);
  EXPECT_EQ(mesh.edges, plain.edges);
  EXPECT_EQ(mesh.fields[0].values[3], 4);
  const std::string open = replaced(text, "</DataArray>", "");
  EXPECT_NE(sentence_of<FileError>([&] { read_mesh_vtu(open, "x.vtu"); }).find("is not closed"), std::string::npos);
}

/// The one triangle of vtu_text, its corners in base64 of compressed blocks.
std::string compressed_vtu(const std::string& corners) {
  std::string text = replaced(vtu_text, "'connectivity' format='ascii'>0 1 2 3 0 1 2 2 1 0",
                              "'connectivity' format='binary'>\n" + corners + "\n");
  text = replaced(replaced(text, "3 7 10", "3"), "5 10 4", "5");
  text = replaced(text, "NumberOfCells='3'", "NumberOfCells='1'");
  return replaced(text, "version=\"0.1\"", "compressor=\"vtkZLibDataCompressor\"");
}

TEST(MeshReaders, VtuCompressedInBlocks) {
  // 0 1 2 as Int32: in blocks of 8 bytes and of 4, and in one of 12.
  for (const char* corners : {"AgAAAAgAAAAEAAAADgAAAAwAAAA=eJxjYGBgYARiAAAMAAJ4nGNiYGAAAAAMAAM=",
                              "AQAAAAwAAAAAAAAAEQAAAA==eJxjYGBgYARiJiAGAAAcAAQ="})
    EXPECT_EQ(read_mesh_vtu(compressed_vtu(corners), "x").triangles,
              (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}}));
}

TEST(MeshReaders, VtuBlocksThatContradictTheirHeader) {
  const std::string array = "x.vtu, line 16: array 'connectivity'";
  for (const auto& [corners, sentence] :
       {std::pair{"AgAAAAgAAAAEAAAADgAAAAwAAAA=eJxjYGCfYARiAAAMAAJ4nGNiYGAAAAAMAAM=",
                  ": block 1 of its 2 compressed blocks is damaged"},
        {"AgAAAAAoa+4EAAAADgAAAAwAAAA=eJxjYGBgYARiAAAMAAJ4nGNiYGAAAAAMAAM=",
         ": block 1 of its 2 compressed blocks is too large for its compressed bytes"},
        {"AAk9AAgAAAAEAAAACgAAAA==", " should have 4000000 compressed blocks, more than the file holds"},
        {"AgAAAAgAAAAEAAAAAChr7goAAAA=eJxjYGBgYARiAAAMAAJ4nGNiYGAAAAAMAAM=",
         " should have a block of 4000000000 bytes, more than are left: the file may be truncated"},
        {"AgAAAAgAAAAEAAAADgAAAAwAAAA=", " should have 26 bytes, but 0 are left: the file may be truncated"}})
    EXPECT_EQ(sentence_of<FileError>([text = compressed_vtu(corners)] { read_mesh_vtu(text, "x.vtu"); }),
              array + sentence);
}

TEST(MeshReaders, VtuErrorsNameTheLine) {
  const auto sentence = [](const std::string& from, const std::string& to) {
    return sentence_of<FileError>([&] { read_mesh_vtu(replaced(vtu_text, from, to), "x.vtu"); });
  };
  EXPECT_EQ(sentence("VTKFile", "mesh"), "x.vtu, line 3: a .vtu file starts with VTKFile, not with 'mesh'");
  EXPECT_EQ(sentence("UnstructuredGrid", "PolyData"),
            "x.vtu, line 3: the type of the file is 'PolyData' instead of 'UnstructuredGrid'");
  EXPECT_EQ(sentence("version=\"0.1\"", "compressor=\"vtkLZ4DataCompressor\""),
            "x.vtu, line 3: its arrays are compressed by 'vtkLZ4DataCompressor'; only vtkZLibDataCompressor is known: "
            "write the file anew with compressor type ZLib or none");
  EXPECT_EQ(sentence("NumberOfPoints='4'", "NumberOfPoints='400000000'"),
            "x.vtu, line 11: array '' has 12 numbers instead of 1200000000");
  EXPECT_EQ(sentence("format='ascii'>\n0 0 0 1 0 0\n0 1 0 0 0 1</DataArray>", "format='ascii'/>"),
            "x.vtu, line 11: array '' has 0 numbers instead of 12");
  EXPECT_EQ(sentence("0 1 0 0 0 1<", "0 1 0 0 0 x<"), "x.vtu, line 13: a number was expected, not 'x'");
  EXPECT_EQ(sentence("0 1 2 3", "0 1 2 4"), "x.vtu, line 16: a cell names point 4 of 4");
  EXPECT_EQ(sentence("3 7 10", "3 2 10"), "x.vtu, line 17: the offset of cell 1 (from 0) is 2, which cannot be");
  EXPECT_EQ(sentence("5 10 4", "5 35 4"),
            "x.vtu, line 18: cell 1 (from 0) has type 35 and 4 points; triangles and quadrilaterals of order 1 and 2 "
            "(types 5, 9, 22, 23, 28, 34, 69, 70), pixels, polygons, strips and solids are read only");
  EXPECT_EQ(sentence("'offsets' format='ascii'", "'offsets' format='appended' offset='0'"),
            "x.vtu, line 17: array 'offsets' lies in AppendedData, which the file does not have");
  EXPECT_EQ(sentence("Name='types'", "Name='kinds'"), "x.vtu, line 5: Cells has no array 'types'");
  EXPECT_EQ(sentence("</Piece>", "<Piece>"), "x.vtu, line 20: NumberOfPoints is '' instead of a number of 32 bits");
}

// A unit square in two pieces, each with two triangles and a copy of one triangle of the other.
TEST(MeshReaders, VtuPiecesShareTheirBorder) {
  const auto piece = [](const std::string& points, const std::string& corners, const std::string& ghosts,
                        const std::string& refs, const std::string& height) {
    const auto array = [](const std::string& type, const std::string& name, const std::string& numbers) {
      return "<DataArray type='" + type + "' Name='" + name + "' format='ascii'>" + numbers + "</DataArray>\n";
    };
    return "<Piece NumberOfPoints='5' NumberOfCells='3'>\n<PointData>" + array("Float64", "height", height) +
           array("Int32", "reference", "1 1 1 1 1") + "</PointData><CellData>" + array("UInt8", "vtkGhostType", ghosts) +
           array("Int32", "reference", refs) + "</CellData><Points>" + array("Float64", "P", points) + "</Points><Cells>" +
           array("Int32", "connectivity", corners) + array("Int32", "offsets", "3 6 9") + array("UInt8", "types", "5 5 5") +
           "</Cells></Piece>\n";
  };
  const std::string text =
      "<?xml version='1.0'?>\n<VTKFile type='UnstructuredGrid' version='0.1' byte_order='LittleEndian'>\n<UnstructuredGrid>\n" +
      piece("0 0 0 .5 0 0 .5 1 0 0 1 0 1 0 0", "0 1 2 0 2 3 1 4 2", "0 0 1", "1 2 9", "0 .5 .5 0 1") +
      piece(".5 0 0 1 0 0 1 1 0 .5 1 0 0 0 0", "0 1 3 1 2 3 4 0 3", "0 0 1", "3 4 9", ".5 1 1 .5 0") +
      "</UnstructuredGrid>\n</VTKFile>\n";
  const FlatMesh mesh = read_mesh_vtu(text, "x.vtu");
  EXPECT_EQ(mesh.vertices.size(), 6u);
  EXPECT_EQ(mesh.triangle_refs, (std::vector<std::int32_t>{1, 2, 3, 4}));
  EXPECT_EQ(mesh.vertex_refs, std::vector<std::int32_t>(6, 1));
  double area = 0;
  std::map<std::pair<std::int32_t, std::int32_t>, int> sides;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[1]] - mesh.vertices[t[0]], b = mesh.vertices[t[2]] - mesh.vertices[t[0]];
    area += (a.x() * b.y() - a.y() * b.x()) / 2;
    for (int k = 0; k < 3; ++k) ++sides[std::minmax(t[k], t[(k + 1) % 3])];
  }
  EXPECT_DOUBLE_EQ(area, 1);
  EXPECT_EQ(std::count_if(sides.begin(), sides.end(), [](const auto& side) { return side.second == 2; }), 3);
  ASSERT_EQ(mesh.fields.size(), 1u);
  for (std::size_t v = 0; v < 6; ++v) EXPECT_EQ(mesh.fields[0].values[v], mesh.vertices[v].x());
}

}  // namespace
}  // namespace carreau
