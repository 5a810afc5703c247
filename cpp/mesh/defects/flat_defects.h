// SPDX-License-Identifier: BSD-3-Clause
// Defects of a mesh that came from a file: references are all that is known of its faces.
#pragma once

#include "mesh/flat_mesh.h"

namespace carreau {

/// One sentence a defect, at most options.limit; empty when the mesh is sound. Checks sizes of lists and index ranges,
/// finite coordinates, repeated vertices, triangles without area, duplicated triangles, unused vertices, edges that
/// more than two triangles of one reference share, two triangles of one reference that run the same way along an edge,
/// and, with options.closed, edges of one triangle. Edges listed in the mesh are curves: they may join more than two
/// triangles of one reference, and turn the orientation. Indices in sentences are from 0.
std::vector<std::string> find_defects(const FlatMesh& mesh, const DefectOptions& options = {});

}  // namespace carreau
