// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/grid/differences.h"

#include <algorithm>

namespace carreau::grid {

Vec3 parabola_derivative(const Sample& a, const Sample& b, const Sample& c, double at) {
  const Vec3 ab = (b.p - a.p) / (b.x - a.x), bc = (c.p - b.p) / (c.x - b.x);
  const Vec3 bend = (bc - ab) / (c.x - a.x);  // half the second derivative
  return ab + (2 * at - a.x - b.x) * bend;
}

namespace {

/// Derivatives of points [first, last) of the line, all of them present.
void differentiate_run(std::span<const Sample> run, std::span<Vec3> out) {
  const std::size_t n = run.size();
  if (n < 2) return;
  if (n == 2) {
    out[0] = out[1] = (run[1].p - run[0].p) / (run[1].x - run[0].x);
    return;
  }
  out[0] = parabola_derivative(run[0], run[1], run[2], run[0].x);
  for (std::size_t k = 1; k + 1 < n; ++k) out[k] = parabola_derivative(run[k - 1], run[k], run[k + 1], run[k].x);
  out[n - 1] = parabola_derivative(run[n - 3], run[n - 2], run[n - 1], run[n - 1].x);
}

}  // namespace

std::vector<Vec3> line_derivatives(std::span<const Sample> line, std::span<const char> there, bool closed) {
  const std::size_t n = line.size();
  std::vector<Vec3> out(n);
  for (std::size_t k = 0; k < n;) {
    std::size_t end = k;
    while (end < n && there[end] != 0) ++end;
    differentiate_run(line.subspan(k, end - k), std::span(out).subspan(k, end - k));
    k = end + 1;
  }
  if (closed && n > 3 && there[0] != 0 && there[1] != 0 && there[n - 2] != 0) {
    const Sample before{line[0].x - (line[n - 1].x - line[n - 2].x), line[n - 2].p};
    out[0] = out[n - 1] = parabola_derivative(before, line[0], line[1], line[0].x);
  }
  return out;
}

namespace {

/// A line of the system of a spline: below d(k-1) + at d(k) + above d(k+1) = right.
struct Equation {
  double below = 0, at = 1, above = 0;
  Vec3 right = Vec3::Zero();
};

void solve_tridiagonal(std::vector<Equation>& rows, std::span<Vec3> out) {
  const std::size_t n = rows.size();
  for (std::size_t k = 1; k < n; ++k) {
    const double factor = rows[k].below / rows[k - 1].at;
    rows[k].at -= factor * rows[k - 1].above;
    rows[k].right -= factor * rows[k - 1].right;
  }
  for (std::size_t k = n; k-- > 0;) out[k] = (k + 1 < n ? Vec3(rows[k].right - rows[k].above * out[k + 1]) : rows[k].right) / rows[k].at;
}

/// Equal second derivatives on both sides of b.
Equation inner_equation(const Sample& a, const Sample& b, const Sample& c) {
  const double before = b.x - a.x, after = c.x - b.x;
  const Vec3 ab = (b.p - a.p) / before, bc = (c.p - b.p) / after;
  return {after, 2 * (before + after), before, 3 * (after * ab + before * bc)};
}

/// Equal third derivatives on both sides of b, with the inner equation at b: for the end a.
Equation end_equation(const Sample& a, const Sample& b, const Sample& c) {
  const double near = b.x - a.x, far = c.x - b.x, both = near + far;
  const Vec3 ab = (b.p - a.p) / near, bc = (c.p - b.p) / far;
  return {0, far, both, ((near + 2 * both) * far * ab + near * near * bc) / both};
}

void spline_run(std::span<const Sample> run, std::span<const std::optional<Vec3>> given, std::span<Vec3> out) {
  const std::size_t n = run.size();
  const bool free = std::none_of(given.begin(), given.end(), [](const std::optional<Vec3>& d) { return d.has_value(); });
  if (free && n <= 3) return differentiate_run(run, out);
  std::vector<Equation> rows(n);
  for (std::size_t k = 1; k + 1 < n; ++k) rows[k] = inner_equation(run[k - 1], run[k], run[k + 1]);
  if (n > 3) {
    rows[0] = end_equation(run[0], run[1], run[2]);
    rows[n - 1] = end_equation(run[n - 1], run[n - 2], run[n - 3]);
    std::swap(rows[n - 1].below, rows[n - 1].above);
  } else {  // no second derivative at ends that are free
    for (const auto& [end, next] : {std::pair<std::size_t, std::size_t>{0, 1}, {n - 1, n - 2}})
      if (n > 1) rows[end] = {end == 0 ? 0. : 1., 2, end == 0 ? 1. : 0., 3 * (run[next].p - run[end].p) / (run[next].x - run[end].x)};
  }
  for (std::size_t k = 0; k < given.size(); ++k)
    if (given[k]) rows[k] = {0, 1, 0, *given[k]};
  solve_tridiagonal(rows, out);
}

/// The last point is the first one. The corners of the cyclic matrix are a product of vectors (Sherman and Morrison).
void spline_closed(std::span<const Sample> line, std::span<Vec3> out) {
  const std::size_t n = line.size() - 1;  // of unknowns
  std::vector<Equation> rows(n);
  for (std::size_t k = 0; k < n; ++k) {
    const Sample before = k > 0 ? line[k - 1] : Sample{line[0].x - (line[n].x - line[n - 1].x), line[n - 1].p};
    rows[k] = inner_equation(before, line[k], line[k + 1]);
  }
  const double first = rows[0].below, last = rows[n - 1].above, pivot = -rows[0].at;
  rows[0].at -= pivot, rows[n - 1].at -= first * last / pivot;
  std::vector<Equation> unit = rows;
  for (Equation& row : unit) row.right = Vec3::Zero();
  unit[0].right.x() = pivot, unit[n - 1].right.x() = last;
  std::vector<Vec3> correction(n);
  solve_tridiagonal(rows, out.first(n));
  solve_tridiagonal(unit, correction);
  const double share = first / pivot;
  const Vec3 amount = (out[0] + share * out[n - 1]) / (1 + correction[0].x() + share * correction[n - 1].x());
  for (std::size_t k = 0; k < n; ++k) out[k] -= correction[k].x() * amount;
  out[n] = out[0];
}

}  // namespace

std::vector<Vec3> spline_derivatives(std::span<const Sample> line, std::span<const char> there, bool closed,
                                     std::span<const std::optional<Vec3>> given) {
  const std::size_t n = line.size();
  std::vector<Vec3> out(n, Vec3::Zero());
  const bool whole = std::find(there.begin(), there.end(), 0) == there.end();
  const bool free = std::none_of(given.begin(), given.end(), [](const std::optional<Vec3>& d) { return d.has_value(); });
  if (closed && whole && free && n > 3) return spline_closed(line, out), out;
  // A closed line with a gap is run through from there, across its joint.
  std::size_t first = 0;
  if (closed && !whole && there[0] != 0 && there[n - 1] != 0) first = static_cast<std::size_t>(std::find(there.begin(), there.end(), 0) - there.begin());
  std::vector<Sample> run;
  std::vector<std::optional<Vec3>> prescribed;
  std::vector<std::size_t> places;
  const auto finish = [&] {
    std::vector<Vec3> d(run.size(), Vec3::Zero());
    spline_run(run, prescribed, d);
    for (std::size_t k = 0; k < run.size(); ++k) out[places[k]] = d[k];
    run.clear(), prescribed.clear(), places.clear();
  };
  const double period = line[n - 1].x - line[0].x;
  for (std::size_t step = 0; step < n; ++step) {
    const std::size_t k = (first + step) % n;
    const bool wrapped = first + step >= n;
    if (there[k] == 0) finish();
    if (there[k] == 0 || (wrapped && k == 0)) continue;  // the joint is there already
    run.push_back({line[k].x + (wrapped ? period : 0), line[k].p}), places.push_back(k);
    if (!given.empty()) prescribed.push_back(given[k]);
  }
  finish();
  if (first > 0) out[0] = out[n - 1];
  return out;
}

}  // namespace carreau::grid
