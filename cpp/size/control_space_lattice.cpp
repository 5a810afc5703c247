#include "size/control_space_lattice.h"

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
  // Cheap and nearly always enough: the difference to the mean is small against a lower bound of its eigenvalues.
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
      cell_{(high.x - low.x) / columns, (high.y - low.y) / rows},
      step_(step),
      end_{columns * step, rows * step},
      domain_(domain) {}

Vec2 Lattice::parameters(GridPoint p) const noexcept {
  const double x = static_cast<double>(p.i) / end_.i, y = static_cast<double>(p.j) / end_.j;
  return {p.i == end_.i ? high_.x : low_.x + x * (high_.x - low_.x),
          p.j == end_.j ? high_.y : low_.y + y * (high_.y - low_.y)};
}

std::int32_t Lattice::node(GridPoint p, Place place) {
  const BlockIndex::Position at = BlockIndex::position(p);
  const auto [block, added] = index_.insert(at);
  if (added) {
    const std::int32_t mask = ~(4 << at.spacing) + 1;
    blocks_.push_back({{p.i & mask, p.j & mask}, at.spacing});
    nodes_.resize(nodes_.size() + 16);
  }
  const std::int32_t number = 16 * block + at.rank;
  if (!nodes_[number].exists) {
    nodes_[number].exists = true;
    nodes_[number].inside = place == Place::inside || (place == Place::unknown && domain_.contains(parameters(p)));
  }
  return number;
}

void Lattice::set_sample(std::int32_t node, Metric2 root) noexcept {
  nodes_[node].root = root;
  nodes_[node].sampled = true;
}

std::int32_t Lattice::sampled_node(GridPoint p) const noexcept {
  if (!contains(p)) return -1;
  const std::int32_t n = find(p);
  return n >= 0 && nodes_[n].sampled ? n : -1;
}

const Metric2* Lattice::sample(GridPoint p) const noexcept {
  const std::int32_t n = sampled_node(p);
  return n >= 0 ? &nodes_[n].root : nullptr;
}

std::int32_t Lattice::valued_node(GridPoint p) {
  if (!contains(p)) return -1;
  std::int32_t n = find(p);
  if (n < 0) n = node(p);
  if (nodes_[n].sampled) return n;
  return nodes_[n].inside && predict(n).order >= 2 ? n : -1;
}

// From the neighbours at odd distances along a line. `coarser`: whether they belong to a coarser grid. If not they are
// centres of cells, which have been sampled or are not yet wanted.
Prediction Lattice::predict_along(GridPoint p, std::int32_t spacing, bool horizontal, bool coarser) {
  const auto neighbour = [&](int k) {
    const GridPoint q = horizontal ? GridPoint{p.i + k * spacing, p.j} : GridPoint{p.i, p.j + k * spacing};
    return coarser ? valued_node(q) : sampled_node(q);
  };
  const std::int32_t before = neighbour(-1), after = neighbour(1);
  if (before < 0 && after < 0) return {};
  if (before < 0 || after < 0) {
    const std::int32_t next = before < 0 ? after : before, second = neighbour(before < 0 ? 3 : -3);
    const Metric2 near = nodes_[next].root;
    if (second < 0) return {near, 1};
    const Metric2 linear = 1.5 * near + -0.5 * nodes_[second].root;
    return {plausible(linear, near, near) ? linear : near, 1};
  }
  const std::int32_t first = neighbour(-3), last = neighbour(3);
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
  Prediction result;
  if (spacing != 0 && spacing < step_) {
    const bool odd_i = (p.i & spacing) != 0, odd_j = (p.j & spacing) != 0;
    result = predict_along(p, spacing, true, odd_i);
    // At a centre both directions give the same product of cubics.
    if (result.order < 4 || !(odd_i && odd_j)) {
      const Prediction column = predict_along(p, spacing, false, odd_j);
      if (result.order == column.order)
        result.root = 0.5 * (result.root + column.root);
      else if (column.order > result.order)
        result = column;
    }
  }
  nodes_[node].pass = pass_;
  nodes_[node].order = static_cast<std::int8_t>(result.order);
  if (!nodes_[node].sampled) nodes_[node].root = result.root;
  return result;
}

}  // namespace carreau::detail
