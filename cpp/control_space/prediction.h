// SPDX-License-Identifier: BSD-3-Clause
// Prediction of the nodes of a cell from samples. Private to the builder of control spaces.
#pragma once

#include "control_space/tree.h"

namespace carreau::detail {

/// Predicts nodes of cells. The tree knows nearly all neighbours; others are looked up in the lattice.
class NodePredictor {
 public:
  /// The arguments must outlive the object.
  NodePredictor(Lattice& lattice, const Tree& tree) : lattice_(lattice), tree_(tree) {}

  /// Lattice::predict() of node `k` of a cell, a rank in TreeCell::node.
  Prediction predict(const TreeCell& cell, int k);
  /// A centre from the twelve nearest corners of a grid of cells, exact for cubics. Returns false if some are unknown.
  [[nodiscard]] bool predict_centre(const TreeCell& cell, Metric2& root) const;

 private:
  Prediction predict_middle(const TreeCell& cell, int side);
  Prediction predict_by_middles(const TreeCell& cell);
  [[nodiscard]] const TreeCell* like_it_beside(const TreeCell& cell, int side) const noexcept {
    const std::int32_t beyond = cell.beside[side];
    return beyond >= 0 && tree_[beyond].size == cell.size ? &tree_[beyond] : nullptr;
  }
  [[nodiscard]] std::int32_t centre_if_sampled(const TreeCell* cell) const noexcept {
    return cell != nullptr && lattice_.sampled(cell->centre()) ? cell->centre() : -1;
  }
  std::int32_t corner_beyond(const TreeCell& cell, int side, int end);
  std::int32_t middle_from_centre(const TreeCell& cell, int side, int k);
  std::int32_t middle_with_value(const TreeCell& cell, int side);

  Lattice& lattice_;
  const Tree& tree_;
};

}  // namespace carreau::detail
