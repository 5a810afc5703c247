// SPDX-License-Identifier: BSD-3-Clause
// The faces into which polylines cut the plane.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/plane/plane_arcs.h"
#include "predicates/edge_grid.h"

namespace carreau {

/// Two arcs that meet where neither ends, or run together.
struct ArcConflict {
  int first = 0, second = 0;  ///< indices of arcs; the same: it crosses itself
  Vec2 at;
};

/// The faces of a plane graph. A half-edge is 2 arc (as the arc runs) or 2 arc + 1 (against it). Loops run with their
/// face on the left: counterclockwise around the face, clockwise around loops inside it.
class PlaneGraph {
 public:
  /// Keeps references to both. The polylines must not conflict.
  PlaneGraph(const PlaneDomainInput& input, std::span<const PlaneArc> arcs);

  /// The first conflict in the order of arcs. Exact; n log n on usual domains.
  static std::optional<ArcConflict> find_conflict(const PlaneDomainInput& input, std::span<const PlaneArc> arcs);

  static constexpr int unbounded = -1, on_an_arc = -2;
  struct Face {
    std::vector<int> half_edges;  ///< of all its loops, the outer one first
    int depth = 0;                ///< number of faces around it that nothing joins to it
  };
  [[nodiscard]] const std::vector<Face>& faces() const noexcept { return faces_; }
  /// The face on the left of a half-edge, or unbounded.
  [[nodiscard]] int face_of(int half_edge) const noexcept { return face_of_loop_[loop_[half_edge]]; }
  /// The face that holds a point, unbounded, or on_an_arc.
  [[nodiscard]] int face_at(const Vec2& p) const;

 private:
  struct Edge {
    int a = 0, b = 0;  // indices of vertices_
    int arc = 0;
  };
  /// Vertex `rank` of the polyline of an arc.
  struct Leftmost {
    Vec2 at;
    int arc = 0;
    std::size_t rank = 0;
  };
  void collect(const PlaneDomainInput& input);
  void find_outsides(const std::map<int, std::vector<int>>& leaving);
  void trace_loops();
  void nest_loops();
  [[nodiscard]] int end_of(int half_edge) const noexcept;
  [[nodiscard]] Vec2 direction(int half_edge) const noexcept;
  [[nodiscard]] int edge_below(const Vec2& p, int skipped, bool& on_it) const;
  [[nodiscard]] int half_edge_above(int edge) const noexcept;
  int container_of(int loop);

  std::span<const PlaneArc> arcs_;
  std::vector<Vec2> vertices_;
  std::vector<Edge> edges_;
  std::vector<int> component_;      // of each arc
  std::vector<int> next_, loop_;    // of each half-edge
  std::vector<int> first_of_loop_;  // a half-edge
  std::vector<int> outside_;        // of each component, a half-edge with the surrounding face on its left
  std::vector<int> face_of_loop_;
  std::vector<Leftmost> leftmost_;  // of each component
  std::vector<Face> faces_;
  std::optional<EdgeGrid> grid_;
};

}  // namespace carreau
