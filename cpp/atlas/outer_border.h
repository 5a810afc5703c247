// SPDX-License-Identifier: BSD-3-Clause
// The outer border of an annulus in the view of the pivots, changed where necessary (Atlas sec. 5.3.2.3).
#pragma once

#include <span>

#include "atlas/parts.h"

namespace carreau::atlas {

/// An outer border of one part: straight pieces between ascending angles. The border lies inside the given annulus.
struct OuterPieces {
  std::vector<double> angle;   ///< with all knots of the part
  std::vector<double> radius;  ///< of the outer border there
  [[nodiscard]] Vec2 line(std::size_t k) const;
};

/// Pieces for all parts. They agree at joints, and together are a simple polygon. Throws DomainError where this is
/// impossible.
std::vector<OuterPieces> outer_pieces(const Polygon& inner, const Polygon& outer, std::span<const Part> parts);

/// A point of a part.
Vec2 point_at(const Part& part, double angle, double radius);
Polygon polygon_of(std::span<const Part> parts, std::span<const OuterPieces> pieces);

}  // namespace carreau::atlas
