// SPDX-License-Identifier: BSD-3-Clause
#include "support/box_tree.h"

#include <numeric>

namespace carreau {

namespace {

using Box = BoxTree::Box;

// Fewer things are looked at one by one. [time only]
constexpr std::int32_t leaf_size = 4;
// Things that are moved between two looks at the monitor. [time only]
constexpr std::int64_t moved_between_checks = 1 << 16;

int longest_side(const Box& box) noexcept {
  const Vec3 size = box.high - box.low;
  return size.x() >= size.y() && size.x() >= size.z() ? 0 : size.y() >= size.z() ? 1 : 2;
}

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes, std::span<const Vec3> centres, Monitor* monitor) : order_(boxes.size()) {
  if (boxes.empty()) return;
  std::iota(order_.begin(), order_.end(), 0);
  const auto enclosed = [&](std::int32_t first, std::int32_t count) {
    Node node{{}, first, count};
    for (std::int32_t k = first; k < first + count; ++k)
      node.box.add(boxes[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])]);
    return node;
  };
  nodes_.push_back(enclosed(0, static_cast<std::int32_t>(order_.size())));
  std::int64_t moved = 0, checked = 0;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    if (monitor != nullptr && moved > checked) {
      monitor->checkpoint();
      checked = moved + moved_between_checks;
    }
    const Node node = nodes_[n];
    moved += node.count;
    if (node.count <= leaf_size) continue;
    const int axis = longest_side(node.box);
    const auto begin = order_.begin() + node.first;
    const std::int32_t half = node.count / 2;
    std::nth_element(begin, begin + half, begin + node.count, [&](std::int32_t s, std::int32_t t) {
      const double x = centres[static_cast<std::size_t>(s)][axis], y = centres[static_cast<std::size_t>(t)][axis];
      return x != y ? x < y : s < t;
    });
    nodes_[n].first = static_cast<std::int32_t>(nodes_.size());
    nodes_[n].count = 0;
    nodes_.push_back(enclosed(node.first, half));
    nodes_.push_back(enclosed(node.first + half, node.count - half));
  }
}

}  // namespace carreau
