// SPDX-License-Identifier: BSD-3-Clause
// The edges of a mesh, each once.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/surface_mesh.h"

namespace carreau {

/// A segment of a curve: vertices rank and rank + 1 of CurveMesh::vertices.
struct CurveSegment {
  std::int32_t curve = 0, rank = 0;
};

/// Edges in the order in which triangles name them first. Side i of a triangle goes from its corner i to the next one.
struct MeshEdges {
  std::vector<std::array<std::int32_t, 2>> vertices;     ///< indices in SurfaceMesh::vertices, the smaller one first
  std::vector<std::array<std::int32_t, 3>> of_triangle;  ///< by triangle, faces in order: edge of each side
  std::vector<std::array<char, 3>> names;                ///< by triangle: whether this side is the first of its edge
  std::vector<std::int32_t> segment;                     ///< by edge: index in `segments`; -1: inside a face
  std::vector<CurveSegment> segments;                    ///< of curves that have edges in the mesh
};

MeshEdges edges_of(const SurfaceMesh& mesh);

}  // namespace carreau
