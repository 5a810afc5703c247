// SPDX-License-Identifier: BSD-3-Clause
#include "support/box_tree.h"

#include <numeric>
#include <utility>

#include "support/stepped_tasks.h"

namespace carreau {

namespace {

using Box = BoxTree::Box;

// Fewer things are tested one by one. [time only]
constexpr std::int32_t leaf_size = 4;
// Things that are moved between two looks at the monitor. [time only]
constexpr std::int64_t moved_between_checks = 1 << 16;
// Groups: number of nodes in a level; fewer things than threaded_from are fastest on one thread. [time only]
constexpr std::size_t groups = 256, threaded_from = 20'000;

int longest_side(const Box& box) noexcept {
  const Vec3 size = box.high - box.low;
  return size.x() >= size.y() && size.x() >= size.z() ? 0 : size.y() >= size.z() ? 1 : 2;
}

}  // namespace

// Level by level: nodes of one level have nothing in common, so that several threads take them.
BoxTree::BoxTree(std::span<const Box> boxes, std::span<const Vec3> centres, Monitor* monitor, int threads)
    : order_(boxes.size()) {
  if (boxes.empty()) return;
  std::iota(order_.begin(), order_.end(), 0);
  const auto enclosed = [&](std::int32_t first, std::int32_t count) {
    Node node{{}, first, count};
    for (std::int32_t k = first; k < first + count; ++k)
      node.box.add(boxes[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])]);
    return node;
  };
  const auto halve = [&](Node& parent, std::size_t child) {
    const Node node = parent;
    const int axis = longest_side(node.box);
    const auto begin = order_.begin() + node.first;
    const std::int32_t half = node.count / 2;
    std::nth_element(begin, begin + half, begin + node.count, [&](std::int32_t s, std::int32_t t) {
      const double x = centres[static_cast<std::size_t>(s)][axis], y = centres[static_cast<std::size_t>(t)][axis];
      return x != y ? x < y : s < t;
    });
    parent.first = static_cast<std::int32_t>(child);
    parent.count = 0;
    nodes_[child] = enclosed(node.first, half);
    nodes_[child + 1] = enclosed(node.first + half, node.count - half);
  };
  Monitor silent;
  Monitor& asked = monitor != nullptr ? *monitor : silent;
  nodes_.push_back(enclosed(0, static_cast<std::int32_t>(order_.size())));
  for (std::size_t first = 0, end = 1; first < end; first = end, end = nodes_.size()) {
    std::vector<std::pair<std::size_t, std::size_t>> halved;  // a node, and the first of its children
    for (std::size_t n = first; n < end; ++n)
      if (nodes_[n].count > leaf_size) halved.emplace_back(n, end + 2 * halved.size());
    nodes_.resize(end + 2 * halved.size());
    const std::size_t most = (halved.size() + groups - 1) / groups;
    const auto halve_some = [&](std::size_t group, Monitor& of_group) {
      std::int64_t moved = 0;
      for (std::size_t k = group * most; k < std::min((group + 1) * most, halved.size()); ++k) {
        if (moved >= moved_between_checks) moved = 0, of_group.checkpoint();
        moved += nodes_[halved[k].first].count;
        halve(nodes_[halved[k].first], halved[k].second);
      }
    };
    const bool worth_it = order_.size() >= threaded_from;
    run_each(std::min(groups, halved.size()), false, worth_it ? threads : 1, halve_some, asked);
  }
}

}  // namespace carreau
