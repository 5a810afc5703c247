// SPDX-License-Identifier: BSD-3-Clause
#include "predicates/edge_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carreau {
namespace {

using Edges = std::span<const std::pair<int, int>>;

/// Lines at the quantiles of sorted values, the extremes included, without repetition.
std::vector<double> quantile_lines(const std::vector<double>& sorted, std::size_t intervals) {
  std::vector<double> lines;
  if (sorted.empty()) return {0, 0};
  for (std::size_t i = 0; i <= intervals; ++i) {
    const double line = sorted[(sorted.size() - 1) * i / intervals];
    if (lines.empty() || line > lines.back()) lines.push_back(line);
  }
  if (lines.size() == 1) lines.push_back(lines.front());
  return lines;
}

/// Mean number of lines that an edge crosses when there is a line at every vertex, divided by the number of lines.
double mean_span(const std::vector<double>& sorted, std::span<const Vec2> vertices, Edges edges, int axis) {
  const auto rank = [&](double value) {
    return static_cast<double>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
  };
  double sum = 0;
  for (const auto& [a, b] : edges) sum += std::abs(rank(vertices[a][axis]) - rank(vertices[b][axis]));
  return sum / (static_cast<double>(edges.size()) * static_cast<double>(sorted.size()));
}

std::vector<double> sorted_coordinates(std::span<const Vec2> vertices, Edges edges, int axis) {
  std::vector<double> values;
  values.reserve(2 * edges.size());
  for (const auto& [a, b] : edges) {
    values.push_back(vertices[a][axis]);
    values.push_back(vertices[b][axis]);
  }
  std::sort(values.begin(), values.end());
  return values;
}

/// The q at p = `at` on the segment from (pa, qa) to (pb, qb); wrong by a few ulp of qa and qb.
double intersection(double pa, double pb, double qa, double qb, double at) noexcept {
  if (at == pa || pa == pb) return qa;
  if (at == pb) return qb;
  // A difference of large doubles may overflow, the difference of their halves does not; halves of subnormal numbers
  // are not exact.
  const double s = std::max(std::abs(pa), std::abs(pb)) > 1 ? 0.5 : 1;
  const double w = (s * at - s * pa) / (s * pb - s * pa);
  return (1 - w) * qa + w * qb;
}

}  // namespace

EdgeGrid::EdgeGrid(std::span<const Vec2> vertices, Edges edges) {
  const std::vector<double> sorted_x = sorted_coordinates(vertices, edges, 0);
  const std::vector<double> sorted_y = sorted_coordinates(vertices, edges, 1);
  // About four cells an edge, but no more than some 16 cells met by an edge on average.
  const double n = static_cast<double>(std::max<std::size_t>(edges.size(), 1));
  const double cells = 4 * n, longest = 16;
  const auto limit = [&](double span) { return std::max(1.0, span > 0 ? longest / span : cells); };
  const double max_x = limit(edges.empty() ? 0 : mean_span(sorted_x, vertices, edges, 0));
  const double max_y = limit(edges.empty() ? 0 : mean_span(sorted_y, vertices, edges, 1));
  const double nx = std::clamp(std::sqrt(cells), std::min(cells / max_y, max_x), max_x);
  const double ny = std::clamp(cells / nx, 1.0, max_y);
  xs_ = quantile_lines(sorted_x, static_cast<std::size_t>(std::max(1.0, nx)));
  ys_ = quantile_lines(sorted_y, static_cast<std::size_t>(ny));

  first_.assign(static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows()) + 1, 0);
  std::vector<std::size_t> met;  // cells, edge by edge
  std::vector<std::size_t> end;
  met.reserve(4 * edges.size()), end.reserve(edges.size());
  for (const auto& [a, b] : edges) {
    visit_cells(vertices[a], vertices[b], [&](std::size_t cell) {
      ++first_[cell + 1];
      met.push_back(cell);
    });
    end.push_back(met.size());
  }
  for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
  edge_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (std::size_t e = 0, k = 0; e < edges.size(); ++e)
    for (; k < end[e]; ++k) edge_[static_cast<std::size_t>(next[met[k]]++)] = static_cast<int>(e);
}

int EdgeGrid::interval_of(const std::vector<double>& lines, double value) noexcept {
  const auto above = std::upper_bound(lines.begin() + 1, lines.end() - 1, value);
  return static_cast<int>(above - lines.begin()) - 1;
}

template <typename Visit>
void EdgeGrid::visit_cells(const Vec2& a, const Vec2& b, const Visit& visit) const {
  if (b.y() < a.y()) return visit_cells(b, a, visit);
  const double slack = 16 * std::numeric_limits<double>::epsilon();
  const double padding = slack * std::abs(a.x()) + slack * std::abs(b.x()) + 4 * std::numeric_limits<double>::denorm_min();
  const double leftmost = std::min(a.x(), b.x()), rightmost = std::max(a.x(), b.x());
  // A point on a line belongs to the closed cells on both sides of it.
  const int bottom = std::max(0, row_of(a.y()) - (ys_[row_of(a.y())] == a.y() ? 1 : 0)), top = row_of(b.y());
  for (int row = bottom; row <= top; ++row) {
    const double from = intersection(a.y(), b.y(), a.x(), b.x(), std::clamp(ys_[row], a.y(), b.y()));
    const double to = a.y() == b.y() ? b.x() : intersection(a.y(), b.y(), a.x(), b.x(), std::clamp(ys_[row + 1], a.y(), b.y()));
    const double low = std::max(leftmost, std::min(from, to) - padding);
    const double high = std::min(rightmost, std::max(from, to) + padding);
    int left = column_of(low);
    if (left > 0 && xs_[left] == low) --left;
    const int right = column_of(high);
    for (int column = left; column <= right; ++column)
      visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns()) + static_cast<std::size_t>(column));
  }
}

}  // namespace carreau
