// SPDX-License-Identifier: BSD-3-Clause
// Defects of a mesh that came from a file: references are all that is known of its faces.
#pragma once

#include "mesh/flat_mesh.h"

namespace carreau {

/// One sentence a defect, at most options.limit; empty when the mesh is sound. Checks sizes of lists and index ranges,
/// finite coordinates, repeated vertices, triangles without area, duplicated triangles and unused vertices. Checks
/// edges: more than two triangles of one reference, two triangles of one reference with equal direction along an edge
/// and, with options.closed, edges of one triangle. Edges listed in the mesh are curves: they may join more than two
/// triangles of one reference, and turn the orientation. Indices in sentences are from 0. `of_elements`: the defects of its elements,
/// which it then does not check; nullptr: find_cell_defects() finds them.
std::vector<std::string> find_defects(const FlatMesh& mesh, const DefectOptions& options = {}, const std::vector<std::string>* of_elements = nullptr);

}  // namespace carreau
