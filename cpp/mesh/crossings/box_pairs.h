// SPDX-License-Identifier: BSD-3-Clause
// Pairs of triangles whose boxes meet, each once. Private to mesh/.
#pragma once

#include <algorithm>
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

/// All pairs of triangles whose closed boxes have a point in common. Searches a tree of boxes against itself, so that
/// neighbours descend together. Works in parts, which do not depend on the number of threads; several threads may
/// search different parts. The tree halves a list of blocks, each of triangles that are neighbours in space. It needs
/// no links, and boxes of triangles are made when they are compared. So it takes ten bytes a triangle.
class BoxPairs {
 public:
  using Box = BoxTree::Box;
  using Triangle = std::array<std::int32_t, 3>;

  /// `numbers` are indices in range of triangles with finite coordinates. Refers to vertices and triangles. Throws
  /// Cancelled soon after `monitor` received a request to stop.
  BoxPairs(std::span<const Vec3> vertices, std::span<const Triangle> triangles, std::vector<std::int32_t> numbers,
           Monitor& monitor, int threads);

  /// Like the constructor above, without pairs of one set; may report some of them nevertheless. `order`: neighbours
  /// near each other, except that triangles of different sets may be far apart; `set`: by triangle of the mesh; -1: in
  /// no set.
  BoxPairs(std::span<const Vec3> vertices, std::span<const Triangle> triangles, std::vector<std::int32_t> order,
           std::span<const std::int32_t> set, Monitor& monitor, int threads);

  [[nodiscard]] std::size_t parts() const noexcept {
    return blocks_ == 0 ? 0 : (blocks_ + blocks_of_part - 1) / blocks_of_part;
  }
  /// Calls look(i, j), i < j, for each pair of the part, in any order.
  template <typename Look>
  void each(std::size_t part, const Look& look) const {
    Part own{part * blocks_of_part, std::vector<Loaded>(blocks_of_part)};
    Meeting meeting;
    start(part, meeting);
    while (find_some(meeting)) {
      Loaded other;
      for (const auto& [b, a] : meeting.blocks) {
        if (other.block != b) load(b, other);
        Loaded& of_a = own.blocks[a - own.first];
        if (of_a.block != a) load(a, of_a);
        compare(of_a, other, look);
      }
    }
  }

 private:
  static constexpr std::size_t block_size = 16, blocks_of_part = 64;  // [time only]

  /// A node of the halved list: block << level is its first block.
  struct Node {
    std::size_t level = 0, index = 0;
    [[nodiscard]] std::size_t begin() const noexcept { return index << level; }
    [[nodiscard]] std::size_t end() const noexcept { return (index + 1) << level; }
  };
  /// The boxes of the triangles of a block.
  struct Loaded {
    std::size_t block = static_cast<std::size_t>(-1), size = 0;
    std::array<Box, block_size> boxes;
  };
  /// The requested blocks of a part.
  struct Part {
    std::size_t first = 0;  // block
    std::vector<Loaded> blocks;
  };
  /// Blocks whose boxes meet, some at a time; and nodes that are still to be compared.
  struct Meeting {
    std::vector<std::pair<Node, Node>> todo;
    std::vector<std::pair<std::size_t, std::size_t>> blocks;  // the later one first, ascending
  };

  [[nodiscard]] const Box& box(const Node& node) const noexcept { return boxes_[first_[node.level] + node.index]; }
  [[nodiscard]] bool are_of_one_set(const Node& a, const Node& b) const noexcept {
    if (set_.empty()) return false;
    const std::int32_t of_a = set_[first_[a.level] + a.index];
    return of_a >= 0 && of_a == set_[first_[b.level] + b.index];
  }
  [[nodiscard]] std::size_t size_of(std::size_t block) const noexcept {
    return std::min(block_size, order_.size() - block * block_size);
  }
  [[nodiscard]] Box box_of(std::int32_t number) const noexcept {
    Box box;
    for (const std::int32_t v : triangles_[static_cast<std::size_t>(number)])
      box.add(vertices_[static_cast<std::size_t>(v)]);
    return box;
  }
  void find_sets(std::span<const std::int32_t> set);
  void load(std::size_t block, Loaded& loaded) const;
  void start(std::size_t part, Meeting& meeting) const;
  /// True if it found more blocks.
  bool find_some(Meeting& meeting) const;
  void go_down(const Node& a, const Node& b, std::vector<std::pair<Node, Node>>& todo) const;

  /// own <= other.
  template <typename Look>
  void compare(const Loaded& own, const Loaded& other, const Look& look) const {
    const std::array<Box, block_size>& boxes = own.boxes;
    const std::int32_t* of_a = order_.data() + own.block * block_size;
    const std::int32_t* of_b = order_.data() + other.block * block_size;
    const Box &all_of_a = box({0, own.block}), &all_of_b = box({0, other.block});
    std::array<std::uint8_t, block_size> near_b;  // ranks in `own`
    std::size_t count = 0;
    for (std::size_t k = 0; k < own.size; ++k)
      if (!all_of_b.is_apart(boxes[k])) near_b[count++] = static_cast<std::uint8_t>(k);
    for (std::size_t l = 0; l < other.size; ++l) {
      if (all_of_a.is_apart(other.boxes[l])) continue;
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t k = near_b[i];
        if (own.block == other.block && k >= l) break;
        if (!boxes[k].is_apart(other.boxes[l]))
          look(static_cast<std::size_t>(std::min(of_a[k], of_b[l])),
               static_cast<std::size_t>(std::max(of_a[k], of_b[l])));
      }
    }
  }

  std::span<const Vec3> vertices_;
  std::span<const Triangle> triangles_;
  std::vector<std::int32_t> order_;
  std::size_t blocks_ = 0;
  std::vector<std::size_t> first_;  // by level: in boxes_
  std::vector<Box> boxes_;          // boxes of nodes, level by level: the blocks first
  std::vector<std::int32_t> set_;   // of nodes: the set of all their triangles, or -1; empty: none is known
};

}  // namespace carreau
