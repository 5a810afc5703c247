// SPDX-License-Identifier: BSD-3-Clause
#include "surface/quads/cleanup.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "support/incidence.h"
#include "surface/quads/quad_shape.h"
#include "surface/quads/smoothing.h"
#include "surface/quads/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::quads;
using Cells = std::vector<MixedCell>;
constexpr MixedCell none{-1, -1, -1, -1};

/// One pass: changes whose vertices no other change of the pass has met.
class Pass {
 public:
  /// `active`: by vertex: only cells with such a one are looked at; empty: all.
  Pass(QuadPatch& patch, const FaceCharts& charts, const std::function<bool(std::int32_t, std::int32_t)>& is_imposed,
       const std::vector<std::int8_t>& ideal, const std::vector<char>& active, Monitor& monitor)
      : patch_(patch),
        charts_(charts),
        is_imposed_(is_imposed),
        ideal_(ideal),
        active_(active),
        monitor_(monitor),
        around_(patch.uv.size(), closed(patch.cells)),
        degree_(patch.uv.size(), 0),
        touched_(patch.uv.size(), 0) {
    for (const MixedCell& cell : patch.cells)
      for (int k = 0; k < corners_of(cell); ++k) ++degree_[cell[k]];
  }

  /// How many changes were made.
  int run() {
    int changes = 0;
    for (std::int32_t c = 0, n = static_cast<std::int32_t>(patch_.cells.size()); c < n; ++c) {
      if (c % searches_between_checks == 0) monitor_.checkpoint();
      if (is_irregular(c) && (remove_doublet(c) || draw_together(c) || turn_edge(c))) ++changes;
    }
    std::erase(patch_.cells, none);
    return changes;
  }

  /// By vertex: those of cells that were changed.
  [[nodiscard]] std::vector<char> take_touched() { return std::move(touched_); }

 private:
  // Triangles name their first corner twice: it is counted once below.
  static Cells closed(Cells cells) {
    for (MixedCell& cell : cells)
      if (cell[3] < 0) cell[3] = cell[0];
    return cells;
  }
  [[nodiscard]] std::vector<std::int32_t> cells_at(std::int32_t v) const {
    const auto all = around_.of(v);
    std::vector<std::int32_t> cells(all.begin(), all.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells;
  }
  [[nodiscard]] int degree(std::int32_t v) const { return degree_[v]; }
  // All changes mend vertices of cells that have some to mend.
  [[nodiscard]] bool is_irregular(std::int32_t c) const {
    const MixedCell& cell = patch_.cells[c];
    if (cell == none) return false;
    bool irregular = false, active = active_.empty();
    for (int k = 0; k < corners_of(cell); ++k) {
      irregular = irregular || degree_[cell[k]] != ideal_[cell[k]];
      active = active || active_[cell[k]] != 0;
    }
    return irregular && active;
  }
  /// What is wrong with so many cells more or less at a vertex.
  [[nodiscard]] int excess(std::int32_t v, int more = 0) const {
    const int d = degree(v) + more - ideal_[v];
    return d * d;
  }
  [[nodiscard]] bool is_untouched(std::span<const std::int32_t> cells) const {
    for (const std::int32_t c : cells) {
      if (patch_.cells[c] == none) return false;
      for (int k = 0; k < corners_of(patch_.cells[c]); ++k)
        if (touched_[patch_.cells[c][k]] != 0) return false;
    }
    return true;
  }
  void touch(const MixedCell& cell) {
    for (int k = 0; k < corners_of(cell); ++k) touched_[cell[k]] = 1;
  }
  [[nodiscard]] bool is_good(const MixedCell& cell) const {
    return is_convex(patch_, cell) && !has_flat_corner(patch_, cell) && cell_quality(patch_, charts_, cell) > least_after_change;
  }
  [[nodiscard]] bool has_good_length(std::int32_t a, std::int32_t b) const {
    const double l = length_in(charts_, patch_.uv[a], patch_.uv[b]);
    return l > shortest_edge && l < longest_edge;
  }

  // A vertex inside with two cells.
  bool remove_doublet(std::int32_t c) {
    const MixedCell cell = patch_.cells[c];
    for (int k = 0, n = corners_of(cell); cell != none && k < n; ++k) {
      const std::int32_t v = cell[k];
      if (patch_.fixed[v] != 0) continue;
      const std::vector<std::int32_t> cells = cells_at(v);
      if (cells.size() != 2 || !is_untouched(cells)) continue;
      const MixedCell& other = patch_.cells[cells[0] == c ? cells[1] : cells[0]];
      if (n == 3 || corners_of(other) == 3) continue;
      const auto at = static_cast<int>(std::find(other.begin(), other.end(), v) - other.begin());
      const MixedCell joined{cell[(k + 1) % 4], cell[(k + 2) % 4], cell[(k + 3) % 4], other[(at + 2) % 4]};
      if (joined[3] == joined[1] || !is_convex(patch_, joined) || has_flat_corner(patch_, joined)) continue;
      for (const std::int32_t one : cells) touch(patch_.cells[one]), patch_.cells[one] = none;
      patch_.cells[c] = joined;
      return true;
    }
    return false;
  }

  // Two opposite corners become one.
  bool draw_together(std::int32_t c) {
    const MixedCell q = patch_.cells[c];
    if (q == none || corners_of(q) == 3) return false;
    for (int k = 0; k < 2; ++k) {
      std::int32_t gone = q[k], kept = q[k + 2];
      if (patch_.fixed[gone] != 0) std::swap(gone, kept);
      if (patch_.fixed[gone] != 0) continue;
      const std::int32_t b = q[k + 1], d = q[(k + 3) % 4];
      const int together = degree(gone) + degree(kept) - 2 - ideal_[kept];
      const int gain = excess(gone) + excess(kept) + excess(b) + excess(d) - together * together - excess(b, -1) -
                       excess(d, -1);
      if (gain <= 0 || degree(b) < 3 + (patch_.fixed[b] != 0 ? -1 : 0) ||
          degree(d) < 3 + (patch_.fixed[d] != 0 ? -1 : 0))
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
    const Vec2 home = patch_.uv[kept];
    if (patch_.fixed[kept] == 0) patch_.uv[kept] = 0.5 * (home + patch_.uv[gone]);
    Cells now;
    bool good = true;
    for (const std::int32_t one : cells) {
      if (one == c) continue;
      MixedCell cell = patch_.cells[one];
      std::replace(cell.begin(), cell.end(), gone, kept);
      const bool twice = std::count(cell.begin(), cell.end(), kept) > 1;
      good = good && !twice && is_good(cell) && has_good_edges(cell, kept);
      now.push_back(cell);
    }
    if (!good) {
      patch_.uv[kept] = home;
      return false;
    }
    std::size_t next = 0;
    for (const std::int32_t one : cells) {
      touch(patch_.cells[one]);
      patch_.cells[one] = one == c ? none : now[next++];
    }
    return true;
  }

  [[nodiscard]] bool has_good_edges(const MixedCell& cell, std::int32_t v) const {
    const int n = corners_of(cell);
    for (int k = 0; k < n; ++k) {
      const std::int32_t a = cell[k], b = cell[(k + 1) % n];
      if ((a == v || b == v) && !(patch_.fixed[a] != 0 && patch_.fixed[b] != 0) && !has_good_length(a, b)) return false;
    }
    return true;
  }

  // The edge between two quadrilaterals becomes another diagonal of their hexagon.
  bool turn_edge(std::int32_t c) {
    const MixedCell q = patch_.cells[c];
    if (q == none || corners_of(q) == 3) return false;
    for (int k = 0; k < 4; ++k) {
      const std::int32_t a = q[k], b = q[(k + 1) % 4];
      const std::optional<std::int32_t> other = beyond(c, a, b);
      if (!other || corners_of(patch_.cells[*other]) == 3 || is_imposed_(a, b)) continue;
      const std::array<std::int32_t, 2> cells{c, *other};
      if (!is_untouched(cells)) continue;
      const MixedCell& o = patch_.cells[*other];
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
    for (const std::int32_t c : cells) touch(patch_.cells[c]);
    patch_.cells[cells[0]] = part(h, best), patch_.cells[cells[1]] = part(h, best + 3);
    return true;
  }
  static MixedCell part(const std::array<std::int32_t, 6>& h, int s) {
    return {h[s], h[(s + 1) % 6], h[(s + 2) % 6], h[(s + 3) % 6]};
  }

  // The cell beyond the side from a to b of c.
  [[nodiscard]] std::optional<std::int32_t> beyond(std::int32_t c, std::int32_t a, std::int32_t b) const {
    for (const std::int32_t o : around_.of(a)) {
      if (o == c) continue;
      const MixedCell& cell = patch_.cells[o];
      const int n = corners_of(cell);
      for (int k = 0; k < n; ++k)
        if (cell[k] == b && cell[(k + 1) % n] == a) return o;
    }
    return {};
  }

  QuadPatch& patch_;
  const FaceCharts& charts_;
  const std::function<bool(std::int32_t, std::int32_t)>& is_imposed_;
  const std::vector<std::int8_t>& ideal_;
  const std::vector<char>& active_;
  Monitor& monitor_;
  Incidence around_;
  std::vector<int> degree_;
  std::vector<char> touched_;
};

// Cells wanted around a vertex: of the angle that cells there have together, in the metric.
std::vector<std::int8_t> ideal_degrees(const QuadPatch& patch, const FaceCharts& charts) {
  std::vector<double> angle(patch.uv.size(), 0);
  for (const MixedCell& cell : patch.cells) {
    const int n = corners_of(cell);
    bool any = false;
    for (int k = 0; k < n; ++k) any = any || patch.fixed[cell[k]] != 0;
    if (!any) continue;
    const Chart chart = charts.about(patch, cell);
    for (int k = 0; k < n; ++k) {
      if (patch.fixed[cell[k]] == 0) continue;
      const Vec2 p = chart.at(patch.uv[cell[k]]);
      const Vec2 d = chart.at(patch.uv[cell[(k + 1) % n]]) - p, e = chart.at(patch.uv[cell[(k + n - 1) % n]]) - p;
      angle[cell[k]] += std::atan2(cross(d, e), dot(d, e));
    }
  }
  std::vector<std::int8_t> ideal(patch.uv.size(), 4);
  for (std::size_t v = 0; v < ideal.size(); ++v)
    if (patch.fixed[v] != 0)
      ideal[v] = static_cast<std::int8_t>(std::max(1., std::round(angle[v] / (std::numbers::pi / 2))));
  return ideal;
}

std::vector<char> with_neighbours(const QuadPatch& patch, const std::vector<char>& some) {
  std::vector<char> all = some;
  for (const MixedCell& cell : patch.cells) {
    const int n = corners_of(cell);
    if (std::none_of(cell.begin(), cell.begin() + n, [&](std::int32_t v) { return some[v] != 0; })) continue;
    for (int k = 0; k < n; ++k) all[cell[k]] = 1;
  }
  return all;
}

}  // namespace

void clean_up(QuadPatch& patch, const FaceCharts& charts,
              const std::function<bool(std::int32_t, std::int32_t)>& is_imposed, Monitor& monitor) {
  const std::vector<std::int8_t> ideal = ideal_degrees(patch, charts);
  // What a pass makes of a cell depends on the cells at its corners: where nothing there has changed or moved since the
  // pass before, it would be tried in vain again.
  std::vector<char> active;
  for (int round = 0; round < cleanup_passes; ++round) {
    Pass pass(patch, charts, is_imposed, ideal, active, monitor);
    if (pass.run() == 0) break;
    std::vector<char> moving;  // all, the first time
    if (round > 0) moving = with_neighbours(patch, pass.take_touched());
    smooth_quads(patch, charts, {.passes = passes_after_changes, .momentum = 0, .moving = moving}, monitor);
    if (round > 0) active = with_neighbours(patch, moving);
  }
}

}  // namespace carreau
