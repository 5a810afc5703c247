// SPDX-License-Identifier: BSD-3-Clause
// Cells of a cross-patch mesh with a vertex for each smooth side.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/elements/base/atlas_surface.h"
#include "surface/elements/cross_patch/line_middles.h"
#include "surface/remesh/cells/cell_placer.h"
#include "surface/elements/quads/space_quads.h"

namespace carreau {

/// The cells on their way to elements. Vertices of `quads` are local. A kept vertex of space has one local vertex for each set of cells
/// around it that are connected over edges which are not imposed.
struct ElementCells {
  SpaceQuads quads;
  std::vector<std::int32_t> vertex;  ///< local -> PlacedVertices; -1: new, and free
};

/// `triangles`: by vertices of space, as the atlas is turned. Imposed edges are edges of lines, and edges without exactly two triangles
/// that run along them in opposite ways.
ElementCells element_cells(const AtlasSurface& surface, const PlacedVertices& vertices, const LineMiddles& lines,
                     const std::vector<SpaceCell>& triangles, Monitor& monitor);

/// An edge that is imposed, between local vertices.
[[nodiscard]] bool is_imposed(const ElementCells& cells, const LineMiddles& lines, std::int32_t a, std::int32_t b);

/// The middle of an imposed edge: a vertex of space, with its place beside the cells.
struct LineMiddle {
  SurfacePlace place;
  std::int32_t vertex = -1;
};
LineMiddle middle_on_line(const PlacedVertices& vertices, LineMiddles& lines, const ElementCells& cells, const MeshEdge& local);

/// The surface between local vertices, near a place of space. If barriers are in the way of all vertices, the result
/// lies on the nearest barrier; if no vertex has a way, it is the place of space.
SurfacePlace place_from(const AtlasSurface& surface, const SpaceQuads& quads,
                                       std::span<const std::int32_t> starts, const Vec3& target);

/// Cuts edges in two, quadrilaterals in four, triangles in three, lines too, and halves the sizes.
void halve(AtlasSurface& surface, PlacedVertices& vertices, LineMiddles& lines, ElementCells& cells, Monitor& monitor);

/// Free vertices go where the cells have them, and new ones are added.
void put_vertices(const ElementCells& cells, PlacedVertices& vertices, std::vector<std::int32_t>& vertex);

}  // namespace carreau
