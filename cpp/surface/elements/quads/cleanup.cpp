// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/shape_levels.h"
#include "surface/elements/quads/passes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "metric/unit_edge.h"
#include "support/work_sizes.h"
#include "surface/elements/quads/quad_shape.h"
#include "surface/elements/quads/space_quads.h"
#include "surface/elements/quads/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::quads;
using Cells = std::vector<MixedCell>;
constexpr MixedCell none{-1, -1, -1, -1};

/// One pass: changes whose vertices no other change of the pass has met. Quads: PlaneQuads or SpaceQuads.
template <typename Quads>
class Pass {
 public:
  /// `active`: by vertex: only cells with an active vertex are considered; empty: all.
  Pass(Quads& quads, const ImposedEdges& is_imposed,
       const std::vector<std::int8_t>& ideal, const std::vector<char>& active, Monitor& monitor)
      : quads_(quads),
        cells_(quads.cells()),
        is_imposed_(is_imposed),
        ideal_(ideal),
        active_(active),
        monitor_(monitor),
        around_(cells_around(quads.vertices(), quads.cells())),
        degree_(quads.vertices(), 0),
        touched_(quads.vertices(), 0) {
    for (const MixedCell& cell : cells_)
      for (int k = 0; k < corners_of(cell); ++k) ++degree_[cell[k]];
  }

  /// Returns the number of changes.
  int run() {
    int changes = 0;
    for (std::int32_t c = 0, n = static_cast<std::int32_t>(cells_.size()); c < n; ++c) {
      if (c % work_sizes::searches == 0) monitor_.checkpoint();
      if (is_irregular(c) && (remove_doublet(c) || draw_together(c) || turn_edge(c))) ++changes;
    }
    std::erase(cells_, none);
    return changes;
  }

  /// Marks the vertices of changed cells.
  [[nodiscard]] std::vector<char> take_touched() { return std::move(touched_); }

 private:
  [[nodiscard]] std::vector<std::int32_t> cells_at(std::int32_t v) const {
    const auto all = around_.of(v);
    std::vector<std::int32_t> cells(all.begin(), all.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells;
  }
  [[nodiscard]] int degree(std::int32_t v) const { return degree_[v]; }
  // Each change improves irregular vertices of its cells.
  [[nodiscard]] bool is_irregular(std::int32_t c) const {
    const MixedCell& cell = cells_[c];
    if (cell == none) return false;
    bool irregular = false, active = active_.empty();
    for (int k = 0; k < corners_of(cell); ++k) {
      irregular = irregular || degree_[cell[k]] != ideal_[cell[k]];
      active = active || active_[cell[k]] != 0;
    }
    return irregular && active;
  }
  /// The penalty on a difference between a vertex's number of cells and its ideal.
  [[nodiscard]] int excess(std::int32_t v, int more = 0) const {
    const int d = degree(v) + more - ideal_[v];
    return d * d;
  }
  [[nodiscard]] bool is_untouched(std::span<const std::int32_t> cells) const {
    for (const std::int32_t c : cells) {
      if (cells_[c] == none) return false;
      for (int k = 0; k < corners_of(cells_[c]); ++k)
        if (touched_[cells_[c][k]] != 0) return false;
    }
    return true;
  }
  void touch(const MixedCell& cell) {
    for (int k = 0; k < corners_of(cell); ++k) touched_[cell[k]] = 1;
  }
  [[nodiscard]] bool is_good(const MixedCell& cell) const {
    return quads_.is_convex(cell) && !quads_.has_flat_corner(cell) && quads_.quality(cell) > shape_level::flat;
  }
  [[nodiscard]] bool has_good_length(std::int32_t a, std::int32_t b) const {
    const double l = quads_.length(a, b);
    return l > unit_edge::shortest_at_last && l < unit_edge::longest_at_last;
  }

  // A vertex inside with two cells.
  bool remove_doublet(std::int32_t c) {
    const MixedCell cell = cells_[c];
    for (int k = 0, n = corners_of(cell); cell != none && k < n; ++k) {
      const std::int32_t v = cell[k];
      if (quads_.is_fixed(v)) continue;
      const std::vector<std::int32_t> cells = cells_at(v);
      if (cells.size() != 2 || !is_untouched(cells)) continue;
      const MixedCell& other = cells_[cells[0] == c ? cells[1] : cells[0]];
      if (n == 3 || corners_of(other) == 3) continue;
      const auto at = static_cast<int>(std::find(other.begin(), other.end(), v) - other.begin());
      const MixedCell joined{cell[(k + 1) % 4], cell[(k + 2) % 4], cell[(k + 3) % 4], other[(at + 2) % 4]};
      if (joined[3] == joined[1] || !quads_.is_convex(joined) || quads_.has_flat_corner(joined)) continue;
      for (const std::int32_t one : cells) touch(cells_[one]), cells_[one] = none;
      cells_[c] = joined;
      return true;
    }
    return false;
  }

  // Two opposite corners become one.
  bool draw_together(std::int32_t c) {
    const MixedCell q = cells_[c];
    if (q == none || corners_of(q) == 3) return false;
    for (int k = 0; k < 2; ++k) {
      std::int32_t gone = q[k], kept = q[k + 2];
      if (quads_.is_fixed(gone)) std::swap(gone, kept);
      if (quads_.is_fixed(gone)) continue;
      const std::int32_t b = q[k + 1], d = q[(k + 3) % 4];
      const int together = degree(gone) + degree(kept) - 2 - ideal_[kept];
      const int gain = excess(gone) + excess(kept) + excess(b) + excess(d) - together * together - excess(b, -1) -
                       excess(d, -1);
      if (gain <= 0 || degree(b) < 3 + (quads_.is_fixed(b) ? -1 : 0) ||
          degree(d) < 3 + (quads_.is_fixed(d) ? -1 : 0))
        continue;
      if (draw(c, gone, kept)) return true;
    }
    return false;
  }

  bool draw(std::int32_t c, std::int32_t gone, std::int32_t kept) {
    std::vector<std::int32_t> cells = cells_at(gone);
    const std::vector<std::int32_t> more = cells_at(kept);
    cells.insert(cells.end(), more.begin(), more.end());
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    if (!is_untouched(cells)) return false;
    const typename Quads::Place home = quads_.place(kept);
    if (!quads_.is_fixed(kept)) quads_.approach(kept, gone);
    Cells now;
    bool good = true;
    for (const std::int32_t one : cells) {
      if (one == c) continue;
      MixedCell cell = cells_[one];
      std::replace(cell.begin(), cell.end(), gone, kept);
      const bool twice = std::count(cell.begin(), cell.end(), kept) > 1;
      good = good && !twice && is_good(cell) && has_good_edges(cell, kept);
      now.push_back(cell);
    }
    if (!good) {
      quads_.put(kept, home);
      return false;
    }
    std::size_t next = 0;
    for (const std::int32_t one : cells) {
      touch(cells_[one]);
      cells_[one] = one == c ? none : now[next++];
    }
    return true;
  }

  [[nodiscard]] bool has_good_edges(const MixedCell& cell, std::int32_t v) const {
    const int n = corners_of(cell);
    for (int k = 0; k < n; ++k) {
      const std::int32_t a = cell[k], b = cell[(k + 1) % n];
      if ((a == v || b == v) && !(quads_.is_fixed(a) && quads_.is_fixed(b)) && !has_good_length(a, b)) return false;
    }
    return true;
  }

  // The edge between two quadrilaterals becomes another diagonal of their hexagon.
  bool turn_edge(std::int32_t c) {
    const MixedCell q = cells_[c];
    if (q == none || corners_of(q) == 3) return false;
    for (int k = 0; k < 4; ++k) {
      const std::int32_t a = q[k], b = q[(k + 1) % 4];
      const std::optional<std::int32_t> other = beyond(c, a, b);
      if (!other || corners_of(cells_[*other]) == 3 || is_imposed_(a, b)) continue;
      const std::array<std::int32_t, 2> cells{c, *other};
      if (!is_untouched(cells)) continue;
      const MixedCell& o = cells_[*other];
      const auto at = static_cast<int>(std::find(o.begin(), o.end(), a) - o.begin());
      // Round the hexagon from b: two of q, a, two of o.
      const std::array<std::int32_t, 6> h{b,  q[(k + 2) % 4], q[(k + 3) % 4], a, o[(at + 1) % 4], o[(at + 2) % 4]};
      if (turn(cells, h)) return true;
    }
    return false;
  }

  bool turn(const std::array<std::int32_t, 2>& cells, const std::array<std::int32_t, 6>& h) {
    int best = 0, best_gain = 0;
    for (const int s : {1, 2}) {
      const int gain = excess(h[0]) + excess(h[3]) + excess(h[s]) + excess(h[s + 3]) - excess(h[0], -1) -
                       excess(h[3], -1) - excess(h[s], 1) - excess(h[s + 3], 1);
      if (gain <= best_gain || degree(h[0]) < 2 || degree(h[3]) < 2) continue;
      if (!has_good_length(h[s], h[s + 3])) continue;
      if (is_good(part(h, s)) && is_good(part(h, s + 3))) best = s, best_gain = gain;
    }
    if (best == 0) return false;
    for (const std::int32_t c : cells) touch(cells_[c]);
    cells_[cells[0]] = part(h, best), cells_[cells[1]] = part(h, best + 3);
    return true;
  }
  static MixedCell part(const std::array<std::int32_t, 6>& h, int s) {
    return {h[s], h[(s + 1) % 6], h[(s + 2) % 6], h[(s + 3) % 6]};
  }

  // The cell beyond the side from a to b of c.
  [[nodiscard]] std::optional<std::int32_t> beyond(std::int32_t c, std::int32_t a, std::int32_t b) const {
    for (const std::int32_t o : around_.of(a)) {
      if (o == c) continue;
      const MixedCell& cell = cells_[o];
      const int n = corners_of(cell);
      for (int k = 0; k < n; ++k)
        if (cell[k] == b && cell[(k + 1) % n] == a) return o;
    }
    return {};
  }

  Quads& quads_;
  Cells& cells_;
  const ImposedEdges& is_imposed_;
  const std::vector<std::int8_t>& ideal_;
  const std::vector<char>& active_;
  Monitor& monitor_;
  Incidence around_;
  std::vector<int> degree_;
  std::vector<char> touched_;
};

// Ideal number of cells around a vertex, by the total angle of its cells in the metric.
template <typename Quads>
std::vector<std::int8_t> ideal_degrees(const Quads& quads) {
  std::vector<double> angle(quads.vertices(), 0);
  for (const MixedCell& cell : quads.cells()) {
    const int n = corners_of(cell);
    bool any = false;
    for (int k = 0; k < n; ++k) any = any || quads.is_fixed(cell[k]);
    if (!any) continue;
    const auto frame = quads.about(cell);
    for (int k = 0; k < n; ++k) {
      if (!quads.is_fixed(cell[k])) continue;
      const Vec2 p = quads.at(frame, cell[k]);
      const Vec2 d = quads.at(frame, cell[(k + 1) % n]) - p, e = quads.at(frame, cell[(k + n - 1) % n]) - p;
      angle[cell[k]] += std::atan2(cross(d, e), dot(d, e));
    }
  }
  std::vector<std::int8_t> ideal(quads.vertices(), 4);
  for (std::size_t v = 0; v < ideal.size(); ++v)
    if (quads.is_fixed(v))
      ideal[v] = static_cast<std::int8_t>(std::max(1., std::round(angle[v] / (std::numbers::pi / 2))));
  return ideal;
}

std::vector<char> with_neighbours(const Cells& cells, const std::vector<char>& some) {
  std::vector<char> all = some;
  for (const MixedCell& cell : cells) {
    const int n = corners_of(cell);
    if (std::none_of(cell.begin(), cell.begin() + n, [&](std::int32_t v) { return some[v] != 0; })) continue;
    for (int k = 0; k < n; ++k) all[cell[k]] = 1;
  }
  return all;
}

}  // namespace

template <typename Quads>
void clean_up(Quads& quads, const ImposedEdges& is_imposed, Monitor& monitor) {
  const std::vector<std::int8_t> ideal = ideal_degrees(quads);
  // The result of a pass for a cell depends on the cells at its corners. If nothing there has changed or moved since
  // the previous pass, the pass skips the cell.
  std::vector<char> active;
  constexpr int max_rounds = 6;
  for (int round = 0; round < max_rounds; ++round) {
    Pass<Quads> pass(quads, is_imposed, ideal, active, monitor);
    if (pass.run() == 0) break;
    std::vector<char> moving;  // all, the first time
    if (round > 0) moving = with_neighbours(quads.cells(), pass.take_touched());
    smooth_quads(quads, {.passes = passes_after_changes, .momentum = 0, .moving = moving}, monitor);
    if (round > 0) active = with_neighbours(quads.cells(), moving);
  }
}
template void clean_up<PlaneQuads>(PlaneQuads&, const ImposedEdges&, Monitor&);
template void clean_up<SpaceQuads>(SpaceQuads&, const ImposedEdges&, Monitor&);

}  // namespace carreau
