// SPDX-License-Identifier: BSD-3-Clause
// Cells of a free mesh with a vertex for each smooth side.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "surface/free_elements/element_vertices.h"
#include "surface/free_elements/line_middles.h"
#include "surface/independent/cells/cell_placer.h"
#include "surface/quads/space_quads.h"

namespace carreau {

/// The cells on their way to elements. Vertices of `quads` are local. A kept vertex of space has one local vertex for each set of cells
/// around it that are connected over edges which are not imposed.
struct FreeCells {
  SpaceQuads quads;
  std::vector<std::int32_t> vertex;  ///< local -> ElementVertices; -1: new, and free
};

/// `triangles`: by vertices of space, as the atlas is turned. Imposed edges are edges of lines, and edges without exactly two triangles
/// that run along them in opposite ways.
FreeCells free_cells(const FreeSurface& surface, const ElementVertices& vertices, const LineMiddles& lines,
                     const std::vector<FreeCell>& triangles, Monitor& monitor);

/// An edge that is imposed, between local vertices.
[[nodiscard]] bool is_imposed(const FreeCells& cells, const LineMiddles& lines, std::int32_t a, std::int32_t b);

/// The surface between local vertices, near a place of space. If barriers are in the way of all vertices, the result
/// lies on the nearest barrier.
std::optional<SurfacePlace> place_from(const FreeSurface& surface, const SpaceQuads& quads,
                                       std::span<const std::int32_t> starts, const Vec3& target);

/// Cuts edges in two, quadrilaterals in four, triangles in three, lines too, and halves the sizes.
void halve(FreeSurface& surface, ElementVertices& vertices, LineMiddles& lines, FreeCells& cells, Monitor& monitor);

/// Free vertices go where the cells have them, and new ones are added.
void put_vertices(const FreeCells& cells, ElementVertices& vertices, std::vector<std::int32_t>& vertex);

}  // namespace carreau
