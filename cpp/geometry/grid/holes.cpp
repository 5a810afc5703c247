// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/grid/holes.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "geometry/grid/thresholds.h"
#include "support/rounding_of.h"

namespace carreau::grid {

namespace {

struct At {
  int i, j;
};

class Filler {
 public:
  Filler(Block& block, const Closed& closed) : block_(block), closed_(closed), seen_(block.nodes.size(), 0) {}

  std::size_t run(Monitor& monitor) {
    for (int j = 0; j < block_.rows; ++j)
      for (int i = 0; i < block_.columns; ++i)
        if (!block_.has(i, j) && seen_[block_.index(i, j)] == 0) add_hole({i, j});
    if (inner_.empty()) return 0;
    const Vec3 middle = mean_of_rims();
    for (const At& at : inner_) block_.nodes[block_.index(at.i, at.j)] = middle;
    relax(monitor);
    close_joint();
    return inner_.size();
  }

 private:
  /// The neighbour on one of four sides; across the joint of a closed block.
  [[nodiscard]] std::optional<At> neighbour(const At& at, int side) const {
    constexpr std::array<At, 4> steps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    const At& step = steps[static_cast<std::size_t>(side)];
    const auto go = [](int k, int by, int n, bool closed) -> std::optional<int> {
      const int to = k + by;
      if (to >= 0 && to < n) return to;
      if (!closed) return {};
      return to < 0 ? n - 2 : 1;
    };
    const auto i = go(at.i, step.i, block_.columns, closed_.columns), j = go(at.j, step.j, block_.rows, closed_.rows);
    if (!i || !j) return {};
    return At{*i, *j};
  }

  void add_hole(const At& first) {
    std::vector<At> hole{first};
    bool inside = true;
    seen_[block_.index(first.i, first.j)] = 1;
    for (std::size_t k = 0; k < hole.size(); ++k)
      for (int side = 0; side < 4; ++side) {
        const std::optional<At> next = neighbour(hole[k], side);
        inside = inside && next.has_value();
        if (!next || block_.has(next->i, next->j) || seen_[block_.index(next->i, next->j)] != 0) continue;
        seen_[block_.index(next->i, next->j)] = 1;
        hole.push_back(*next);
      }
    if (inside) inner_.insert(inner_.end(), hole.begin(), hole.end());
  }

  /// A place to start from.
  [[nodiscard]] Vec3 mean_of_rims() const {
    Vec3 sum;
    double count = 0;
    for (const At& at : inner_)
      for (int side = 0; side < 4; ++side)
        if (const std::optional<At> next = neighbour(at, side); next && block_.has(next->i, next->j))
          sum += block_.node(next->i, next->j), ++count;
    return sum / std::max(1.0, count);
  }

  /// Sweeps of Gauss and Seidel.
  void relax(Monitor& monitor) {
    double first = 0;
    // A hole of 50 x 50 nodes keeps 1e-3 of its error after 2000 sweeps. [Holes.*]
    for (int sweep = 0; sweep < 2000; ++sweep) {
      monitor.checkpoint();
      double largest = 0;
      for (const At& at : inner_) {
        Vec3 sum;
        for (int side = 0; side < 4; ++side) {
          const At next = *neighbour(at, side);
          sum += block_.node(next.i, next.j);
        }
        Vec3& here = block_.nodes[block_.index(at.i, at.j)];
        const Vec3 mean = sum / 4;
        largest = std::max(largest, norm(mean - here));
        here = mean;
      }
      if (sweep == 0) first = largest;
      if (largest <= rounding_of::places * first) return;
    }
  }

  void close_joint() {
    for (int j = 0; closed_.columns && j < block_.rows; ++j)
      block_.nodes[block_.index(block_.columns - 1, j)] = block_.node(0, j);
    for (int i = 0; closed_.rows && i < block_.columns; ++i)
      block_.nodes[block_.index(i, block_.rows - 1)] = block_.node(i, 0);
  }

  Block& block_;
  Closed closed_;
  std::vector<char> seen_;
  std::vector<At> inner_;
};

}  // namespace

std::size_t fill_holes(Block& block, const Closed& closed, Monitor& monitor) {
  return Filler(block, closed).run(monitor);
}

}  // namespace carreau::grid
