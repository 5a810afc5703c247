// SPDX-License-Identifier: BSD-3-Clause
#include "control_space/even_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "control_space/survey.h"
#include "control_space/thresholds.h"
#include "control_space/writer.h"
#include "metric/metric2_algebra.h"
#include "support/error.h"

namespace carreau {

namespace {

using namespace thresholds::control_space;

std::vector<Metric2> sampled(const MetricSampler& sampler, const std::vector<Vec2>& uv, Monitor& monitor) {
  monitor.checkpoint();
  std::vector<Metric2> metric(uv.size());
  sampler(uv, metric);
  for (std::size_t k = 0; k < uv.size(); ++k)
    if (!std::isfinite(metric[k].a) || !std::isfinite(metric[k].b) || !std::isfinite(metric[k].c))
      throw DomainError({.uv = uv[k]}, "the metric of the parameter domain is not finite");
  return metric;
}

// Nodes of an even grid over a box, sides included, row by row. Exact on the sides of the box.
std::vector<Vec2> nodes_of(const detail::Box2& box, int columns, int rows) {
  const auto between = [](double low, double high, int k, int n) {
    return k == n ? high : low + static_cast<double>(k) / n * (high - low);
  };
  std::vector<Vec2> nodes;
  nodes.reserve(static_cast<std::size_t>(columns + 1) * static_cast<std::size_t>(rows + 1));
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i)
      nodes.emplace_back(between(box.low.x(), box.high.x(), i, columns), between(box.low.y(), box.high.y(), j, rows));
  return nodes;
}

/// Summary of some samples of a box.
struct Extent {
  double edges_u = 0, edges_v = 0;  ///< mean lengths of the sides
  double floor = 0;                 ///< smallest eigenvalue in units of the box
};

Extent extent_of(std::span<const Metric2> metrics, const Vec2& box) {
  Extent e;
  std::vector<double> shortest;
  double longest = 0;
  for (const Metric2& metric : metrics) {
    const Metric2 m = detail::in_box(metric, box);
    const Eigen2 of_m = eigen(m);
    shortest.push_back(std::sqrt(std::max(of_m.minor, 0.0)));
    longest = std::max(longest, std::sqrt(of_m.major));
    e.edges_u += std::sqrt(std::max(m.a, 0.0)) / static_cast<double>(metrics.size());
    e.edges_v += std::sqrt(std::max(m.c, 0.0)) / static_cast<double>(metrics.size());
  }
  e.floor = detail::floor_from(std::move(shortest), longest);
  return e;
}

// The share of each cell that is inside the domain, by the parity of crossings along rows of points.
std::vector<double> shares_inside(const SampledDomain& domain, const detail::Box2& box, int columns, int rows) {
  constexpr int points = cut_leaf_points;
  std::vector<double> shares(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0), crossings;
  const Vec2 cell{(box.high.x() - box.low.x()) / columns, (box.high.y() - box.low.y()) / rows};
  for (int j = 0; j < points * rows; ++j) {
    const double y = box.low.y() + (j + 0.5) / points * cell.y();
    crossings.clear();
    for (const auto& [a, b] : domain.edges) {
      const Vec2 &p = domain.vertices[static_cast<std::size_t>(a)], &q = domain.vertices[static_cast<std::size_t>(b)];
      if ((p.y() > y) != (q.y() > y)) crossings.push_back(p.x() + (y - p.y()) / (q.y() - p.y()) * (q.x() - p.x()));
    }
    std::sort(crossings.begin(), crossings.end());
    auto next = crossings.begin();
    for (int i = 0; i < points * columns; ++i) {
      const double x = box.low.x() + (i + 0.5) / points * cell.x();
      while (next != crossings.end() && *next <= x) ++next;
      if ((next - crossings.begin()) % 2 == 1)
        shares[static_cast<std::size_t>(j / points * columns + i / points)] += 1.0 / (points * points);
    }
  }
  return shares;
}

}  // namespace

std::optional<ControlSpace> build_even_space(const SampledDomain& domain, const MetricSampler& sampler, Monitor& monitor) {
  const detail::Box2 box = detail::box_of(domain);
  const Vec2 sides = box.high - box.low;
  const Extent extent = extent_of(sampled(sampler, nodes_of(box, 2, 2), monitor), sides);
  if (!(extent.edges_u * extent.edges_v < max_even_edges2) || !(std::max(extent.edges_u, extent.edges_v) < max_even_edges))
    return {};
  const auto cells = [](double edges) { return std::max(min_even_side, static_cast<int>(std::ceil(edges / even_cell))); };
  const int columns = cells(extent.edges_u), rows = cells(extent.edges_v);
  const std::vector<Metric2> metrics = sampled(sampler, nodes_of(box, 2 * columns, 2 * rows), monitor);
  ControlSpaceWriter::EvenGrid grid{box.low, box.high, columns, rows, {}, shares_inside(domain, box, columns, rows)};
  grid.roots.reserve(metrics.size());
  for (const Metric2& metric : metrics) {
    const Metric2 m = clamp_eigenvalues(detail::in_box(metric, sides), extent.floor, std::numeric_limits<double>::max());
    grid.roots.push_back(square_root({m.a / (columns * columns), m.b / (columns * rows), m.c / (rows * rows)}));
  }
  return ControlSpaceWriter::write(std::move(grid));
}

ControlSpace ControlSpaceWriter::write(EvenGrid grid) {
  const auto columns = static_cast<std::size_t>(grid.columns), rows = static_cast<std::size_t>(grid.rows);
  const std::size_t width = 2 * columns + 1;
  const auto root = [&](std::size_t i, std::size_t j) -> Metric2& { return grid.roots[j * width + i]; };
  for (std::size_t j = 0; j <= 2 * rows; ++j)
    for (std::size_t i = 0; i <= 2 * columns; ++i) {
      if (i % 2 == 1 && j % 2 == 0) make_side_definite(root(i - 1, j), root(i, j), root(i + 1, j));
      if (i % 2 == 0 && j % 2 == 1) make_side_definite(root(i, j - 1), root(i, j), root(i, j + 1));
    }
  ControlSpace space;
  space.columns_ = columns;
  space.table_.clear(), space.leaves_.clear(), space.measures_.clear();
  space.leaves_.reserve(columns * rows), space.measures_.reserve(columns * rows), space.table_.reserve(columns * rows);
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i) {
      Nine v;
      for (std::size_t k = 0; k < 9; ++k) v[k] = root(2 * i + k % 3, 2 * j + k / 3);
      make_centre_definite(v);
      const double measure = grid.shares[j * columns + i] * mean_determinant(v) / (0.25 * std::numbers::sqrt3);
      space.table_.push_back(static_cast<std::int32_t>(space.leaves_.size()));
      space.leaves_.push_back(leaf_of(v, static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5, 2));
      space.measures_.push_back(measure);
      space.measure_ += measure;
    }
  const Vec2 sides = grid.high - grid.low, cell{sides.x() / grid.columns, sides.y() / grid.rows};
  space.low_ = grid.low;
  space.scale_ = {1 / cell.x(), 1 / cell.y()};
  space.last_ = {std::nextafter(static_cast<double>(columns), 0.0), std::nextafter(static_cast<double>(rows), 0.0)};
  space.unit_ = {1 / (cell.x() * cell.x()), 1 / (cell.x() * cell.y()), 1 / (cell.y() * cell.y())};
  space.samples_ = grid.roots.size();
  return space;
}

}  // namespace carreau
