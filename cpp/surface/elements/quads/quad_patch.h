// SPDX-License-Identifier: BSD-3-Clause
// Quadrilaterals and triangles of one face, in its parameter plane.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "control_space/control_space.h"
#include "metric/chart.h"
#include "support/incidence.h"
#include "support/vec.h"

namespace carreau {

/// Corners of a cell, counterclockwise; the last one of a triangle is -1.
using MixedCell = std::array<std::int32_t, 4>;
constexpr int corners_of(const MixedCell& cell) noexcept { return cell[3] < 0 ? 3 : 4; }

/// The data of the passes of this room. Indices are local vertices of the face.
struct QuadPatch {
  std::vector<Vec2> uv;
  std::vector<char> fixed;  ///< by vertex: it stays, and stays in place
  std::vector<MixedCell> cells;
  /// Vertices v, a, b where edges v - a and v - b of curves go on smoothly into each other, both ways, ascending. A cell
  /// with that corner has an angle of 180 degrees there, whatever the angle of its chords.
  std::vector<std::array<std::int32_t, 3>> flat = {};
};

/// The cells at each vertex, ascending; a triangle is there twice at its first corner.
Incidence cells_around(std::size_t vertices, std::vector<MixedCell> cells);

/// The metric of a face about any of its places.
class FaceCharts {
 public:
  /// Keeps a reference to the space.
  explicit FaceCharts(const ControlSpace& space);
  /// Returns whether charts bend; otherwise they are tensors.
  [[nodiscard]] bool bends() const noexcept { return bends_; }
  [[nodiscard]] Chart about(const Vec2& uv) const noexcept {
    if (bends_) return {uv, space_->slopes_at(uv)};
    constexpr Metric2 none{0, 0, 0};
    return {uv, {space_->at(uv), none, none}};
  }
  /// The chart about the mean of the corners of a cell.
  [[nodiscard]] Chart about(const QuadPatch& patch, const MixedCell& cell) const noexcept;

 private:
  const ControlSpace* space_;
  bool bends_;
};

/// Length of a segment in the metric about its middle.
double length_in(const FaceCharts& charts, const Vec2& p, const Vec2& q) noexcept;

}  // namespace carreau
