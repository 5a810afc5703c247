// Physical size inside a face where the host does not answer: interpolated from the discretised interfaces (RT-0232
// sec. 3.1.3 a).
#pragma once

#include <array>
#include <vector>

#include "plane/plane_mesher.h"
#include "size/size_law.h"
#include "support/monitor.h"

namespace carreau {

/// Interpolates in the triangulation of the boundary vertices alone (RR-2928 sec. 2.2, "maillage frontalier"), along
/// each edge by the law of hinterpol_flag. Keeps its own copy of everything.
class InterfaceSizes {
 public:
  /// sizes: one a vertex of the domain; vertices whose size is not positive (imposed points) are left out.
  InterfaceSizes(const PlaneDomain& domain, const std::vector<double>& sizes, SizeLaw law, Monitor& monitor);

  /// Size at a point of the domain; outside, that of the nearest triangle met. Remembers where it was last: not for
  /// several threads at once.
  double operator()(Vec2 uv) const;

 private:
  [[nodiscard]] double inside(int triangle, const std::array<double, 3>& weights) const;

  PlaneMesh mesh_;
  std::vector<std::array<int, 3>> neighbours_;  // across the edge opposite to each corner; -1: none
  std::vector<double> sizes_;
  SizeLaw law_;
  mutable int last_ = 0;
};

}  // namespace carreau
