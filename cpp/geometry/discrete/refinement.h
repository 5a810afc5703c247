// SPDX-License-Identifier: BSD-3-Clause
// Triangles of a discrete surface, cut finer (HDR sec. 4.9.3).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/discrete/surface.h"
#include "support/monitor.h"

namespace carreau::discrete {

/// A finer mesh of the same surface. Each triangle lies on one patch.
struct RefinedMesh {
  std::vector<Vec3> vertices;  ///< those of the surface first
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> parent;              ///< of triangles: the one of the surface
  std::vector<std::array<Vec2, 3>> uv;           ///< of triangles: corners on their patch
  std::vector<std::vector<std::int32_t>> lines;  ///< vertices of each line of the surface, in its order
  bool complete = true;                          ///< false: the depth was reached before all was as wanted
};

struct RefinementLimits {
  int depth = 12;                      ///< rounds
  std::int64_t triangles = 100000000;  ///< LimitError beyond
};

/// Whether triangles are to be cut into four, and whether an edge (vertices and their places in `mesh`) is to be
/// halved.
struct RefinementWish {
  std::function<bool(const RefinedMesh& mesh, std::size_t triangle)> triangle;
  std::function<bool(const RefinedMesh& mesh, std::int32_t v, std::int32_t w)> edge;
};

/// Cuts triangles by their edges until all is as wanted. Where triangles are wished, those with two halved edges get
/// the third one halved, too (HDR sec. 4.9.3); where edges alone are, they become three. Throws LimitError and
/// Cancelled.
RefinedMesh refine(const DiscreteSurface& surface, const RefinementWish& wish, const RefinementLimits& limits,
                   Monitor& monitor);

/// Wants four triangles where the normal of one is off that of the surface at a corner by more than `angle` degrees.
RefinementWish wish_of_angle(const DiscreteSurface& surface, double angle);

/// The mesh with face_refs(), sharp edges, whose references are the ranks of their lines, and those of corners.
FlatMesh flat_mesh(const DiscreteSurface& surface, const RefinedMesh& mesh);
/// The triangles themselves, the same way.
RefinedMesh unrefined(const DiscreteSurface& surface);

/// References of faces that results have, by triangle of the surface, positive: those that the surface was told, else
/// those of the input when it has several, else of regions, from 1.
std::vector<std::int32_t> face_refs(const DiscreteSurface& surface);

}  // namespace carreau::discrete
