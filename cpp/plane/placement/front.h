// SPDX-License-Identifier: BSD-3-Clause
// The front: edges between triangles that are small enough and triangles that are not.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plane/placement/insertion.h"

namespace carreau::plane {

struct FrontEdge {
  HalfEdge edge;           ///< of a triangle that is not done
  std::int32_t a, b;       ///< its ends; the triangle lies on the left
  std::int32_t next = -1;  ///< edge of the front that starts at b
  bool chained = false, has_previous = false;
};

struct Front {
  std::vector<FrontEdge> edges;
  std::vector<std::int32_t> leaving;  ///< edge by the vertex it leaves; -1 none, -2 several
  std::vector<std::int32_t> several;  ///< edges that leave such vertices
  std::span<const std::uint8_t> resting;

  /// The front of the whole mesh. A degenerate side does not belong to it, since no layer starts at a point of space.
  void find(const Placement& placement);
  /// Around the triangles touched, which are cleared.
  void find_again(Placement& placement);

 private:
  void clear(const Triangulation& mesh);
  void visit(const Triangulation& mesh, int t);
  void add(const Triangulation& mesh, HalfEdge he);
  void connect(const Triangulation& mesh);
  [[nodiscard]] std::int32_t next_around(const Triangulation& mesh, const FrontEdge& edge) const;
};

}  // namespace carreau::plane
