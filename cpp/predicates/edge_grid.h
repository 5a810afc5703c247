// SPDX-License-Identifier: BSD-3-Clause
// A grid over the edges of a planar domain: which edges meet a cell.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "support/vec.h"

namespace carreau {

/// Cells between grid lines that follow the density of the vertices (their quantiles): a small dense part of a large
/// domain is resolved as well as the rest. A cell lists at least every edge that has a point in common with the closed
/// cell. The outermost lines pass through the outermost vertices.
class EdgeGrid {
 public:
  /// Indices of the edges count from 0; edges refer to `vertices`. Finite coordinates of any size.
  EdgeGrid(std::span<const Vec2> vertices, std::span<const std::pair<int, int>> edges);

  [[nodiscard]] int columns() const noexcept { return static_cast<int>(xs_.size()) - 1; }
  [[nodiscard]] int rows() const noexcept { return static_cast<int>(ys_.size()) - 1; }
  /// Line 0 .. columns() and 0 .. rows(), increasing; at least two each (equal when all vertices are aligned).
  [[nodiscard]] double x(int column) const noexcept { return xs_[column]; }
  [[nodiscard]] double y(int row) const noexcept { return ys_[row]; }
  /// The column i with x(i) <= value < x(i + 1); the first or the last one for values outside.
  [[nodiscard]] int column_of(double value) const noexcept { return interval_of(xs_, value); }
  [[nodiscard]] int row_of(double value) const noexcept { return interval_of(ys_, value); }
  [[nodiscard]] std::span<const int> edges_in(int column, int row) const noexcept {
    const auto cell =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(columns()) + static_cast<std::size_t>(column);
    return {edge_.data() + first_[cell], edge_.data() + first_[cell + 1]};
  }

 private:
  static int interval_of(const std::vector<double>& lines, double value) noexcept;
  template <typename Visit>
  void visit_cells(const Vec2& a, const Vec2& b, const Visit& visit) const;

  std::vector<double> xs_, ys_;
  std::vector<int> first_, edge_;  // compressed rows: cell c has edge_[first_[c]] .. edge_[first_[c + 1] - 1]
};

}  // namespace carreau
