// SPDX-License-Identifier: BSD-3-Clause
// Surfaces for programs that fill solids: TetGen, Netgen, Gmsh.
#include <gtest/gtest.h>

#include <string>

#include "io/mesh_files.h"
#include "support/error.h"

namespace carreau {
namespace {

/// The corner tetrahedron, with a vertex of no triangle.
FlatMesh corner() {
  FlatMesh mesh;
  mesh.vertices = {{0, 0, 0}, {9, 9, 9}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.vertex_refs = {0, 0, 5, 0, 0};
  mesh.triangles = {{0, 3, 2}, {0, 2, 4}, {2, 3, 4}, {0, 4, 3}};
  mesh.triangle_refs = {1, 2, 3, 3};
  mesh.names.face_solids = {{1, {8, 0}}, {2, {8, 0}}, {3, {8, 0}}};
  mesh.names.solids = {{8, "steel part"}};
  return mesh;
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(SolidSurfaces, TetgenGetsMarkersAndAPointOfTheSolid) {
  const std::string smesh = mesh_bytes(corner(), MeshFormat::smesh);
  EXPECT_TRUE(holds(smesh, "\n4 3 0 1\n1 0 0 0 0\n2 1 0 0 5\n")) << smesh;
  EXPECT_TRUE(holds(smesh, "\n4 1\n3 1 3 2 1\n3 1 2 4 2\n3 2 3 4 3\n3 1 4 3 3\n")) << smesh;
  EXPECT_TRUE(holds(smesh, "# holes\n0\n"));
  EXPECT_TRUE(holds(smesh, " 8 ") && holds(smesh, "# steel part\n"));
  EXPECT_TRUE(holds(mesh_bytes(corner(), MeshFormat::poly), "\n1 0 1\n3 1 3 2\n1 0 2\n3 1 2 4\n"));
}

TEST(SolidSurfaces, NetgenGetsTheSolidsOnBothSides) {
  const std::string text = mesh_bytes(corner(), MeshFormat::vol);
  EXPECT_TRUE(holds(text, "surfaceelements\n4\n1 1 1 0 3 1 3 2\n2 2 1 0 3 1 2 4\n3 3 1 0 3 2 3 4\n")) << text;
  EXPECT_TRUE(holds(text, "materials\n1\n1 steel_part\n")) << text;
  EXPECT_TRUE(holds(text, "points\n4\n0 0 0\n1 0 0\n"));
}

TEST(SolidSurfaces, GmshGetsAVolumeInsideTheSurfaceOfItsFile) {
  MeshFileOptions options;
  options.surface = "part.msh";
  EXPECT_EQ(mesh_bytes(corner(), MeshFormat::geo, options),
            "Merge \"part.msh\";\nDelete { Volume{:}; }\nSurface Loop(8) = {1, 2, 3};\nVolume(8) = {8};\nPhysical Volume(\"steel part\") = {8};\n");
}

TEST(SolidSurfaces, AnOpenSurfaceIsRejected) {
  FlatMesh mesh = corner();
  mesh.triangles.pop_back(), mesh.triangle_refs.pop_back();
  for (const MeshFormat format : {MeshFormat::smesh, MeshFormat::poly, MeshFormat::vol, MeshFormat::geo})
    EXPECT_THROW((void)mesh_bytes(mesh, format), InvalidArgument);
}

TEST(SolidSurfaces, TheFormatsAreNotRead) {
  for (const std::string path : {"x.smesh", "x.poly", "x.vol", "x.geo"}) EXPECT_THROW((void)read_mesh(path), InvalidArgument);
}

}  // namespace
}  // namespace carreau
