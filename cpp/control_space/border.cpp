// SPDX-License-Identifier: BSD-3-Clause
#include "control_space/border.h"

#include <algorithm>
#include <cmath>

#include "control_space/quadratic_fit.h"
#include "control_space/thresholds.h"
#include "metric/metric2_algebra.h"
#include "predicates/clamped_int.h"
#include "support/infinity.h"
#include "support/rounding_of.h"

namespace carreau::detail {

namespace {

using namespace thresholds::control_space;

// Clamps a root to bounds by the eigenvalues of `near`. The bounds are computed exactly only if it may be outside.
template <class Samples>
Metric2 clamped_to(const Samples& near, Metric2 root) noexcept {
  // Bounds for each sample: the larger eigenvalue is at least half of the trace, the smaller at most twice determinant
  // over trace.
  double above = 0, below = infinity;
  for (const auto& s : near) {
    const double trace = s.root.a + s.root.c;
    above = std::max(above, 0.5 * trace);
    below = std::min(below, 2 * determinant(s.root) / trace);
  }
  const auto spread = [](Metric2 m) {
    const double across = m.a - m.c;
    return std::sqrt(across * across + 4 * m.b * m.b);
  };
  const double trace = root.a + root.c, s = spread(root);
  if (0.5 * (trace + s) < (1 - rounding_of::sizes) * max_extrapolation * above &&
      0.5 * (trace - s) > rounding_of::sizes * trace + below / max_extrapolation)
    return root;
  double low = infinity, high = 0;
  for (const auto& sample : near) {
    const double major = 0.5 * (sample.root.a + sample.root.c + spread(sample.root));
    low = std::min(low, accurate_determinant(sample.root) / major);
    high = std::max(high, major);
  }
  return clamp_eigenvalues(root, low / max_extrapolation, max_extrapolation * high);
}

}  // namespace

BorderSamples::BorderSamples(const Lattice& lattice)
    : lattice_(lattice),
      columns_(lattice.end().i / lattice.step()),
      rows_(lattice.end().j / lattice.step()),
      in_cell_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

void BorderSamples::add(Vec2 position, Metric2 root) {
  const int i = clamped_int(position.x() / lattice_.step(), 0, columns_ - 1);
  const int j = clamped_int(position.y() / lattice_.step(), 0, rows_ - 1);
  in_cell_[static_cast<std::size_t>(j * columns_ + i)].push_back(static_cast<std::int32_t>(samples_.size()));
  samples_.push_back({position, root});
}

void BorderSamples::sort_nodes() {
  const std::span<const std::int32_t> sampled = lattice_.samples();
  const std::size_t known = nodes_.size();
  for (std::size_t k = known; k < sampled.size(); ++k) nodes_.push_back({lattice_.point(sampled[k]), sampled[k]});
  const auto before = [](const NodeAt& p, const NodeAt& q) { return p.p.j != q.p.j ? p.p.j < q.p.j : p.p.i < q.p.i; };
  const auto fresh = nodes_.begin() + static_cast<std::ptrdiff_t>(known);
  std::sort(fresh, nodes_.end(), before);
  std::inplace_merge(nodes_.begin(), fresh, nodes_.end(), before);
}

void BorderSamples::collect(Vec2 centre, double reach, std::int32_t spacing, std::vector<Sample>& found) {
  found.clear();
  const auto cells = [&](double x, int count) {
    return clamped_int(x / lattice_.step(), 0, count - 1);
  };
  const int i0 = cells(centre.x() - reach, columns_), i1 = cells(centre.x() + reach, columns_);
  const int j0 = cells(centre.y() - reach, rows_), j1 = cells(centre.y() + reach, rows_);
  for (int j = j0; j <= j1; ++j)
    for (int i = i0; i <= i1; ++i)
      for (const std::int32_t k : in_cell_[static_cast<std::size_t>(j * columns_ + i)]) {
        const Vec2 d = samples_[k].position - centre;
        if (std::max(std::abs(d.x()), std::abs(d.y())) <= reach) found.push_back(samples_[k]);
      }
  // Far nodes of the finer of both grids would cost time and add little.
  const double near = near_share * reach;
  const auto is_left_out = [&](std::int32_t i, std::int32_t j) {
    const bool fine = ((i | j) & spacing) != 0;
    return fine && (std::abs(i - centre.x()) > near || std::abs(j - centre.y()) > near);
  };
  const auto lowest = [&](double x) { return static_cast<std::int32_t>(std::ceil(std::max(x - reach, 0.))); };
  const auto highest = [&](double x, std::int32_t end) {
    return static_cast<std::int32_t>(std::floor(std::min<double>(x + reach, end)));
  };
  // So few nodes are searched faster one by one than by the places of a grid. [time only]
  if (lattice_.samples().size() <= 400) {
    if (nodes_.size() < lattice_.samples().size()) sort_nodes();
    const std::int32_t left = lowest(centre.x()), right = highest(centre.x(), lattice_.end().i);
    const std::int32_t bottom = lowest(centre.y()), top = highest(centre.y(), lattice_.end().j);
    auto n = std::lower_bound(nodes_.begin(), nodes_.end(), bottom,
                              [](const NodeAt& at, std::int32_t j) { return at.p.j < j; });
    for (; n != nodes_.end() && n->p.j <= top; ++n) {
      const auto [i, j] = n->p;
      if (i < left || i > right || ((i | j) & (spacing - 1)) != 0 || is_left_out(i, j)) continue;
      found.push_back({{static_cast<double>(i), static_cast<double>(j)}, lattice_.value(n->node)});
    }
    return;
  }
  const auto first = [&](double x) {
    return std::max(0, static_cast<std::int32_t>(std::ceil((x - reach) / spacing)) * spacing);
  };
  const double right = std::min<double>(centre.x() + reach, lattice_.end().i);
  const double top = std::min<double>(centre.y() + reach, lattice_.end().j);
  for (std::int32_t j = first(centre.y()); j <= top; j += spacing)
    for (std::int32_t i = first(centre.x()); i <= right; i += spacing) {
      if (is_left_out(i, j)) continue;
      if (const Metric2* root = lattice_.sample({i, j}))
        found.push_back({{static_cast<double>(i), static_cast<double>(j)}, *root});
    }
}

Metric2 BorderSamples::fit(Vec2 position, std::int32_t size) {
  std::vector<Sample> near;
  near.reserve(48);
  double scale = size;
  const double widest = 2.0 * std::max(lattice_.end().i, lattice_.end().j);
  // At widened reaches the grid is read with the spacing of wider cells.
  std::int32_t spacing = std::max(size / 2, 1);
  collect(position, reach_in_sizes * scale, spacing, near);
  while (near.size() < enough_neighbours && scale < widest) {
    scale *= 2;
    if (spacing < lattice_.step()) spacing *= 2;
    std::vector<Sample> more;
    collect(position, reach_in_sizes * scale, spacing, more);
    // A wider but sparser neighbourhood may miss near samples.
    if (more.size() > near.size()) near.swap(more);
  }
  QuadraticFit equations;
  for (const Sample& s : near) {
    const Vec2 d = (1 / scale) * (s.position - position);
    const double q = softness + dot(d, d);
    equations.add(d.x(), d.y(), 1 / (q * q), s.root);
  }
  return clamped_to(near, equations.value_at_origin());
}

}  // namespace carreau::detail
