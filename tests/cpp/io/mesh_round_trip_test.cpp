// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "io/files.h"
#include "io/mesh_files.h"
#include "io/mesh_writers.h"
#include "io_test_support.h"

namespace carreau {
namespace {

TEST(MeshFiles, RandomMeshesReadBackExactlyAndFormatsAgree) {
  std::mt19937_64 random(11);
  for (int run = 0; run < 300; ++run) {
    const FlatMesh mesh = random_mesh(random);
    expect_same_geometry(read_mesh_text(mesh_bytes(mesh, MeshFormat::mesh), "a"), mesh);
    expect_same_geometry(read_mesh_binary(gmf_bytes(mesh, 2), "b"), mesh);
    expect_same_geometry(read_mesh_binary(gmf_bytes(mesh, 3), "c"), mesh);
  }
}

TEST(MeshFiles, AreRecognisedByTheirContent) {
  const TemporaryFolder folder;
  for (const MeshFormat format : {MeshFormat::mesh, MeshFormat::meshb}) {
    const std::string path = folder.file("a mesh.mesh");
    write_mesh(square(), path, format);
    expect_same_geometry(read_mesh(path), square());
  }
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(MeshFiles, ErrorsNameTheFile) {
  const TemporaryFolder folder;
  const std::string path = folder.file("x.mesh");
  const auto sentence = [&] { return sentence_of<FileError>([&] { read_mesh(path); }); };
  EXPECT_EQ(sentence(), "cannot read '" + path + "': No such file or directory");
  write_file(path, "");
  EXPECT_EQ(sentence(), path + ", line 1: the file is empty");
  write_file(path, std::string("\1\0\0\0\2\0", 6));
  EXPECT_EQ(sentence(), path + ": byte 6: the file ends inside the header");
}

TEST(MeshFiles, TheSuffixGivesTheFormat) {
  EXPECT_EQ(mesh_format_of("x.mesh"), MeshFormat::mesh);
  EXPECT_EQ(mesh_format_of("a.b/x.y.MeshB"), MeshFormat::meshb);
  EXPECT_EQ(mesh_format_of(".vtu"), MeshFormat::vtu);
  EXPECT_EQ(mesh_format_of("/tmp/x.STL"), MeshFormat::stl);
  for (const std::string path : {"", "x", "mesh", "x.mesh/y", "x.exr", "x.mesh.", "x.meshbb"})
    EXPECT_EQ(sentence_of<InvalidArgument>([&] { mesh_format_of(path); }),
              "'" + path +
                  "' does not have a suffix of mesh files: .mesh, .meshb, .vtu, .stl, .msh, .msh2, .bl2d, .inp, .bdf, "
                  ".unv, .su2, .off, .obj, .ply, .vtk, .tri, .smesh, .poly, .vol, .geo");
}

TEST(MeshFiles, AMeshThatNoReaderWouldTakeIsRejectedAndTheOldFileStays) {
  const TemporaryFolder folder;
  const std::string path = folder.file("x.mesh");
  write_file(path, "old");
  const auto sentence = [&](auto&& spoil) {
    FlatMesh mesh = square();
    spoil(mesh);
    std::string first;
    for (const MeshFormat format : {MeshFormat::mesh, MeshFormat::meshb, MeshFormat::vtu, MeshFormat::stl}) {
      const std::string found = sentence_of<InvalidArgument>([&] { write_mesh(mesh, path, format); });
      if (format == MeshFormat::mesh) first = found;
      EXPECT_EQ(found, first);
    }
    EXPECT_EQ(read_file(path), "old");
    return first;
  };
  const std::string start = "a mesh cannot be written: ";
  EXPECT_EQ(sentence([](FlatMesh& m) { m.vertices[2].y() = std::nan(""); }),
            start + "vertex 2 (from 0) has a coordinate that is not finite");
  EXPECT_EQ(sentence([](FlatMesh& m) { m.triangles[1][2] = 4; }), start + "triangle 1 (from 0) names vertex 4 of 4");
  EXPECT_EQ(sentence([](FlatMesh& m) { m.edges[0][0] = -1; }), start + "edge 0 (from 0) names vertex -1 of 4");
  EXPECT_EQ(sentence([](FlatMesh& m) { m.vertex_refs.pop_back(); }),
            start + "the list of vertex references has 3 entries instead of 4");
  EXPECT_EQ(sentence([](FlatMesh& m) { m.fields[1].values.pop_back(); }),
            start + "field 'quality & <shape>' has 3 entries instead of 4");
  EXPECT_EQ(sentence([](FlatMesh& m) { m.fields[0].components = 0; }), start + "field 'size' has 0 components");
  EXPECT_EQ(sentence([](FlatMesh& m) { m.dimension = 1; }), start + "its dimension is 1");
}

TEST(MeshFiles, AFailedWriteLeavesTheOldFile) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("x.mesh"));
  EXPECT_EQ(sentence_of<FileError>([&] { write_mesh(square(), folder.file("x.mesh"), MeshFormat::mesh); }),
            "cannot write '" + folder.file("x.mesh") + "': it is a folder");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(MeshFiles, AMeshWithoutTrianglesOrVerticesIsAFileToo) {
  for (const MeshFormat format : {MeshFormat::mesh, MeshFormat::meshb}) {
    FlatMesh mesh;
    const auto back = [&] {
      const std::string bytes = mesh_bytes(mesh, format);
      return format == MeshFormat::mesh ? read_mesh_text(bytes, "x") : read_mesh_binary(bytes, "x");
    };
    expect_same_geometry(back(), mesh);
    mesh = square();
    mesh.triangles.clear();
    mesh.triangle_refs.clear();
    mesh.fields.clear();
    expect_same_geometry(back(), mesh);
  }
}

}  // namespace
}  // namespace carreau
