// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/atlas/mend_folds.h"

#include <algorithm>
#include <cmath>

#include "geometry/atlas/fold_places.h"
#include "geometry/atlas/mend_step.h"
#include "geometry/atlas/thresholds.h"
#include "support/shares.h"
#include "support/work_bounds.h"

namespace carreau::atlas {
namespace {

Block block_of(const Primitive& p) {
  Block b;
  for (int k = 0; k < Primitive::terms; ++k)
    for (int d = 0; d < 3; ++d) b(k, d) = p.coefficient[static_cast<std::size_t>(k)][d];
  return b;
}

/// Mean of squares of a primitive's values at the vertices of its chart, by the size of the chart.
Gram gram_of(const Covering& covering, const Chart& chart, const Primitive& p) {
  Gram gram = Gram::Zero();
  const double size2 = p.unit * p.unit;
  const double each = 1 / (static_cast<double>(chart.members.size() + chart.around.size()) * size2);
  for (const auto* list : {&chart.members, &chart.around})
    for (const std::int32_t v : *list) {
      const auto b = p.basis(pair_of(chart.frame.project(covering.surface().vertices[static_cast<std::size_t>(v)])));
      for (int r = 0; r < Primitive::terms; ++r)
        for (int c = 0; c < Primitive::terms; ++c)
          gram(r, c) += each * b[static_cast<std::size_t>(r)] * b[static_cast<std::size_t>(c)];
    }
  // Coefficients that the vertices do not determine also move little.
  for (int k = 0; k < Primitive::terms; ++k) gram(k, k) += shares::negligible / size2;
  return gram;
}

std::vector<std::size_t> sorted(std::vector<std::size_t> list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

class FoldMender {
 public:
  FoldMender(const Covering& covering, const HeightBlend& heights, std::vector<Primitive>& primitives,
             const std::vector<PlaceOfT>& given)
      : covering_(covering),
        heights_(heights),
        primitives_(primitives),
        grid_(covering, given),
        rank_(primitives.size(), none) {}

  FoldReport mend() {
    FoldReport report;
    std::vector<std::size_t> all(covering_.triples().size());
    for (std::size_t t = 0; t < all.size(); ++t) all[t] = t;
    Folds folds = look(all);
    report.folded_before = report.folded_after = folds.triples.size();
    std::vector<Primitive> best = primitives_;
    for (int round = 0; round < work_bounds::rounds && !folds.charts.empty(); ++round) {
      activate(folds.charts);
      descend();
      folds = look(triples_of_active());
      if (folds.triples.size() >= report.folded_after && !folds.charts.empty()) continue;
      report.folded_after = folds.triples.size(), report.mended_charts = active_.size();
      best = primitives_;
    }
    primitives_ = std::move(best);
    return report;
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  struct Folds {
    std::vector<std::size_t> triples, charts;
  };

  /// Finds folded T, and their charts. Watches their places, and places of active charts that are nearly folded.
  Folds look(const std::vector<std::size_t>& triples) {
    Folds folds;
    watched_.clear();
    for (const std::size_t t : triples)
      grid_.visit_triple(t, [&](const FoldPlace& place) {
        if (note(place, heights_.near_triple(t), folds)) folds.triples.push_back(t);
      });
    for (const std::size_t i : active_)
      for (const FoldPlace& place : grid_.of_pure_zone(i))
        if (note(place, heights_.near_chart(i), folds))
          folds.triples.push_back(static_cast<std::size_t>(covering_.charts()[i].corners[0].triple));
    folds.triples = sorted(std::move(folds.triples)), folds.charts = sorted(std::move(folds.charts));
    return folds;
  }
  bool note(FoldPlace place, const std::vector<std::int32_t>& vertices, Folds& folds) {
    if (place.jacobian(primitives_) > thresholds::watched_jacobian) return false;
    // The heights move a place along their own direction, which differs from the mean of the planes' normals on coarse
    // surfaces.
    place.normal = norm(place.normal) * heights_.direction(vertices, place.point(primitives_));
    const double jacobian = place.jacobian(primitives_);
    watched_.push_back(place);
    if (jacobian > thresholds::least_jacobian) return false;
    for (std::size_t c = 0; c < place.shares; ++c) folds.charts.push_back(place.share[c].chart);
    return true;
  }
  [[nodiscard]] std::vector<std::size_t> triples_of_active() const {
    std::vector<std::size_t> list;
    for (const std::size_t i : active_)
      for (const Corner& corner : covering_.charts()[i].corners)
        list.push_back(static_cast<std::size_t>(corner.triple));
    return sorted(std::move(list));
  }

  /// Charts at folds get a smaller anchor weight; if it is small already, their neighbours move as well.
  void activate(const std::vector<std::size_t>& folded) {
    for (const std::size_t i : folded) {
      if (rank_[i] == none) {
        add(i);
        continue;
      }
      double& anchor = anchor_[rank_[i]];
      anchor = std::max(anchor * thresholds::loosening, thresholds::min_anchor);
      if (anchor > shares::notable) continue;
      for (const Corner& corner : covering_.charts()[i].corners)
        for (const std::int32_t j : covering_.triples()[static_cast<std::size_t>(corner.triple)].chart)
          if (rank_[static_cast<std::size_t>(j)] == none) add(static_cast<std::size_t>(j));
    }
  }
  void add(std::size_t i) {
    rank_[i] = active_.size();
    active_.push_back(i), anchor_.push_back(1);
    gram_.push_back(gram_of(covering_, covering_.charts()[i], primitives_[i]));
    start_.push_back(block_of(primitives_[i]));
  }

  void move(const Blocks& step, double times) {
    for (std::size_t r = 0; r < active_.size(); ++r)
      for (int k = 0; k < Primitive::terms; ++k)
        for (int d = 0; d < 3; ++d)
          primitives_[active_[r]].coefficient[static_cast<std::size_t>(k)][d] += times * step[r](k, d);
  }

  [[nodiscard]] double missing_at(const FoldPlace& place) const {
    return thresholds::wanted_jacobian - place.jacobian(primitives_);
  }
  [[nodiscard]] double energy() const {
    double sum = 0;
    for (const FoldPlace& place : watched_)
      if (const double missing = missing_at(place); missing > 0) sum += missing * missing;
    for (std::size_t r = 0; r < active_.size(); ++r) {
      const Block off = block_of(primitives_[active_[r]]) - start_[r];
      sum += anchor_[r] * product(off, gram_[r] * off);
    }
    return sum;
  }

  [[nodiscard]] MendRow row_of(const FoldPlace& place, double missing) const {
    MendRow row;
    row.missing = missing;
    const FoldPlace::Tangents t = place.tangents(primitives_);
    const Vec3 along_u = cross(t.by_v, place.normal), along_v = cross(place.normal, t.by_u);
    for (std::size_t c = 0; c < place.shares; ++c) {
      const FoldPlace::Share& share = place.share[c];
      if (rank_[share.chart] == none) continue;
      const auto basis = primitives_[share.chart].basis(share.at);
      Block& g = row.gradient[row.count];
      for (int k = 0; k < Primitive::terms; ++k) {
        const Slope b = share.weight * basis[static_cast<std::size_t>(k)];
        for (int d = 0; d < 3; ++d) g(k, d) = b.u * along_u[d] + b.v * along_v[d];
      }
      row.rank[row.count++] = rank_[share.chart];
    }
    return row;
  }
  [[nodiscard]] std::vector<MendRow> rows() const {
    std::vector<MendRow> rows;
    for (const FoldPlace& place : watched_)
      if (const double missing = missing_at(place); missing > 0) rows.push_back(row_of(place, missing));
    return rows;
  }
  [[nodiscard]] Blocks downhill(const std::vector<MendRow>& rows) const {
    Blocks right;
    for (std::size_t r = 0; r < active_.size(); ++r)
      right.emplace_back(anchor_[r] * (gram_[r] * (start_[r] - block_of(primitives_[active_[r]]))));
    for (const MendRow& row : rows)
      for (std::size_t c = 0; c < row.count; ++c) right[row.rank[c]] += row.missing * row.gradient[c];
    return right;
  }

  /// Steps of Levenberg and Marquardt, until they gain little.
  void descend() {
    double damping = 1, now = energy();
    for (int step = 0; step < thresholds::mend_steps; ++step) {
      const std::vector<MendRow> pulling = rows();
      if (pulling.empty()) return;
      const double then = step_down(pulling, damping, now);
      if (!(then < (1 - shares::negligible) * now)) return;
      now = then;
    }
  }
  /// The energy after a step that is short enough, or the previous energy if no step is.
  double step_down(const std::vector<MendRow>& pulling, double& damping, double now) {
    const Blocks right = downhill(pulling);
    // Damping (Levenberg and Marquardt) in the unit of anchors: 1 at first.
    for (; damping < 1e8; damping *= 4) {
      std::vector<double> weight = anchor_;
      for (double& w : weight) w += damping;
      const Blocks step = solve_step(gram_, weight, pulling, right);
      move(step, 1);
      if (const double then = energy(); then < now) {
        damping = std::max(damping / 4, 1e-6);
        return then;
      }
      move(step, -1);
    }
    return now;
  }

  const Covering& covering_;
  const HeightBlend& heights_;
  std::vector<Primitive>& primitives_;
  FoldGrid grid_;
  std::vector<std::size_t> rank_;    ///< of each chart among the active ones, or none
  std::vector<std::size_t> active_;  ///< charts that move
  std::vector<double> anchor_;       ///< of each active chart: the weight of distances from the start
  std::vector<Gram> gram_;
  Blocks start_;
  std::vector<FoldPlace> watched_;
};

}  // namespace

FoldReport mend_folds(const Covering& covering, const HeightBlend& heights, std::vector<Primitive>& primitives,
                      const std::vector<PlaceOfT>& given) {
  return FoldMender(covering, heights, primitives, given).mend();
}

}  // namespace carreau::atlas
