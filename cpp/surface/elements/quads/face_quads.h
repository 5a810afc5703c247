// SPDX-License-Identifier: BSD-3-Clause
// The state of a face that becomes quadrilaterals.
#pragma once

#include <vector>

#include "mesh/layer_cell.h"
#include "periodic/match_faces.h"
#include "surface/elements/base/curve_middles.h"
#include "surface/elements/quads/quad_patch.h"

namespace carreau {

/// The cells of one face, and their origin.
struct FaceQuads {
  std::size_t face = 0;
  QuadPatch patch;
  std::vector<std::int32_t> vertex;  ///< local -> index in SurfaceMesh::vertices; -1: new, and of this face only
  std::vector<Vec3> xyz;             ///< positions; lift() computes the positions of new vertices
  std::vector<Vec2> lifted;          ///< (u, v) that xyz belongs to
  std::vector<double> size;          ///< prescribed at each vertex that was lifted here; 0: not known; below: as it was
  std::vector<CurveSide> sides;      ///< on curves, ascending; of cells before they are cut
  std::vector<std::int32_t> middles;  ///< of sides: local vertices, once the cells are cut; -1: none
  std::vector<std::array<std::int32_t, 3>> flattened;  ///< FaceMesh::flattened
  std::vector<MixedCell> rows;  ///< cells of layers, which no pass changes; put_back() adds them
  std::vector<std::array<std::int32_t, 2>> tops;  ///< edges between these and other cells, ascending
  std::vector<std::int32_t> now;  ///< put_back(): by local vertex its number in the mesh of the face; -1: it is gone

  [[nodiscard]] const CurveSide* side_between(std::int32_t a, std::int32_t b) const noexcept;
  /// On a curve, or at cells of layers.
  [[nodiscard]] bool is_imposed(std::int32_t a, std::int32_t b) const noexcept;
};

/// Sets the cells of layers apart from the other cells, and fixes their vertices.
/// If the triangles are not their halves any more, removes `layers` instead.
void set_rows_apart(FaceQuads& quads, std::vector<LayerCell>& layers);

/// Vertices on curves, imposed points and corners of flattened triangles are fixed.
FaceQuads face_quads(const ElementWork& work, std::size_t face);

/// Evaluates the surface for positions of vertices that are new or were moved, and `metric` for sizes there (no sizes
/// if it is null). One evaluation a vertex.
void lift(const ElementWork& work, const ControlSpace* metric, FaceQuads& quads, Monitor& monitor);

/// Puts the cells of faces into the mesh, all at once. Vertices without a cell are removed, new vertices are appended
/// face by face. Order stays.
void put_back(std::vector<FaceQuads>& faces, CompositeResult& result);

/// A periodic face whose cells are images of the cells of another face, on its way beside it.
struct SlaveQuads {
  const FacePair* pair = nullptr;
  FaceQuads *master = nullptr, *slave = nullptr;
  std::vector<std::int32_t> image;  ///< local vertices of the slave by local vertices of the master; -1: none yet
};

/// Gives the slave the cells of its master; vertices that it lacks are added without a place.
void copy_cells(SlaveQuads& quads);

/// Both have been cut (halve_cells()): images of the new vertices. `corners`: of the master's cells before.
void match_halves(const std::vector<int>& corners, SlaveQuads& quads);

/// Moves vertices inside the slave to the images of the master's.
void place_cells(const ElementWork& work, SlaveQuads& quads);

/// After put_back(): the slave has the master's elements, diagonals and all.
void carry_back(const SlaveQuads& quads, SurfaceMesh& mesh);

}  // namespace carreau
