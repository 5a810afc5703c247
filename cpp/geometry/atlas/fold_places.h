// SPDX-License-Identifier: BSD-3-Clause
// Places at which the blended surface is checked for folds.
#pragma once

#include <vector>

#include "atlas/covering/covering.h"
#include "geometry/atlas/primitive.h"

namespace carreau::atlas {

/// A place with its coordinates and weights in all charts that count there.
struct FoldPlace {
  struct Share {
    std::size_t chart = 0;
    Slope weight;
    Pair<Slope> at;
  };
  std::array<Share, 3> share;
  std::size_t shares = 0;
  Vec3 normal{0, 0, 0};  ///< of the charts' planes, by their area

  /// Derivatives of the surface.
  struct Tangents {
    Vec3 by_u{0, 0, 0}, by_v{0, 0, 0};
  };
  [[nodiscard]] Vec3 point(const std::vector<Primitive>& primitives) const;
  [[nodiscard]] Tangents tangents(const std::vector<Primitive>& primitives) const;
  /// Jacobian of the surface over the Jacobian of its charts' planes: 1 on the planes, below 0 where it is turned over.
  [[nodiscard]] double jacobian(const std::vector<Primitive>& primitives) const;
};

/// A place of a T, where the final check looks.
struct PlaceOfT {
  std::size_t triple = 0;
  Vec2 at{0, 0};
};

/// Places of all T on a grid, and given ones; values common to all T are computed once.
class FoldGrid {
 public:
  FoldGrid(const Covering& covering, const std::vector<PlaceOfT>& given);

  /// Places of a T where charts share it.
  template <typename Visit>
  void visit_triple(std::size_t triple, Visit&& visit) const {
    for (const Node& node : nodes_) visit(place(triple, node));
    for (const Vec2& at : given_[triple]) visit(place(triple, node_at(at)));
  }
  /// Places where a chart is alone: on its triangles and at the border of its pure zone.
  [[nodiscard]] std::vector<FoldPlace> of_pure_zone(std::size_t chart) const;

 private:
  /// A place of T: weights, shares and phi for each of its corners.
  struct Node {
    std::array<Slope, 3> weight;
    std::array<Polar<Slope>, 3> place;
  };
  [[nodiscard]] static Node node_at(const Vec2& place);
  [[nodiscard]] FoldPlace place(std::size_t triple, const Node& node) const;

  const Covering& covering_;
  std::vector<Node> nodes_;
  std::vector<std::vector<Vec2>> given_;  ///< by T
};

}  // namespace carreau::atlas
