// SPDX-License-Identifier: BSD-3-Clause
#include "control_space/lattice.h"

#include <algorithm>
#include <cmath>

namespace carreau::detail {

std::pair<std::int32_t, bool> BlockIndex::insert(const Position& p) {
  if (2 * static_cast<std::size_t>(size_) >= slots_.size()) grow();
  Slot& slot = slots_[slot_of(p.key)];
  if (slot.key != 0) return {slot.block, false};
  slot = {p.key, size_};
  return {size_++, true};
}

void BlockIndex::grow() {
  std::vector<Slot> old(4 * slots_.size());
  old.swap(slots_);
  for (const Slot& s : old)
    if (s.key != 0) slots_[slot_of(s.key)] = s;
}

bool plausible(Metric2 root, Metric2 p, Metric2 q) noexcept {
  // A cheap test that nearly always suffices: the difference to the mean is small against a lower bound of its
  // eigenvalues.
  const Metric2 twice = p + q, d = 2.0 * root + -1.0 * twice;
  const double bound = 0.25 * determinant(twice) / (twice.a + twice.c);
  if (bound > 0 && d.a * d.a + 2 * d.b * d.b + d.c * d.c < bound * bound) return true;
  // Twice the eigenvalues are the trace plus and minus the norm of the deviator.
  const auto spread = [](Metric2 m) { return std::sqrt((m.a - m.c) * (m.a - m.c) + 4 * m.b * m.b); };
  const double trace = root.a + root.c, s = spread(root);
  const double tp = p.a + p.c, sp = spread(p), tq = q.a + q.c, sq = spread(q);
  return trace - s >= 0.5 * std::min(tp - sp, tq - sq) && trace + s <= 2 * std::max(tp + sp, tq + sq);
}

Lattice::Lattice(Vec2 low, Vec2 high, int columns, int rows, std::int32_t step, const PolygonLocator& domain)
    : low_(low),
      high_(high),
      cell_{(high.x() - low.x()) / columns, (high.y() - low.y()) / rows},
      step_(step),
      end_{columns * step, rows * step},
      domain_(domain) {}

Vec2 Lattice::parameters(GridPoint p) const noexcept {
  const double x = static_cast<double>(p.i) / end_.i, y = static_cast<double>(p.j) / end_.j;
  return {p.i == end_.i ? high_.x() : low_.x() + x * (high_.x() - low_.x()),
          p.j == end_.j ? high_.y() : low_.y() + y * (high_.y() - low_.y())};
}

// Moves a node on a side of the box off it, by the error that points interpolated along a side may have.
Vec2 Lattice::inward(GridPoint p) const noexcept {
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  const Vec2 at = parameters(p);
  const auto off = [](double x, double low, double high, std::int32_t i, std::int32_t end) {
    const double by = rounding * std::max(std::abs(low), std::abs(high));
    return i == 0 ? x + by : i == end ? x - by : x;
  };
  return {off(at.x(), low_.x(), high_.x(), p.i, end_.i), off(at.y(), low_.y(), high_.y(), p.j, end_.j)};
}

// Sides of the box go through the outermost vertices: the others of a straight side may be off it by rounding.
Place Lattice::place_of(GridPoint p) const {
  if (domain_.contains(parameters(p))) return Place::inside;
  const bool on_side = p.i == 0 || p.j == 0 || p.i == end_.i || p.j == end_.j;
  return on_side && domain_.contains(inward(p)) ? Place::by_border : Place::outside;
}

std::int32_t Lattice::block_at(GridPoint p, const BlockIndex::Position& at) {
  const auto [block, added] = index_.insert(at);
  if (added) {
    const auto mask = static_cast<std::int32_t>(~((4U << at.spacing) - 1U));
    blocks_.push_back({{p.i & mask, p.j & mask}, at.spacing});
    nodes_.append(16);
  }
  return 16 * block;
}

std::int32_t Lattice::block(GridPoint corner, std::int32_t spacing) {
  return block_at(corner, BlockIndex::position(corner, std::countr_zero(static_cast<std::uint32_t>(spacing))));
}

std::int32_t Lattice::node(GridPoint p, Place place) {
  const BlockIndex::Position at = BlockIndex::position(p);
  const std::int32_t number = block_at(p, at) + at.rank;
  create(number, place);
  return number;
}

void Lattice::set_sample(std::int32_t node, Metric2 root) {
  nodes_[node].root = root;
  if (!nodes_[node].sampled) samples_.push_back(node);
  nodes_[node].sampled = true;
}

std::int32_t Lattice::valued_node(GridPoint p) {
  if (!contains(p)) return -1;
  const std::int32_t n = find(p);
  return valued(n >= 0 ? n : node(p));
}

// From the neighbours at odd distances along a line, two on one side.
Prediction Lattice::extrapolate(std::int32_t near, std::int32_t far) const noexcept {
  const Metric2 root = nodes_[near].root;
  if (far < 0) return {root, 1};
  const Metric2 linear = 1.5 * root + -0.5 * nodes_[far].root;
  return {plausible(linear, root, root) ? linear : root, 1};
}

// The same from both sides.
Prediction Lattice::interpolate(std::int32_t first, std::int32_t before, std::int32_t after,
                                std::int32_t last) const noexcept {
  const Metric2 p0 = nodes_[before].root, p1 = nodes_[after].root, mean = 0.5 * (p0 + p1);
  Prediction result{mean, 2};
  if (first >= 0 && last >= 0)
    result = {0.5625 * (p0 + p1) + -0.0625 * (nodes_[first].root + nodes_[last].root), 4};
  else if (first >= 0)
    result = {0.375 * p1 + 0.75 * p0 + -0.125 * nodes_[first].root, 3};
  else if (last >= 0)
    result = {0.375 * p0 + 0.75 * p1 + -0.125 * nodes_[last].root, 3};
  if (!plausible(result.root, p0, p1)) result.root = mean;
  return result;
}

Prediction Lattice::predict(std::int32_t node) {
  if (nodes_[node].pass == pass_) return {nodes_[node].root, nodes_[node].order};
  const GridPoint p = point(node);
  const std::int32_t bits = p.i | p.j, spacing = bits & -bits;
  if (spacing == 0 || spacing >= step_) {
    remember(node, {});
    return {};
  }
  const bool odd_i = (p.i & spacing) != 0, odd_j = (p.j & spacing) != 0;
  // Nodes of the same spacing are centres of cells, which have been sampled or are not yet needed.
  const auto value_at = [&](GridPoint q, bool coarser) { return coarser ? valued_node(q) : sampled_node(q); };
  return predict_from(
      node, odd_i, odd_j,
      [&](int k) {
        return value_at({p.i + k * spacing, p.j}, odd_i);
      },
      [&](int k) {
        return value_at({p.i, p.j + k * spacing}, odd_j);
      });
}

}  // namespace carreau::detail
