// SPDX-License-Identifier: BSD-3-Clause
#include "variable/base/size_map.h"

#include <algorithm>

#include "gradation/smallest_first.h"
#include "support/monitor.h"

namespace carreau::variable {

std::vector<double> damage_sizes(const Piece& piece, std::span<const double> damage, double h_min, double h_max) {
  std::vector<double> worst(piece.vertices.size(), 0);
  for (std::size_t t = 0; t < damage.size(); ++t)
    for (const std::int32_t v : piece.triangles[t]) {
      double& d = worst[static_cast<std::size_t>(v)];
      d = std::max(d, damage[t]);
    }
  for (double& d : worst) d = h_max + std::min(d, 1.0) * (h_min - h_max);
  return worst;
}

void grade_sizes(const Piece& piece, double slope, std::vector<double>& sizes) {
  std::vector<std::vector<std::int32_t>> triangles_at(piece.vertices.size());
  for (std::size_t t = 0; t < piece.triangles.size(); ++t)
    for (const std::int32_t v : piece.triangles[t])
      triangles_at[static_cast<std::size_t>(v)].push_back(static_cast<std::int32_t>(t));
  SmallestFirst queue;
  for (std::size_t v = 0; v < sizes.size(); ++v) queue.push(sizes[v], static_cast<int>(v));
  Monitor monitor;
  queue.run([&](double size, int v) { return size == sizes[static_cast<std::size_t>(v)]; },
            [&](int v) {
              const auto from = static_cast<std::size_t>(v);
              for (const std::int32_t t : triangles_at[from])
                for (const std::int32_t w : piece.triangles[static_cast<std::size_t>(t)]) {
                  const auto to = static_cast<std::size_t>(w);
                  const double most = sizes[from] + slope * norm(piece.vertices[to] - piece.vertices[from]);
                  if (most < sizes[to]) queue.push(sizes[to] = most, w);
                }
            },
            monitor);
}

double SizeMap::bounded(double size, const Vec2& p) const {
  if (!sources_.empty()) size = sources_.at({p.x(), p.y(), 0}, size);
  return std::clamp(size, bounds_.h_min, bounds_.h_max);
}

double SizeMap::at(const Vec2& p, std::int32_t& guess) const {
  const NearestOnMesh found = search_->nearest({p.x(), p.y(), 0}, guess);
  guess = found.triangle;
  double size = 0;
  for (std::size_t k = 0; k < 3; ++k)
    size += found.weight[k] *
            sizes_[static_cast<std::size_t>(piece_->triangles[static_cast<std::size_t>(found.triangle)][k])];
  return bounded(size, p);
}

double SizeMap::between(std::array<std::int32_t, 2> vertices, double t, const Vec2& p) const {
  return bounded(
      (1 - t) * sizes_[static_cast<std::size_t>(vertices[0])] + t * sizes_[static_cast<std::size_t>(vertices[1])], p);
}

}  // namespace carreau::variable
