// SPDX-License-Identifier: BSD-3-Clause
// Middles of the edges of sharp lines, once for all faces beside.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "surface/elements/base/atlas_surface.h"
#include "surface/remesh/lines/line_remeshing.h"

namespace carreau {

/// The remaining edges of the sharp lines of a cross-patch mesh. Keeps references.
class LineMiddles {
 public:
  /// `worked`: by line, with the places of its vertices.
  LineMiddles(const AtlasSurface& surface, PlacedVertices& vertices, std::vector<SharpLine> left,
              std::span<WorkedLine> worked, Monitor& monitor);

  [[nodiscard]] const std::vector<SharpLine>& lines() const noexcept { return lines_; }
  /// Returns whether the edge belongs to a line.
  [[nodiscard]] bool is_edge(const MeshEdge& edge) const { return middle_.contains(edge); }
  /// A vertex at half the metric length of the edge on the curves of the line; the first call makes it.
  [[nodiscard]] std::int32_t middle_of(const MeshEdge& edge);
  /// If no known curve has the middle of an edge, it lies on the first surface beside.
  [[nodiscard]] std::size_t unknown() const noexcept { return unknown_; }
  /// Halves each edge.
  void halve();

 private:
  /// The place of an edge: in line `line`, from its vertex `rank`.
  struct Edge {
    std::size_t line = 0, rank = 0;
    std::int32_t middle = -1;
  };
  [[nodiscard]] bool has_arcs(std::size_t line) const;
  void list_edges();
  [[nodiscard]] double share(std::int32_t v, std::int32_t w) const;
  [[nodiscard]] KeptPlaces places_at(const Edge& edge);
  [[nodiscard]] KeptPlaces places_beside(std::int32_t v, std::int32_t w) const;

  const AtlasSurface& surface_;
  PlacedVertices& vertices_;
  std::vector<SharpLine> lines_;
  std::span<WorkedLine> worked_;
  Monitor& monitor_;
  std::map<MeshEdge, Edge> middle_;
  std::size_t unknown_ = 0;
};

}  // namespace carreau
