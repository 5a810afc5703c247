// SPDX-License-Identifier: BSD-3-Clause
#include "surface/quads/smoothing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "mesh/local_search.h"
#include "support/incidence.h"
#include "surface/quads/quad_shape.h"
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

/// What a chart does near its origin, and back.
struct Linear {
  double p, q, r, ip, iq, ir;

  explicit Linear(const Chart& chart) noexcept {
    const Vec2 x = chart.offset({1, 0}), y = chart.offset({0, 1});
    ip = x.x(), iq = y.x(), ir = y.y();
    p = 1 / ip, r = 1 / ir, q = -iq * p * r;
  }
  [[nodiscard]] Vec2 at(const Vec2& e) const noexcept { return {p * e.x() + q * e.y(), r * e.y()}; }
  [[nodiscard]] Vec2 offset(const Vec2& d) const noexcept { return {ip * d.x() + iq * d.y(), ir * d.y()}; }
};

class Smoothing {
 public:
  Smoothing(QuadPatch& patch, const FaceCharts& charts, const QuadSmoothing& how, Monitor& monitor)
      : patch_(patch), how_(how), monitor_(monitor), bends_(charts.bends()), sum_(patch.uv.size()) {
    std::vector<double> count(patch.uv.size(), 0);
    cells_.reserve(patch.cells.size()), linear_.reserve(patch.cells.size());
    if (bends_) charts_.reserve(patch.cells.size());
    for (const MixedCell& cell : patch.cells) {
      const int n = corners_of(cell);
      if (!how.moving.empty() &&
          std::none_of(cell.begin(), cell.begin() + n, [&](std::int32_t v) { return how.moving[v] != 0; }))
        continue;
      if (cells_.size() % cells_between_checks == 0) monitor.checkpoint();
      const Chart chart = charts.about(patch, cell);
      cells_.push_back(cell), linear_.emplace_back(chart);
      if (bends_) charts_.push_back(chart);
      for (int k = 0; k < n; ++k) count[cell[k]] += n == 4 ? 1 : triangle_weight;
    }
    for (std::size_t v = 0; v < count.size(); ++v)
      if (patch.fixed[v] == 0 && count[v] > 0 && (how.moving.empty() || how.moving[v] != 0))
        movers_.push_back({static_cast<std::int32_t>(v), how.share / count[v], {0, 0}});
  }

  void run() {
    for (int pass = 0; pass < how_.passes; ++pass) {
      monitor_.checkpoint();
      std::fill(sum_.begin(), sum_.end(), Vec2{0, 0});
      bends_ ? propose<true>() : propose<false>();
      before_ = patch_.uv;
      const double kept = pass + plain_passes < how_.passes ? how_.momentum : 0;
      for (Mover& m : movers_) {
        m.step = kept * m.step + m.share * sum_[m.vertex];
        patch_.uv[m.vertex] += m.step;
      }
      take_back();
    }
  }

 private:
  /// A vertex that may move.
  struct Mover {
    std::int32_t vertex;
    double share;  ///< of the sum of proposals
    Vec2 step;     ///< its last one
  };

  template <bool bends>
  void propose() {
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      if (c % cells_between_checks == 0) monitor_.checkpoint();
      const MixedCell& cell = cells_[c];
      const int n = corners_of(cell);
      const Vec2 origin = patch_.uv[cell[0]];
      std::array<Vec2, 4> y;
      for (int k = 0; k < n; ++k)
        y[k] = bends ? charts_[c].at(patch_.uv[cell[k]]) : linear_[c].at(patch_.uv[cell[k]] - origin);
      const std::array<Vec2, 4> wanted =
          n == 4 ? fitted_square(y, how_.unit * std::numbers::sqrt2 / 2, how_.pull)
                 : fitted_triangle(y, how_.unit / std::numbers::sqrt3, how_.pull);
      const double weight = n == 4 ? 1 : triangle_weight;
      for (int k = 0; k < n; ++k) sum_[cell[k]] += weight * linear_[c].offset(wanted[k] - y[k]);
    }
  }

  // Vertices of cells that have turned over go back, and then those of others that have because of that: only cells whose
  // vertices went back in the round before or in this one need a look. They have no momentum then.
  void take_back() {
    went_back_.assign(patch_.uv.size(), 0);
    int round = 1;
    for (bool any = true; any; ++round) {
      any = false;
      for (const MixedCell& cell : cells_) {
        const int n = corners_of(cell);
        if (round > 1 && std::none_of(cell.begin(), cell.begin() + n,
                                      [&](std::int32_t v) { return went_back_[v] + 1 >= round; }))
          continue;
        if (is_convex(patch_, cell)) continue;
        for (int k = 0; k < n; ++k)
          if (patch_.uv[cell[k]] != before_[cell[k]])
            patch_.uv[cell[k]] = before_[cell[k]], went_back_[cell[k]] = round, any = true;
      }
    }
    if (round == 2) return;  // none went back
    for (Mover& m : movers_)
      if (went_back_[m.vertex] != 0) m.step = {0, 0};
  }

  QuadPatch& patch_;
  const QuadSmoothing& how_;
  Monitor& monitor_;
  bool bends_;
  std::vector<MixedCell> cells_;  // with a vertex that may move
  std::vector<Linear> linear_;    // of these; they stay while vertices move
  std::vector<Chart> charts_;     // the same, where the metric bends
  std::vector<Mover> movers_;
  std::vector<Vec2> sum_, before_;
  std::vector<int> went_back_;  // by vertex: the round of take_back() in which it did
};

/// The cells around each vertex.
class Worst {
 public:
  Worst(QuadPatch& patch, const FaceCharts& charts, double good, Monitor& monitor)
      : patch_(patch),
        charts_(charts),
        good_(good),
        monitor_(monitor),
        quality_(patch.cells.size(), 0),
        stale_(patch.cells.size(), 1) {}

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
    for (std::size_t c = 0; c < patch_.cells.size(); ++c) {
      if (stale_[c] != 0) quality_[c] = untangling_quality(patch_, charts_.about(patch_, patch_.cells[c]), patch_.cells[c]);
      stale_[c] = 0;
      if (quality_[c] < good_) bad.emplace_back(quality_[c], static_cast<std::int32_t>(c));
    }
    std::sort(bad.begin(), bad.end());
    std::vector<std::int32_t> corners;
    for (const auto& [q, c] : bad)
      for (int k = 0; k < corners_of(patch_.cells[c]); ++k)
        if (patch_.fixed[patch_.cells[c][k]] == 0) corners.push_back(patch_.cells[c][k]);
    return corners;
  }

  // Below `enough` it need not be known; beyond what is good all are alike.
  double worst_around(double enough) const {
    double worst = good_;
    for (const auto& [c, chart] : star_) {
      worst = std::min(worst, untangling_quality(patch_, chart, patch_.cells[c]));
      if (worst < enough) break;
    }
    return worst;
  }

  bool improve(std::int32_t v) {
    star_.clear();
    if (!around_) around_.emplace(patch_.uv.size(), closed(patch_.cells));
    for (const std::int32_t c : around_->of(v)) star_.emplace_back(c, charts_.about(patch_, patch_.cells[c]));
    const double start = worst_around(-2);
    if (start >= good_) return false;
    const Vec2 home = patch_.uv[v];
    const Chart chart = charts_.about(home);
    const Vec2 way = search_along_compass(start, first_step, last_step, [&](const Vec2& there, double best) {
      patch_.uv[v] = home + chart.offset(there);
      return worst_around(best);
    });
    patch_.uv[v] = home + chart.offset(way);
    if (way == Vec2{0, 0}) return false;
    for (const std::int32_t c : around_->of(v)) stale_[c] = 1;
    return true;
  }

  QuadPatch& patch_;
  const FaceCharts& charts_;
  double good_;
  Monitor& monitor_;
  std::optional<Incidence> around_;
  std::vector<double> quality_;  // by cell, unless
  std::vector<char> stale_;      // its vertices have moved since
  std::vector<std::pair<std::int32_t, Chart>> star_;  // cells around the vertex at hand, with charts that stay
};

}  // namespace

void smooth_quads(QuadPatch& patch, const FaceCharts& charts, const QuadSmoothing& how, Monitor& monitor) {
  Smoothing(patch, charts, how, monitor).run();
}

void improve_worst_quads(QuadPatch& patch, const FaceCharts& charts, double good, Monitor& monitor) {
  Worst(patch, charts, good, monitor).run();
}

}  // namespace carreau
