// SPDX-License-Identifier: BSD-3-Clause
// The content of a mesh handle, whether a session made it or a file.
#pragma once

#include <cstddef>

#include "guard.h"
#include "handles.h"
#include "mesh/quality.h"
#include "mesh/surface_mesh.h"

namespace carreau::abi {

/// Throws when the mesh has no content.
void require_content(const carreau_mesh& mesh);
/// The names of faces, curves, points and solids.
const carreau::EntityNames& entity_names_of(const carreau_mesh& mesh);

/// The surface mesh of a session's mesh.
inline const SurfaceMesh& surface_of(const carreau_mesh& mesh) { return mesh.session->session.mesh(); }
inline FlatMesh flat_of(const carreau_mesh& mesh) { return flatten(surface_of(mesh), false); }
/// Throws where a file has made it; `what`: "corners".
const SurfaceMesh& session_only(const carreau_mesh& mesh, const char* what);

carreau_quality quality_of(const QualitySummary& summary);

/// The mesh becomes a part.
void keep_part(PartMesh part, carreau_mesh& mesh);

/// Numbers of rows of either kind of mesh.
struct Counts {
  explicit Counts(const carreau_mesh& mesh);
  std::size_t vertices = 0, triangles = 0, edges = 0, faces = 0;
};

}  // namespace carreau::abi
