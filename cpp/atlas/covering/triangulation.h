// SPDX-License-Identifier: BSD-3-Clause
// A closed triangulated surface and its neighbourhoods.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "support/vec.h"

namespace carreau::atlas {

struct Triangulation {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< counterclockwise from outside
};

/// Neighbours of vertices, in order.
class Fans {
 public:
  /// Throws InvalidArgument with the vertices, from 1, for a border, an edge of three triangles, or triangles that are
  /// turned differently. Also for a vertex where several fans meet, and invalid indices and coordinates.
  explicit Fans(const Triangulation& surface);

  /// Counterclockwise, each once; with the next one a triangle.
  [[nodiscard]] const std::vector<std::int32_t>& around(std::int32_t vertex) const {
    return fans_[static_cast<std::size_t>(vertex)];
  }
  [[nodiscard]] std::size_t size() const { return fans_.size(); }
  /// The vertex of the triangle on the left of the edge from a to b.
  [[nodiscard]] std::int32_t left_of(std::int32_t a, std::int32_t b) const;

 private:
  std::vector<std::vector<std::int32_t>> fans_;
};

/// Four triangles in place of one, with middles of edges.
Triangulation subdivided(const Triangulation& surface);

}  // namespace carreau::atlas
