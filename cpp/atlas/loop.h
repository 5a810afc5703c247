// SPDX-License-Identifier: BSD-3-Clause
// A loop of the plane with an orthoradial parameter (Atlas sec. 5.2).
#pragma once

#include "atlas/parts.h"

namespace carreau::atlas {

enum class LoopSpeed {
  even,   ///< angles are linear in phi: a homeomorphism
  smooth  ///< C1 where pivots change; at vertices the loop itself turns
};

/// phi runs from 0 at vertex 1 to 2 pi, counterclockwise, and repeats.
class Loop {
 public:
  /// Throws DomainError with the vertex: a loop that crosses itself, runs clockwise, or has parts too near to one
  /// another.
  explicit Loop(Polygon polygon, LoopSpeed speed = LoopSpeed::smooth, bool star = false);

  [[nodiscard]] const Polygon& polygon() const { return polygon_; }
  [[nodiscard]] const Pivots& pivots() const { return chosen_.pivots; }
  [[nodiscard]] PivotChoice pivot_choice() const { return chosen_.how; }
  [[nodiscard]] double period() const { return 2 * std::numbers::pi; }

  struct Place {
    Vec2 point{0, 0}, derivative{0, 0};
  };
  /// Point and derivative by phi; a vertex has the derivative of the edge behind it.
  [[nodiscard]] Place at(double phi) const;
  /// phi, from 0 to 2 pi, of the point of the loop on the ray from p's pivot through p; of several points the nearest.
  /// Throws InvalidArgument when p is further from the loop than `tolerance`.
  [[nodiscard]] double phi_of(const Vec2& p, double tolerance) const;

 private:
  Polygon polygon_;
  ChosenPivots chosen_;
  std::vector<Part> parts_;
};

/// The part that holds phi, which is moved into the period that begins with the first part.
std::size_t part_of(std::span<const Part> parts, double period, double& phi);

}  // namespace carreau::atlas
