// What holds for every mesh that was read: all formats take it, and Medit's give it back.
#pragma once

#include "fuzz_check.h"
#include "io/mesh_files.h"

namespace carreau {

inline void check_same(const FlatMesh& a, const FlatMesh& b) {
  FUZZ_CHECK(a.dimension == b.dimension && a.vertices == b.vertices && a.vertex_refs == b.vertex_refs);
  FUZZ_CHECK(a.triangles == b.triangles && a.triangle_refs == b.triangle_refs);
  FUZZ_CHECK(a.edges == b.edges && a.edge_refs == b.edge_refs);
}

inline void check_written_and_read(const FlatMesh& mesh) {
  check_same(mesh, read_mesh_text(mesh_bytes(mesh, MeshFormat::mesh), "again"));
  check_same(mesh, read_mesh_binary(mesh_bytes(mesh, MeshFormat::meshb), "again"));
  FUZZ_CHECK(!mesh_bytes(mesh, MeshFormat::vtu).empty());
  FUZZ_CHECK(!mesh_bytes(mesh, MeshFormat::stl, {.ascii_stl = true}).empty());
}

}  // namespace carreau
