// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/crossings/box_pairs.h"

#include <algorithm>

#include "support/stepped_tasks.h"

namespace carreau {

namespace {

// Triangles of a part at most. [time only]
constexpr std::size_t largest_part = 1024;

}  // namespace

BoxPairs::BoxPairs(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                   Monitor& monitor, int threads) {
  constexpr std::size_t at_once = 16384;
  const std::size_t n = triangles.size();
  std::vector<BoxTree::Box> boxes(n);
  std::vector<Vec3> centres(n);
  const auto enclose = [&](std::size_t part, Monitor&) {
    for (std::size_t k = part * at_once; k < std::min((part + 1) * at_once, n); ++k) {
      const auto corner = [&](std::size_t i) { return vertices[static_cast<std::size_t>(triangles[k][i])]; };
      for (std::size_t i = 0; i < 3; ++i) boxes[k].add(corner(i));
      centres[k] = (1.0 / 3) * (corner(0) + corner(1) + corner(2));
    }
  };
  run_each((n + at_once - 1) / at_once, false, threads, enclose, monitor);
  tree_ = BoxTree(boxes, centres, &monitor, threads);
  if (tree_.empty()) return;
  boxes_.reserve(n);
  for (const std::int32_t t : tree_.order()) boxes_.push_back(boxes[static_cast<std::size_t>(t)]);
  range_.resize(tree_.nodes());
  for (std::size_t node = tree_.nodes(); node-- > 0;) {
    const BoxTree::Node& of = tree_.node(node);
    const auto first = static_cast<std::size_t>(of.first);
    range_[node] = of.count > 0 ? Range{first, first + static_cast<std::size_t>(of.count)}
                                : Range{range_[first].begin, range_[first + 1].end};
  }
  std::vector<std::size_t> todo{0};
  while (!todo.empty()) {
    const std::size_t node = todo.back();
    todo.pop_back();
    const auto first = static_cast<std::size_t>(tree_.node(node).first);
    if (tree_.node(node).count > 0 || range_[node].end - range_[node].begin <= largest_part)
      parts_.push_back(node);
    else
      todo.push_back(first + 1), todo.push_back(first);
  }
}

void BoxPairs::go_down(std::size_t a, std::size_t b, std::vector<std::pair<std::size_t, std::size_t>>& todo) const {
  const auto first = [&](std::size_t node) { return static_cast<std::size_t>(tree_.node(node).first); };
  if (a == b) {
    todo.emplace_back(first(a), first(a) + 1);
    todo.emplace_back(first(a) + 1, first(a) + 1);
    todo.emplace_back(first(a), first(a));
  } else if (range_[b].end - range_[b].begin >= range_[a].end - range_[a].begin) {
    todo.emplace_back(a, first(b) + 1);
    todo.emplace_back(a, first(b));
  } else {
    todo.emplace_back(first(a) + 1, b);
    todo.emplace_back(first(a), b);
  }
}

}  // namespace carreau
