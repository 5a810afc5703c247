// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstring>

#include "io/mesh_files.h"
#include "io_test_support.h"

namespace carreau {
namespace {

/// Reads an array in the appended section by the VTK documentation. Its offset counts from the byte after the
/// underscore, and 64 bits of length in bytes come first (header_type UInt64).
template <typename T>
std::vector<T> array_of(const std::string& file, const std::string& section, const std::string& name,
                        const std::string& type) {
  std::size_t at = file.find("<" + section);
  const std::size_t section_end = file.find("</" + section + ">");
  at = file.find("Name=\"" + name + "\"", at);
  if (at == std::string::npos || at > section_end) {
    ADD_FAILURE() << section << " has no array " << name;
    return {};
  }
  const std::size_t begin = file.rfind("<DataArray", at);
  const std::string element = file.substr(begin, file.find("/>", begin) - begin);
  EXPECT_NE(element.find("type=\"" + type + "\""), std::string::npos) << element;
  EXPECT_NE(element.find("format=\"appended\""), std::string::npos) << element;
  const std::size_t offset = std::stoul(element.substr(element.find("offset=\"") + 8));
  const std::string opening = "<AppendedData encoding=\"raw\">\n_";
  const std::size_t data = file.find(opening) + opening.size() + offset;
  std::uint64_t length = 0;
  std::memcpy(&length, file.data() + data, sizeof length);
  if (data + sizeof length + length > file.size() || length % sizeof(T) != 0) {
    ADD_FAILURE() << name << " has " << length << " bytes";
    return {};
  }
  std::vector<T> values(length / sizeof(T));
  if (length > 0) std::memcpy(values.data(), file.data() + data + sizeof length, length);
  return values;
}

TEST(Vtu, HoldsPointsCellsReferencesAndFields) {
  const std::string file = mesh_bytes(square(), MeshFormat::vtu);
  EXPECT_EQ(file.find("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\""), 0u);
  EXPECT_NE(file.find("header_type=\"UInt64\""), std::string::npos);
  EXPECT_NE(file.find("<Piece NumberOfPoints=\"4\" NumberOfCells=\"6\">"), std::string::npos);
  EXPECT_EQ(array_of<double>(file, "Points", "Points", "Float64"),
            (std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0.5, 0, 1, 0.5}));
  EXPECT_EQ(array_of<std::int32_t>(file, "Cells", "connectivity", "Int32"),
            (std::vector<std::int32_t>{0, 1, 2, 0, 2, 3, 0, 1, 1, 2, 2, 3, 3, 0}));
  EXPECT_EQ(array_of<std::int64_t>(file, "Cells", "offsets", "Int64"),
            (std::vector<std::int64_t>{3, 6, 8, 10, 12, 14}));
  EXPECT_EQ(array_of<std::uint8_t>(file, "Cells", "types", "UInt8"), (std::vector<std::uint8_t>{5, 5, 3, 3, 3, 3}));
  EXPECT_EQ(array_of<std::int32_t>(file, "PointData", "reference", "Int32"), (std::vector<std::int32_t>{1, 2, 0, 4}));
  EXPECT_EQ(array_of<std::int32_t>(file, "CellData", "reference", "Int32"),
            (std::vector<std::int32_t>{7, -2, 11, 12, 13, 14}));
  EXPECT_EQ(array_of<double>(file, "PointData", "size", "Float64"), (std::vector<double>{0.1, 0.2, 0.3, 0.4}));
  const auto quality = array_of<double>(file, "CellData", "quality &amp; &lt;shape&gt;", "Float64");
  ASSERT_EQ(quality.size(), 12u);  // two components for each of six cells
  EXPECT_EQ(std::vector<double>(quality.begin(), quality.begin() + 4), (std::vector<double>{1, 2, 3, 4}));
  for (std::size_t i = 4; i < quality.size(); ++i) EXPECT_TRUE(std::isnan(quality[i]));
}

TEST(Vtu, AMeshOfThePlaneHasZeroZAndZeroReferencesWhenNoneAreGiven) {
  FlatMesh mesh = square();
  mesh.dimension = 2;
  mesh.vertex_refs.clear();
  mesh.triangle_refs.clear();
  mesh.edge_refs.clear();
  const std::string file = mesh_bytes(mesh, MeshFormat::vtu);
  EXPECT_EQ(array_of<double>(file, "Points", "Points", "Float64"),
            (std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}));
  EXPECT_EQ(array_of<std::int32_t>(file, "PointData", "reference", "Int32"), std::vector<std::int32_t>(4, 0));
  EXPECT_EQ(array_of<std::int32_t>(file, "CellData", "reference", "Int32"), std::vector<std::int32_t>(6, 0));
}

TEST(Vtu, FieldsOfCellsMayBeOfTrianglesOfEdgesOrOfBoth) {
  FlatMesh mesh = square();
  mesh.fields = {
      {.name = "length", .on_vertices = false, .components = 1, .values = {}, .edge_values = {1, 2, 3, 4}},
      {.name = "both", .on_vertices = false, .components = 1, .values = {5, 6}, .edge_values = {7, 8, 9, 10}}};
  const std::string file = mesh_bytes(mesh, MeshFormat::vtu);
  const auto length = array_of<double>(file, "CellData", "length", "Float64");
  ASSERT_EQ(length.size(), 6U);
  EXPECT_TRUE(std::isnan(length[0]) && std::isnan(length[1]));
  EXPECT_EQ(std::vector<double>(length.begin() + 2, length.end()), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(array_of<double>(file, "CellData", "both", "Float64"), (std::vector<double>{5, 6, 7, 8, 9, 10}));

  const auto refused = [&](MeshField field, const std::string& why) {
    mesh.fields = {std::move(field)};
    try {
      (void)mesh_bytes(mesh, MeshFormat::vtu);
      ADD_FAILURE() << "not refused: " << why;
    } catch (const InvalidArgument& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  };
  refused({.name = "f", .on_vertices = false, .components = 1, .values = {}, .edge_values = {1, 2, 3}},
          "field 'f' of edges has 3 entries instead of 4");
  refused({.name = "f", .on_vertices = true, .components = 1, .values = {1, 2, 3, 4}, .edge_values = {1}},
          "field 'f' of edges has 1 entries instead of 0");
  refused({.name = "f", .on_vertices = false, .components = 1, .values = {}}, "field 'f' has 0 entries instead of 2");
}

FlatMesh with_fields() {
  FlatMesh mesh = square();
  mesh.fields = {{.name = "heat flow", .on_vertices = true, .components = 1, .values = {1, 2.5, -3, 1e-300}},
                 {.name = "both", .on_vertices = false, .components = 2, .values = {1, 2, 3, 4}, .edge_values = {5, 6, 7, 8, 9, 10, 11, 12}}};
  return mesh;
}

TEST(LegacyVtk, BothFormsGiveMeshReferencesAndFieldsBack) {
  const FlatMesh mesh = with_fields();
  for (const bool ascii : {false, true}) {
    const std::string content = mesh_bytes(mesh, MeshFormat::vtk, {.ascii_stl = ascii});
    const FlatMesh read = read_mesh_vtk(content, "x");
    expect_same_geometry(read, mesh);
    EXPECT_EQ(read.vertex_refs, mesh.vertex_refs);
    EXPECT_EQ(read.triangle_refs, mesh.triangle_refs);
    EXPECT_EQ(read.edge_refs, mesh.edge_refs);
    ASSERT_EQ(read.fields.size(), 2u);
    EXPECT_EQ(read.fields[0].name, "heat_flow");
    EXPECT_EQ(read.fields[0].values, mesh.fields[0].values);
    EXPECT_EQ(read.fields[1].values, mesh.fields[1].values);
    EXPECT_EQ(read.fields[1].edge_values, mesh.fields[1].edge_values);
    // Cut off before the cells have their types, the file is an error.
    for (std::size_t n = 0; n < content.find("CELL_TYPES"); n += 3)
      EXPECT_THROW(read_mesh_vtk(content.substr(0, n), "x"), FileError) << n;
  }
}

TEST(LegacyVtk, PolyDataOfOtherPrograms) {
  const std::string head = "# vtk DataFile Version 4.2\ntitle\nASCII\nDATASET POLYDATA\nPOINTS 5 float\n0 0 0 1 0 0 1 1 0\n0 1 0 2 0 0\n"
                           "METADATA\nINFORMATION 1\nNAME L2 LOCATION x\nDATA 2 0 1\n\n";
  const FlatMesh mesh = read_mesh_vtk(
      head + "POLYGONS 2 9\n4 0 1 2 3\n3 1 4 2\nLINES 1 3\n2 0 1\nCELL_DATA 3\nSCALARS a double\nLOOKUP_TABLE default\n"
             "7 8 9\nFIELD FieldData 1\nreference 1 3 int\n1 2 3\nPOINT_DATA 5\nVECTORS v float\n1 2 3 4 5 6 7 8 9 10 11 12 13 14 15\n", "x");
  EXPECT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.triangle_refs, (std::vector<std::int32_t>{2, 2, 3}));
  EXPECT_EQ(mesh.edge_refs, (std::vector<std::int32_t>{1}));
  ASSERT_EQ(mesh.fields.size(), 2u);
  EXPECT_EQ(mesh.fields[0].values, (std::vector<double>{8, 8, 9}));
  EXPECT_EQ(mesh.fields[1].components, 3);
  // Version 5.1 has offsets.
  const FlatMesh offsets = read_mesh_vtk(head + "POLYGONS 3 7\nOFFSETS vtktypeint64\n0 4 7\nCONNECTIVITY vtktypeint64\n0 1 2 3 1 4 2\n", "x");
  EXPECT_EQ(offsets.triangles.size(), 3u);
  const auto sentence = [&](const std::string& rest) { return sentence_of<FileError>([&] { read_mesh_vtk(head + rest, "x.vtk"); }); };
  EXPECT_EQ(sentence("POLYGONS 1 4\n3 0 1 5\n"), "x.vtk, line 13: a cell names point 5 of 5");
  EXPECT_EQ(sentence("POLYGONS 1 4\n4 0 1 2\n"), "x.vtk, line 13: cell 0 (from 0) has more points than are announced");
  EXPECT_EQ(sentence("NONSENSE 1\n"), "x.vtk, line 13: the name of a section was expected, not 'NONSENSE'");
  EXPECT_EQ(sentence_of<FileError>([] { read_mesh_vtk("solid", "x.vtk"); }), "x.vtk, line 1: a .vtk file starts with '# vtk DataFile Version'");
}

}  // namespace
}  // namespace carreau
