#include "geometry/grid/smoothing.h"

#include <cmath>
#include <utility>

#include "support/error.h"

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

/// to[i] = from[i] + weight (mean - from[i]) but for the ends of an open line.
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
    to[i] = from[i] + weight * (mean(near) - from[i]);
  }
}

template <typename Value>
void smooth(std::span<Value> values, bool closed, const Smoothing& smoothing) {
  if (values.size() < 3) return;
  std::vector<Value> moved(values.begin(), values.end());
  pass<Value>(values, moved, closed, smoothing.inward);
  pass<Value>(moved, values, closed, -smoothing.outward);
}

bool same(const Vec3& p, const Vec3& q, double tolerance) {
  return !is_finite(p) ? !is_finite(q) : is_finite(q) && norm(p - q) <= tolerance;
}

/// One line of a block, node k at first + k * step.
struct Line {
  std::size_t first, step, count;
  bool closed;  ///< its last node is its first one
};

/// Calls visit(nodes of a run without missing ones, whether the run is the whole closed line).
template <typename Visit>
void for_runs(const Block& block, const Line& line, Visit&& visit) {
  std::vector<std::size_t> run;
  bool whole = true;
  for (std::size_t k = 0; k < line.count; ++k) {
    const std::size_t node = line.first + k * line.step;
    if (is_finite(block.nodes[node])) {
      run.push_back(node);
      continue;
    }
    whole = false;
    if (!run.empty()) visit(run, false);
    run.clear();
  }
  if (!run.empty()) visit(run, whole && line.closed);
}

/// What smoothing moves of a node, and back.
class Moved {
 public:
  explicit Moved(Measured measured) : heights_(measured == Measured::heights) {}
  [[nodiscard]] double of(const Vec3& p) const { return heights_ ? p.z() : std::hypot(p.x(), p.y()); }
  void set(Vec3& p, double value) const {
    if (heights_) {
      p.z() = value;
      return;
    }
    const double before = std::hypot(p.x(), p.y());
    if (before > 0) p.x() *= value / before, p.y() *= value / before;
  }

 private:
  bool heights_;
};

void smooth_run(Block& block, const std::vector<std::size_t>& run, bool closed, const Smoothing& smoothing) {
  const std::size_t n = closed ? run.size() - 1 : run.size();  // the joint counts once
  if (block.measured == Measured::points) {
    std::vector<Vec3> points(n);
    for (std::size_t k = 0; k < n; ++k) points[k] = block.nodes[run[k]];
    smooth_line(points, closed, smoothing);
    for (std::size_t k = 0; k < n; ++k) block.nodes[run[k]] = points[k];
  } else {
    const Moved moved(block.measured);
    std::vector<double> values(n);
    for (std::size_t k = 0; k < n; ++k) values[k] = moved.of(block.nodes[run[k]]);
    smooth_line(values, closed, smoothing);
    for (std::size_t k = 0; k < n; ++k) moved.set(block.nodes[run[k]], values[k]);
  }
  if (closed) block.nodes[run.back()] = block.nodes[run.front()];
}

}  // namespace

void smooth_line(std::span<double> values, bool closed, const Smoothing& smoothing) {
  smooth(values, closed, smoothing);
}

void smooth_line(std::span<Vec3> points, bool closed, const Smoothing& smoothing) {
  smooth(points, closed, smoothing);
}

Closed closed_directions(const Block& block, double tolerance) {
  Closed closed{block.columns > 3, block.rows > 3};
  for (int j = 0; closed.columns && j < block.rows; ++j)
    closed.columns = same(block.node(0, j), block.node(block.columns - 1, j), tolerance);
  for (int i = 0; closed.rows && i < block.columns; ++i)
    closed.rows = same(block.node(i, 0), block.node(i, block.rows - 1), tolerance);
  return closed;
}

void smooth_block(Block& block, const Closed& closed, const Smoothing& smoothing, Monitor& monitor) {
  const auto columns = static_cast<std::size_t>(block.columns), rows = static_cast<std::size_t>(block.rows);
  for (int round = 0; round < smoothing.rounds; ++round) {
    monitor.checkpoint();
    const auto smooth = [&](const std::vector<std::size_t>& run, bool whole) {
      smooth_run(block, run, whole, smoothing);
    };
    for (std::size_t j = 0; j < rows; ++j) for_runs(block, Line{j * columns, 1, columns, closed.columns}, smooth);
    for (std::size_t i = 0; i < columns; ++i) for_runs(block, Line{i, columns, rows, closed.rows}, smooth);
  }
}

}  // namespace carreau::grid
