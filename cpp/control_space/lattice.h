// SPDX-License-Identifier: BSD-3-Clause
// The nodes of a control space under construction. Private to the builder.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "metric/metric2.h"
#include "predicates/polygon_locator.h"
#include "support/memory/segmented_array.h"

namespace carreau::detail {

/// Column and row on the finest grid that the tree can reach: cells of any size share their nodes exactly.
struct GridPoint {
  std::int32_t i = 0, j = 0;
};

/// Place of a node, as far as it is known before the node exists.
/// `by_border`: outside, but by no more than rounding.
enum class Place : std::int8_t { unknown, inside, outside, by_border };

/// Map from points to consecutive numbers of blocks: squares of 4 x 4 points of equal spacing. The spacing is the
/// largest power of two that divides both of a point's indices. Callers that need one point mostly need its neighbours
/// too.
class BlockIndex {
 public:
  struct Position {
    std::uint64_t key;
    int spacing, rank;  ///< logarithm of the spacing; place in the block, row by row
  };
  static Position position(GridPoint p) noexcept {
    return position(p, std::countr_zero(static_cast<std::uint32_t>(p.i | p.j) | 1U << 30));
  }
  /// Position of a point of a coarser grid, as if it were a point of this spacing.
  static Position position(GridPoint p, int spacing) noexcept {
    const auto i = static_cast<std::uint32_t>(p.i), j = static_cast<std::uint32_t>(p.j);
    const std::uint64_t key = (static_cast<std::uint64_t>(j >> spacing >> 2) << 29 | i >> spacing >> 2) << 5 |
                              static_cast<std::uint64_t>(spacing);
    return {key + 1, spacing, static_cast<int>((j >> spacing & 3) << 2 | (i >> spacing & 3))};
  }
  /// -1 when absent.
  [[nodiscard]] std::int32_t find(const Position& p) const noexcept { return slots_[slot_of(p.key)].block; }
  /// Returns the number of the block, and whether it is new (then it is the next one).
  std::pair<std::int32_t, bool> insert(const Position& p);

 private:
  struct Slot {
    std::uint64_t key = 0;  // 0: free
    std::int32_t block = -1;
  };
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const noexcept {
    const std::size_t mask = slots_.size() - 1;
    std::uint64_t mixed = key * 0x9E3779B97F4A7C15u;
    mixed ^= mixed >> 29;
    std::size_t slot = static_cast<std::size_t>(mixed * 0xBF58476D1CE4E5B9u >> 24) & mask;
    while (slots_[slot].key != 0 && slots_[slot].key != key) slot = (slot + 1) & mask;
    return slot;
  }
  void grow();
  std::vector<Slot> slots_ = std::vector<Slot>(1024);
  std::int32_t size_ = 0;
};

/// A predicted value with the order of the error's leading term (2 linear, 3 quadratic, 4 cubic interpolation; 1:
/// extrapolation; 0: unknown).
struct Prediction {
  Metric2 root{};
  int order = 0;
};

/// Returns whether `root` is definite, and at most twice and at least half of the values beside it.
bool plausible(Metric2 root, Metric2 p, Metric2 q) noexcept;

/// Square roots of metrics at the nodes of nested grids over a box, in units of the coarsest cells. Nodes that were not
/// sampled are predicted from coarser grids by cubic interpolation along a line (four points, fewer near the
/// boundary), which is an interpolating subdivision.
class Lattice {
 public:
  /// columns x rows coarsest cells, each `step` units of the finest grid wide; step a power of two.
  Lattice(Vec2 low, Vec2 high, int columns, int rows, std::int32_t step, const PolygonLocator& domain);

  [[nodiscard]] std::int32_t step() const noexcept { return step_; }
  [[nodiscard]] GridPoint end() const noexcept { return end_; }
  [[nodiscard]] Vec2 low() const noexcept { return low_; }
  /// Extents of a coarsest cell.
  [[nodiscard]] Vec2 cell() const noexcept { return cell_; }
  /// Parameters of a node; exact on the sides of the box, because hosts are often undefined beyond.
  [[nodiscard]] Vec2 parameters(GridPoint p) const noexcept;
  /// The point at which to sample a node inside the domain: its parameters, or a point as near as rounding allows.
  [[nodiscard]] Vec2 sampling_point(std::int32_t node) const noexcept {
    return nodes_[node].place == Place::by_border ? inward(point(node)) : parameters(point(node));
  }
  /// Position in units of the finest grid, not rounded.
  [[nodiscard]] Vec2 position(const Vec2& uv) const noexcept {
    return {(uv.x() - low_.x()) / cell_.x() * step_, (uv.y() - low_.y()) / cell_.y() * step_};
  }
  /// The lower corner of the cell of the finest grid that holds a point; for points outside the box, the nearest cell.
  [[nodiscard]] GridPoint unit_cell(const Vec2& uv) const noexcept {
    const Vec2 p = position(uv);
    const auto within = [](double x, std::int32_t end) {
      return x > 0 ? std::min(static_cast<std::int32_t>(std::min<double>(x, end)), end - 1) : 0;
    };
    return {within(p.x(), end_.i), within(p.y(), end_.j)};
  }
  [[nodiscard]] bool contains(GridPoint p) const noexcept {
    return p.i >= 0 && p.j >= 0 && p.i <= end_.i && p.j <= end_.j;
  }

  /// The number of a node, created when new.
  std::int32_t node(GridPoint p, Place place = Place::unknown);
  /// The block of the nodes corner + {0, 1, 2, 3} x `spacing` in both directions, row by row. Nodes that belong to no
  /// coarser grid have consecutive numbers; the result is the first node's number, as if it were one of them. `corner`:
  /// of a cell of four times the spacing. The nodes must be created later.
  std::int32_t block(GridPoint corner, std::int32_t spacing);
  /// Creates a node of a block when it is new.
  void create(std::int32_t node, Place place) {
    Node& n = nodes_[node];
    if (n.place == Place::unknown) n.place = place == Place::unknown ? place_of(point(node)) : place;
  }
  [[nodiscard]] GridPoint point(std::int32_t node) const noexcept {
    const Block& b = blocks_[node >> 4];
    return {b.corner.i + ((node & 3) << b.spacing), b.corner.j + ((node >> 2 & 3) << b.spacing)};
  }
  /// Numbers of nodes are below this one; not every number belongs to a node.
  [[nodiscard]] std::int32_t size() const noexcept { return static_cast<std::int32_t>(nodes_.size()); }
  [[nodiscard]] bool inside(std::int32_t node) const noexcept {
    return nodes_[node].place == Place::inside || nodes_[node].place == Place::by_border;
  }
  [[nodiscard]] bool sampled(std::int32_t node) const noexcept { return nodes_[node].sampled; }
  void set_sample(std::int32_t node, Metric2 root);
  [[nodiscard]] const Metric2& value(std::int32_t node) const noexcept { return nodes_[node].root; }
  /// Gives a node its last value, when all predictions have been made.
  void fix(std::int32_t node, Metric2 root) noexcept {
    nodes_[node].root = root;
    nodes_[node].pass = fixed;
  }
  /// Returns whether value() is available: a sample, a prediction since forget(), or the last value.
  [[nodiscard]] bool known(std::int32_t node) const noexcept {
    return nodes_[node].sampled || nodes_[node].pass >= pass_;
  }

  /// Null when p was not sampled.
  [[nodiscard]] const Metric2* sample(GridPoint p) const noexcept {
    const std::int32_t n = sampled_node(p);
    return n >= 0 ? &nodes_[n].root : nullptr;
  }
  /// All nodes that were sampled, in the order in which they first were.
  [[nodiscard]] std::span<const std::int32_t> samples() const noexcept { return samples_; }
  /// Prediction of a node inside the domain from all present samples: predictions are remembered until forget().
  Prediction predict(std::int32_t node);
  void forget() noexcept { ++pass_; }
  /// Prediction if the caller knows the neighbours: `row(k)` and `column(k)` are numbers of nodes on the horizontal and
  /// the vertical line through this node, at k = -3, -1, 1, 3 times the spacing. They are -1 if the nodes have no
  /// value(). `odd_i`, `odd_j`: whether the nodes on the horizontal, on the vertical line belong to a coarser grid.
  template <class Row, class Column>
  Prediction predict_from(std::int32_t node, bool odd_i, bool odd_j, const Row& row, const Column& column) {
    if (nodes_[node].pass == pass_) return {nodes_[node].root, nodes_[node].order};
    Prediction result = predict_along(row);
    // At a centre both directions give the same product of cubics.
    if (result.order < 4 || !(odd_i && odd_j)) {
      const Prediction other = predict_along(column);
      if (result.order == other.order)
        result.root = 0.5 * (result.root + other.root);
      else if (other.order > result.order)
        result = other;
    }
    remember(node, result);
    return result;
  }
  /// The node itself when it has a value, sampled or predicted from at least two nodes; else -1.
  std::int32_t valued(std::int32_t node) {
    return nodes_[node].sampled || (inside(node) && predict(node).order >= 2) ? node : -1;
  }
  /// As valued(), for the node at a place. It is created when new: predictions are remembered in nodes.
  std::int32_t valued_node(GridPoint p);

 private:
  static constexpr std::int32_t fixed = std::numeric_limits<std::int32_t>::max();
  struct Node {
    Metric2 root{};  // a sample, or the prediction of pass `pass`
    std::int32_t pass = -1;
    std::int8_t order = 0;
    bool sampled = false;
    Place place = Place::unknown;  // of nodes that exist it is known
  };
  struct Block {
    GridPoint corner;
    int spacing = 0;
  };
  // The first node of a block has the number 16 times the block's number.
  [[nodiscard]] std::int32_t find(GridPoint p) const noexcept {
    const BlockIndex::Position at = BlockIndex::position(p);
    const std::int32_t block = index_.find(at);
    return block >= 0 && nodes_[16 * block + at.rank].place != Place::unknown ? 16 * block + at.rank : -1;
  }
  [[nodiscard]] std::int32_t sampled_node(GridPoint p) const noexcept {
    if (!contains(p)) return -1;
    const std::int32_t n = find(p);
    return n >= 0 && nodes_[n].sampled ? n : -1;
  }
  std::int32_t block_at(GridPoint p, const BlockIndex::Position& at);
  [[nodiscard]] Vec2 inward(GridPoint p) const noexcept;
  [[nodiscard]] Place place_of(GridPoint p) const;
  void remember(std::int32_t node, const Prediction& result) noexcept {
    Node& n = nodes_[node];
    n.pass = pass_;
    n.order = static_cast<std::int8_t>(result.order);
    if (!n.sampled) n.root = result.root;
  }
  template <class Neighbour>
  Prediction predict_along(const Neighbour& neighbour) const {
    const std::int32_t before = neighbour(-1), after = neighbour(1);
    if (before < 0 && after < 0) return {};
    if (before < 0) return extrapolate(after, neighbour(3));
    if (after < 0) return extrapolate(before, neighbour(-3));
    const std::int32_t first = neighbour(-3), last = neighbour(3);
    return interpolate(first, before, after, last);
  }
  [[nodiscard]] Prediction extrapolate(std::int32_t near, std::int32_t far) const noexcept;
  [[nodiscard]] Prediction interpolate(std::int32_t first, std::int32_t before, std::int32_t after,
                                       std::int32_t last) const noexcept;

  Vec2 low_, high_, cell_;
  std::int32_t step_;
  GridPoint end_;
  const PolygonLocator& domain_;
  BlockIndex index_;
  std::vector<Block> blocks_;
  std::vector<std::int32_t> samples_;
  SegmentedArray<Node> nodes_;
  std::int32_t pass_ = 0;
};

}  // namespace carreau::detail
