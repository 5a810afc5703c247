// SPDX-License-Identifier: BSD-3-Clause
// Middles of the edges of curves, once for all faces that hold them.
#pragma once

#include <optional>
#include <vector>

#include "surface/elements/base/work.h"

namespace carreau {

/// A point of a curve between two of its vertices.
struct CurveMiddle {
  Vec3 xyz;                     ///< on the surface of the first use
  std::vector<Vec2> uv_of_use;  ///< by use of the topology's curve: exact values of curv0
};

/// The middle of a segment by metric length, as a share of the segment: `left`, `middle` and `right` are densities of
/// length (for example 1 / size) at its ends and its middle. The density between them is linear. Exactly 0.5 for equal
/// ones, and between 0.29 and 0.71: a node there keeps the segment's own Jacobian positive.
double metric_middle(double left, double middle, double right) noexcept;

/// Share of the length of segment k at which half of its metric length lies, by the sizes along the curve.
double middle_share(const DiscreteCurve& curve, std::size_t k);

/// Computes points between the vertices of curves, with one allocation of memory.
class EdgeMiddles {
 public:
  explicit EdgeMiddles(const ElementWork& work) : work_(work) { piece_.sizes = {{0, 1}, {1, 1}, {1, 1}}; }

  /// The point at half the metric length of edge k of result.mesh.curves[curve], `shift` of the edge further, in every
  /// use; on periodic curves the image of this point of the first curve of the class. Empty if the curve is one point of
  /// space, or if its vertices differ from work.curves[curve] (a narrow face has vanished there).
  [[nodiscard]] std::optional<CurveMiddle> at(std::size_t curve, std::size_t k, double shift = 0);

 private:
  [[nodiscard]] std::optional<CurveMiddle> at_share(std::size_t curve, std::size_t k, double share);
  [[nodiscard]] std::optional<CurveMiddle> image(std::size_t curve, std::size_t k, double shift);
  [[nodiscard]] std::optional<CurveMiddle> repeated_middle(std::size_t curve, std::size_t k, double shift);
  void move_to(std::size_t curve, std::size_t k, const Vec3& target, CurveMiddle& middle);

  const ElementWork& work_;
  DiscreteCurve piece_;
};

/// A side of a face's triangles that lies on a curve.
struct CurveSide {
  std::int32_t a = 0, b = 0;           ///< local vertices, a < b
  std::int32_t curve = 0, segment = 0;  ///< of result.mesh.curves: edge `segment`
  std::int32_t use = 0;                ///< of the topology's curve
  friend auto operator<=>(const CurveSide&, const CurveSide&) = default;
};

/// All of a face, ascending, each once. (u, v) distinguishes the two sides of a seam.
std::vector<CurveSide> curve_sides(const ElementWork& work, std::size_t face);

}  // namespace carreau
