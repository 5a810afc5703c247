// SPDX-License-Identifier: BSD-3-Clause
// The face of a cell of a cross-patch mesh, and the places of its corners and nodes in (u, v).
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

#include "surface/remesh/base/charts.h"
#include "surface/remesh/base/placed_vertices.h"

namespace carreau {

/// Corners of a cell; the last one of a triangle is -1.
using SpaceCell = std::array<std::int32_t, 4>;

/// A vertex of a cell, and the number of its place. Cells of several sheets of a face that meet along an edge may have one place there; the
/// sheet distinguishes their corners.
struct PlacedCorner {
  std::int32_t vertex = -1, place = 0, sheet = 0;
  friend auto operator<=>(const PlacedCorner&, const PlacedCorner&) = default;
};

struct PlacedCell {
  std::int32_t face = -1;
  int count = 3;  ///< of corners
  std::array<PlacedCorner, 4> corners{};  ///< as the face turns
  std::array<PlacedCorner, 4> nodes{};    ///< on the sides from each corner to the next one, of cells of second order
  bool spread = false;  ///< it is not an element of (u, v)
};

/// Keeps references.
class CellPlacer {
 public:
  CellPlacer(const PlacedVertices& vertices, const Charts& charts, Cad& cad)
      : vertices_(vertices), charts_(charts), cad_(cad) {}

  /// `cell`: as the atlas is turned; `nodes`: vertices on its sides from corner k to the next one, or -1. A cell belongs to a face in which
  /// all of its corners have places that fit. Otherwise it belongs to the face of the closest point of its centroid. A corner that is free
  /// fixes the side of barriers on which the cell lies.
  PlacedCell operator()(const SpaceCell& cell, const SpaceCell& nodes = {-1, -1, -1, -1});

 private:
  using Choice = std::array<std::int32_t, 4>;
  [[nodiscard]] std::int32_t face_of(const SurfacePlace& p) const { return charts_.face(p.foot); }
  [[nodiscard]] bool is_allowed(const SurfacePlace& p) const { return side_ < 0 || charts_.triangles()[p.foot.triangle].side == side_; }
  [[nodiscard]] bool is_turned(const SurfacePlace& p) const { return charts_.triangles()[p.foot.triangle].turned; }
  [[nodiscard]] const SurfacePlace& place(int corner, const Choice& k) const {
    return vertices_.places(vertex_[corner])[k[corner]];
  }
  [[nodiscard]] std::optional<std::int32_t> only_one_each() const;
  [[nodiscard]] std::vector<std::int32_t> common_faces() const;
  [[nodiscard]] std::optional<PlacedCell> in_one_chart(std::int32_t face) const;
  [[nodiscard]] bool fits(const Choice& k) const;
  [[nodiscard]] PlacedCell placed(std::int32_t face, const Choice& k, bool turned, bool spread) const;
  [[nodiscard]] std::int32_t nearest_place(std::int32_t v, std::int32_t face) const;
  [[nodiscard]] std::optional<SurfacePlace> below(const std::array<double, 4>& weight, const Choice& k) const;
  [[nodiscard]] std::optional<SurfacePlace> most_of(const Choice& k) const;
  [[nodiscard]] std::optional<std::int32_t> only_face() const;
  [[nodiscard]] PlacedCell over_several() const;
  void place_nodes(const SpaceCell& nodes, PlacedCell& cell) const;
  [[nodiscard]] std::int32_t place_of_node(std::int32_t node, const PlacedCell& cell, const Vec2& middle) const;
  [[nodiscard]] bool is_valid_in_chart(const PlacedCell& cell) const;

  const PlacedVertices& vertices_;
  const Charts& charts_;
  Cad& cad_;
  SpaceCell vertex_{};
  int n_ = 3;
  std::int32_t side_ = -1;  ///< Charts::Triangle::side; -1: no corner is free
  Vec3 normal_;
};

}  // namespace carreau
