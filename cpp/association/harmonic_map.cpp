// SPDX-License-Identifier: BSD-3-Clause
#include "association/harmonic_map.h"

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "association/thresholds.h"
#include "mesh/local_search.h"
#include "predicates/predicates.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "support/shares.h"

namespace carreau {

namespace {

using Triangle = std::array<std::int32_t, 3>;

// tan(angle / 2) of the angle between two vectors of the plane.
double half_tangent(const Vec2& a, const Vec2& b) {
  const double sine = std::abs(a.x() * b.y() - a.y() * b.x()), cosine = dot(a, b), lengths = norm(a) * norm(b);
  return lengths > 0 ? sine / std::max(lengths + cosine, 1e-9 * lengths) : 0;
}

/// Triangles around vertices.
class Fans {
 public:
  Fans(std::span<const Triangle> triangles, std::size_t n) : first_(n + 1, 0) {
    for (const Triangle& t : triangles)
      for (const std::int32_t v : t) ++first_[v + 1];
    for (std::size_t v = 1; v <= n; ++v) first_[v] += first_[v - 1];
    triangle_.resize(static_cast<std::size_t>(first_.back()));
    std::vector<std::int32_t> next = first_;
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (const std::int32_t v : triangles[t]) triangle_[next[v]++] = static_cast<std::int32_t>(t);
  }
  [[nodiscard]] std::span<const std::int32_t> of(std::int32_t v) const { return std::span(triangle_).subspan(first_[v], first_[v + 1] - first_[v]); }

 private:
  std::vector<std::int32_t> first_, triangle_;
};

class Untangler {
 public:
  Untangler(std::span<const Triangle> triangles, const std::vector<char>& fixed, std::vector<Vec2>& uv)
      : triangles_(triangles), fixed_(fixed), uv_(uv), fans_(triangles, uv.size()) {}

  std::vector<std::int32_t> run() {
    for (int pass = 0; pass < rounding_of::max_steps; ++pass) {
      const std::vector<std::int32_t> turned = turned_triangles();
      if (turned.empty()) return {};
      std::vector<std::int32_t> vertices;
      for (const std::int32_t t : turned)
        for (const std::int32_t v : triangles_[t])
          for (const std::int32_t beside : fans_.of(v)) vertices.insert(vertices.end(), triangles_[beside].begin(), triangles_[beside].end());
      std::sort(vertices.begin(), vertices.end());
      vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
      bool moved = false;
      for (const std::int32_t v : vertices)
        if (fixed_[v] == 0) moved = improve(v) || moved;
      if (!moved) break;
    }
    return turned_triangles();
  }

 private:
  [[nodiscard]] std::vector<std::int32_t> turned_triangles() const {
    std::vector<std::int32_t> turned;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const auto [a, b, c] = triangles_[t];
      if (orientation(uv_[a], uv_[b], uv_[c]) <= 0) turned.push_back(static_cast<std::int32_t>(t));
    }
    return turned;
  }

  // Least area of the triangles around; of valid ones over their longest side, so that shapes count.
  [[nodiscard]] double worst(std::int32_t v, double box) const {
    double least = infinity;
    for (const std::int32_t t : fans_.of(v)) {
      const auto [a, b, c] = triangles_[t];
      const Vec2 p = uv_[b] - uv_[a], q = uv_[c] - uv_[a], r = q - p;
      const double area = p.x() * q.y() - p.y() * q.x(), squares = dot(p, p) + dot(q, q) + dot(r, r);
      least = std::min(least, area > 0 ? area / squares : area / box);
    }
    return least;
  }

  bool improve(std::int32_t v) {
    Vec2 low = uv_[v], high = uv_[v];
    for (const std::int32_t t : fans_.of(v))
      for (const std::int32_t w : triangles_[t]) low = low.cwiseMin(uv_[w]), high = high.cwiseMax(uv_[w]);
    const Vec2 home = uv_[v], size = high - low;
    const double box = size.x() * size.y();
    if (!(box > 0)) return false;
    const double before = worst(v, box);
    const Vec2 by = search_along_compass(before, 0.5, shares::negligible, [&](const Vec2& place, double) {
      uv_[v] = home + place.cwiseProduct(size);
      return worst(v, box);
    });
    uv_[v] = home + by.cwiseProduct(size);
    return by != Vec2{0, 0};
  }

  std::span<const Triangle> triangles_;
  const std::vector<char>& fixed_;
  std::vector<Vec2>& uv_;
  Fans fans_;
};

}  // namespace

void map_harmonically(std::span<const Vec2> from, std::span<const Triangle> triangles, const std::vector<char>& known, std::vector<Vec2>& to) {
  std::vector<int> row(from.size(), -1);
  int n = 0;
  for (const Triangle& t : triangles)
    for (const std::int32_t v : t)
      if (known[v] == 0 && row[v] < 0) row[v] = n++;
  if (n == 0) return;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(n, 2);
  std::vector<double> sum(static_cast<std::size_t>(n), 0);
  const auto add = [&](std::int32_t v, std::int32_t w, double weight) {
    sum[row[v]] += weight;
    if (known[w] != 0)
      right.row(row[v]) += weight * to[w].transpose();
    else
      entries.emplace_back(row[v], row[w], -weight);
  };
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t v = t[i], p = t[(i + 1) % 3], q = t[(i + 2) % 3];
      if (known[v] != 0) continue;
      const Vec2 a = from[p] - from[v], b = from[q] - from[v];
      const double tangent = half_tangent(a, b);
      if (norm(a) > 0) add(v, p, tangent / norm(a));
      if (norm(b) > 0) add(v, q, tangent / norm(b));
    }
  for (int k = 0; k < n; ++k) entries.emplace_back(k, k, sum[k] > 0 ? sum[k] : 1);
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(matrix);
  const Eigen::MatrixX2d places = solver.solve(right);
  for (std::size_t v = 0; v < from.size(); ++v)
    if (row[v] >= 0) to[v] = places.row(row[v]).transpose();
}

std::vector<std::int32_t> untangle(std::span<const Triangle> triangles, const std::vector<char>& fixed, std::vector<Vec2>& uv) {
  return Untangler(triangles, fixed, uv).run();
}

}  // namespace carreau
