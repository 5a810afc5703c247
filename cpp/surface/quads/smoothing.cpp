// SPDX-License-Identifier: BSD-3-Clause
#include "surface/quads/smoothing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "mesh/local_search.h"
#include "support/incidence.h"
#include "surface/quads/quad_shape.h"
#include "surface/quads/space_quads.h"
#include "surface/quads/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::quads;

// Offsets that turn the corners of a cell into the square that fits them best, mean + z i^k. The four points are mean + z i^k + w (-1)^k +
// c (-i)^k. `diagonals`: corner 0 less 2 and 1 less 3, which give z and c.
struct ToSquare {
  Vec2 even, odd;  // without w: to corner 0 (and, the other way, to 2), to corner 1 (to 3)

  ToSquare(const Vec2& d, const Vec2& e, double radius, double pull) noexcept {
    const Vec2 z{0.25 * (d.x() + e.y()), 0.25 * (d.y() - e.x())}, c{0.25 * (d.x() - e.y()), 0.25 * (d.y() + e.x())};
    const double size = norm(z), grown = size > 0 ? pull * (radius / size - 1) : 0;
    even = grown * z - c;
    const Vec2 s = grown * z + c;
    odd = {-s.y(), s.x()};
  }
};

std::array<Vec2, 3> fitted_triangle(const std::array<Vec2, 3>& y, double radius, double pull) {
  const Vec2 mean = (1.0 / 3) * (y[0] + y[1] + y[2]);
  const auto turned = [](const Vec2& p, double sine) -> Vec2 {
    return {-0.5 * p.x() - sine * p.y(), sine * p.x() - 0.5 * p.y()};
  };
  constexpr double s = half_root3;
  Vec2 z = (1.0 / 3) * (y[0] + turned(y[1], -s) + turned(y[2], s));
  const double size = norm(z);
  if (size > 0) z = ((1 - pull) + pull * radius / size) * z;
  return {mean + z, mean + turned(z, s), mean + turned(z, -s)};
}

/// Quads: PlaneQuads or SpaceQuads.
template <typename Quads>
class Smoothing {
 public:
  Smoothing(Quads& quads, const QuadSmoothing& how, Monitor& monitor)
      : quads_(quads), how_(how), monitor_(monitor), frames_(quads), sum_(quads.vertices()) {
    std::vector<double> count(quads.vertices(), 0);
    cells_.reserve(quads.cells().size()), frames_.reserve(quads.cells().size());
    for (const MixedCell& cell : quads.cells()) {
      const int n = corners_of(cell);
      if (!how.moving.empty() &&
          std::none_of(cell.begin(), cell.begin() + n, [&](std::int32_t v) { return how.moving[v] != 0; }))
        continue;
      if (cells_.size() % steps_between_checks == 0) monitor.checkpoint();
      cells_.push_back(cell), frames_.add(cell);
      for (int k = 0; k < n; ++k) count[cell[k]] += weight(n);
    }
    for (std::size_t v = 0; v < count.size(); ++v)
      if (!quads.is_fixed(v) && count[v] > 0 && (how.moving.empty() || how.moving[v] != 0))
        movers_.push_back({static_cast<std::int32_t>(v), how.share / count[v], Quads::no_way()});
  }

  void run() {
    for (int pass = 0; pass < how_.passes; ++pass) {
      monitor_.checkpoint();
      propose();
      before_ = quads_.places();
      const double kept = pass + plain_passes < how_.passes ? how_.momentum : 0;
      for (std::size_t i = 0; i < movers_.size(); ++i) {
        if (i % steps_between_checks == 0) monitor_.checkpoint();
        Mover& m = movers_[i];
        m.step = kept * m.step + m.share * sum_[m.vertex];
        quads_.move(m.vertex, m.step);
      }
      take_back();
    }
  }

 private:
  /// A vertex that may move.
  struct Mover {
    std::int32_t vertex;
    double share;              ///< of the sum of proposals
    typename Quads::Way step;  ///< its last one
  };

  static double weight(int corners) noexcept { return corners == 4 ? 1 : triangle_weight; }

  void propose() {
    std::fill(sum_.begin(), sum_.end(), Quads::no_way());
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      if (c % steps_between_checks == 0) monitor_.checkpoint();
      if (corners_of(cells_[c]) == 4)
        propose_square(c, cells_[c]);
      else
        propose_triangle(c, cells_[c]);
    }
  }

  void propose_square(std::size_t c, const MixedCell& cell) {
    using Way = typename Quads::Way;
    const auto diagonals = frames_.diagonals(c, cell);
    const ToSquare to(diagonals.first, diagonals.second, how_.unit * std::numbers::sqrt2 / 2, how_.pull);
    const Way &between = diagonals.between, even = frames_.way(c, to.even), odd = frames_.way(c, to.odd);
    sum_[cell[0]] += even - between, sum_[cell[2]] -= even + between;
    sum_[cell[1]] += odd + between, sum_[cell[3]] += between - odd;
  }

  void propose_triangle(std::size_t c, const MixedCell& cell) {
    std::array<Vec2, 3> y;
    for (int k = 0; k < 3; ++k) y[k] = frames_.at(c, cell, k);
    const std::array<Vec2, 3> wanted = fitted_triangle(y, how_.unit / std::numbers::sqrt3, how_.pull);
    for (int k = 0; k < 3; ++k) sum_[cell[k]] += triangle_weight * frames_.way(c, wanted[k] - y[k]);
  }

  // Takes back the vertices of cells that have turned over, and then the vertices of cells that have turned over
  // because of that. Only cells whose vertices went back in the previous round or in this one need a look. These
  // vertices then have no momentum.
  void take_back() {
    went_back_.assign(quads_.vertices(), 0);
    int round = 1;
    for (bool any = true; any; ++round) {
      any = false;
      for (const MixedCell& cell : cells_) {
        const int n = corners_of(cell);
        if (round > 1 && std::none_of(cell.begin(), cell.begin() + n,
                                      [&](std::int32_t v) { return went_back_[v] + 1 >= round; }))
          continue;
        if (quads_.is_convex(cell)) continue;
        for (int k = 0; k < n; ++k)
          if (!quads_.is_at(cell[k], before_[cell[k]]))
            quads_.put(cell[k], before_[cell[k]]), went_back_[cell[k]] = round, any = true;
      }
    }
    if (round == 2) return;  // none went back
    for (Mover& m : movers_)
      if (went_back_[m.vertex] != 0) m.step = Quads::no_way();
  }

  Quads& quads_;
  const QuadSmoothing& how_;
  Monitor& monitor_;
  std::vector<MixedCell> cells_;        // with a vertex that may move
  typename Quads::KeptFrames frames_;   // of these; they stay while vertices move
  std::vector<Mover> movers_;
  std::vector<typename Quads::Way> sum_;
  std::vector<typename Quads::Place> before_;
  std::vector<int> went_back_;  // by vertex: the round of take_back() in which it did
};

/// Vertices around the worst cells. Quads: PlaneQuads or SpaceQuads.
template <typename Quads>
class Worst {
 public:
  Worst(Quads& quads, double good, Monitor& monitor)
      : quads_(quads),
        good_(good),
        monitor_(monitor),
        quality_(quads.cells().size(), 0),
        stale_(quads.cells().size(), 1),
        in_vain_(quads.vertices(), 0) {}

  void run() {
    improve_in_passes(
        worst_passes, monitor_, [this] { return corners_of_bad(); }, [this](std::int32_t v) { return improve(v); });
  }

 private:
  // Triangles name their first corner twice.
  static std::vector<MixedCell> closed(std::vector<MixedCell> cells) {
    for (MixedCell& cell : cells)
      if (cell[3] < 0) cell[3] = cell[0];
    return cells;
  }

  std::vector<std::int32_t> corners_of_bad() {
    std::vector<std::pair<double, std::int32_t>> bad;
    const std::vector<MixedCell>& cells = quads_.cells();
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (stale_[c] != 0) quality_[c] = quads_.untangling_quality(quads_.about(cells[c]), cells[c]);
      stale_[c] = 0;
      if (quality_[c] < good_) bad.emplace_back(quality_[c], static_cast<std::int32_t>(c));
    }
    std::sort(bad.begin(), bad.end());
    std::vector<std::int32_t> corners;
    for (const auto& [q, c] : bad)
      for (int k = 0; k < corners_of(cells[c]); ++k)
        if (!quads_.is_fixed(cells[c][k])) corners.push_back(cells[c][k]);
    return corners;
  }

  // Below `enough` the exact value does not matter; all values beyond good_ count as equal.
  double worst_around(double enough) const {
    double worst = good_;
    for (const auto& [c, frame] : star_) {
      worst = std::min(worst, quads_.untangling_quality(frame, quads_.cells()[c]));
      if (worst < enough) break;
    }
    return worst;
  }

  bool improve(std::int32_t v) {
    if (in_vain_[v] != 0) return false;
    in_vain_[v] = 1;
    star_.clear();
    if (!around_) around_.emplace(quads_.vertices(), closed(quads_.cells()));
    for (const std::int32_t c : around_->of(v)) star_.emplace_back(c, quads_.about(quads_.cells()[c]));
    const double start = worst_around(-2);
    if (start >= good_) return false;
    const typename Quads::Place home = quads_.place(v);
    const typename Quads::Frame frame = quads_.about(v);
    const Vec2 way = search_along_compass(start, first_step, last_step, [&](const Vec2& there, double best) {
      quads_.try_at(v, home, Quads::way(frame, there));
      return worst_around(best);
    });
    quads_.try_at(v, home, Quads::way(frame, way));
    if constexpr (!Quads::on_surface) {
      if (way == Vec2{0, 0} || !quads_.settle(v, home) || !(worst_around(-2) > start)) {
        quads_.put(v, home);
        return false;
      }
    }
    if (way == Vec2{0, 0}) return false;
    for (const std::int32_t c : around_->of(v)) {
      stale_[c] = 1;
      for (int k = 0; k < corners_of(quads_.cells()[c]); ++k) in_vain_[quads_.cells()[c][k]] = 0;
    }
    return true;
  }

  Quads& quads_;
  double good_;
  Monitor& monitor_;
  std::optional<Incidence> around_;
  std::vector<double> quality_;  // by cell, unless
  std::vector<char> stale_;      // its vertices have moved since
  std::vector<char> in_vain_;    // by vertex: nothing around has moved since a search
  std::vector<std::pair<std::int32_t, typename Quads::Frame>> star_;  // cells around the vertex at hand, with frames that stay
};

}  // namespace

void smooth_quads(QuadPatch& patch, const FaceCharts& charts, const QuadSmoothing& how, Monitor& monitor) {
  PlaneQuads quads(patch, charts);
  Smoothing<PlaneQuads>(quads, how, monitor).run();
}
void smooth_quads(SpaceQuads& quads, const QuadSmoothing& how, Monitor& monitor) {
  Smoothing<SpaceQuads>(quads, how, monitor).run();
}

void improve_worst_quads(QuadPatch& patch, const FaceCharts& charts, double good, Monitor& monitor) {
  PlaneQuads quads(patch, charts);
  Worst<PlaneQuads>(quads, good, monitor).run();
}
void improve_worst_quads(SpaceQuads& quads, double good, Monitor& monitor) {
  Worst<SpaceQuads>(quads, good, monitor).run();
}

}  // namespace carreau
