// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/atlas/mend_folds.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "geometry/atlas/thresholds.h"

namespace carreau::atlas {
namespace {

constexpr int terms = Primitive::terms;
using Normal = Eigen::Matrix<double, terms, terms>;
using Right = Eigen::Matrix<double, terms, 3>;

/// A place of a T, as all charts that count there see it.
struct Sample {
  std::array<Jet, 3> weight;
  std::array<Pair<Jet>, 3> place;
};

Vec3 by_u(const std::array<Jet, 3>& s) { return {s[0].u, s[1].u, s[2].u}; }
Vec3 by_v(const std::array<Jet, 3>& s) { return {s[0].v, s[1].v, s[2].v}; }
Vec3 value(const std::array<double, 3>& s) { return {s[0], s[1], s[2]}; }

double steepness(const Jet& weight) { return std::hypot(weight.u, weight.v); }

/// The same for all T.
std::vector<Vec2> grid_of_t() {
  constexpr int n = thresholds::grid_of_t;
  std::vector<Vec2> grid;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      const Vec2 p = (i * corner_of_t(1) + j * corner_of_t(2)) / n;
      const auto weights = Covering::weights(pair_of(p));
      if (*std::max_element(weights.begin(), weights.end()) < 1) grid.push_back(p);
    }
  return grid;
}

class FoldMender {
 public:
  FoldMender(const Covering& covering, std::vector<Primitive>& primitives)
      : covering_(covering), primitives_(primitives), anchor_(primitives.size(), 0), grid_(grid_of_t()) {
    for (std::size_t t = 0; t < covering.triples().size(); ++t)
      for (const Vec2& p : grid_) samples_.push_back(sample(t, p));
    emphasis_.assign(samples_.size(), 1);
  }

  FoldReport mend() {
    FoldReport report;
    std::vector<std::size_t> folded = folds();
    report.folded_before = report.folded_after = folded.size();
    std::vector<Primitive> best = primitives_;
    for (int round = 0; round < thresholds::mend_rounds && !folded.empty(); ++round) {
      loosen(folded);
      const std::vector<std::size_t> charts = active();
      for (int sweep = 0; sweep < thresholds::mend_sweeps; ++sweep)
        for (const std::size_t i : charts) refit(i);
      folded = folds();
      if (folded.size() >= report.folded_after) continue;
      report.folded_after = folded.size(), report.mended_charts = charts.size();
      best = primitives_;
    }
    primitives_ = std::move(best);
    return report;
  }

 private:
  [[nodiscard]] Sample sample(std::size_t t, const Vec2& p) const {
    const Pair<Jet> place = parameters_at(p);
    Sample s{Covering::weights(place), {}};
    for (std::size_t c = 0; c < 3; ++c)
      if (s.weight[c].f > 0) s.place[c] = covering_.from_t(static_cast<std::int32_t>(t), static_cast<int>(c), place);
    return s;
  }
  [[nodiscard]] std::size_t chart(std::size_t t, std::size_t c) const {
    return static_cast<std::size_t>(covering_.triples()[t].chart[c]);
  }
  [[nodiscard]] const Sample& sample_of(std::size_t t, std::size_t k) const { return samples_[t * grid_.size() + k]; }

  /// Is the surface turned over beside the planes of its charts, or much smaller than they are?
  [[nodiscard]] bool is_folded(std::size_t t, const Sample& s) const {
    std::array<Jet, 3> sum;
    Vec3 normal(0, 0, 0);
    double area = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      if (s.weight[c].f <= 0) continue;
      const std::array<Jet, 3> p = primitives_[chart(t, c)].at(s.place[c]);
      for (std::size_t i = 0; i < 3; ++i) sum[i] = sum[i] + s.weight[c] * p[i];
      normal += s.weight[c].f * covering_.charts()[chart(t, c)].frame.normal;
      const Jet &x = s.place[c][0], &y = s.place[c][1];
      area += s.weight[c].f * (x.u * y.v - x.v * y.u);
    }
    return !(dot(cross(by_u(sum), by_v(sum)), normal) > thresholds::least_jacobian * area * norm(normal));
  }

  /// Does a primitive turn over where it is alone?
  [[nodiscard]] bool is_folded_inside(std::size_t i) const {
    const Chart& own = covering_.charts()[i];
    const auto is_bad = [&](const Vec2& m) {
      const std::array<Jet, 3> s = primitives_[i].at(parameters_at(m));
      return !(dot(cross(by_u(s), by_v(s)), own.frame.normal) > thresholds::least_jacobian);
    };
    for (const std::int32_t v : own.members)
      if (is_bad(own.frame.project(covering_.surface().vertices[static_cast<std::size_t>(v)]))) return true;
    for (std::size_t k = 0; k < 4 * own.corners.size(); ++k)
      if (is_bad(value_of(own.annulus.at(0., static_cast<double>(k) * sixth_turn / 4)))) return true;
    return false;
  }
  [[nodiscard]] bool touches_active(std::size_t t) const {
    return anchor_[chart(t, 0)] + anchor_[chart(t, 1)] + anchor_[chart(t, 2)] > 0;
  }
  [[nodiscard]] bool is_folded(std::size_t t) const {
    for (std::size_t k = 0; k < grid_.size(); ++k)
      if (is_folded(t, sample_of(t, k))) return true;
    return false;
  }

  /// T with a place that is turned over, and one T of each chart that is so inside; of those that may have changed.
  [[nodiscard]] std::vector<std::size_t> folds() const {
    std::vector<char> is_bad(covering_.triples().size(), 0);
    const bool all = active().empty();
    for (std::size_t t = 0; t < is_bad.size(); ++t)
      if (all || touches_active(t)) is_bad[t] = is_folded(t) ? 1 : 0;
    for (std::size_t i = 0; i < primitives_.size(); ++i)
      if (anchor_[i] > 0 && is_folded_inside(i))
        is_bad[static_cast<std::size_t>(covering_.charts()[i].corners.front().triple)] = 1;
    std::vector<std::size_t> list;
    for (std::size_t t = 0; t < is_bad.size(); ++t)
      if (is_bad[t] != 0) list.push_back(t);
    return list;
  }

  /// Charts that meet at folds count on their vertices less, their neighbours begin to give way.
  void loosen(const std::vector<std::size_t>& folded) {
    std::vector<double> old = anchor_;
    std::vector<char> at_fold(primitives_.size(), 0);
    for (const std::size_t t : folded) {
      for (std::size_t c = 0; c < 3; ++c) at_fold[chart(t, c)] = 1;
      for (std::size_t k = 0; k < grid_.size(); ++k)
        if (is_folded(t, sample_of(t, k))) emphasis_[t * grid_.size() + k] *= thresholds::emphasis;
    }
    for (std::size_t i = 0; i < primitives_.size(); ++i) {
      if (at_fold[i] == 0) continue;
      anchor_[i] =
          old[i] > 0 ? std::max(old[i] * thresholds::loosening, thresholds::least_anchor) : thresholds::first_anchor;
      if (old[i] == 0 || old[i] > thresholds::giving_way) continue;
      for (const Corner& corner : covering_.charts()[i].corners)
        for (std::size_t c = 0; c < 3; ++c) {
          double& a = anchor_[chart(static_cast<std::size_t>(corner.triple), c)];
          if (a == 0) a = thresholds::first_anchor;
        }
    }
  }
  [[nodiscard]] std::vector<std::size_t> active() const {
    std::vector<std::size_t> list;
    for (std::size_t i = 0; i < anchor_.size(); ++i)
      if (anchor_[i] > 0) list.push_back(i);
    return list;
  }

  static void add(Normal& normal, Right& right, const Primitive::Basis& b, const Vec3& target, double weight) {
    for (int i = 0; i < terms; ++i) {
      const double wi = weight * b[static_cast<std::size_t>(i)];
      for (int j = 0; j < terms; ++j) normal(i, j) += wi * b[static_cast<std::size_t>(j)];
      for (int k = 0; k < 3; ++k) right(i, k) += wi * target[k];
    }
  }

  void refit(std::size_t i) {
    const Chart& own = covering_.charts()[i];
    Primitive& p = primitives_[i];
    Normal normal = Normal::Zero();
    Right right = Right::Zero();
    double whole = 0;
    for (const Corner& corner : own.corners) whole += add_neighbours(i, corner, normal, right);
    normal /= whole, right /= whole;
    const double each = anchor_[i] / static_cast<double>(own.members.size() + own.around.size());
    for (const auto* list : {&own.members, &own.around})
      for (const std::int32_t v : *list) {
        const Vec3& at = covering_.surface().vertices[static_cast<std::size_t>(v)];
        add(normal, right, p.basis(own.frame.project(at)), at, each);
      }
    constexpr double ridge = 1e-9;
    for (int k = 0; k < terms; ++k) {
      normal(k, k) += ridge;
      for (int d = 0; d < 3; ++d) right(k, d) += ridge * p.coefficient[static_cast<std::size_t>(k)][d];
    }
    const Right solution = normal.ldlt().solve(right);
    for (int k = 0; k < terms; ++k)
      p.coefficient[static_cast<std::size_t>(k)] = Vec3(solution(k, 0), solution(k, 1), solution(k, 2));
  }

  double add_neighbours(std::size_t i, const Corner& corner, Normal& normal, Right& right) const {
    const auto t = static_cast<std::size_t>(corner.triple), mine = static_cast<std::size_t>(corner.corner);
    double whole = 0;
    for (std::size_t k = 0; k < grid_.size(); ++k) {
      const Sample& s = sample_of(t, k);
      if (s.weight[mine].f <= 0) continue;
      const Primitive::Basis b = primitives_[i].basis(value_of(s.place[mine]));
      for (std::size_t c = 0; c < 3; ++c) {
        if (c == mine || s.weight[c].f <= 0) continue;
        const double w = emphasis_[t * grid_.size() + k] * steepness(s.weight[mine]) * steepness(s.weight[c]);
        add(normal, right, b, value(primitives_[chart(t, c)].at(pair_of(value_of(s.place[c])))), w);
        whole += w;
      }
    }
    return whole;
  }

  const Covering& covering_;
  std::vector<Primitive>& primitives_;
  std::vector<double> anchor_;  ///< of each chart, what its vertices count beside its neighbours; 0: it is left alone
  std::vector<Vec2> grid_;
  std::vector<Sample> samples_;
  std::vector<double> emphasis_;  ///< of each sample
};

}  // namespace

FoldReport mend_folds(const Covering& covering, std::vector<Primitive>& primitives) {
  return FoldMender(covering, primitives).mend();
}

}  // namespace carreau::atlas
