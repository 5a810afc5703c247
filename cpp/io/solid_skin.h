// SPDX-License-Identifier: BSD-3-Clause
// The outer surface of the solids of a volume mesh.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "io/element_lists.h"

namespace carreau {

enum class SolidShape { tetrahedron, pyramid, prism, hexahedron };

/// Number of corners.
constexpr std::size_t corner_count(SolidShape shape) noexcept {
  constexpr std::array<std::size_t, 4> corners{4, 5, 6, 8};
  return corners[static_cast<std::size_t>(shape)];
}
/// Number of nodes of a solid of order 2 without nodes on faces or inside.
constexpr std::size_t quadratic_count(SolidShape shape) noexcept {
  constexpr std::array<std::size_t, 4> nodes{10, 13, 15, 20};
  return nodes[static_cast<std::size_t>(shape)];
}
/// The shape with this number of corners; empty: there is no such shape.
constexpr std::optional<SolidShape> shape_of_corners(std::size_t corners) noexcept {
  for (const SolidShape shape : {SolidShape::tetrahedron, SolidShape::pyramid, SolidShape::prism, SolidShape::hexahedron})
    if (corner_count(shape) == corners) return shape;
  return std::nullopt;
}

/// A face of one solid alone, its normal outward.
struct SkinFace {
  Cell cell;
  std::size_t solid = 0;  ///< rank of the solid, in the order of add()
  std::int32_t ref = 0;   ///< of the solid
};

/// Gathers solids. Their nodes are in the order of VTK's cells 10, 14, 13, 12 and 24, 27, 26, 25: corners, then nodes on
/// edges.
class SolidSkin {
 public:
  /// If there are fewer nodes than quadratic_count(), only the corners count.
  void add(SolidShape shape, std::span<const std::int32_t> nodes, std::int32_t ref);
  [[nodiscard]] bool empty() const noexcept { return solids_.empty(); }
  /// The faces that one solid alone has, in the order of the solids; straight when a solid is. Corners that a solid has
  /// twice count once.
  [[nodiscard]] std::vector<SkinFace> faces(const std::vector<Vec3>& vertices) const;
  /// Appends the faces to the lists when these have no surface.
  void give_to(ElementLists& lists, const std::vector<Vec3>& vertices) const;

 private:
  struct Solid {
    SolidShape shape;
    std::size_t start;  ///< of its nodes
    std::int32_t ref;
  };

  std::vector<Solid> solids_;
  std::vector<std::int32_t> nodes_;
  bool straight_ = false;
};

}  // namespace carreau
