#include "size/control_space_lattice.h"

#include <cmath>

namespace carreau::detail {

std::uint64_t GridIndex::key(GridPoint p) noexcept {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(p.j)) << 32 | static_cast<std::uint32_t>(p.i)) + 1;
}

std::size_t GridIndex::slot_of(std::uint64_t key) const noexcept {
  const std::size_t mask = key_.size() - 1;
  std::uint64_t mixed = key * 0x9E3779B97F4A7C15u;
  mixed ^= mixed >> 29;
  std::size_t slot = static_cast<std::size_t>(mixed * 0xBF58476D1CE4E5B9u >> 24) & mask;
  while (key_[slot] != 0 && key_[slot] != key) slot = (slot + 1) & mask;
  return slot;
}

std::int32_t GridIndex::find(GridPoint p) const noexcept { return value_[slot_of(key(p))]; }

std::pair<std::int32_t, bool> GridIndex::insert(GridPoint p) {
  if (2 * static_cast<std::size_t>(size_) >= key_.size()) grow();
  const std::size_t slot = slot_of(key(p));
  if (key_[slot] != 0) return {value_[slot], false};
  key_[slot] = key(p);
  value_[slot] = size_;
  return {size_++, true};
}

void GridIndex::grow() {
  std::vector<std::uint64_t> keys(2 * key_.size(), 0);
  std::vector<std::int32_t> values(2 * value_.size(), -1);
  keys.swap(key_);
  values.swap(value_);
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (keys[k] == 0) continue;
    const std::size_t slot = slot_of(keys[k]);
    key_[slot] = keys[k];
    value_[slot] = values[k];
  }
}

bool plausible(Metric2 root, Metric2 p, Metric2 q) noexcept {
  // Twice the eigenvalues are tr +- sqrt(tr^2 - 4 det) = tr +- norm of the deviator.
  const auto spread = [](Metric2 m) { return std::hypot(m.a - m.c, 2 * m.b); };
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

std::int32_t Lattice::node(GridPoint p) {
  const auto [number, added] = index_.insert(p);
  if (added) {
    nodes_.push_back({.point = p});
    nodes_.back().inside = domain_.contains(parameters(p));
  }
  return number;
}

void Lattice::set_sample(std::int32_t node, Metric2 root) noexcept {
  nodes_[node].root = root;
  nodes_[node].sampled = true;
}

const Metric2* Lattice::sample(GridPoint p) const noexcept {
  if (!contains(p)) return nullptr;
  const std::int32_t n = index_.find(p);
  return n >= 0 && nodes_[n].sampled ? &nodes_[n].root : nullptr;
}

std::optional<Metric2> Lattice::fetch(GridPoint p) {
  if (!contains(p)) return std::nullopt;
  const std::int32_t n = node(p);
  if (nodes_[n].sampled) return nodes_[n].root;
  if (!nodes_[n].inside) return std::nullopt;
  const Prediction known = predict(p);
  if (known.order < 2) return std::nullopt;
  return known.root;
}

// The value at 0 from those at -5, -3, -1, 1, 3, 5.
template <typename Get>
Prediction Lattice::along_line(const Get& get) {
  const std::optional<Metric2> before = get(-1), after = get(1);
  if (before && after) {
    const Metric2 mean = 0.5 * (*before + *after);
    const std::optional<Metric2> first = get(-3), last = get(3);
    Prediction p{mean, 2};
    if (first && last)
      p = {0.5625 * (*before + *after) + -0.0625 * (*first + *last), 4};
    else if (first)
      p = {0.375 * *after + 0.75 * *before + -0.125 * *first, 3};
    else if (last)
      p = {0.375 * *before + 0.75 * *after + -0.125 * *last, 3};
    if (!plausible(p.root, *before, *after)) p.root = mean;
    return p;
  }
  if (!before && !after) return {};
  const int side = before ? -1 : 1;
  const Metric2 next = before ? *before : *after;
  const std::optional<Metric2> second = get(3 * side);
  if (!second) return {next, 1};
  const Metric2 linear = 1.5 * next + -0.5 * *second;
  return {plausible(linear, next, next) ? linear : next, 1};
}

Prediction Lattice::predict(GridPoint p) {
  const std::int32_t n = node(p);
  if (nodes_[n].pass == pass_) return {nodes_[n].root, nodes_[n].order};
  const std::int32_t bits = p.i | p.j, s = bits & -bits;
  Prediction result;
  if (s != 0 && s < step_) {
    const bool odd_i = (p.i & s) != 0, odd_j = (p.j & s) != 0;
    // A node amid a side lies between centres of cells too; those centres were sampled or are not yet wanted.
    const auto at = [&](GridPoint q, bool coarser) -> std::optional<Metric2> {
      if (coarser) return fetch(q);
      const Metric2* known = sample(q);
      return known != nullptr ? std::optional(*known) : std::nullopt;
    };
    const Prediction row = along_line([&](int k) { return at({p.i + k * s, p.j}, odd_i); });
    const Prediction column = along_line([&](int k) { return at({p.i, p.j + k * s}, odd_j); });
    if (row.order == column.order)
      result = {0.5 * (row.root + column.root), row.order};
    else
      result = row.order > column.order ? row : column;
  }
  nodes_[n].pass = pass_;
  nodes_[n].order = static_cast<std::int8_t>(result.order);
  if (!nodes_[n].sampled) nodes_[n].root = result.root;
  return result;
}

}  // namespace carreau::detail
