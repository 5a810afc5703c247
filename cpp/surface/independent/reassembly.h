// SPDX-License-Identifier: BSD-3-Clause
// From a free mesh back to faces, curves and (u, v).
#pragma once

#include <span>
#include <vector>

#include "surface/independent/free_mesh.h"
#include "surface/independent/line_remeshing.h"
#include "surface/independent/sharp_edges.h"
#include "surface/result.h"

namespace carreau {

/// What changes when a mesh has been made free of its patches.
struct FreedMesh {
  SurfaceMesh mesh;
  std::vector<double> vertex_size;
  std::vector<std::vector<double>> curve_size;     ///< by curve of the mesh
  std::vector<CurveParameters> curve_parameters;   ///< the same
  std::vector<std::vector<std::int32_t>> feet;  ///< [face][local vertex]: triangle of the atlas
  bool worse_shaped = false;                    ///< the mean shape has fallen
};

/// A triangle belongs to the face of the foot of its centroid. Faces without a triangle are collapsed; edges of lines
/// have the curve of the middle one of the edges that they stand for, and curves without an edge have no vertices.
/// `worked`: by line, where the vertices are that are left of it.
FreedMesh reassemble(const SurfaceMesh& before, FreeMesh& free, const std::vector<SharpLine>& lines,
                     std::span<const WorkedLine> worked, const std::vector<std::int32_t>& corners, Monitor& monitor);

}  // namespace carreau
