// SPDX-License-Identifier: BSD-3-Clause
// The contact of the boundary of a piece with tools: bound deformation (HDR sec. 3.4.2).
#pragma once

#include <cstdint>
#include <vector>

#include "variable/base/erosion.h"
#include "variable/boundary/tools.h"

namespace carreau::variable {

struct BoundaryNode {
  Vec2 point;
  std::int32_t vertex = -1;                ///< of the piece; -1: a node of a tool that lies on the edge `on`
  std::array<std::int32_t, 2> on{-1, -1};  ///< vertices of the piece beside it
  ToolPlace place;                         ///< of a bound node; tool -1: it is not

  [[nodiscard]] bool is_bound() const noexcept { return place.tool >= 0; }
};

/// A closed loop with the piece on its left; edges[i] runs from nodes[i] to the next one.
struct BoundaryLoop {
  struct Edge {
    bool imposed = false;       ///< laid bare by the removal of elements
    bool bared = false;         ///< by this one
    bool follows_tool = false;  ///< its geometry is the tool's
    double way = 0;             ///< then: the distance along the tool, against its direction
  };
  std::vector<BoundaryNode> nodes;
  std::vector<Edge> edges;

  [[nodiscard]] std::size_t size() const noexcept { return nodes.size(); }
  [[nodiscard]] std::size_t after(std::size_t i) const noexcept { return i + 1 < size() ? i + 1 : 0; }
  [[nodiscard]] std::size_t before(std::size_t i) const noexcept { return i > 0 ? i - 1 : size() - 1; }
  [[nodiscard]] double length(std::size_t i) const noexcept { return norm(nodes[after(i)].point - nodes[i].point); }
  /// free_boundary, imposed, or bound + tool.
  [[nodiscard]] std::int32_t kind_of_edge(std::size_t i) const noexcept;
  /// A node between edges of two kinds is bound rather than imposed, and imposed rather than free.
  [[nodiscard]] std::int32_t kind_of_node(std::size_t i) const noexcept;
  /// Removes a node; the edge to the next node goes with it, and the previous edge takes its place.
  void remove(std::size_t i);
};

/// Each loop from its lowest vertex, in the order of these. The piece has no multiple vertices.
std::vector<BoundaryLoop> boundary_of(const Eroded& eroded);

/// Distances for contact.
struct ContactDistances {
  double step = 0;   ///< delta of HDR eq. 3.1: how deep a node may lie in a tool, or a tool's node in the piece
  double reach = 0;  ///< distance outside up to which a node is bound, at most the step. HDR has the step; a surface that
                     ///< leaves a tool more slowly would then never come off
};

/// Binds nodes in regions of radius `step` about the tools' edges (HDR eq. 3.1): they move to the nearest place of the
/// tool. Nodes of tools in regions of the piece's edges become bound nodes of the boundary, if no edge follows the tool
/// there. Edges between bound nodes of one tool follow it, unless they bridge a notch. n log n in nodes and edges.
/// Throws InvalidArgument if a vertex lies deeper than `step` in a tool, or a tool's node deeper than that in the
/// piece.
void bind_to_tools(std::vector<BoundaryLoop>& loops, const Tools& tools, ContactDistances distances, double h_min);

/// Lets edges follow the tools between bound nodes, after nodes have been removed.
void follow_tools(BoundaryLoop& loop, const Tools& tools, double h_min);

}  // namespace carreau::variable
