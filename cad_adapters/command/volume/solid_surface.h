// SPDX-License-Identifier: BSD-3-Clause
// The surface that an engine fills with tetrahedra.
#pragma once

#include <carreau.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "files/mesh_file.h"

namespace command {

/// A closed surface of triangles with solids on its sides. Vertices count from 0; nodes on edges are apart.
struct SolidSurface {
  std::vector<Point> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> refs;                  ///< of the faces of triangles
  std::vector<std::array<std::int32_t, 2>> sides;  ///< the solid that a triangle looks out of, and the other one; 0: none
  std::vector<double> sizes;                       ///< edge lengths at vertices
  std::map<std::array<std::int32_t, 2>, Point> mids;  ///< nodes of edges a < b; empty: elements of order 1
  std::map<std::int32_t, std::string> solids, faces;  ///< names by number; "": none
  std::map<std::int32_t, double> volumes;             ///< of solids, by the divergence theorem
  double diagonal = 0;

  [[nodiscard]] bool is_quadratic() const noexcept { return !mids.empty(); }
};

/// Takes the surface of a mesh. Throws Failure with the place when the mesh has quadrilaterals, is open,
/// crosses itself, or a shell has its material on the wrong side.
SolidSurface solid_surface_of(carreau_mesh* mesh, int threads);

}  // namespace command
