// SPDX-License-Identifier: BSD-3-Clause
// The prescribed size at each place of the piece: H of HDR sec. 3.4.1, the least of all maps, graded.
#pragma once

#include <span>
#include <vector>

#include "gradation/edge_sizes.h"
#include "mesh/triangle_search.h"
#include "variable/base/piece.h"

namespace carreau::variable {

/// H_phi2 (HDR sec. 3.4.3 b) at vertices: linear from h_max without damage to h_min with damage 1, by the most damaged
/// triangle of each.
std::vector<double> damage_sizes(const Piece& piece, std::span<const double> damage, double h_min, double h_max);

/// Lowers the sizes of vertices until each is at most the size of each neighbour plus slope times the distance.
void grade_sizes(const Piece& piece, double slope, std::vector<double>& sizes);

/// Linear between the vertices of the piece, and bounded by the sizes that grow from edges of space. Refers to its
/// arguments.
class SizeMap {
 public:
  struct Bounds {
    double h_min = 0, h_max = 0;
  };
  /// `search` holds the triangles of the piece.
  SizeMap(const Piece& piece, const TriangleSearch& search, std::vector<double> sizes, Bounds bounds)
      : piece_(&piece), search_(&search), sizes_(std::move(sizes)), bounds_(bounds) {}

  void set_sources(std::vector<EdgeSizes::Source> sources, double slope) { sources_ = {std::move(sources), slope}; }
  /// At a place known by its triangle, or outside by the nearest one; `guess` is any triangle, and then that one.
  [[nodiscard]] double at(const Vec2& p, std::int32_t& guess) const;
  /// Between two vertices of the piece, at p.
  [[nodiscard]] double between(std::array<std::int32_t, 2> vertices, double t, const Vec2& p) const;

 private:
  [[nodiscard]] double bounded(double size, const Vec2& p) const;

  const Piece* piece_;
  const TriangleSearch* search_;
  std::vector<double> sizes_;
  EdgeSizes sources_;
  Bounds bounds_;
};

}  // namespace carreau::variable
