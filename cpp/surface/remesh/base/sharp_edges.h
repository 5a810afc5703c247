// SPDX-License-Identifier: BSD-3-Clause
// Remaining borders of patches: sharp edges, corners, and lines between them (HDR sec. 4.5.5).
#pragma once

#include <cstdint>
#include <vector>

#include "cad/cad.h"
#include "curve/support.h"
#include "model/topology.h"
#include "surface/remesh/base/charts.h"

namespace carreau {

/// Edges of curves from corner to corner, or all around.
struct SharpLine {
  std::vector<std::int32_t> vertices;  ///< of the mesh; the first one again at the end of a closed line
  std::vector<std::int32_t> curve;     ///< by edge: index in SurfaceMesh::curves

  [[nodiscard]] bool closed() const noexcept { return vertices.front() == vertices.back(); }
};

/// First derivatives at each local vertex: [face][local].
using VertexJets = std::vector<std::vector<SurfaceJet>>;
/// Evaluates the surface once at each vertex.
VertexJets evaluate_vertices(const SurfaceMesh& mesh, Cad& cad, Monitor& monitor);

/// Edges of internal curves, and edges of curves with one triangle, three or more, or with normals that differ by more
/// than `angle` degrees at one end. Ascending.
std::vector<MeshEdge> find_sharp_edges(const SurfaceMesh& mesh, const VertexJets& jets, double angle);

/// Vertices that stay where they are, ascending. These are imposed points, ends of wires and singular places. Vertices where other than two
/// sharp edges meet, or two that turn by more than `angle` degrees, stay too. So do vertices around which the surface is not one disc, or
/// not as many discs as meet at the edges of the line. `topology` may be null: then every end of a curve on a line is one.
std::vector<std::int32_t> find_corners(const SurfaceMesh& mesh, const VertexJets& jets, const Charts& charts,
                                       const std::vector<MeshEdge>& sharp, const Topology* topology,
                                       const std::vector<std::vector<CurveSupport>>& supports, double angle);

std::vector<SharpLine> find_lines(const SurfaceMesh& mesh, const std::vector<MeshEdge>& sharp,
                                  const std::vector<std::int32_t>& corners);

}  // namespace carreau
