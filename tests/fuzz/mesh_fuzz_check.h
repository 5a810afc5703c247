// SPDX-License-Identifier: BSD-3-Clause
// Checks of every mesh that was read: all formats write it and restore their part of it.
#pragma once

#include <algorithm>
#include <cstdint>

#include "fuzz_check.h"
#include "io/mesh_files.h"
#include "support/error.h"

namespace carreau {

inline void check_same(const FlatMesh& a, const FlatMesh& b) {
  FUZZ_CHECK(a.dimension == b.dimension && a.vertices == b.vertices && a.vertex_refs == b.vertex_refs);
  FUZZ_CHECK(a.triangles == b.triangles && a.triangle_refs == b.triangle_refs);
  FUZZ_CHECK(a.edges == b.edges && a.edge_refs == b.edge_refs);
}

inline void check_written_and_read(const FlatMesh& mesh) {
  check_same(mesh, read_mesh_text(mesh_bytes(mesh, MeshFormat::mesh), "again"));
  check_same(mesh, read_mesh_binary(mesh_bytes(mesh, MeshFormat::meshb), "again"));
  FlatMesh space = mesh;
  space.dimension = 3;
  check_same(space, read_mesh_vtu(mesh_bytes(mesh, MeshFormat::vtu), "again"));
  const FlatMesh solids = read_mesh_stl(mesh_bytes(mesh, MeshFormat::stl, {.ascii_stl = true}), "again");
  FUZZ_CHECK(solids.triangles.size() == mesh.triangles.size());
  for (const MeshFormat format : {MeshFormat::msh, MeshFormat::msh2}) {
    const FlatMesh gmsh = read_mesh_msh(mesh_bytes(mesh, format), "again");
    FUZZ_CHECK(gmsh.triangles.size() == mesh.triangles.size() && gmsh.edges.size() == mesh.edges.size());
  }
}

/// Any bytes are a mesh or a FileError that names the file. `read` is one of the readers.
template <typename Read>
int fuzz_mesh(const std::uint8_t* data, std::size_t size, Read&& read) {
  FlatMesh mesh;
  try {
    mesh = read(std::string_view(reinterpret_cast<const char*>(data), size), "x");
  } catch (const FileError& error) {
    FUZZ_CHECK(error.where().file == "x");
    return 0;
  }
  check_written_and_read(mesh);
  return 0;
}

}  // namespace carreau
