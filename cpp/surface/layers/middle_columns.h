// SPDX-License-Identifier: BSD-3-Clause
// Columns over the middles of a curve's edges, for nodes of edges and for cells that are cut.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "cad/cad.h"
#include "mesh/layer_cell.h"

namespace carreau {

/// The cells above one edge of a curve, or in one step of a fan: first and last + 1 of consecutive cells, rows ascending.
std::vector<std::array<std::size_t, 2>> piles_of(std::span<const LayerCell> cells);

/// Vertices of both sides of a pile, lowest first. The first ones of a fan are equal.
struct PileSides {
  explicit PileSides(std::span<const LayerCell> pile);
  std::vector<std::int32_t> left, right;
};

/// A place of the surface.
struct ColumnPlace {
  Vec2 uv;
  Vec3 xyz;
};

/// The column that rises from `base` between two columns. The base comes first. Chords of a curve lie farther from the curve
/// than rows are high, so middles of chords are no such column. Its vertices divide the edges as the base divides the lowest one.
/// If `heights` are given, the rows have these heights over the chords from the base to both columns.
std::vector<ColumnPlace> middle_column(Cad& cad, int face, const ColumnPlace& base, std::span<const ColumnPlace> left,
                                        std::span<const ColumnPlace> right, std::span<const double> heights = {});

/// The place between two places of a column that divides their distance: `share` of it is below.
ColumnPlace dividing_place(Cad& cad, int face, const ColumnPlace& low, const ColumnPlace& high, double share);

}  // namespace carreau
