// SPDX-License-Identifier: BSD-3-Clause
#include "atlas/covering/ring_chart.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atlas/covering/ring_phi.h"
#include "atlas/covering/shared_triangle.h"
#include "atlas/covering/thresholds.h"
#include "atlas/pivots.h"

namespace carreau::atlas {
namespace {

/// A direction from the centre of the pure zone and its phi.
struct Bearing {
  double angle, phi;
};

class StarRing {
 public:
  StarRing(const Triangulation& surface, const Frame& frame, const Ring& ring, const Polygon& inner, const Vec2& centre)
      : surface_(surface), frame_(frame), ring_(ring), inner_(inner), centre_(centre) {}

  RingChart chart(Polygon outer) const {
    const std::vector<Bearing> bearings = increasing(middles());
    const double period = sixth_turn * static_cast<double>(ring_.triples.size());
    RingChart chart{{}, std::move(outer), {}};
    const std::size_t n = inner_.size();
    for (std::size_t v = 0; v < n; ++v) {
      const Vec2 &a = inner_[v], &b = inner_[next_of(v, n)];
      const double from = angle_of(a), width = turn(a, b);
      chart.inner.push_back(a), chart.phi.push_back(phi_at(bearings, period, from));
      std::vector<Bearing> on_edge;
      for (const Bearing& bearing : bearings) {
        const double ahead = positive(bearing.angle - from);
        if (ahead > thresholds::apart && ahead < width - thresholds::apart) on_edge.push_back({ahead, bearing.phi});
      }
      std::sort(on_edge.begin(), on_edge.end(), [](const Bearing& p, const Bearing& q) { return p.angle < q.angle; });
      for (const Bearing& bearing : on_edge) {
        const double at = from + bearing.angle;
        const Vec2 ray(std::cos(at), std::sin(at));
        chart.inner.push_back(lerp(a, b, crossing_share(a, b, centre_, Vec2(centre_ + ray)))),
            chart.phi.push_back(bearing.phi);
      }
    }
    unwrap(chart.phi, period);
    return chart;
  }

 private:
  [[nodiscard]] static double positive(double angle) {
    return angle - 2 * std::numbers::pi * std::floor(angle / (2 * std::numbers::pi));
  }
  [[nodiscard]] double angle_of(const Vec2& p) const { return std::atan2(p.y() - centre_.y(), p.x() - centre_.x()); }
  [[nodiscard]] double turn(const Vec2& a, const Vec2& b) const {
    return std::atan2(cross(a - centre_, b - centre_), dot(a - centre_, b - centre_));
  }
  [[nodiscard]] Vec2 project(std::int32_t v) const {
    return frame_.project(surface_.vertices[static_cast<std::size_t>(v)]);
  }

  [[nodiscard]] std::vector<Bearing> middles() const {
    std::vector<Bearing> list;
    std::size_t triple = 0;
    for (std::size_t s = 0; s < ring_.spokes.size(); ++s) {
      const Spoke &spoke = ring_.spokes[s], &next = ring_.spokes[(s + 1) % ring_.spokes.size()];
      const Vec2 sum = project(spoke.inner) + project(spoke.outer);
      list.push_back({angle_of(sum / 2), spoke.phi});
      if (triple < ring_.triples.size() && ring_.triples[triple] == s)
        list.push_back({angle_of((sum + project(next.outer)) / 3), sixth_turn * (static_cast<double>(triple++) + .5)});
    }
    return list;
  }

  /// Unwraps angles, and drops angles that do not increase, as of triangles that lie askew. Within one turn.
  [[nodiscard]] static std::vector<Bearing> increasing(const std::vector<Bearing>& list) {
    std::vector<Bearing> kept;
    for (const Bearing& b : list) {
      if (kept.empty()) {
        kept.push_back(b);
        continue;
      }
      const double step = std::remainder(b.angle - kept.back().angle, 2 * std::numbers::pi);
      const double at = kept.back().angle + step;
      if (step > thresholds::apart && at < kept.front().angle + 2 * std::numbers::pi - thresholds::apart)
        kept.push_back({at, b.phi});
    }
    return kept;
  }

  [[nodiscard]] static double phi_at(const std::vector<Bearing>& bearings, double period, double angle) {
    const double ahead = positive(angle - bearings.front().angle);
    for (std::size_t k = 0; k < bearings.size(); ++k) {
      const bool last = k + 1 == bearings.size();
      const double from = bearings[k].angle - bearings.front().angle;
      const double to = last ? 2 * std::numbers::pi : bearings[k + 1].angle - bearings.front().angle;
      const double phi_to = last ? bearings.front().phi + period : bearings[k + 1].phi;
      if (ahead <= to) return bearings[k].phi + (phi_to - bearings[k].phi) * std::max(0.0, ahead - from) / (to - from);
    }
    return bearings.back().phi;
  }

  static void unwrap(std::vector<double>& phi, double period) {
    for (std::size_t v = 1; v < phi.size(); ++v) phi[v] -= period * std::floor((phi[v] - phi[v - 1]) / period);
  }

  const Triangulation& surface_;
  const Frame& frame_;
  const Ring& ring_;
  const Polygon& inner_;
  Vec2 centre_;
};

}  // namespace

RingChart chart_of_ring(const Triangulation& surface, const Frame& frame, const Ring& ring) {
  const auto projected = [&](const std::vector<std::int32_t>& border) {
    Polygon p;
    for (const std::int32_t v : border) p.push_back(frame.project(surface.vertices[static_cast<std::size_t>(v)]));
    return p;
  };
  const Polygon inner = projected(ring.inner_border);
  const StarCentre centre = star_centre(inner);
  if (!centre.found) return {inner, projected(ring.outer_border), phi_of_border(ring)};
  return StarRing(surface, frame, ring, inner, centre.place).chart(projected(ring.outer_border));
}

}  // namespace carreau::atlas
