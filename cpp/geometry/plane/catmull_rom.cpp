// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane/catmull_rom.h"

namespace carreau {

namespace {

/// Derivative at a point between two others (RR-2818 sec. 3.2).
Vec2 tangent_between(const Vec2& before, const Vec2& after) { return (after - before) / 2; }

}  // namespace

std::vector<CubicPiece> catmull_rom(std::span<const Vec2> points, const SplineEnds& ends) {
  const std::size_t n = points.size();
  std::vector<std::optional<Vec2>> tangents(n);
  for (std::size_t i = 1; i + 1 < n; ++i) tangents[i] = tangent_between(points[i - 1], points[i + 1]);
  if (ends.tangent_start)
    tangents.front() = ends.tangent_start;
  else if (ends.before)
    tangents.front() = tangent_between(*ends.before, points[1]);
  if (ends.tangent_end)
    tangents.back() = ends.tangent_end;
  else if (ends.after)
    tangents.back() = tangent_between(points[n - 2], *ends.after);
  const bool wraps = n > 2 && points.front() == points.back() && !tangents.front() && !tangents.back();
  if (wraps) tangents.front() = tangents.back() = tangent_between(points[n - 2], points[1]);
  std::vector<CubicPiece> pieces;
  for (std::size_t i = 0; i + 1 < n; ++i)
    pieces.push_back(piece_between(points[i], points[i + 1], tangents[i], tangents[i + 1]));
  return pieces;
}

std::vector<CubicPiece> straight_pieces(std::span<const Vec2> points) {
  std::vector<CubicPiece> pieces;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    pieces.push_back(piece_between(points[i], points[i + 1], std::nullopt, std::nullopt));
  return pieces;
}

}  // namespace carreau
