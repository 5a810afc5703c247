// SPDX-License-Identifier: BSD-3-Clause
// Pairs of triangles whose boxes meet, each once. Private to mesh/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "support/box_tree.h"
#include "support/monitor.h"
#include "support/vec.h"

namespace carreau {

/// All pairs of triangles whose closed boxes have a point in common: a tree of boxes is asked against itself, so that
/// neighbours go down together. In parts, which do not depend on the number of threads and may be asked from several.
class BoxPairs {
 public:
  /// Indices lie in range, coordinates are finite. Throws Cancelled soon after `monitor` was asked to stop.
  BoxPairs(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles, Monitor& monitor,
           int threads);

  [[nodiscard]] std::size_t parts() const noexcept { return parts_.size(); }
  /// Calls look(i, j), i < j, for each pair of the part, in any order.
  template <typename Look>
  void each(std::size_t part, const Look& look) const {
    std::vector<std::pair<std::size_t, std::size_t>> todo{{parts_[part], 0}};
    while (!todo.empty()) {
      const auto [a, b] = todo.back();
      todo.pop_back();
      // What comes before a meets it in its own part.
      if (range_[b].end <= range_[a].begin || tree_.node(a).box.is_apart(tree_.node(b).box)) continue;
      if (tree_.node(a).count > 0 && tree_.node(b).count > 0)
        compare(range_[a], range_[b], look);
      else
        go_down(a, b, todo);
    }
  }

 private:
  /// Of tree_.order().
  struct Range {
    std::size_t begin = 0, end = 0;
  };

  void go_down(std::size_t a, std::size_t b, std::vector<std::pair<std::size_t, std::size_t>>& todo) const;

  template <typename Look>
  void compare(const Range& a, const Range& b, const Look& look) const {
    const std::span<const std::int32_t> order = tree_.order();
    const bool same = a.begin == b.begin;
    for (std::size_t k = a.begin; k < a.end; ++k)
      for (std::size_t l = same ? k + 1 : b.begin; l < b.end; ++l)
        if (!boxes_[k].is_apart(boxes_[l]))
          order[k] < order[l] ? look(static_cast<std::size_t>(order[k]), static_cast<std::size_t>(order[l]))
                              : look(static_cast<std::size_t>(order[l]), static_cast<std::size_t>(order[k]));
  }

  BoxTree tree_;
  std::vector<BoxTree::Box> boxes_;  // in the tree's order
  std::vector<Range> range_;         // by node
  std::vector<std::size_t> parts_;   // nodes that hold all, in the tree's order
};

}  // namespace carreau
