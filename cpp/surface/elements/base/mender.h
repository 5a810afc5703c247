// SPDX-License-Identifier: BSD-3-Clause
// Elements whose Jacobian is not positive: nodes that are not fixed move until it is.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/cells.h"
#include "mesh/local_search.h"
#include "support/infinity.h"
#include "support/monitor.h"
#include "support/rounding_of.h"
#include "support/work_bounds.h"
#include "surface/elements/base/thresholds.h"

namespace carreau {

/// Index in Jacobian::c of the coefficient at a corner.
inline std::size_t coefficient_at(CellKind kind, int corner) {
  constexpr std::array<std::size_t, 4> of_quad8{0, 12, 15, 3};
  if (kind == CellKind::triangle3) return 0;
  return kind == CellKind::quad8 ? of_quad8[static_cast<std::size_t>(corner)] : static_cast<std::size_t>(corner);
}

/// Improves elements below thresholds::elements::good_jacobian by a pattern search over their nodes: nodes of edges first, then corners.
/// Nodes beside a corner move by half its way. Elements that are invalid at a corner wherever free nodes are stay as they are, and nodes
/// do not move for them. The search ends after the number of places that thresholds::elements allow. Nodes have the numbers of `cells`,
/// corners before the nodes of edges. Derived defines the places, and the ways of nodes:
///   Way, Trial (with a member `node`);
///   double score(const Cell&)                          least Jacobian over its mean
///   double score_at(const Cell&, int corner)           its value at a corner
///   std::array<double, 2> orientations(const Cell&)    of its straight triangles; their signs are kept
///   std::array<Way, 8> ways(std::int32_t node, double step)      around it, `step` its longest edge long
///   std::vector<Trial> places(const std::vector<std::pair<std::int32_t, Way>>&)   of nodes that move; empty: they cannot
///   Trial trial_of(std::int32_t node), void put(const Trial&)
/// Derived may define a lower bound of score() that is cheaper: double bound(const Cell&).
template <typename Derived, typename Way>
class Mender {
 public:
  Mender(std::vector<Cell> cells, std::int32_t corners, std::int32_t nodes, std::vector<char> fixed, Monitor& monitor)
      : cells_(std::move(cells)), corners_(corners), nodes_(nodes), fixed_(std::move(fixed)), monitor_(monitor) {}

  [[nodiscard]] const std::vector<Cell>& cells() const noexcept { return cells_; }
  /// Elements that are not good, now.
  [[nodiscard]] const std::vector<std::int32_t>& bad() const noexcept { return bad_; }
  [[nodiscard]] std::size_t moves() const noexcept { return moves_; }

  [[nodiscard]] double bound(const Cell&) const noexcept { return -infinity; }

  /// Lists elements below `least`, and returns the number of invalid ones.
  std::size_t find_below(double least) {
    std::size_t invalid = 0;
    bad_.clear();
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      if (c % cells_between_checks == 0) monitor_.checkpoint();
      if (self().bound(cells_[c]) >= least) continue;
      const double found = self().score(cells_[c]);
      if (found < least) bad_.push_back(static_cast<std::int32_t>(c));
      if (found < rounding_of::sizes) ++invalid;
    }
    return invalid;
  }

  /// Improves the elements that find_below(good_jacobian) has listed.
  void mend() {
    using namespace thresholds::elements;
    if (bad_.empty()) return;
    find_cells_of_nodes();
    in_vain_.assign(static_cast<std::size_t>(nodes_), 0);
    trials_ = Budget(max_trials + max_trials_of_element * std::ssize(cells_));
    hopeless_.assign(cells_.size(), 0);
    for (const std::int32_t c : bad_) hopeless_[c] = static_cast<char>(is_hopeless(cells_[c]));
    std::erase_if(bad_, [&](std::int32_t c) { return hopeless_[c] != 0; });
    for (int round = 0; round < work_bounds::rounds; ++round) {
      const std::size_t before = moves_;
      for (std::size_t i = 0, n = bad_.size(); i < n && !trials_.is_spent(); ++i) {
        monitor_.checkpoint();
        mend(cells_[bad_[i]]);
      }
      std::erase_if(bad_, [&](std::int32_t c) { return self().score(cells_[c]) >= good_jacobian; });
      if (moves_ == before || bad_.empty() || trials_.is_spent()) break;
    }
  }

 protected:
  [[nodiscard]] std::span<const std::int32_t> around(std::int32_t node) const {
    return std::span(of_node_).subspan(first_[node], first_[node + 1] - first_[node]);
  }
  [[nodiscard]] std::int32_t corners() const noexcept { return corners_; }

  /// The other corners of the cells' sides that end at corner `v`, and the nodes on them; -1: of first order.
  template <typename Use>
  void for_sides(std::int32_t v, const Use& use) const {
    for (const std::int32_t c : around(v)) {
      const Cell& cell = cells_[c];
      const int n = corner_count(cell.kind);
      for (int i = 0; i < n; ++i) {
        const std::int32_t a = cell.nodes[i], b = cell.nodes[(i + 1) % n];
        if (a == v || b == v) use(a == v ? b : a, cell.nodes[n + i]);
      }
    }
  }

  /// The longest side by `length(a, b)` that ends at a corner, or that the node of an edge halves.
  template <typename Length>
  [[nodiscard]] double reach(std::int32_t node, const Length& length) const {
    double longest = 0;
    if (node < corners_) {
      for_sides(node, [&](std::int32_t end, std::int32_t) { longest = std::max(longest, length(node, end)); });
      return longest;
    }
    for (const std::int32_t c : around(node)) {
      const Cell& cell = cells_[c];
      const int n = corner_count(cell.kind);
      for (int i = 0; i < n; ++i)
        if (cell.nodes[n + i] == node) longest = std::max(longest, length(cell.nodes[i], cell.nodes[(i + 1) % n]));
    }
    return longest;
  }

 private:
  static constexpr std::size_t cells_between_checks = 4096;
  Derived& self() { return static_cast<Derived&>(*this); }
  using Trials = std::vector<typename std::pair<std::int32_t, Way>>;

  void find_cells_of_nodes() {
    first_.assign(static_cast<std::size_t>(nodes_) + 1, 0);
    for (const Cell& cell : cells_)
      for (const std::int32_t node : cell.nodes)
        if (node >= 0) ++first_[node + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    of_node_.resize(static_cast<std::size_t>(first_.back()));
    std::vector<std::int32_t> next = first_;
    for (std::size_t c = 0; c < cells_.size(); ++c)
      for (const std::int32_t node : cells_[c].nodes)
        if (node >= 0) of_node_[next[node]++] = static_cast<std::int32_t>(c);
  }

  [[nodiscard]] double worst(std::int32_t node) {
    double least = thresholds::elements::good_jacobian;  // the aim of the search
    for (const std::int32_t c : around(node))
      if (hopeless_[c] == 0) least = std::min(least, self().score(cells_[c]));
    return least;
  }

  // Both sides of the corner are fixed, with their nodes: so are the derivatives there.
  [[nodiscard]] bool is_hopeless(const Cell& cell) {
    const int n = corner_count(cell.kind);
    for (int i = 0; i < n; ++i) {
      const int before = (i + n - 1) % n;
      bool fixed = fixed_[cell.nodes[i]] != 0 && fixed_[cell.nodes[before]] != 0 && fixed_[cell.nodes[(i + 1) % n]] != 0;
      if (fixed && node_count(cell.kind) > n) fixed = fixed_[cell.nodes[n + i]] != 0 && fixed_[cell.nodes[n + before]] != 0;
      if (fixed && self().score_at(cell, i) < rounding_of::sizes) return true;
    }
    return false;
  }

  void mend(const Cell& cell) {
    const int corners = corner_count(cell.kind), all = node_count(cell.kind);
    const auto is_bad = [&] { return self().score(cell) < thresholds::elements::good_jacobian; };
    for (int i = corners; i < all && is_bad(); ++i) search(cell.nodes[i]);
    for (int i = 0; i < corners && is_bad(); ++i) search(cell.nodes[i]);
  }

  /// Moves the node, and beside a corner the nodes on its sides by half its way.
  [[nodiscard]] Trials moves_with(std::int32_t node, const Way& by) const {
    Trials moves{{node, by}};
    if (node < corners_)
      for_sides(node, [&](std::int32_t, std::int32_t mid) {
        const bool known = std::any_of(moves.begin(), moves.end(), [&](const auto& m) { return m.first == mid; });
        if (mid >= 0 && !known && fixed_[mid] == 0) moves.push_back({mid, 0.5 * by});
      });
    return moves;
  }

  // Returns whether the straight triangles keep their orientation.
  [[nodiscard]] bool keeps_triangles(std::int32_t node, const std::vector<double>& before) {
    std::size_t i = 0;
    for (const std::int32_t c : around(node))
      for (const double side : self().orientations(cells_[c]))
        if (side * before[i++] <= 0) return false;
    return true;
  }

  /// Worst score around the node with `trials` in their places.
  template <typename Places>
  double judge(const Places& trials) {
    const std::int32_t node = trials.front().node;
    trials_.spend();
    Places back;
    std::vector<double> sides;
    for (const auto& trial : trials) back.push_back(self().trial_of(trial.node));
    for (const std::int32_t c : around(node))
      for (const double side : self().orientations(cells_[c])) sides.push_back(side);
    for (const auto& trial : trials) self().put(trial);
    const double found = keeps_triangles(node, sides) ? worst(node) : -infinity;
    for (const auto& trial : back) self().put(trial);
    return found;
  }

  // Eight directions, halved steps.
  void search(std::int32_t node) {
    using namespace thresholds::elements;
    if (fixed_[node] != 0 || in_vain_[node] != 0) return;
    in_vain_[node] = 1;
    double best = worst(node);
    for (double step = first_step; step >= last_step && best < good_jacobian && !trials_.is_spent();) {
      decltype(self().places(Trials{})) chosen;
      for (const Way& way : self().ways(node, step)) {
        auto trials = self().places(moves_with(node, way));
        if (trials.empty()) continue;
        const double found = judge(trials);
        const double gain = chosen.empty() && found < good_jacobian ? min_gain : 0;
        if (found > best + gain) best = found, chosen = std::move(trials);
      }
      if (chosen.empty()) {
        step /= 2;
        continue;
      }
      for (const auto& trial : chosen) self().put(trial);
      ++moves_;
      note_move(node);
    }
  }

  // A good element may now be bad, if an element beside was worse. The search therefore repeats nodes beside.
  void note_move(std::int32_t node) {
    for (const std::int32_t c : around(node)) {
      for (const std::int32_t beside : cells_[c].nodes)
        if (beside >= 0) in_vain_[beside] = 0;
      if (hopeless_[c] == 0 && self().score(cells_[c]) < thresholds::elements::good_jacobian &&
          std::find(bad_.begin(), bad_.end(), c) == bad_.end())
        bad_.push_back(c);
    }
  }

  std::vector<Cell> cells_;
  std::int32_t corners_, nodes_;
  std::vector<char> fixed_;     // by node
  std::vector<char> hopeless_;  // by cell
  Monitor& monitor_;
  std::vector<std::int32_t> bad_, first_, of_node_;
  std::vector<char> in_vain_;  // by node: a search has moved nothing, and no node beside has moved since
  std::size_t moves_ = 0;
  Budget trials_;
};

}  // namespace carreau
