// SPDX-License-Identifier: BSD-3-Clause
// Faces and lines of triangulated surfaces that maps of space carry onto each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/surface_mesh.h"
#include "model/isometry.h"
#include "model/model.h"

namespace carreau {

/// Indices in SurfaceMesh::faces or SurfaceMesh::curves.
struct TrianglePair {
  int master = -1, slave = -1;
  Isometry map;  ///< of the master onto the slave
};

struct PeriodicTriangles {
  std::vector<TrianglePair> faces;  ///< each slave once; its master is no slave
  std::vector<TrianglePair> lines;  ///< the same; a slave runs like the image of its master
  std::vector<std::int32_t> corners;  ///< images of corners that became corners, vertices of the mesh
  double gap = 0;                   ///< model length: images may miss by it

  [[nodiscard]] bool empty() const noexcept { return lines.empty(); }
  /// Returns, by line, the line that is divided for it, or -1.
  [[nodiscard]] std::vector<std::int32_t> twins(std::size_t n) const;
};

/// Finds the pairs of the model's periodicities. `mesh`: of start_mesh(), its first `given` vertices are the surface's; images of corners cut its lines, and lines that are slaves are
/// turned to run like the images of their masters. Throws InvalidModel: nothing matches, with the distance and the place.
PeriodicTriangles find_periodic_triangles(const Model& model, double diag, std::size_t given, SurfaceMesh& mesh);

}  // namespace carreau
