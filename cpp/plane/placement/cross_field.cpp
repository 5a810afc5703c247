// SPDX-License-Identifier: BSD-3-Clause
#include "plane/placement/cross_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "plane/kernel/thresholds.h"
#include "support/infinity.h"
#include "support/work_sizes.h"

namespace carreau::plane {

namespace {

using Complex = std::complex<double>;

Complex unit(Complex z) noexcept {
  const double size = std::sqrt(std::norm(z));
  return size > 0 ? z / size : Complex(1, 0);
}
Complex fourth_power(Complex z) noexcept {
  const Complex z2(z.real() * z.real() - z.imag() * z.imag(), 2 * z.real() * z.imag());
  return {z2.real() * z2.real() - z2.imag() * z2.imag(), 2 * z2.real() * z2.imag()};
}
Complex times(Complex a, Complex b) noexcept {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

// Square root of a unit number, on the side of positive ones.
Complex square_root(Complex z) noexcept {
  if (z.real() >= 0) {
    const double x = std::sqrt((1 + z.real()) / 2);
    return {x, z.imag() / (2 * x)};
  }
  const double y = std::copysign(std::sqrt((1 - z.real()) / 2), z.imag());
  return {z.imag() / (2 * y), y};
}

/// Minimise the sum of |x_i - t_ij x_j|^2 over links: one level of cascadic aggregation.
struct Level {
  struct Link {
    std::int32_t to;
    Complex transport;  // of the cross at `to` to here, times its weight
  };
  std::vector<std::int32_t> start;
  std::vector<Link> links;
  std::vector<double> diagonal;
  std::vector<Complex> value;
  std::vector<char> fixed;
  std::vector<std::int32_t> aggregate;  // node of the coarser level
  std::vector<Complex> up;              // the remote cross, in the frame here

  [[nodiscard]] std::size_t size() const { return value.size(); }
};

/// Links from unsorted triples.
struct Triple {
  std::int32_t from, to;
  Complex transport;
};
// Stable sort of a few items.
template <typename Iterator, typename Less>
void insertion_sort(Iterator first, Iterator last, const Less& less) {
  for (Iterator x = first; x != last; ++x)
    for (Iterator y = x; y != first && less(*y, *(y - 1)); --y) std::iter_swap(y, y - 1);
}

void set_links(Level& level, const std::vector<Triple>& triples) {
  std::vector<std::int32_t> end(level.size() + 1, 0);
  for (const Triple& t : triples) ++end[t.from + 1];
  for (std::size_t i = 0; i < level.size(); ++i) end[i + 1] += end[i];
  std::vector<Level::Link> all(triples.size());
  for (const Triple& t : triples) all[end[t.from]++] = {t.to, t.transport};  // end[i] is the end of row i afterwards
  level.start.reserve(level.size() + 1), level.links.reserve(triples.size());
  level.start.assign(1, 0);
  for (std::size_t i = 0, first = 0; i < level.size(); ++i) {
    const auto row = all.begin() + static_cast<std::ptrdiff_t>(first), last = all.begin() + end[i];
    insertion_sort(row, last, [](const Level::Link& a, const Level::Link& b) { return a.to < b.to; });
    for (auto link = row; link != last; ++link) {
      if (link != row && level.links.back().to == link->to)
        level.links.back().transport += link->transport;
      else
        level.links.push_back(*link);
    }
    level.start.push_back(static_cast<std::int32_t>(level.links.size()));
    first = static_cast<std::size_t>(end[i]);
  }
}

// Pairs of free nodes become one, each with the neighbour that it is linked to most.
void aggregate(Level& fine, Level& coarse, Monitor& monitor) {
  const auto n = static_cast<std::int32_t>(fine.size());
  fine.aggregate.assign(fine.size(), -1);
  fine.up.assign(fine.size(), Complex(1, 0));
  std::int32_t count = 0;
  for (std::int32_t i = 0; i < n; ++i) {
    if (i % work_sizes::steps == 0) monitor.checkpoint();
    if (fine.aggregate[i] >= 0) continue;
    fine.aggregate[i] = count;
    for (int members = 1; members < 4 && fine.fixed[i] == 0; ++members) {
      std::int32_t best = -1;
      for (std::int32_t k = fine.start[i]; k < fine.start[i + 1]; ++k) {
        const std::int32_t j = fine.links[k].to;
        if (fine.aggregate[j] < 0 && fine.fixed[j] == 0 &&
            (best < 0 || std::norm(fine.links[k].transport) > std::norm(fine.links[best].transport)))
          best = k;
      }
      if (best < 0) break;
      const std::int32_t j = fine.links[best].to;
      fine.aggregate[j] = count;
      fine.up[j] = std::conj(unit(fine.links[best].transport));
    }
    ++count;
  }
  coarse.value.assign(static_cast<std::size_t>(count), Complex(0, 0));
  coarse.fixed.assign(static_cast<std::size_t>(count), 0);
  coarse.diagonal.assign(static_cast<std::size_t>(count), 0);
  std::vector<Triple> triples;
  triples.reserve(fine.links.size());
  for (std::int32_t i = 0; i < n; ++i) {
    if (i % work_sizes::steps == 0) monitor.checkpoint();
    const std::int32_t I = fine.aggregate[i];
    if (fine.fixed[i] != 0) coarse.fixed[I] = 1, coarse.value[I] = fine.value[i];
    coarse.diagonal[I] += fine.diagonal[i];
    for (std::int32_t k = fine.start[i]; k < fine.start[i + 1]; ++k) {
      const std::int32_t j = fine.links[k].to, J = fine.aggregate[j];
      const Complex transport = times(times(std::conj(fine.up[i]), fine.links[k].transport), fine.up[j]);
      if (I == J)
        coarse.diagonal[I] -= transport.real();
      else
        triples.push_back({I, J, transport});
    }
  }
  set_links(coarse, triples);
}

// Until nothing moves any more.
void relax(Level& level, int sweeps, Monitor& monitor) {
  const auto n = static_cast<std::int32_t>(level.size());
  double moved = infinity;  // squared, in one sweep
  for (int sweep = 0; sweep < sweeps && moved > cross_at_rest * cross_at_rest; ++sweep) {
    monitor.checkpoint();
    moved = 0;
    for (std::int32_t m = 0; m < n; ++m) {
      const std::int32_t i = sweep % 2 == 0 ? m : n - 1 - m;
      if (level.fixed[i] != 0) continue;
      Complex sum(0, 0);
      for (std::int32_t k = level.start[i]; k < level.start[i + 1]; ++k)
        sum += times(level.links[k].transport, level.value[level.links[k].to]);
      if (!(level.diagonal[i] > 0)) continue;
      const Complex now = (1 / level.diagonal[i]) * sum;
      moved = std::max(moved, std::norm(now - level.value[i]));
      level.value[i] = now;
    }
  }
}

void solve(std::vector<Level>& levels, Monitor& monitor) {
  while (levels.back().size() > coarsest_crosses) {
    Level coarse;
    aggregate(levels.back(), coarse, monitor);
    if (coarse.size() * 10 > levels.back().size() * 9) break;
    levels.push_back(std::move(coarse));
  }
  relax(levels.back(), 200, monitor);
  for (std::size_t l = levels.size() - 1; l-- > 0;) {
    Level &fine = levels[l], &coarse = levels[l + 1];
    for (std::size_t i = 0; i < fine.size(); ++i)
      if (fine.fixed[i] == 0) fine.value[i] = times(fine.up[i], coarse.value[fine.aggregate[i]]);
    relax(fine, cross_sweeps, monitor);
  }
}

void fix_at_imposed_edges(const Triangulation& mesh, const std::vector<MetricFrame>& frames, Level& level) {
  for (const Triangle& T : mesh.triangles) {
    if (T.v[0] < 0) continue;
    for (int i = 0; i < 3; ++i) {
      if (((T.imposed | (T.n[i] == no_edge ? 1 << i : 0)) >> i & 1) == 0 || (T.degenerate >> i & 1) != 0) continue;
      const std::int32_t a = T.v[next3[i]], b = T.v[prev3[i]];
      const Vec2 d = mesh.at(b) - mesh.at(a);
      level.value[a] += fourth_power(unit(frames[a].to_frame(d)));
      level.value[b] += fourth_power(unit(frames[b].to_frame(d)));
    }
  }
  for (std::size_t v = 0; v < level.size(); ++v) {
    const double size = std::sqrt(std::norm(level.value[v]));
    if (size > min_cross)
      level.fixed[v] = 1, level.value[v] /= size;
    else
      level.value[v] = 0;
  }
}

}  // namespace

MetricFrame::MetricFrame(Metric2 m) noexcept
    : p(std::sqrt(m.a)), q(m.b / p), r(std::sqrt(std::max(m.c - q * q, 1e-12 * m.c))) {}

CrossField::CrossField(const Triangulation& mesh, Monitor& monitor) : mesh_(mesh) {
  frames_.reserve(mesh.vertices.size());
  for (const Vertex& v : mesh.vertices) frames_.emplace_back(v.metric());
  std::vector<Level> levels(1);
  Level& level = levels.front();
  level.value.assign(frames_.size(), Complex(0, 0));
  level.fixed.assign(frames_.size(), 0);
  level.diagonal.assign(frames_.size(), 0);
  fix_at_imposed_edges(mesh, frames_, level);
  std::vector<Triple> triples;
  triples.reserve(3 * mesh.triangles.size());
  monitor.checkpoint();
  for (const Triangle& T : mesh.triangles) {
    if (T.v[0] < 0) continue;
    for (int i = 0; i < 3; ++i) {
      const std::int32_t a = T.v[next3[i]], b = T.v[prev3[i]];
      if (T.n[i] != no_edge && a > b) continue;
      const Vec2 d = mesh.at(b) - mesh.at(a);
      const Complex turn = unit(times(frames_[a].to_frame(d), std::conj(frames_[b].to_frame(d))));
      const Complex transport = fourth_power(turn);  // from b to a
      triples.push_back({a, b, transport});
      triples.push_back({b, a, std::conj(transport)});
      level.diagonal[a] += 1, level.diagonal[b] += 1;
    }
  }
  monitor.checkpoint();
  set_links(level, triples);
  solve(levels, monitor);
  cross_ = std::move(levels.front().value);
  for (Complex& z : cross_) z = unit(z);
}

Complex CrossField::arm(const Vec2& p, const MetricFrame& at_p, int& triangle) const {
  const int found = mesh_.locate_near(p, triangle, 64);
  if (found >= 0) triangle = found;
  const Triangle& T = mesh_.triangles[triangle];
  const Vec2 a = mesh_.at(T.v[0]), b = mesh_.at(T.v[1]), c = mesh_.at(T.v[2]);
  const std::array<double, 3> weight{std::max(0., cross(b - p, c - p)), std::max(0., cross(c - p, a - p)),
                                     std::max(0., cross(a - p, b - p))};
  Complex sum(0, 0);
  for (int i = 0; i < 3; ++i) {
    if (weight[i] == 0) continue;
    const Vec2 d = p - mesh_.at(T.v[i]);
    Complex z = cross_[T.v[i]];
    if (d != Vec2{0, 0})
      z = times(z, fourth_power(unit(times(at_p.to_frame(d), std::conj(frames_[T.v[i]].to_frame(d))))));
    sum += weight[i] * z;
  }
  return square_root(square_root(unit(sum)));
}

}  // namespace carreau::plane
