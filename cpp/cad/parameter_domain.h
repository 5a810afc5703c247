// SPDX-License-Identifier: BSD-3-Clause
// The parameter domain of a face: steps that stay inside, and places.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cad/cad.h"
#include "predicates/polygon_locator.h"
#include "support/box_tree.h"
#include "support/vec.h"

namespace carreau {

/// Gives the ends of curves that are nearest to each other, in shares of the extents of all, one point: the chords form loops then.
void join_ends(std::vector<BoundaryCurve>& boundary);
/// Share of a chord. Curves leave the chords of their supports by less; nearer places are decided by the curve itself.
/// [Projector.TrimmedPlane]
inline constexpr double beside_chord = 0.05;
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

/// The domain of a face whose boundary is not a rectangle. Far from the boundary the polygon of the supports decides, near it the curves
/// themselves. Answers from several threads if the host does.
class TrimmedDomain {
 public:
  /// `boundary`: all curves around the face. Ends of curves that are apart in the plane are joined with the nearest other end.
  TrimmedDomain(int face, std::vector<BoundaryCurve> boundary);

  enum class Side { outside, inside, crossing };
  /// The side of a box; `crossing` if the boundary comes near it.
  [[nodiscard]] Side side_of(const Vec2& low, const Vec2& high) const;
  /// True if the place lies in the domain or on its boundary.
  [[nodiscard]] bool contains(const Vec2& uv, Cad& cad) const;
  /// The closest place of the boundary, in shares of the extents, for a place outside the domain; none for the others.
  [[nodiscard]] std::optional<Vec2> closest_from_outside(const Vec2& uv, Cad& cad) const;

 private:
  struct Piece {
    int ic = 0;
    double t0 = 0, t1 = 0, a = 0, b = 0;
    double margin = 0;  // share of the extents
    bool both_sides_inside = false;  // a curve that is given twice
  };
  struct Beside {
    double share = -1;             ///< along the edge
    double place = 0, curve = 0;  ///< across it
  };
  [[nodiscard]] Beside beside(std::int32_t edge, const Vec2& uv, Cad& cad) const;
  [[nodiscard]] Vec2 closest_of(const Piece& piece, const Vec2& uv, Cad& cad) const;
  [[nodiscard]] double distance_to(std::int32_t edge, const Vec3& p) const;
  [[nodiscard]] Vec3 scaled(const Vec2& uv) const {
    return {(uv.x() - low_.x()) / size_.x(), (uv.y() - low_.y()) / size_.y(), 0};
  }

  int ref_;
  Vec2 low_, size_;
  std::vector<Vec2> vertices_;
  std::vector<std::pair<int, int>> edges_;
  std::vector<Piece> pieces_;  // of edges_
  std::optional<PolygonLocator> polygon_;
  BoxTree tree_;  // of the edges, scaled to the unit square
};

}  // namespace carreau
