// SPDX-License-Identifier: BSD-3-Clause
// Cubic splines through points of the plane, twice continuously differentiable (HDR sec. 3.4.2, after de Boor).
#pragma once

#include <span>
#include <vector>

#include "support/vec.h"

namespace carreau::variable {

enum class SplineEnds {
  natural,   ///< no second derivative at the ends: of second order there
  tangent,   ///< derivatives of the cubics through the first and the last four points: of fourth order throughout
  periodic,  ///< the last point is followed by the first one
};

/// Parameters are chord lengths: piece i runs from point i to the next one.
class CubicSpline {
 public:
  /// Two points or more, three if periodic, neighbours different.
  CubicSpline(std::span<const Vec2> points, SplineEnds ends);

  [[nodiscard]] std::size_t pieces() const noexcept { return width_.size(); }
  [[nodiscard]] double width(std::size_t piece) const noexcept { return width_[piece]; }
  /// At fraction t in [0, 1] of a piece; exact at its ends.
  [[nodiscard]] Vec2 at(std::size_t piece, double t) const noexcept;
  [[nodiscard]] Vec2 derivative(std::size_t piece, double t) const noexcept;
  [[nodiscard]] Vec2 second_derivative(std::size_t piece, double t) const noexcept;
  /// Not negative; 0 if the curve stands still.
  [[nodiscard]] double curvature(std::size_t piece, double t) const noexcept;

 private:
  void solve_open(SplineEnds ends);
  void solve_periodic();
  [[nodiscard]] Vec2 slope_of(std::size_t piece) const noexcept;
  [[nodiscard]] const Vec2& end(std::size_t piece) const noexcept { return points_[(piece + 1) % points_.size()]; }

  std::vector<Vec2> points_, moments_;  // second derivatives at the points
  std::vector<double> width_;
};

}  // namespace carreau::variable
