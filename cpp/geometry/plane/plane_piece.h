// SPDX-License-Identifier: BSD-3-Clause
// A piece of a curve of the plane on [0, 1]: of a spline, or an arc of a circle.
#pragma once

#include <variant>
#include <vector>

#include "geometry/plane/circle_piece.h"
#include "geometry/plane/cubic_piece.h"

namespace carreau {

struct PlanePiece {
  std::variant<CubicPiece, CirclePiece> form;

  [[nodiscard]] Vec2 at(double t) const {
    return std::visit([t](const auto& piece) -> Vec2 { return piece.at(t); }, form);
  }
  [[nodiscard]] Vec2 first(double t) const {
    return std::visit([t](const auto& piece) -> Vec2 { return piece.first(t); }, form);
  }
  [[nodiscard]] Vec2 second(double t) const {
    return std::visit([t](const auto& piece) -> Vec2 { return piece.second(t); }, form);
  }
};

/// RR-2818 sec. 3.7, whatever the form.
inline std::vector<double> subdivide(const PlanePiece& piece, double eps) {
  return std::visit([eps](const auto& form) { return subdivide(form, eps); }, piece.form);
}

}  // namespace carreau
