// SPDX-License-Identifier: BSD-3-Clause
// The mesh as the viewer of a report reads it.
#pragma once

#include <string>
#include <vector>

#include "files/mesh_file.h"
#include "report/triangle_values.h"

namespace command {

/// The data that the viewer draws; all members live as long as the call.
struct ViewerMesh {
  const MeshArrays& mesh;                    ///< finite numbers, indices in range, at least one triangle
  const std::vector<std::uint8_t>& halves;   ///< of halves_of()
  const std::vector<TriangleValues>& values;
};

/// <script> elements that hold data and are not run. `viewer-data`, JSON: counts, box, faces with names and colours,
/// scales of values, and the packing of each array (packing.h). `data-NAME`, base64: the arrays
///   positions  3 a vertex; x = low + number * quantum of the box
///   corners    3 a triangle: vertices, from 0
///   faces      of each triangle: index in the list of faces, ascending references
///   sides      of each triangle: bit k: its side from corner k to the next lies on a curve, bit 3 + k: it is the
///              diagonal of a quadrilateral
///   KEY        of each triangle, values.key: 0: none, else 1 to 65535 from the lowest to the highest value, by the
///              logarithm on a logarithmic scale
/// If elements are curved, pieces are drawn in the place of their triangles; further positions follow the vertices:
///   piece-corners   3 a piece: points
///   piece-triangle  of each piece: its triangle, ascending
///   piece-sides     of each piece: as sides, bit 3 + k: the side lies inside an element
std::string viewer_data(const ViewerMesh& viewer);

}  // namespace command
