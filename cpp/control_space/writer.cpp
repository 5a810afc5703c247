// SPDX-License-Identifier: BSD-3-Clause
#include "control_space/writer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>

#include "control_space/thresholds.h"
#include "metric/metric2_algebra.h"
#include "support/shares.h"

namespace carreau {

using detail::GridPoint;
using detail::TreeCell;

namespace {

using namespace thresholds::control_space;

double smaller_eigenvalue(Metric2 m) noexcept {
  const double half = 0.5 * (m.a - m.c);
  return 0.5 * (m.a + m.c) - std::sqrt(half * half + m.b * m.b);
}

// A cheap sufficient test that the smaller eigenvalue of `inner` exceeds shares::notable of the smaller eigenvalues of
// p and q. A smaller eigenvalue exceeds determinant over trace and is at most half of the trace; the factor of two
// remains for rounding.
bool surely_definite(Metric2 inner, Metric2 p, Metric2 q) noexcept {
  const double trace = inner.a + inner.c;
  return trace > 0 && determinant(inner) > shares::notable * std::min(p.a + p.c, q.a + q.c) * trace;
}

// straight + theta (bent - straight) with the largest theta of 1, 7/8, ... 0 for which it is definite enough.
Metric2 definite_between(Metric2 straight, Metric2 bent, double least) noexcept {
  for (int k = straightening_steps; k > 0; --k) {
    const double theta = static_cast<double>(k) / straightening_steps;
    const Metric2 m = (1 - theta) * straight + theta * bent;
    if (smaller_eigenvalue(m) >= least) return m;
  }
  return straight;
}

}  // namespace

ControlSpaceWriter::ControlSpaceWriter(detail::ControlSpaceSampling& sampling, Monitor& monitor)
    : sampling_(sampling), tree_(sampling.tree()), lattice_(sampling.lattice()), monitor_(monitor) {}

ControlSpace ControlSpaceWriter::run() {
  balance();
  sort_leaves();
  set_values();
  fill_outside();
  straighten_sides();
  write();
  return std::move(space_);
}

// A leaf has no neighbour of less than half or more than twice its size.
void ControlSpaceWriter::balance() {
  std::vector<std::int32_t> todo;
  for (std::int32_t c = 0; c < tree_.size(); ++c)
    if (tree_[c].child < 0) todo.push_back(c);
  while (!todo.empty()) {
    const std::int32_t c = todo.back();
    todo.pop_back();
    if (tree_[c].child >= 0) continue;
    for (int side = 0; side < 4; ++side) {
      // A neighbour larger than the cell is a leaf.
      for (std::int32_t leaf = tree_[c].beside[side]; leaf >= 0 && tree_[leaf].size > 2 * tree_[c].size;
           leaf = tree_[c].beside[side]) {
        tree_.split(leaf);
        for (int k = 0; k < 4; ++k) todo.push_back(tree_[leaf].child + k);
      }
    }
  }
}

// Sorts by size; leaves of equal size stay in the order of the tree.
void ControlSpaceWriter::sort_leaves() {
  constexpr std::size_t sizes = 32;
  const auto rank = [](const TreeCell& cell) {
    return sizes - 1 - static_cast<std::size_t>(std::countr_zero(static_cast<std::uint32_t>(cell.size)));
  };
  std::array<std::size_t, sizes + 1> begin{};
  for (std::int32_t c = 0; c < tree_.size(); ++c)
    if (tree_[c].child < 0) ++begin[rank(tree_[c]) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  leaves_.resize(begin.back());
  for (std::int32_t c = 0; c < tree_.size(); ++c)
    if (tree_[c].child < 0) leaves_[begin[rank(tree_[c])]++] = c;
}

// Predicts all values that can be predicted. The rest has to wait until all predictions are made: it must not take part
// in them.
void ControlSpaceWriter::predict_values() {
  lattice_.forget();
  std::size_t count = 0;
  // From fine to coarse: a node outside is extrapolated from the nearest available samples.
  for (auto leaf = leaves_.rbegin(); leaf != leaves_.rend(); ++leaf) {
    if (++count % 1024 == 0) monitor_.checkpoint();
    const TreeCell& cell = tree_[*leaf];
    if (!cell.relevant) continue;
    const auto predict = [&](int k) {
      const std::int32_t n = cell.node[k];
      if (lattice_.sampled(n)) return;
      if (!lattice_.inside(n) || sampling_.predictor().predict(cell, k).order < 3 || sampling_.bounds_slopes())
        late_.push_back({*leaf, k});
    };
    predict(4);
    for (const int k : detail::corners_of_cell) predict(k);
    // A side that is half of a coarser side takes its middle from there.
    for (int side = 0; side < 4; ++side)
      if (coarser_beside(cell, side) < 0) predict(detail::middles_of_sides[side]);
  }
}

void ControlSpaceWriter::set_values() {
  predict_values();
  std::vector<char> done(static_cast<std::size_t>(lattice_.size()), 0);
  for (const auto& [leaf, k] : late_) {
    const TreeCell& cell = tree_[leaf];
    const std::int32_t n = cell.node[k];
    if (done[n] != 0) continue;
    done[n] = 1;
    if (lattice_.inside(n)) {
      const detail::Prediction guess = sampling_.predictor().predict(cell, k);
      if (guess.order >= 3) {
        lattice_.fix(n, sampling_.within_slopes(n, cell, guess.root));
        continue;
      }
    }
    const GridPoint p = lattice_.point(n);
    lattice_.fix(n, sampling_.border().fit({static_cast<double>(p.i), static_cast<double>(p.j)}, cell.size));
  }
}

// Far outside any continuation suffices: the mean of the known values in a leaf spreads from leaf to leaf.
void ControlSpaceWriter::fill_outside() {
  std::vector<std::int32_t> todo;
  for (const std::int32_t leaf : leaves_)
    if (!tree_[leaf].relevant) todo.push_back(leaf);
  while (!todo.empty()) {
    std::vector<std::int32_t> later;
    for (const std::int32_t leaf : todo) {
      Metric2 sum{0, 0, 0};
      int known = 0;
      for (const std::int32_t n : tree_[leaf].node)
        if (lattice_.known(n)) sum = sum + lattice_.value(n), ++known;
      if (known == 0) {
        later.push_back(leaf);
        continue;
      }
      for (const std::int32_t n : tree_[leaf].node)
        if (!lattice_.known(n)) lattice_.fix(n, (1.0 / known) * sum);
    }
    if (later.size() == todo.size()) break;  // nothing is known anywhere: cannot happen after a sample
    todo.swap(later);
  }
}

// The larger leaf on the other side of a side, or -1.
std::int32_t ControlSpaceWriter::coarser_beside(const TreeCell& cell, int side) const {
  const std::int32_t beside = cell.beside[side];
  return beside >= 0 && tree_[beside].size > cell.size ? beside : -1;
}

// Along each side, from coarse to fine, the middle Bernstein coefficient of the quadratic becomes definite.
void ControlSpaceWriter::straighten_sides() {
  for (const std::int32_t leaf : leaves_) {
    const TreeCell& cell = tree_[leaf];
    for (int side = 0; side < 4; ++side) {
      if (coarser_beside(cell, side) >= 0) continue;
      const std::int32_t at = cell.node[detail::middles_of_sides[side]];
      Metric2 middle = lattice_.value(at);
      if (make_side_definite(lattice_.value(cell.node[detail::ends_of_sides[side][0]]), middle,
                             lattice_.value(cell.node[detail::ends_of_sides[side][1]])))
        lattice_.fix(at, middle);
    }
  }
}

bool ControlSpaceWriter::make_side_definite(Metric2 a, Metric2& middle, Metric2 b) noexcept {
  const Metric2 mean = 0.5 * (a + b);
  const Metric2 inner = 2.0 * middle + -1.0 * mean;
  if (surely_definite(inner, a, b)) return false;
  const double least = shares::notable * std::min(smaller_eigenvalue(a), smaller_eigenvalue(b));
  if (smaller_eigenvalue(inner) >= least) return false;
  middle = 0.5 * (mean + definite_between(mean, inner, least));
  return true;
}

// If a side is half of a coarser side, its middle lies on the quadratic of the coarser side.
ControlSpaceWriter::Nine ControlSpaceWriter::values_in(const TreeCell& cell) const {
  Nine v;
  for (int k = 0; k < 9; ++k) v[k] = lattice_.value(cell.node[k]);
  for (int side = 0; side < 4; ++side) {
    const std::int32_t other = coarser_beside(cell, side);
    if (other < 0) continue;
    const TreeCell& coarser = tree_[other];
    // The side as seen from beyond: lower and upper, left and right change places.
    const int facing = side ^ 1;
    const Metric2 low = lattice_.value(coarser.node[detail::ends_of_sides[facing][0]]);
    const Metric2 middle = lattice_.value(coarser.node[detail::middles_of_sides[facing]]);
    const Metric2 high = lattice_.value(coarser.node[detail::ends_of_sides[facing][1]]);
    const bool first_half = side < 2 ? cell.i == coarser.i : cell.j == coarser.j;
    // The quadratic at 1/4 or 3/4.
    v[detail::middles_of_sides[side]] =
        first_half ? 0.375 * low + 0.75 * middle + -0.125 * high : 0.375 * high + 0.75 * middle + -0.125 * low;
  }
  make_centre_definite(v);
  return v;
}

// The centre's Bernstein coefficient, kept definite as on the sides.
void ControlSpaceWriter::make_centre_definite(Nine& v) noexcept {
  const Metric2 corners = v[0] + v[2] + v[6] + v[8];
  const Metric2 inner_sides = 2.0 * (v[1] + v[3] + v[5] + v[7]) + -1.0 * corners;
  const Metric2 straight = 0.25 * inner_sides;
  const Metric2 inner = 4.0 * v[4] + -0.25 * corners + -0.5 * inner_sides;
  if (surely_definite(inner, straight, straight)) return;
  const double least = shares::notable * smaller_eigenvalue(straight);
  if (smaller_eigenvalue(inner) < least) {
    const Metric2 definite = definite_between(straight, inner, least);
    v[4] = 0.0625 * corners + 0.125 * inner_sides + 0.25 * definite;
  }
}

// Simpson's rule in both directions.
double ControlSpaceWriter::mean_determinant(const Nine& v) noexcept {
  constexpr double weight[9] = {1, 4, 1, 4, 16, 4, 1, 4, 1};
  double sum = 0;
  for (int k = 0; k < 9; ++k) sum += weight[k] / 36 * accurate_determinant(v[k]);
  return sum;
}

// Three values at -1, 0, 1 to coefficients of 1, s, s^2: first along rows, then across them.
ControlSpace::Leaf ControlSpaceWriter::leaf_of(const Nine& v, double x, double y, double scale) noexcept {
  ControlSpace::Leaf leaf{.x = x, .y = y, .scale = scale};
  const auto quadratic = [](Metric2 low, Metric2 middle, Metric2 high) {
    return std::array<Metric2, 3>{middle, 0.5 * (high + -1.0 * low), 0.5 * (low + high) + -1.0 * middle};
  };
  std::array<std::array<Metric2, 3>, 3> rows;
  for (int r = 0; r < 3; ++r) rows[r] = quadratic(v[3 * r], v[3 * r + 1], v[3 * r + 2]);
  for (int n = 0; n < 3; ++n) {
    const auto column = quadratic(rows[0][n], rows[1][n], rows[2][n]);
    for (int m = 0; m < 3; ++m) leaf.c[3 * m + n] = {column[m].a, column[m].b, column[m].c};
  }
  return leaf;
}

double ControlSpaceWriter::measure_of(const TreeCell& cell, const Nine& v) const {
  const double side = static_cast<double>(cell.size) / lattice_.step();
  const double sum = mean_determinant(v);
  double share = 1;
  const bool cut = cell.edges_begin != cell.edges_end;
  if (cut && std::any_of(cell.node.begin(), cell.node.end(), [this](std::int32_t n) { return !lattice_.inside(n); })) {
    int inside = 0;
    for (int k = 0; k < cut_leaf_points * cut_leaf_points; ++k) {
      const double x = (k % cut_leaf_points + 0.5) / cut_leaf_points, y = (k / cut_leaf_points + 0.5) / cut_leaf_points;
      const Vec2 p{lattice_.low().x() + (cell.i + x * cell.size) / lattice_.step() * lattice_.cell().x(),
                   lattice_.low().y() + (cell.j + y * cell.size) / lattice_.step() * lattice_.cell().y()};
      inside += sampling_.locator().contains(p) ? 1 : 0;
    }
    share = static_cast<double>(inside) / (cut_leaf_points * cut_leaf_points);
  }
  return share * sum * side * side / (0.25 * std::numbers::sqrt3);
}

std::int32_t ControlSpaceWriter::write_leaf(const TreeCell& cell) {
  const Nine v = values_in(cell);
  const double measure = cell.relevant ? measure_of(cell, v) : 0;
  space_.measures_.push_back(measure);
  space_.measure_ += measure;
  space_.leaves_.push_back(leaf_of(v, (cell.i + 0.5 * cell.size) / table_step_, (cell.j + 0.5 * cell.size) / table_step_,
                                   2.0 * table_step_ / cell.size));
  return static_cast<std::int32_t>(space_.leaves_.size()) - 1;
}

// A cell of the tree no larger than cells of the table, and all below it.
std::int32_t ControlSpaceWriter::write_cell(std::int32_t number) {
  const TreeCell cell = tree_[number];
  if (cell.child < 0) return write_leaf(cell);
  const auto at = static_cast<std::int32_t>(space_.children_.size());
  space_.children_.push_back({});
  for (int k = 0; k < 4; ++k) {
    const std::int32_t child = write_cell(cell.child + k);
    space_.children_[at][k] = child;
  }
  return ~at;
}

void ControlSpaceWriter::write() {
  const auto count = [this](std::int32_t step) {
    return static_cast<std::size_t>(lattice_.end().i / step) * static_cast<std::size_t>(lattice_.end().j / step);
  };
  const std::int32_t finest = tree_[leaves_.back()].size;
  table_step_ = lattice_.step();
  // At most two entries of the table for each leaf. [Limits.SmallMeshesTakeLittleMemory]
  while (table_step_ > finest && count(table_step_ / 2) <= 2 * leaves_.size()) table_step_ /= 2;

  const std::int32_t columns = lattice_.end().i / table_step_, rows = lattice_.end().j / table_step_;
  space_.columns_ = static_cast<std::size_t>(columns);
  space_.table_.assign(space_.columns_ * static_cast<std::size_t>(rows), -1);
  space_.leaves_.clear();
  space_.measures_.clear();
  space_.leaves_.reserve(leaves_.size());
  space_.measures_.reserve(leaves_.size());
  // Cells at least as large as cells of the table, each with all entries that it covers; depth first, so that near
  // leaves are near in memory.
  std::vector<std::int32_t> stack;
  for (std::int32_t c = tree_.columns() * tree_.rows(); c-- > 0;) stack.push_back(c);
  while (!stack.empty()) {
    const TreeCell cell = tree_[stack.back()];
    const std::int32_t number = stack.back();
    stack.pop_back();
    if (cell.child >= 0 && cell.size > table_step_) {
      for (int k = 3; k >= 0; --k) stack.push_back(cell.child + k);
      continue;
    }
    const std::int32_t entry = write_cell(number);
    for (std::int32_t j = cell.j / table_step_; j < (cell.j + cell.size) / table_step_; ++j)
      for (std::int32_t i = cell.i / table_step_; i < (cell.i + cell.size) / table_step_; ++i)
        space_.table_[static_cast<std::size_t>(j) * space_.columns_ + static_cast<std::size_t>(i)] = entry;
  }
  space_.children_.shrink_to_fit();
  space_.low_ = lattice_.low();
  const Vec2 unit = lattice_.cell();
  const double per_cell = static_cast<double>(lattice_.step()) / table_step_;
  space_.scale_ = {per_cell / unit.x(), per_cell / unit.y()};
  space_.last_ = {std::nextafter(static_cast<double>(columns), 0.0), std::nextafter(static_cast<double>(rows), 0.0)};
  space_.unit_ = {1 / (unit.x() * unit.x()), 1 / (unit.x() * unit.y()), 1 / (unit.y() * unit.y())};
  space_.samples_ = sampling_.samples();
}

}  // namespace carreau
