// SPDX-License-Identifier: BSD-3-Clause
// Steps that stay in the parameter domain of a face.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "cad/cad.h"
#include "support/box_tree.h"

namespace carreau {

/// Gives the ends of curves that are nearest to each other, in shares of the extents of all, one point: the chords form loops then.
void join_ends(std::vector<BoundaryCurve>& boundary);
/// The lowest and highest parameters of the samples.
std::pair<Vec2, Vec2> box_of(std::span<const BoundaryCurve> boundary);

/// Proves by the samples of the boundary, without the host, that steps lead into the domain. Searches are safe from
/// several threads.
class ParameterDomain {
 public:
  /// `boundary`: all curves around the face, whose chords enclose it by the even-odd rule.
  explicit ParameterDomain(std::vector<BoundaryCurve> boundary);

  /// True if the steps from a point of the closed domain to all points of `to` stay inside: each of them keeps three degrees
  /// from every edge of the boundary nearby, or stays on the inner side of its curve. False does not prove the contrary.
  [[nodiscard]] bool admits(const Vec2& from, std::span<const Vec2> to) const;

 private:
  /// In shares of the extents of the boundary.
  struct Edge {
    Vec2 a, b, inward;  ///< `inward`: unit normal
    double margin = 0;  ///< the curve is no farther from its chord
    double slack = 0;   ///< sine of the least angle between a step and the chord
  };
  [[nodiscard]] Vec2 scaled(const Vec2& uv) const { return (uv - low_).cwiseQuotient(size_); }

  Vec2 low_, size_;
  std::vector<Edge> edges_;
  BoxTree tree_;
};

}  // namespace carreau
