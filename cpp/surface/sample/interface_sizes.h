// SPDX-License-Identifier: BSD-3-Clause
// Physical size inside a face where the host does not answer: interpolated from the discretised interfaces (RT-0232
// sec. 3.1.3 a).
#pragma once

#include <array>
#include <vector>

#include "plane/plane_mesher.h"
#include "size/size_law.h"
#include "support/monitor.h"

namespace carreau {

/// Mean value interpolation from the edges in view: h(x) = M^-1( integral of M(h(y)) / |y - x| over all directions,
/// over integral of 1 / |y - x| ). Here y is the first interface met in that direction, boundary or internal curve; M
/// is the logarithm for the geometric law and the identity for the others. Along an interface the vertices' sizes
/// follow the law. Reproduces them on the interfaces, stays between their extremes, and reproduces fields whose M is
/// linear on convex domains. The result is smooth, unlike the interpolation in a triangulation of the boundary. Keeps
/// its own copy of everything.
class InterfaceSizes {
 public:
  /// sizes: one a vertex of the domain; vertices whose size is not positive (imposed points) are left out.
  InterfaceSizes(const PlaneDomain& domain, const std::vector<double>& sizes, SizeLaw law, Monitor& monitor);

  /// Size at a point of the domain; a point outside is taken to be in the nearest triangle met. Remembers its last
  /// triangle and keeps its memory: not for several threads at once.
  double operator()(const Vec2& uv) const;

 private:
  using Triangle = std::array<int, 3>;
  /// The edge opposite to corner `side` of a triangle, seen between two directions, the first on the right.
  struct View {
    int triangle, side;
    Vec2 right, left;
  };
  struct Sums;

  [[nodiscard]] std::array<double, 3> weights(int triangle, const Vec2& p) const;
  [[nodiscard]] int triangle_at(const Vec2& p) const;
  [[nodiscard]] bool is_interface(const View& view) const {
    return across_[static_cast<std::size_t>(view.triangle)][static_cast<std::size_t>(view.side)] < 0;
  }
  void look_through(const View& view, const Vec2& from) const;
  void add(const View& view, Vec2 from, Sums& sums) const;

  PlaneMesh mesh_;                   // (u, v) in units of the domain's box
  std::vector<Triangle> neighbour_;  // across the edge opposite to each corner; -1: none
  std::vector<Triangle> across_;     // same, and -1 if the edge is imposed: the neighbours that a view passes to
  std::vector<double> value_;        // M(h) at the vertices
  Vec2 low_, scale_;
  SizeLaw law_;
  mutable int last_ = 0;
  mutable std::vector<View> views_;
};

}  // namespace carreau
