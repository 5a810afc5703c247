// SPDX-License-Identifier: BSD-3-Clause
#include "variable/transfer/slopes.h"

#include <algorithm>
#include <cmath>

namespace carreau::variable {

Vec2 centre_of(const Piece& piece, std::size_t triangle) noexcept {
  const auto& v = piece.triangles[triangle];
  return (piece.vertices[static_cast<std::size_t>(v[0])] + piece.vertices[static_cast<std::size_t>(v[1])] +
          piece.vertices[static_cast<std::size_t>(v[2])]) /
         3;
}

namespace {

/// Sums of the normal equations, and the range of values.
struct Fit {
  double xx = 0, xy = 0, yy = 0, low = 0, high = 0;
  Vec2 right{0, 0};

  void add(const Vec2& d, double difference) noexcept {
    xx += d.x() * d.x(), xy += d.x() * d.y(), yy += d.y() * d.y();
    right += difference * d;
    low = std::min(low, difference), high = std::max(high, difference);
  }
  /// Zero if the neighbours lie in a line, or nearly so.
  [[nodiscard]] Vec2 slope() const noexcept {
    const double det = xx * yy - xy * xy;
    if (!(det > 1e-3 * (xx + yy) * (xx + yy))) return {0, 0};
    return {(yy * right.x() - xy * right.y()) / det, (xx * right.y() - xy * right.x()) / det};
  }
};

}  // namespace

std::vector<Vec2> limited_slopes(const Piece& piece, const Adjacency& adjacency, std::span<const double> values,
                                 std::size_t components, std::size_t c) {
  std::vector<Vec2> slopes;
  slopes.reserve(piece.triangles.size());
  for (std::size_t t = 0; t < piece.triangles.size(); ++t) {
    const Vec2 centre = centre_of(piece, t);
    Fit fit;
    for (const std::int32_t n : adjacency[t])
      if (n >= 0)
        fit.add(centre_of(piece, static_cast<std::size_t>(n)) - centre,
                values[components * static_cast<std::size_t>(n) + c] - values[components * t + c]);
    const Vec2 slope = fit.slope();
    double share = 1;
    for (const std::int32_t v : piece.triangles[t]) {
      const double rise = dot(slope, piece.vertices[static_cast<std::size_t>(v)] - centre);
      if (rise > fit.high) share = std::min(share, fit.high / rise);
      if (rise < fit.low) share = std::min(share, fit.low / rise);
    }
    slopes.emplace_back(share * slope);
  }
  return slopes;
}

}  // namespace carreau::variable
