// SPDX-License-Identifier: BSD-3-Clause
#include "surface/layers/middle_columns.h"

#include <algorithm>
#include <cmath>

#include "support/rounding_of.h"
#include "support/shares.h"
#include "surface/layers/row_face.h"
#include "surface/layers/surface_step.h"
#include "surface/layers/thresholds.h"

namespace carreau {

std::vector<std::array<std::size_t, 2>> piles_of(std::span<const LayerCell> cells) {
  std::vector<std::array<std::size_t, 2>> piles;
  const auto lies_on = [](const LayerCell& high, const LayerCell& low) {
    const std::int32_t left = low.is_triangle() ? low.corners[2] : low.corners[3], right = low.corners[low.is_triangle() ? 1 : 2];
    return high.row == low.row + 1 && high.corners[0] == left && high.corners[1] == right;
  };
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (c > 0 && lies_on(cells[c], cells[c - 1]))
      ++piles.back()[1];
    else
      piles.push_back({c, c + 1});
  }
  return piles;
}

PileSides::PileSides(std::span<const LayerCell> pile) {
  const LayerCell& first = pile.front();
  left.push_back(first.corners[0]), right.push_back(first.corners[first.is_triangle() ? 0 : 1]);
  for (const LayerCell& cell : pile) {
    left.push_back(cell.corners[cell.is_triangle() ? 2 : 3]);
    right.push_back(cell.corners[cell.is_triangle() ? 1 : 2]);
  }
}

std::vector<ColumnPlace> middle_column(Cad& cad, int face, const ColumnPlace& base, std::span<const ColumnPlace> left,
                                        std::span<const ColumnPlace> right, std::span<const double> heights) {
  std::vector<ColumnPlace> column{base};
  const auto way = [](std::span<const ColumnPlace> side, std::size_t k) -> Vec3 { return side[k + 1].xyz - side[k].xyz; };
  const SurfaceJet foot = surface_at(cad, face, want_position | want_first, base.uv);
  const Vec3 normal = RowFace::unit(cross(foot.su, foot.sv));
  // The base divides the edge, and its offset from the chord shrinks like the square of the edges' lengths.
  const Vec3 whole = right[0].xyz - left[0].xyz;
  const double length2 = dot(whole, whole), share = length2 > 0 ? std::clamp(dot(base.xyz - left[0].xyz, whole) / length2, 0.0, 1.0) : 0.5;
  const Vec2 offset = base.uv - left[0].uv - share * (right[0].uv - left[0].uv);
  if (heights.empty()) {
    for (std::size_t k = 1; k < left.size(); ++k) {
      const Vec3 edge = right[k].xyz - left[k].xyz;
      const double shrunk = length2 > 0 ? std::min(dot(edge, edge) / length2, 1.0) : 0;
      const Vec2 uv = left[k].uv + share * (right[k].uv - left[k].uv) + shrunk * offset;
      column.push_back({uv, surface_at(cad, face, want_position, uv).s});
    }
    return column;
  }
  const Vec3 up = RowFace::unit((1 - share) * RowFace::unit(way(left, 0)) + share * RowFace::unit(way(right, 0)));
  const ColumnPlane plane{base.xyz, RowFace::unit(cross(normal, up))};
  // The step for a height of 1: chords turn at the base, and the column may lean.
  const Vec3 in = RowFace::unit(base.xyz - left[0].xyz), out = RowFace::unit(right[0].xyz - base.xyz), chord = in + out;
  const double cosine = norm(chord) > 0 ? 0.5 * norm(chord) * dot(up, RowFace::unit(cross(normal, chord))) : 1;
  const double stretch = 1 / std::clamp(cosine, 0.5, 1.0);
  const auto anywhere = [](const Vec2&) { return true; };
  for (std::size_t k = 0; k + 1 < left.size(); ++k) {
    const double step = stretch * heights[k];
    const Vec2 mean = (1 - share) * (left[k + 1].uv - left[k].uv) + share * (right[k + 1].uv - right[k].uv);
    Vec2 next = column.back().uv + mean;
    SurfaceJet jet;
    if (!find_step(cad, face, plane, column.back().xyz, step, anywhere, next, jet)) {
      next = 0.5 * (left[k + 1].uv + right[k + 1].uv);
      jet = surface_at(cad, face, want_position, next);
    }
    column.push_back({next, jet.s});
  }
  return column;
}

ColumnPlace dividing_place(Cad& cad, int face, const ColumnPlace& low, const ColumnPlace& high, double share) {
  ColumnPlace place = low;
  double t = share;
  for (int k = 0; k < rounding_of::newton_steps; ++k) {
    place.uv = low.uv + t * (high.uv - low.uv);
    place.xyz = surface_at(cad, face, want_position, place.uv).s;
    const double below = norm(place.xyz - low.xyz), above = norm(high.xyz - place.xyz);
    const double error = below - share * (below + above);
    if (!(std::abs(error) > shares::negligible * below)) break;
    const double next = t - error / (below + above);
    if (!(next > 0 && next < 1)) break;
    t = next;
  }
  return place;
}

}  // namespace carreau
