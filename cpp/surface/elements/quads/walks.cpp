// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/shape_levels.h"
#include "surface/elements/quads/passes.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "surface/elements/quads/quad_shape.h"
#include "surface/elements/quads/space_quads.h"
#include "surface/elements/quads/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::quads;
constexpr MixedCell none{-1, -1, -1, -1};

/// Quads: PlaneQuads or SpaceQuads.
template <typename Quads>
class Walks {
 public:
  Walks(Quads& quads, const ImposedEdges& is_imposed, Monitor& monitor)
      : quads_(quads),
        cells_(quads.cells()),
        is_imposed_(is_imposed),
        monitor_(monitor),
        around_(cells_around(quads.vertices(), quads.cells())),
        met_(quads.cells().size(), -1),
        from_(quads.cells().size(), -1),
        touched_(quads.cells().size(), 0) {}

  /// Returns the number of pairs that have met.
  int run() {
    int pairs = 0;
    for (std::int32_t c = 0, n = static_cast<std::int32_t>(cells_.size()); c < n; ++c) {
      if (corners_of(cells_[c]) == 4 || touched_[c] != 0) continue;
      monitor_.checkpoint();
      if (walk_to_another(c)) ++pairs;
    }
    std::erase(cells_, none);
    return pairs;
  }

 private:
  using Side = std::pair<std::int32_t, std::int32_t>;

  // From c to the nearest other triangle, through cells that no walk has met.
  bool walk_to_another(std::int32_t c) {
    std::vector<std::int32_t> ring{c};
    met_[c] = c, from_[c] = -1;
    constexpr int longest_walk = 8;  // cells
    for (int length = 0; length < longest_walk && !ring.empty(); ++length) {
      std::vector<std::int32_t> next;
      for (const std::int32_t x : ring)
        for (int k = 0, n = corners_of(cells_[x]); k < n; ++k) {
          const std::optional<std::int32_t> y = beyond(x, cells_[x][k], cells_[x][(k + 1) % n]);
          if (!y || met_[*y] == c || touched_[*y] != 0) continue;
          met_[*y] = c, from_[*y] = x;
          if (corners_of(cells_[*y]) == 3) return walk(way_to(*y));
          next.push_back(*y);
        }
      ring = std::move(next);
    }
    return false;
  }
  [[nodiscard]] std::vector<std::int32_t> way_to(std::int32_t last) const {
    std::vector<std::int32_t> way;
    for (std::int32_t x = last; x >= 0; x = from_[x]) way.push_back(x);
    std::reverse(way.begin(), way.end());
    return way;
  }

  // The cell beyond the side from a to b of x, unless the edge is imposed.
  [[nodiscard]] std::optional<std::int32_t> beyond(std::int32_t x, std::int32_t a, std::int32_t b) const {
    for (const std::int32_t y : around_.of(a))
      if (y != x && side_of(cells_[y], {b, a}) >= 0) return is_imposed_(a, b) ? std::nullopt : std::optional(y);
    return {};
  }
  static int side_of(const MixedCell& cell, const Side& side) {
    for (int k = 0, n = corners_of(cell); k < n; ++k)
      if (cell[k] == side.first && cell[(k + 1) % n] == side.second) return k;
    return -1;
  }
  // The side of `cell` that is also a side of `other`; -1: no common side.
  static int common_side(const MixedCell& cell, const MixedCell& other) {
    for (int k = 0, n = corners_of(cell); k < n; ++k)
      if (side_of(other, {cell[(k + 1) % n], cell[k]}) >= 0) return k;
    return -1;
  }

  [[nodiscard]] double quality(const MixedCell& cell) const {
    return quads_.is_convex(cell) && !quads_.has_flat_corner(cell) ? quads_.quality(cell) : 0;
  }

  bool walk(const std::vector<std::int32_t>& way) {
    MixedCell triangle = cells_[way.front()];
    std::vector<MixedCell> now;
    for (std::size_t k = 1; k + 1 < way.size(); ++k) {
      const std::optional<MixedCell> quad = pass(cells_[way[k]], cells_[way[k + 1]], triangle);
      if (!quad) return false;
      now.push_back(*quad);
    }
    const MixedCell& last = cells_[way.back()];
    const int side = common_side(triangle, last);
    if (side < 0) return false;
    const int apex = common_side(last, triangle);
    const MixedCell joined{triangle[side], last[(apex + 2) % 3], triangle[(side + 1) % 3], triangle[(side + 2) % 3]};
    if (joined[1] == joined[3] || quality(joined) < shape_level::flat) return false;
    now.push_back(joined);
    for (const std::int32_t c : way) touched_[c] = 1, cells_[c] = none;
    for (std::size_t k = 0; k < now.size(); ++k) cells_[way[k]] = now[k];
    return true;
  }

  // The triangle passes through `quad` to the side that this has in common with `next`. Returns the quadrilateral that
  // stays behind.
  [[nodiscard]] std::optional<MixedCell> pass(const MixedCell& quad, const MixedCell& next, MixedCell& triangle) const {
    const int in = common_side(quad, triangle), apex = common_side(triangle, quad);
    if (in < 0) return {};
    // Counterclockwise from the end of that side.
    const std::array<std::int32_t, 5> p{quad[(in + 1) % 4], quad[(in + 2) % 4], quad[(in + 3) % 4], quad[in],
                                        triangle[(apex + 2) % 3]};
    if (std::find(p.begin(), p.begin() + 4, p[4]) != p.begin() + 4) return {};
    std::optional<MixedCell> behind;
    double best = shape_level::flat;
    for (int out = 0; out < 3; ++out) {
      if (side_of(next, {p[out + 1], p[out]}) < 0) continue;
      for (const int s : {out, (out + 4) % 5}) {  // first corner of the triangle: that side is its first or second
        const MixedCell t{p[s], p[(s + 1) % 5], p[(s + 2) % 5], -1};
        const MixedCell q{p[s], p[(s + 2) % 5], p[(s + 3) % 5], p[(s + 4) % 5]};
        const double least = std::min(quality(t), quality(q));
        if (least > best) best = least, behind = q, triangle = t;
      }
    }
    return behind;
  }

  Quads& quads_;
  std::vector<MixedCell>& cells_;
  const ImposedEdges& is_imposed_;
  Monitor& monitor_;
  Incidence around_;
  std::vector<std::int32_t> met_, from_;  // by cell: of the search from a triangle
  std::vector<char> touched_;             // by cell
};

}  // namespace

template <typename Quads>
void join_triangles(Quads& quads, const ImposedEdges& is_imposed, Monitor& monitor) {
  const auto is_triangle = [](const MixedCell& cell) { return corners_of(cell) == 3; };
  constexpr int passes = 3;
  for (int pass = 0; pass < passes; ++pass)
    if (std::count_if(quads.cells().begin(), quads.cells().end(), is_triangle) < 2 || Walks<Quads>(quads, is_imposed, monitor).run() == 0) break;
}
template void join_triangles<PlaneQuads>(PlaneQuads&, const ImposedEdges&, Monitor&);
template void join_triangles<SpaceQuads>(SpaceQuads&, const ImposedEdges&, Monitor&);

}  // namespace carreau
