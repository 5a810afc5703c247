// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/grid/smoothing.h"

#include <cmath>
#include <vector>

#include "geometry/grid/thresholds.h"

namespace carreau::grid {

namespace {

template <typename Value>
struct Neighbours {
  const Value &before, &here, &after;
};

double mean(const Neighbours<double>& n) { return (n.before + n.after) / 2; }

Vec3 mean(const Neighbours<Vec3>& n) {
  const double d1 = norm(n.here - n.before), d2 = norm(n.after - n.here);
  return d1 + d2 > 0 ? Vec3((d2 * n.before + d1 * n.after) / (d1 + d2)) : n.here;
}

/// A height or radius on its line of space.
struct Placed {
  double value = 0;
  Vec3 base, direction;

  [[nodiscard]] Vec3 position() const { return base + value * direction; }
};

double mean(const Neighbours<Placed>& n) {
  const Vec3 here = n.here.position();
  const double d1 = norm(here - n.before.position()), d2 = norm(n.after.position() - here);
  return d1 + d2 > 0 ? (d2 * n.before.value + d1 * n.after.value) / (d1 + d2) : n.here.value;
}

template <typename Value>
Value moved(const Value& from, double weight, const Value& to) {
  return from + weight * (to - from);
}
Placed moved(const Placed& from, double weight, double to) { return {from.value + weight * (to - from.value), from.base, from.direction}; }

/// to[i] = from[i] + weight (mean - from[i]), except at the ends of an open line.
template <typename Value>
void pass(std::span<const Value> from, std::span<Value> to, bool closed, double weight) {
  const std::size_t n = from.size();
  for (std::size_t i = 0; i < n; ++i) {
    const bool end = i == 0 || i + 1 == n;
    if (end && !closed) {
      to[i] = from[i];
      continue;
    }
    const Neighbours<Value> near{from[i == 0 ? n - 1 : i - 1], from[i], from[i + 1 == n ? 0 : i + 1]};
    to[i] = moved(from[i], weight, mean(near));
  }
}

/// `scratch` has equal size.
template <typename Value>
void smooth(std::span<Value> values, std::span<Value> scratch, bool closed, const Smoothing& smoothing) {
  if (values.size() < 3) return;
  pass<Value>(values, scratch, closed, smoothing.inward);
  pass<Value>(scratch, values, closed, -smoothing.outward);
}

bool same(const Vec3& p, const Vec3& q, double tolerance) {
  return !is_finite(p) ? !is_finite(q) : is_finite(q) && norm(p - q) <= tolerance;
}

/// Adds the turn of a line at its joint, from `before` by way of `here` to `after`.
void add_turn(const Vec3& before, const Vec3& here, const Vec3& after, double& sum, int& count) {
  const Vec3 a = here - before, b = after - here;
  if (!is_finite(a) || !is_finite(b) || norm(a) * norm(b) == 0) return;
  sum += std::atan2(norm(cross(a, b)), dot(a, b));
  ++count;
}

bool is_smooth(const Block& block, bool columns) {
  double sum = 0;
  int count = 0;
  for (int k = 0; columns && k < block.rows; ++k)
    add_turn(block.node(block.columns - 2, k), block.node(0, k), block.node(1, k), sum, count);
  for (int k = 0; !columns && k < block.columns; ++k)
    add_turn(block.node(k, block.rows - 2), block.node(k, 0), block.node(k, 1), sum, count);
  return block.measured == Measured::radii || sum < thresholds::closed_turn * count;
}

/// Successive present nodes of a line, node k at first + k * step.
struct Run {
  std::size_t first, step, count;
  bool closed;  ///< a whole closed line, without the node that repeats its first one
};

/// Adds the runs of a line; `closed`: its last node is its first one.
void add_runs(const Block& block, const Run& line, bool closed, std::vector<Run>& runs) {
  std::size_t start = 0;
  for (std::size_t k = 0; k <= line.count; ++k) {
    if (k < line.count && is_finite(block.nodes[line.first + k * line.step])) continue;
    if (k > start) runs.push_back({line.first + start * line.step, line.step, k - start, false});
    start = k + 1;
  }
  if (closed && !runs.empty() && runs.back().count == line.count) --runs.back().count, runs.back().closed = true;
}

/// All rows, then all columns.
std::vector<Run> runs_of(const Block& block, const Closed& closed) {
  const auto columns = static_cast<std::size_t>(block.columns), rows = static_cast<std::size_t>(block.rows);
  std::vector<Run> runs;
  for (std::size_t j = 0; j < rows; ++j) add_runs(block, {j * columns, 1, columns, false}, closed.columns, runs);
  for (std::size_t i = 0; i < columns; ++i) add_runs(block, {i, columns, rows, false}, closed.rows, runs);
  return runs;
}

template <typename Value>
void smooth_runs(std::vector<Value>& values, const std::vector<Run>& runs, const Smoothing& smoothing, Monitor& monitor) {
  std::vector<Value> line(values.size()), moved(values.size());
  for (int round = 0; round < smoothing.rounds; ++round) {
    monitor.checkpoint();
    for (const Run& run : runs) {
      for (std::size_t k = 0; k < run.count; ++k) line[k] = values[run.first + k * run.step];
      smooth<Value>(std::span(line).first(run.count), std::span(moved).first(run.count), run.closed, smoothing);
      for (std::size_t k = 0; k < run.count; ++k) values[run.first + k * run.step] = line[k];
      if (run.closed) values[run.first + run.count * run.step] = line[0];
    }
  }
}

double radius_of(const Vec3& p) { return std::hypot(p.x(), p.y()); }

/// Sets the coordinate of a node that smoothing moves, for heights and radii.
void set_moved(const Block& block, double value, Vec3& p) {
  if (block.measured == Measured::heights)
    p.z() = value;
  else if (const double before = radius_of(p); before > 0)
    p.x() *= value / before, p.y() *= value / before;
}

void smooth_by_distance(Block& block, const std::vector<Run>& runs, const Smoothing& smoothing, Monitor& monitor) {
  const bool heights = block.measured == Measured::heights;
  std::vector<Placed> values;
  for (const Vec3& p : block.nodes) {
    const double r = radius_of(p);
    if (heights)
      values.push_back({p.z(), {p.x(), p.y(), 0}, {0, 0, 1}});
    else
      values.push_back({r, {0, 0, p.z()}, r > 0 ? Vec3(p.x() / r, p.y() / r, 0) : Vec3::Zero()});
  }
  smooth_runs(values, runs, smoothing, monitor);
  for (std::size_t k = 0; k < values.size(); ++k)
    if (is_finite(block.nodes[k])) set_moved(block, values[k].value, block.nodes[k]);
}

}  // namespace

void smooth_line(std::span<double> values, bool closed, const Smoothing& smoothing) {
  std::vector<double> moved(values.size());
  smooth<double>(values, moved, closed, smoothing);
}

void smooth_line(std::span<Vec3> points, bool closed, const Smoothing& smoothing) {
  std::vector<Vec3> moved(points.size());
  smooth<Vec3>(points, moved, closed, smoothing);
}

Closed closed_directions(const Block& block, double tolerance) {
  Closed closed{block.columns > 3, block.rows > 3};
  for (int j = 0; closed.columns && j < block.rows; ++j)
    closed.columns = same(block.node(0, j), block.node(block.columns - 1, j), tolerance);
  for (int i = 0; closed.rows && i < block.columns; ++i)
    closed.rows = same(block.node(i, 0), block.node(i, block.rows - 1), tolerance);
  closed.columns = closed.columns && is_smooth(block, true);
  closed.rows = closed.rows && is_smooth(block, false);
  return closed;
}

void smooth_block(Block& block, const Closed& closed, const Smoothing& smoothing, Monitor& monitor) {
  if (smoothing.rounds == 0) return;
  const std::vector<Run> runs = runs_of(block, closed);
  if (block.measured == Measured::points) return smooth_runs(block.nodes, runs, smoothing, monitor);
  if (smoothing.by_distance) return smooth_by_distance(block, runs, smoothing, monitor);
  std::vector<double> values;
  for (const Vec3& p : block.nodes) values.push_back(block.measured == Measured::heights ? p.z() : radius_of(p));
  smooth_runs(values, runs, smoothing, monitor);
  for (std::size_t k = 0; k < values.size(); ++k)
    if (is_finite(block.nodes[k])) set_moved(block, values[k], block.nodes[k]);
}

}  // namespace carreau::grid
