// SPDX-License-Identifier: BSD-3-Clause
// Grids made by formulas.
#pragma once

#include <cmath>
#include <numbers>

#include "geometry/grid/grid.h"

namespace carreau::grid {

/// Node (i, j) is at(i, j).
template <typename At>
Block block_of(int columns, int rows, At&& at) {
  Block block;
  block.columns = columns, block.rows = rows;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) block.nodes.push_back(at(i, j));
  return block;
}

/// A sphere of radius 1, or the surface r(theta, phi): `around` intervals of longitude, closed, and `up` of latitude
/// from pole to pole.
template <typename Radius>
Block globe(int around, int up, Radius&& radius) {
  return block_of(around + 1, up + 1, [&](int i, int j) -> Vec3 {
    const double theta = 2 * std::numbers::pi * (i % around) / around, phi = std::numbers::pi * (j / double(up) - 0.5);
    const double r = radius(theta, phi), c = j == 0 || j == up ? 0 : std::cos(phi);
    return {r * c * std::cos(theta), r * c * std::sin(theta), r * std::sin(phi)};
  });
}

inline Block sphere(int around, int up) {
  return globe(around, up, [](double, double) { return 1.0; });
}

inline GridGeometry build(std::vector<Block> blocks, const Options& options = {}) {
  Monitor silent;
  return build_grid_geometry({.blocks = std::move(blocks), .source = {}}, options, silent);
}

inline Vec3 unit_normal(const SurfaceJet& s) {
  const Vec3 n = cross(s.su, s.sv);
  return n / norm(n);
}

}  // namespace carreau::grid
