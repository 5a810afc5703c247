// SPDX-License-Identifier: BSD-3-Clause
// Cells of the layers along a curve.
#pragma once

#include <array>
#include <cstdint>

namespace carreau {

/// A cell of a layer along a curve. Its corners are counterclockwise in (u, v): a and b nearer to the curve, then c above
/// b and d above a. A triangle at a corner of the curve has the corner, then its two upper vertices, and -1.
struct LayerCell {
  std::array<std::int32_t, 4> corners{-1, -1, -1, -1};  ///< local vertices of the face
  std::int32_t layers = 0;                              ///< index of the layers that it belongs to
  std::int32_t row = 0;                                 ///< from 0, which touches the curve
  [[nodiscard]] bool is_triangle() const noexcept { return corners[3] < 0; }
  friend bool operator==(const LayerCell&, const LayerCell&) = default;
};

}  // namespace carreau
