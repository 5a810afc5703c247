// SPDX-License-Identifier: BSD-3-Clause
#include "gradation/metric_grading.h"

#include <algorithm>
#include <utility>

#include "gradation/graded_field.h"
#include "gradation/graph_walk.h"
#include "gradation/thresholds.h"
#include "metric/metric3_algebra.h"
#include "support/angles.h"
#include "support/error.h"
#include "support/shares.h"

namespace carreau {

namespace {

using detail::facing;
using detail::roll;

using namespace thresholds::gradation;

class MetricGrading : detail::GraphWalk<TangentMetric> {
 public:
  MetricGrading(const GradationGraph& graph, std::vector<TangentMetric> sizes, double slope, Monitor& monitor)
      : GraphWalk(graph, std::move(sizes), slope / detour, monitor) {
    waits_.assign(sizes_.size(), 0);
    joins_.resize(graph.joined.empty() ? 0 : graph.xyz.size());
    for (std::size_t k = 0; k < graph.joined.size(); ++k) {
      const auto [a, b] = graph.joined[k];
      const Isometry map = k < graph.joined_by.size() ? graph.joined_by[k] : Isometry{};
      joins_[a].push_back({b, map.inverse()});
      joins_[b].push_back({a, map});
    }
  }

  void add(const MetricSource& s) {
    bound(s.place, normal(s.place), s.way, [&](Vec3 w) { return s.sizes.along(w); });
  }

  std::vector<TangentMetric> run() {
    for (std::size_t p = 0; p < sizes_.size(); ++p) enqueue(static_cast<int>(p));
    // Ignores the sizes at insertion: negligible changes come in between.
    queue_.run([this](double, int p) { return waits_[p] != 0; }, [this](int p) { leave(p); }, monitor_);
    return std::move(sizes_);
  }

 private:
  [[nodiscard]] double smaller(int p) const noexcept { return sizes_[p].h1 * sizes_[p].h2; }
  void enqueue(int p) {
    if (!std::isfinite(smaller(p))) return;
    queue_.push(smaller(p), p);
    waits_[p] = 1;
  }

  /// Bounds the sizes at `to` by the sizes `along` at the other end of `way` (a tangent vector there, where the normal
  /// is n).
  template <typename Along>
  bool bound(int to, Vec3 n, Vec3 way, const Along& along) {
    TangentMetric& q = sizes_[to];
    const TangentMetric before = q;
    const double length = norm(way);
    const double growth = length > 0 ? 1 + slope_ * length / along((1 / length) * way) : 1;
    const Vec3 m = normal(to), near = facing(m, n);
    q.h1 = std::min(q.h1, growth * along(roll(q.d1, m, near)));
    q.h2 = std::min(q.h2, growth * along(roll(q.d2, m, near)));
    if (length > 0) {
      const Vec3 e = (1 / length) * way;
      q.bound_along(roll(e, near, m), growth * along(e));
    }
    return q.h1 < (1 - shares::negligible) * before.h1 || q.h2 < (1 - shares::negligible) * before.h2;
  }

  void leave(int p) {
    waits_[p] = 0;
    const Vec3 n = normal(p);
    step_from(p, [&](int r, int q) {
      if (vertex(q) == vertex(p) || vertex(r) == vertex(p)) return;
      const auto here = [&, s = sizes_[p]](Vec3 w) { return s.along(w); };
      if (bound(q, n, step_on_surface(n, position(q) - position(p)), here)) enqueue(q);
      from_middle(p, r, q);
    });
    carry_to_other_places(p);
    if (!joins_.empty()) carry_to_joined(p);
  }

  // Pulls the metric back by the map, onto the places of a joined vertex with the same tangent plane.
  void carry_to_joined(int p) {
    const Vec3 n = normal(p);
    for (const auto& [joined, back] : joins_[vertex(p)])
      for (int q = fans_.first(joined); q >= 0; q = fans_.next(q)) {
        const Vec3 m = back.turn(normal(q)), near = detail::facing(m, n);
        if (dot(m, near) < angles::cosine_of_26) continue;
        const double h1 = sizes_[p].along(roll(back.turn(sizes_[q].d1), m, near)), h2 = sizes_[p].along(roll(back.turn(sizes_[q].d2), m, near));
        if (!(h1 < (1 - shares::negligible) * sizes_[q].h1) && !(h2 < (1 - shares::negligible) * sizes_[q].h2)) continue;
        sizes_[q].h1 = std::min(sizes_[q].h1, h1);
        sizes_[q].h2 = std::min(sizes_[q].h2, h2);
        enqueue(q);
      }
  }

  // Bounds from the middle of the edge (p, r), where sizes are means.
  void from_middle(int p, int r, int q) {
    const Vec3 n = normal(p), near = facing(n, normal(r));
    const auto mean = [&, s = sizes_[p], t = sizes_[r]](Vec3 w) {
      return 0.5 * (s.along(w) + t.along(roll(w, n, near)));
    };
    const Vec3 way = position(q) - lerp(position(p), position(r), 0.5);
    if (bound(q, n, step_on_surface(n, way), mean)) enqueue(q);
  }

  // Carries the metric, unfolded, to the other sides of a crease or a seam.
  void carry_to_other_places(int p) {
    for (int q = fans_.first(vertex(p)); q >= 0; q = fans_.next(q)) {
      if (q == p) continue;
      Vec3 d1 = sizes_[q].d1, d2 = sizes_[q].d2;
      if (!fans_.carry(q, p, d1) || !fans_.carry(q, p, d2)) continue;
      const double h1 = sizes_[p].along(d1), h2 = sizes_[p].along(d2);
      if (!(h1 < (1 - shares::negligible) * sizes_[q].h1) && !(h2 < (1 - shares::negligible) * sizes_[q].h2)) continue;
      sizes_[q].h1 = std::min(sizes_[q].h1, h1);
      sizes_[q].h2 = std::min(sizes_[q].h2, h2);
      enqueue(q);
    }
  }

  std::vector<TangentMetric>& sizes_ = values_;  // by place
  // A joined vertex, and the map from there to here.
  struct Join {
    int vertex = 0;
    Isometry back;
  };
  std::vector<std::vector<Join>> joins_;  // by vertex
  std::vector<char> waits_;  // by place: it is in the queue, and has not left yet
};

}  // namespace

// Makes the least change of the logarithms of both, to first order; then scales both by the remainder.
void TangentMetric::bound_along(Vec3 w, double h) noexcept {
  const double size = along(w);
  if (!(size > h) || !(dot(w, w) > 0)) return;
  const double a = dot(w, d1) / h1, b = dot(w, d2) / h2;
  const double share = std::isfinite(size) ? a * a / (a * a + b * b) : 0.5;
  const double power = 1 / (share * share + (1 - share) * (1 - share));
  if (std::isfinite(size)) {
    h1 *= std::pow(h / size, share * power);
    h2 *= std::pow(h / size, (1 - share) * power);
  } else {
    h1 = std::min(h1, h);
    h2 = std::min(h2, h);
  }
  const double now = along(w);
  if (!(now > h)) return;
  h1 *= h / now;
  h2 *= h / now;
}

std::optional<TangentMetric> tangent_metric(const SurfaceJet& jet, Metric2 metric) noexcept {
  const auto frame = TangentFrame::of(jet.su, jet.sv);
  if (!frame) return {};
  const Eigen2 e = eigen(frame->of_parameters(metric));
  if (!(e.minor > 0) || !std::isfinite(e.major)) return {};
  return TangentMetric{e.direction.x() * frame->e1 + e.direction.y() * frame->e2,
                       e.direction.x() * frame->e2 - e.direction.y() * frame->e1, 1 / std::sqrt(e.major),
                       1 / std::sqrt(e.minor)};
}

Metric2 metric_of(const SurfaceJet& jet, const TangentMetric& sizes) noexcept {
  const double a = dot(sizes.d1, jet.su) / sizes.h1, b = dot(sizes.d1, jet.sv) / sizes.h1;
  const double c = dot(sizes.d2, jet.su) / sizes.h2, d = dot(sizes.d2, jet.sv) / sizes.h2;
  return {a * a + c * c, a * b + c * d, b * b + d * d};
}

void bound_lean(const SurfaceJet& jet, double lean, TangentMetric& sizes) noexcept {
  if (!(sizes.h2 > sizes.h1)) return;
  // In (u, v): the tangent d is x Su + y Sv.
  const double e = dot(jet.su, jet.su), f = dot(jet.su, jet.sv), g = dot(jet.sv, jet.sv), area2 = e * g - f * f;
  if (!(area2 > 0)) return;
  const auto in_parameters = [&](Vec3 d) {
    const double p = dot(d, jet.su), q = dot(d, jet.sv);
    return Vec2{(g * p - f * q) / area2, (e * q - f * p) / area2};
  };
  const Vec2 x = in_parameters(sizes.d1), y = in_parameters(sizes.d2);
  // Second derivative along both, without its component along the edge.
  const auto aside = [&](Vec2 a, Vec2 b) {
    const Vec3 s = (a.x() * b.x()) * jet.suu + (a.x() * b.y() + a.y() * b.x()) * jet.suv + (a.y() * b.y()) * jet.svv;
    return norm(s - dot(s, sizes.d2) * sizes.d2);
  };
  const double bend = aside(y, y), turn = aside(x, y);
  if (bend > 0) sizes.h2 = std::max(sizes.h1, std::min(sizes.h2, std::sqrt(8 * lean * sizes.h1 / bend)));
  if (turn > 0) sizes.h2 = std::max(sizes.h1, std::min(sizes.h2, 2 * lean / turn));
}

std::vector<TangentMetric> grade_metrics(const GradationGraph& graph, std::vector<TangentMetric> sizes,
                                         const std::vector<MetricSource>& sources, double slope, Monitor& monitor) {
  detail::check_slope(slope);
  if (sizes.size() != graph.places.size())
    throw InvalidArgument("a gradation has " + std::to_string(sizes.size()) + " metrics for " +
                          std::to_string(graph.places.size()) + " places");
  MetricGrading grading(graph, std::move(sizes), slope, monitor);
  for (const MetricSource& s : sources) grading.add(s);
  return grading.run();
}

}  // namespace carreau
