// SPDX-License-Identifier: BSD-3-Clause
#include "atlas/parts.h"

#include <cmath>

namespace carreau::atlas {
namespace {

/// A joint: the crossing of the loop with the segment from pivot k to the next.
struct Joint {
  std::size_t edge = 0;
  double share = 0;  ///< along the edge
  Vec2 place{0, 0};
};

std::vector<Joint> joints_of(const Polygon& loop, const Pivots& pivots) {
  std::vector<Joint> joints;
  for (std::size_t k = 0; k < pivots.size(); ++k) {
    const std::size_t e = pivots.crossed[k];
    const Vec2 &a = loop[e], &b = loop[next_of(e, loop.size())];
    Joint joint{e, 0.5, lerp(a, b, 0.5)};
    if (pivots.size() > 1) {
      const Vec2 &c = pivots.place[k], &d = pivots.place[next_of(k, pivots.size())];
      joint.share = crossing_share(a, b, c, d), joint.place = lerp(c, d, crossing_share(c, d, a, b));
    }
    joints.push_back(joint);
  }
  return joints;
}

class PartMaker {
 public:
  PartMaker(const Polygon& loop, const Pivots& pivots, std::span<const double> phi, double period)
      : loop_(loop), pivots_(pivots), phi_(phi), period_(period), joints_(joints_of(loop, pivots)) {}

  std::vector<Part> make() {
    std::vector<Part> parts;
    const Joint& first = joints_.back();
    turn_ = 0, phi_at_ = phi_on(first.edge, first.share);
    for (std::size_t k = 0; k < pivots_.size(); ++k)
      parts.push_back(part(k, joints_[previous_of(k, joints_.size())], joints_[k], k + 1 == pivots_.size()));
    parts.back().phi.back() = parts.front().phi.front() + period_;
    return parts;
  }

 private:
  [[nodiscard]] double phi_on(std::size_t edge, double share) const {
    const double from = phi_[edge], to = edge + 1 < phi_.size() ? phi_[edge + 1] : phi_[0] + period_;
    return from + share * (to - from);
  }
  /// phi of a place of the loop that lies ahead of the last one: by full turns.
  double ahead(double phi) {
    while (phi + turn_ < phi_at_) turn_ += period_;
    return phi_at_ = phi + turn_;
  }

  Part part(std::size_t k, const Joint& from, const Joint& to, bool last) {
    Part p;
    p.pivot = pivots_.place[k], p.side = pivots_.is_inside(k) ? 1 : -1;
    p.start = (from.place - p.pivot) / norm(from.place - p.pivot);
    p.angle = {0}, p.phi = {phi_at_};
    Vec2 before = from.place;
    const auto go_to = [&](const Vec2& place, double phi) {
      const Vec2 a = before - p.pivot, b = place - p.pivot;
      p.angle.push_back(p.angle.back() + p.side * std::atan2(cross(a, b), dot(a, b)));
      p.phi.push_back(phi), before = place;
    };
    const std::size_t m = loop_.size();
    std::size_t e = from.edge;
    const bool whole_turn = pivots_.size() == 1;
    for (bool begun = false; e != to.edge || (whole_turn && !begun); begun = true) {
      p.line.push_back(line_through(p, loop_[e], loop_[next_of(e, m)]));
      e = next_of(e, m);
      go_to(loop_[e], ahead(phi_[e]));
    }
    p.line.push_back(line_through(p, loop_[e], loop_[next_of(e, m)]));
    go_to(to.place, last ? p.phi.front() + period_ : ahead(phi_on(to.edge, to.share)));
    if (whole_turn) p.angle.back() = 2 * std::numbers::pi;
    return p;
  }

  const Polygon& loop_;
  const Pivots& pivots_;
  std::span<const double> phi_;
  double period_;
  std::vector<Joint> joints_;
  double turn_ = 0, phi_at_ = 0;
};

double steepness(const Part& p, std::size_t k) { return (p.angle[k + 1] - p.angle[k]) / (p.phi[k + 1] - p.phi[k]); }

/// The least distance from the pivot at a joint, over all strata.
double min_distance(const Part& p, std::size_t edge, double at, bool first) {
  const double b = p.ratio_angle.empty() ? 1 : (first ? p.ratio.front() : p.ratio.back());
  return radius_on(p.line[edge], at) * std::min(1.0, b);
}

}  // namespace

Vec2 line_through(const Part& part, const Vec2& a, const Vec2& b) {
  const auto local = [&](const Vec2& p) -> Vec2 {
    const Vec2 d = p - part.pivot;
    return {dot(part.start, d), part.side * cross(part.start, d)};
  };
  const Vec2 p = local(a), q = local(b);
  return Vec2(q.y() - p.y(), p.x() - q.x()) / cross(p, q);
}

std::vector<Part> make_parts(const Polygon& loop, const Pivots& pivots, std::span<const double> phi, double period) {
  return PartMaker(loop, pivots, phi, period).make();
}

std::vector<double> phi_by_length(const Polygon& loop, double period) {
  std::vector<double> phi{0};
  for (std::size_t v = 1; v < loop.size(); ++v) phi.push_back(phi.back() + norm(loop[v] - loop[v - 1]));
  const double whole = phi.back() + norm(loop.front() - loop.back());
  for (double& value : phi) value *= period / whole;
  return phi;
}

void make_smooth(std::vector<Part>& parts) {
  for (std::size_t n = 0; n < parts.size(); ++n) {
    Part &p = parts[n], &next = parts[next_of(n, parts.size())];
    p.slope.assign(p.angle.size(), 0);
    for (std::size_t k = 1; k + 1 < p.angle.size(); ++k) p.slope[k] = std::min(steepness(p, k - 1), steepness(p, k));
    // One lambda a joint is enough for C1 (Atlas eq. 5.10), and distorts less than one for all.
    const std::size_t last = p.line.size() - 1;
    p.last_speed = next.first_speed = std::min(steepness(p, last) * min_distance(p, last, p.total(), false),
                                               steepness(next, 0) * min_distance(next, 0, 0, true));
  }
}

}  // namespace carreau::atlas
