// SPDX-License-Identifier: BSD-3-Clause
// From samples to the piecewise polynomial of a control space. Private to control_space/.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "control_space/control_space.h"
#include "control_space/sampling.h"

namespace carreau {

/// Balances the tree, and gives a value to the nine nodes of every leaf (corners, middles of sides, centre). Writes
/// biquadratic polynomials that are continuous and positive definite.
class ControlSpaceWriter {
 public:
  ControlSpaceWriter(detail::ControlSpaceSampling& sampling, Monitor& monitor);
  /// Call once.
  ControlSpace run();

  /// An even grid of cells over a box.
  struct EvenGrid {
    Vec2 low, high;
    int columns = 1, rows = 1;
    std::vector<Metric2> roots;  ///< at corners, middles and centres of cells, row by row, in units of the cells
    std::vector<double> shares;  ///< of the cells, row by row: inside the domain
  };
  static ControlSpace write(EvenGrid grid);

 private:
  using Nine = std::array<Metric2, 9>;  // row by row
  /// Moves a value at the middle of a side towards the mean of its ends until the side is definite. Returns false if it
  /// was.
  static bool make_side_definite(Metric2 a, Metric2& middle, Metric2 b) noexcept;
  static void make_centre_definite(Nine& nodes) noexcept;
  [[nodiscard]] static double mean_determinant(const Nine& nodes) noexcept;
  [[nodiscard]] static ControlSpace::Leaf leaf_of(const Nine& nodes, double x, double y, double scale) noexcept;

  void balance();
  void sort_leaves();
  void predict_values();
  void set_values();
  void fill_outside();
  void straighten_sides();
  [[nodiscard]] Nine values_in(const detail::TreeCell& cell) const;
  [[nodiscard]] std::int32_t coarser_beside(const detail::TreeCell& cell, int side) const;

  void write();
  std::int32_t write_cell(std::int32_t cell);
  std::int32_t write_leaf(const detail::TreeCell& cell);
  /// Triangles of unit edges in the part of a cell that belongs to the domain.
  [[nodiscard]] double measure_of(const detail::TreeCell& cell, const Nine& nodes) const;

  detail::ControlSpaceSampling& sampling_;
  detail::Tree& tree_;
  detail::Lattice& lattice_;
  Monitor& monitor_;
  std::vector<std::int32_t> leaves_;                // from coarse to fine
  std::vector<std::pair<std::int32_t, int>> late_;  // leaf, rank of a node that gets its value after predictions
  std::int32_t table_step_ = 1;                     // units of the finest grid
  ControlSpace space_;
};

}  // namespace carreau
