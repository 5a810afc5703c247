// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/shape_levels.h"
#include "surface/elements/quads/passes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "support/incidence.h"
#include "support/work_sizes.h"
#include "surface/elements/quads/quad_shape.h"
#include "surface/elements/quads/space_quads.h"
#include "surface/elements/quads/thresholds.h"
#include "surface/elements/quads/worst_quads.h"

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
      if (cells_.size() % work_sizes::searches == 0) monitor.checkpoint();
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
        if (i % work_sizes::searches == 0) monitor_.checkpoint();
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
      if (c % work_sizes::searches == 0) monitor_.checkpoint();
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

}  // namespace

template <typename Quads>
void smooth_quads(Quads& quads, const QuadSmoothing& how, Monitor& monitor) {
  Smoothing<Quads>(quads, how, monitor).run();
}
template void smooth_quads<PlaneQuads>(PlaneQuads&, const QuadSmoothing&, Monitor&);
template void smooth_quads<SpaceQuads>(SpaceQuads&, const QuadSmoothing&, Monitor&);

template <typename Quads>
void improve_worst_quads(Quads& quads, double good, Monitor& monitor) {
  WorstQuads<Quads>(quads, good, monitor).run();
}
template void improve_worst_quads<PlaneQuads>(PlaneQuads&, double, Monitor&);
template void improve_worst_quads<SpaceQuads>(SpaceQuads&, double, Monitor&);

template <typename Quads>
void smooth_all(Quads& quads, Monitor& monitor) {
  smooth_quads(quads, {}, monitor);
  improve_worst_quads(quads, shape_level::poor, monitor);
}
template void smooth_all<PlaneQuads>(PlaneQuads&, Monitor&);
template void smooth_all<SpaceQuads>(SpaceQuads&, Monitor&);

}  // namespace carreau
