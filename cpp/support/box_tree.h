// SPDX-License-Identifier: BSD-3-Clause
// A tree of boxes around things of space, divided at medians. Finds things near a point, or things that meet a segment
// or box, in logarithmic time.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "support/infinity.h"
#include "support/monitor.h"
#include "support/vec.h"

namespace carreau {

/// The tree knows the numbers of things, not the things. Searches are safe from several threads.
class BoxTree {
 public:
  /// An axis-parallel box; at first it holds nothing.
  struct Box {
    Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};

    void add(const Vec3& p) noexcept { low = low.cwiseMin(p), high = high.cwiseMax(p); }
    void add(const Box& other) noexcept { low = low.cwiseMin(other.low), high = high.cwiseMax(other.high); }
    /// From the vector that leads from p to the nearest point of the box.
    [[nodiscard]] double squared_distance(const Vec3& p) const noexcept {
      const auto beyond = [](double from, double x, double to) { return std::max({from - x, x - to, 0.0}); };
      const double x = beyond(low.x(), p.x(), high.x()), y = beyond(low.y(), p.y(), high.y()),
                   z = beyond(low.z(), p.z(), high.z());
      return x * x + y * y + z * z;
    }
    /// True if the closed boxes have no common point.
    [[nodiscard]] bool is_apart(const Box& other) const noexcept {
      return low.x() > other.high.x() || high.x() < other.low.x() || low.y() > other.high.y() ||
             high.y() < other.low.y() || low.z() > other.high.z() || high.z() < other.low.z();
    }
  };

  BoxTree() = default;
  /// `boxes`: of the things, without NaN. `centres`: they are halved at medians of these along the longest sides of
  /// their boxes, equal ones by number. Throws Cancelled soon after `monitor` received a request to stop; `monitor` may
  /// be null. The tree does not depend on the number of threads.
  BoxTree(std::span<const Box> boxes, std::span<const Vec3> centres, Monitor* monitor = nullptr, int threads = 1);

  [[nodiscard]] bool empty() const noexcept { return order_.empty(); }
  /// The things in the order of the leaves: the things of each node follow each other.
  [[nodiscard]] std::span<const std::int32_t> order() const noexcept { return order_; }
  [[nodiscard]] std::size_t nodes() const noexcept { return nodes_.size(); }
  /// Nodes come after their parents.
  struct Node {
    Box box;
    std::int32_t first = 0;  ///< of two children; or of order(), in a leaf
    std::int32_t count = 0;  ///< things of a leaf; 0: not a leaf
  };
  [[nodiscard]] const Node& node(std::size_t n) const noexcept { return nodes_[n]; }

  /// Looks at the leaves that may matter, the nearer ones first, which may rule others out: `bound(n)` is a lower bound
  /// of the things of node n, `matters(bound)` returns whether that is good enough now, `look(node)` receives each
  /// leaf.
  template <typename Bound, typename Matters, typename Look>
  void nearest_first(const Bound& bound, const Matters& matters, const Look& look) const {
    if (nodes_.empty()) return;
    struct Todo {
      std::int32_t node;
      double bound;
    };
    std::array<Todo, deepest> todo;
    std::size_t size = 0;
    Todo next{0, bound(0)};
    while (true) {
      if (matters(next.bound)) {
        const Node& n = nodes_[static_cast<std::size_t>(next.node)];
        if (n.count == 0) {
          const Todo first{n.first, bound(n.first)}, second{n.first + 1, bound(n.first + 1)};
          const bool ahead = second.bound < first.bound;
          todo[size++] = ahead ? first : second;
          next = ahead ? second : first;
          continue;
        }
        look(n);
      }
      if (size == 0) return;
      next = todo[--size];
    }
  }

  /// Looks at the leaves of all nodes for whose boxes `meets(box)` holds, in the order of order().
  template <typename Meets, typename Look>
  void all_that_meet(const Meets& meets, const Look& look) const {
    if (nodes_.empty()) return;
    std::array<std::int32_t, deepest> todo;
    std::size_t size = 0;
    todo[size++] = 0;
    while (size > 0) {
      const Node& n = nodes_[static_cast<std::size_t>(todo[--size])];
      if (!meets(n.box)) continue;
      if (n.count > 0) {
        look(n);
        continue;
      }
      todo[size++] = n.first + 1;
      todo[size++] = n.first;
    }
  }
  [[nodiscard]] std::span<const std::int32_t> things(const Node& leaf) const noexcept {
    return order().subspan(static_cast<std::size_t>(leaf.first), static_cast<std::size_t>(leaf.count));
  }

 private:
  // The depth is the logarithm of the number of things: 64 pairs are more than memory can hold.
  static constexpr std::size_t deepest = 128;

  std::vector<std::int32_t> order_;
  std::vector<Node> nodes_;  // the root first; children in pairs
};

}  // namespace carreau
