// SPDX-License-Identifier: BSD-3-Clause
// The six sides of a box: x, y, z upwards, then downwards.
#pragma once

#include <Bnd_Box.hxx>
#include <array>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>
#include <limits>

namespace carreau_occ {

using BoxSides = std::array<double, 6>;

inline double along(const gp_Pnt& p, int side) { return side < 3 ? p.Coord(side + 1) : -p.Coord(side - 2); }

inline gp_Vec direction(int side) {
  gp_Vec d;
  d.SetCoord(side % 3 + 1, side < 3 ? 1 : -1);
  return d;
}

/// Largest coordinate of a box on each side; a void box is at minus infinity.
inline BoxSides sides_of(const Bnd_Box& box) {
  BoxSides sides;
  sides.fill(-std::numeric_limits<double>::infinity());
  if (box.IsVoid()) return sides;
  const gp_Pnt low = box.CornerMin(), high = box.CornerMax();
  for (int side = 0; side < 6; ++side) sides[side] = along(side < 3 ? high : low, side);
  return sides;
}

}  // namespace carreau_occ
