// SPDX-License-Identifier: BSD-3-Clause
// Fields on the old mesh of a piece become fields on the new one.
#pragma once

#include <span>
#include <vector>

#include "mesh/triangle_search.h"
#include "variable/transfer/overlaps.h"

namespace carreau::variable {

/// Refers to its arguments. Overlaps are found when they are first needed.
class PieceTransfer {
 public:
  /// `search` holds the triangles of `old`, `adjacency` is theirs.
  PieceTransfer(const Piece& old, const Adjacency& adjacency, const TriangleSearch& search, const Piece& piece)
      : old_(&old), adjacency_(&adjacency), search_(&search), piece_(&piece) {}

  /// Linear in the triangle that holds a vertex, or continued from the nearest one: exact for linear fields.
  [[nodiscard]] std::vector<double> nodal(std::span<const double> values, int components);
  /// Values in old triangles become linear functions with limited slopes: a field that is carried from mesh to mesh a
  /// hundred times spreads much less than with constants. Mean over the intersection of a triangle with old ones; value
  /// of the nearest old triangle if it meets none. Between the smallest and the largest value around.
  [[nodiscard]] std::vector<double> means(std::span<const double> values, int components);
  /// The integral over each old triangle is distributed to the new ones in proportion to their common area, or to the
  /// nearest one: the integral over all stays, up to rounding.
  [[nodiscard]] std::vector<double> conserved(std::span<const double> values, int components);

 private:
  struct Place {
    std::int32_t triangle = 0;
    std::array<double, 3> weight{};
  };
  const std::vector<Place>& places();
  const Overlaps& overlaps();
  void give_uncovered(std::span<const double> values, std::size_t components, std::span<const double> covered,
                      std::vector<double>& result) const;

  const Piece* old_;
  const Adjacency* adjacency_;
  const TriangleSearch* search_;
  const Piece* piece_;
  std::vector<Place> places_;
  Overlaps overlaps_;
};

}  // namespace carreau::variable
