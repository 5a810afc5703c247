// SPDX-License-Identifier: BSD-3-Clause
#include "surface/quads/smoothing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/local_search.h"
#include "support/incidence.h"
#include "surface/quads/quad_shape.h"
#include "surface/quads/space_quads.h"
#include "surface/quads/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::quads;

// The square that fits four points best: mean + z i^k, z their first Fourier coefficient.
std::array<Vec2, 4> fitted_square(const std::array<Vec2, 4>& y, double radius, double pull) {
  const Vec2 mean = 0.25 * (y[0] + y[1] + y[2] + y[3]);
  Vec2 z{0.25 * (y[0].x() + y[1].y() - y[2].x() - y[3].y()), 0.25 * (y[0].y() - y[1].x() - y[2].y() + y[3].x())};
  const double size = norm(z);
  if (size > 0) z = ((1 - pull) + pull * radius / size) * z;
  const Vec2 iz{-z.y(), z.x()};
  return {mean + z, mean + iz, mean - z, mean - iz};
}

std::array<Vec2, 4> fitted_triangle(const std::array<Vec2, 4>& y, double radius, double pull) {
  const Vec2 mean = (1.0 / 3) * (y[0] + y[1] + y[2]);
  const auto turned = [](const Vec2& p, double sine) -> Vec2 {
    return {-0.5 * p.x() - sine * p.y(), sine * p.x() - 0.5 * p.y()};
  };
  constexpr double s = half_root3;
  Vec2 z = (1.0 / 3) * (y[0] + turned(y[1], -s) + turned(y[2], s));
  const double size = norm(z);
  if (size > 0) z = ((1 - pull) + pull * radius / size) * z;
  return {mean + z, mean + turned(z, s), mean + turned(z, -s), mean};
}

/// Quads: PlaneQuads or SpaceQuads.
template <typename Quads>
class Smoothing {
 public:
  Smoothing(Quads& quads, const QuadSmoothing& how, Monitor& monitor)
      : quads_(quads), how_(how), monitor_(monitor), sum_(quads.vertices()), count_(quads.vertices()) {
    for (const MixedCell& cell : quads.cells()) {
      const int n = corners_of(cell);
      if (!how.moving.empty() &&
          std::none_of(cell.begin(), cell.begin() + n, [&](std::int32_t v) { return how.moving[v] != 0; }))
        continue;
      if (cells_.size() % cells_between_checks == 0) monitor.checkpoint();
      cells_.push_back(cell);
      frames_.push_back(quads.about(cell));
    }
  }

  void run() {
    for (int pass = 0; pass < how_.passes; ++pass) {
      monitor_.checkpoint();
      propose();
      before_ = quads_.places();
      for (std::size_t v = 0; v < sum_.size(); ++v) {
        if (v % cells_between_checks == 0) monitor_.checkpoint();
        if (may_move(v)) quads_.move(v, (how_.share / count_[v]) * sum_[v]);
      }
      while (take_back()) {
      }
    }
  }

 private:
  [[nodiscard]] bool may_move(std::size_t v) const {
    return !quads_.is_fixed(v) && count_[v] > 0 && (how_.moving.empty() || how_.moving[v] != 0);
  }

  void propose() {
    std::fill(sum_.begin(), sum_.end(), Quads::no_way());
    std::fill(count_.begin(), count_.end(), 0.);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      if (c % cells_between_checks == 0) monitor_.checkpoint();
      const MixedCell& cell = cells_[c];
      const typename Quads::Frame& frame = frames_[c];
      const int n = corners_of(cell);
      std::array<Vec2, 4> y;
      for (int k = 0; k < n; ++k) y[k] = quads_.at(frame, cell[k]);
      const std::array<Vec2, 4> wanted =
          n == 4 ? fitted_square(y, how_.unit * std::numbers::sqrt2 / 2, how_.pull)
                 : fitted_triangle(y, how_.unit / std::numbers::sqrt3, how_.pull);
      const double weight = n == 4 ? 1 : triangle_weight;
      for (int k = 0; k < n; ++k) {
        sum_[cell[k]] += weight * Quads::way(frame, wanted[k] - y[k]);
        count_[cell[k]] += weight;
      }
    }
  }

  // Vertices of cells that have turned over go back, and then those of others that have because of that.
  bool take_back() {
    bool any = false;
    for (const MixedCell& cell : cells_) {
      if (quads_.is_convex(cell)) continue;
      for (int k = 0; k < corners_of(cell); ++k)
        if (!quads_.is_at(cell[k], before_[cell[k]])) quads_.put(cell[k], before_[cell[k]]), any = true;
    }
    return any;
  }

  Quads& quads_;
  const QuadSmoothing& how_;
  Monitor& monitor_;
  std::vector<MixedCell> cells_;  // with a vertex that may move
  std::vector<typename Quads::Frame> frames_;  // of these; they stay while vertices move
  std::vector<typename Quads::Way> sum_;
  std::vector<typename Quads::Place> before_;
  std::vector<double> count_;
};

/// The cells around each vertex. Quads: PlaneQuads or SpaceQuads.
template <typename Quads>
class Worst {
 public:
  Worst(Quads& quads, double good, Monitor& monitor)
      : quads_(quads), good_(good), monitor_(monitor), around_(quads.vertices(), closed(quads.cells())) {}

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

  std::vector<std::int32_t> corners_of_bad() const {
    std::vector<std::pair<double, std::int32_t>> bad;
    const std::vector<MixedCell>& cells = quads_.cells();
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (const double q = quads_.untangling_quality(quads_.about(cells[c]), cells[c]); q < good_)
        bad.emplace_back(q, static_cast<std::int32_t>(c));
    std::sort(bad.begin(), bad.end());
    std::vector<std::int32_t> corners;
    for (const auto& [q, c] : bad)
      for (int k = 0; k < corners_of(cells[c]); ++k)
        if (!quads_.is_fixed(cells[c][k])) corners.push_back(cells[c][k]);
    return corners;
  }

  // Below `enough` it need not be known; beyond what is good all are alike.
  double worst_around(double enough) const {
    double worst = good_;
    for (const auto& [c, frame] : star_) {
      worst = std::min(worst, quads_.untangling_quality(frame, quads_.cells()[c]));
      if (worst < enough) break;
    }
    return worst;
  }

  bool improve(std::int32_t v) {
    star_.clear();
    for (const std::int32_t c : around_.of(v)) star_.emplace_back(c, quads_.about(quads_.cells()[c]));
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
    return !(way == Vec2{0, 0});
  }

  Quads& quads_;
  double good_;
  Monitor& monitor_;
  Incidence around_;
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
