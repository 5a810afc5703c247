// SPDX-License-Identifier: BSD-3-Clause
// A piece of the plane that is known by its mesh only (HDR sec. 3.4.1).
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "support/vec.h"

namespace carreau::variable {

/// Kinds of vertices and boundary edges (HDR sec. 3.4.1). Values of bound ones name the tool: bound + its index.
enum Kind : std::int32_t {
  inside = 0,
  free_boundary = 1,  ///< deformed by stresses
  imposed = 2,        ///< laid bare by the removal of elements
  bound = 3,          ///< on a tool
};

/// Vertices and counterclockwise triangles.
struct Piece {
  std::vector<Vec2> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;

  [[nodiscard]] double double_area(std::size_t triangle) const noexcept {
    const auto& t = triangles[triangle];
    const Vec2 a = vertices[static_cast<std::size_t>(t[0])];
    return cross(vertices[static_cast<std::size_t>(t[1])] - a, vertices[static_cast<std::size_t>(t[2])] - a);
  }
  [[nodiscard]] double area() const noexcept;
};

/// Vertices in the plane z = 0, for other rooms.
std::vector<Vec3> in_space(const std::vector<Vec2>& vertices);

/// For each side (t[k], t[k + 1]) of each triangle the triangle on its other side, or -1.
using Adjacency = std::vector<std::array<std::int32_t, 3>>;
/// Throws InvalidArgument if more than two triangles share an edge, or two have equal directions along it.
Adjacency adjacency_of(const Piece& piece);

/// Parts joined by edges: the part of each triangle, numbered in the order of their first triangles, and their number.
std::pair<std::vector<std::int32_t>, std::int32_t> parts_of(const Adjacency& adjacency);

}  // namespace carreau::variable
