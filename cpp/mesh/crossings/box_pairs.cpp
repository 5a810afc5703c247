// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/crossings/box_pairs.h"

#include <bit>

#include "mesh/crossings/spatial_order.h"
#include "support/stepped_tasks.h"

namespace carreau {

namespace {

// Pairs of blocks that are kept at a time. [memory only]
constexpr std::size_t max_kept = 4096;

}  // namespace

BoxPairs::BoxPairs(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                   std::vector<std::int32_t> numbers, Monitor& monitor, int threads)
    : BoxPairs(vertices, triangles, spatial_order(vertices, triangles, std::move(numbers), monitor, threads), {},
               monitor, threads) {}

BoxPairs::BoxPairs(std::span<const Vec3> vertices, std::span<const Triangle> triangles, std::vector<std::int32_t> order,
                   std::span<const std::int32_t> set, Monitor& monitor, int threads)
    : vertices_(vertices),
      triangles_(triangles),
      order_(std::move(order)),
      blocks_((order_.size() + block_size - 1) / block_size) {
  if (blocks_ == 0) return;
  std::size_t nodes = 0;
  for (std::size_t level = 0;; ++level) {
    const std::size_t of_level = (blocks_ + (std::size_t{1} << level) - 1) >> level;
    first_.push_back(nodes);
    nodes += of_level;
    if (of_level == 1) break;
  }
  boxes_.resize(nodes);
  const auto enclose = [this](std::size_t part, Monitor&) {
    for (std::size_t b = part * blocks_of_part; b < std::min((part + 1) * blocks_of_part, blocks_); ++b)
      for (std::size_t k = 0; k < size_of(b); ++k) boxes_[b].add(box_of(order_[b * block_size + k]));
  };
  run_each(parts(), false, threads, enclose, monitor);
  for (std::size_t level = 1; level < first_.size(); ++level) {
    const std::size_t below = first_[level - 1], end = first_[level];
    for (std::size_t k = below; k < end; ++k) boxes_[end + (k - below) / 2].add(boxes_[k]);
  }
  if (!set.empty()) find_sets(set);
}

void BoxPairs::find_sets(std::span<const std::int32_t> set) {
  set_.assign(boxes_.size(), -1);
  for (std::size_t b = 0; b < blocks_; ++b) {
    const auto of = [&](std::size_t k) { return set[static_cast<std::size_t>(order_[b * block_size + k])]; };
    std::size_t k = 1;
    while (k < size_of(b) && of(k) == of(0)) ++k;
    if (k == size_of(b)) set_[b] = of(0);
  }
  for (std::size_t level = 1; level < first_.size(); ++level) {
    const std::size_t below = first_[level - 1], end = first_[level];
    for (std::size_t k = below; k < end; k += 2)
      if (k + 1 == end || set_[k] == set_[k + 1]) set_[end + (k - below) / 2] = set_[k];
  }
}

void BoxPairs::load(std::size_t block, Loaded& loaded) const {
  loaded.block = block;
  loaded.size = size_of(block);
  for (std::size_t k = 0; k < loaded.size; ++k) loaded.boxes[k] = box_of(order_[block * block_size + k]);
}

void BoxPairs::start(std::size_t part, Meeting& meeting) const {
  const std::size_t root = first_.size() - 1;
  const std::size_t level = std::min<std::size_t>(std::bit_width(blocks_of_part) - 1, root);
  meeting.todo.push_back({{level, part}, {root, 0}});
}

// The part of an earlier node finds its pairs with a.
bool BoxPairs::find_some(Meeting& meeting) const {
  meeting.blocks.clear();
  while (!meeting.todo.empty() && meeting.blocks.size() < max_kept) {
    const auto [a, b] = meeting.todo.back();
    meeting.todo.pop_back();
    if (b.end() <= a.begin() || are_of_one_set(a, b) || box(a).is_apart(box(b))) continue;
    if (a.level > 0 || b.level > 0)
      go_down(a, b, meeting.todo);
    else
      meeting.blocks.emplace_back(b.index, a.index);
  }
  std::sort(meeting.blocks.begin(), meeting.blocks.end());
  return !meeting.blocks.empty();
}

void BoxPairs::go_down(const Node& a, const Node& b, std::vector<std::pair<Node, Node>>& todo) const {
  // The second child may be none: the list ends before it.
  const auto children = [this](const Node& node, const auto& use) {
    for (std::size_t k = 0; k < 2; ++k)
      if (const Node child{node.level - 1, 2 * node.index + k}; child.begin() < blocks_) use(child);
  };
  if (a.level == b.level && a.index == b.index)
    children(a, [&](const Node& of_a) {
      children(a, [&](const Node& of_b) {
        if (of_a.index <= of_b.index) todo.emplace_back(of_a, of_b);
      });
    });
  else if (b.level >= a.level)
    children(b, [&](const Node& child) { todo.emplace_back(a, child); });
  else
    children(a, [&](const Node& child) { todo.emplace_back(child, b); });
}

}  // namespace carreau
