// SPDX-License-Identifier: BSD-3-Clause
#include "atlas/smooth_borders.h"

#include <cmath>
#include <limits>

#include "atlas/thresholds.h"
#include "predicates/clamped_int.h"
#include "support/shares.h"

namespace carreau::atlas {
namespace {

/// Angle of the point of a line that is nearest to the pivot.
double foot(const Vec2& line) { return std::atan2(line.y(), line.x()); }

bool foot_between(const Vec2& line, double from, double to, double& at) {
  at = foot(line);
  if (at < from) at += 2 * std::numbers::pi;
  return at > from && at < to;
}

/// Pieces are divided at their nearest points, so that radii have their extremes at knots (Atlas sec. 5.4.3).
OuterPieces divided_at_feet(const OuterPieces& given) {
  OuterPieces result;
  for (std::size_t k = 0; k + 1 < given.angle.size(); ++k) {
    result.angle.push_back(given.angle[k]), result.radius.push_back(given.radius[k]);
    const Vec2 line = given.line(k);
    constexpr double margin = 1e-3;
    double at = 0;
    if (const double width = given.angle[k + 1] - given.angle[k];
        foot_between(line, given.angle[k] + margin * width, given.angle[k + 1] - margin * width, at))
      result.angle.push_back(at), result.radius.push_back(radius_on(line, at));
  }
  result.angle.push_back(given.angle.back()), result.radius.push_back(given.radius.back());
  return result;
}

/// Pieces over which the ratio of both borders changes much are divided, so that b can follow it.
OuterPieces divided_where_steep(const Part& part, const OuterPieces& given) {
  OuterPieces result;
  for (std::size_t k = 0; k + 1 < given.angle.size(); ++k) {
    const double from = given.angle[k], to = given.angle[k + 1];
    const Vec2 outer = given.line(k), inner = part.line[interval_of(part.angle, (from + to) / 2)];
    const auto width = [&](double at) { return std::abs(radius_on(outer, at) / radius_on(inner, at) - 1); };
    const double change = std::abs(std::log(width(to) / width(from)));
    const int count =
        std::isfinite(change)
            ? clamped_int(std::ceil(change / thresholds::change_of_width), 1, thresholds::divisions)
            : 1;
    for (int i = 0; i < count; ++i) {
      const double at = from + (to - from) * i / count;
      result.angle.push_back(at), result.radius.push_back(i == 0 ? given.radius[k] : radius_on(outer, at));
    }
  }
  result.angle.push_back(given.angle.back()), result.radius.push_back(given.radius.back());
  return result;
}

/// One part: its polygonal borders, from which bounds are computed.
class PartBorders {
 public:
  PartBorders(Part& part, const OuterPieces& pieces) : part_(part), pieces_(pieces) {}

  void round_vertices() {
    part_.rounding.assign(part_.angle.size(), {});
    for (std::size_t k = 1; k + 1 < part_.angle.size(); ++k) {
      constexpr double straight_on = 1e-9;
      if (norm(part_.line[k] - part_.line[k - 1]) < straight_on * norm(part_.line[k])) continue;
      constexpr int halvings = 40;
      double share = thresholds::rounded_share;
      for (int i = 0; i < halvings; ++i, share /= 2) {
        const Rounding r = arc(k, share);
        if (!leaves_room(r)) continue;
        part_.rounding[k] = r;
        break;
      }
    }
  }

  /// A bound of b on piece k: with it b * rho stays on the inner side of the outer border, rounded or not. Below 1 for
  /// pivots outside.
  [[nodiscard]] double bound(std::size_t k) const {
    const double from = pieces_.angle[k], to = pieces_.angle[k + 1];
    double b = nearer(outer(k, from) / straight(from, k), outer(k, to) / straight(to, k));
    for (const Rounding& r : part_.rounding) {
      const double a = std::max(from, r.first), z = std::min(to, r.last);
      if (a < z) b = nearer(b, nearer(outer(k, a), outer(k, z)) / r.radius);
    }
    return 1 + (1 - shares::negligible) * (b - 1);
  }

  [[nodiscard]] double nearer(double a, double b) const { return part_.sense() > 0 ? std::min(a, b) : std::max(a, b); }

 private:
  [[nodiscard]] double outer(std::size_t k, double at) const { return radius_on(pieces_.line(k), at); }
  /// The inner border on piece k, which contains no vertex inside.
  [[nodiscard]] double straight(double at, std::size_t k) const {
    const double middle = (pieces_.angle[k] + pieces_.angle[k + 1]) / 2;
    return radius_on(part_.line[interval_of(part_.angle, middle)], at);
  }

  [[nodiscard]] Rounding arc(std::size_t k, double share) const {
    Rounding r;
    r.at = part_.angle[k];
    double before_it = share * (r.at - part_.angle[k - 1]), behind_it = share * (part_.angle[k + 1] - r.at);
    before_it = std::min(before_it, thresholds::most_uneven_arc * behind_it);
    behind_it = std::min(behind_it, thresholds::most_uneven_arc * before_it);
    r.first = r.at - before_it, r.last = r.at + behind_it;
    const Vec2 &before = part_.line[k - 1], &after = part_.line[k];
    const double radii[] = {radius_on(before, r.first), radius_on(before, r.at), radius_on(after, r.last)};
    if (part_.sense() > 0) {
      r.radius = *std::max_element(std::begin(radii), std::end(radii));
    } else {
      r.radius = *std::min_element(std::begin(radii), std::end(radii));
      double at = 0;
      if (foot_between(before, r.first, r.at, at)) r.radius = std::min(r.radius, radius_on(before, at));
      if (foot_between(after, r.at, r.last, at)) r.radius = std::min(r.radius, radius_on(after, at));
    }
    return r;
  }

  /// Half of the width between the polygons must remain around a vertex.
  [[nodiscard]] bool leaves_room(const Rounding& r) const {
    double polygonal = part_.sense() > 0 ? std::numeric_limits<double>::infinity() : 0, rounded = polygonal;
    for (std::size_t k = 0; k + 1 < pieces_.angle.size(); ++k) {
      const double a = std::max(pieces_.angle[k], r.first), z = std::min(pieces_.angle[k + 1], r.last);
      if (a >= z) continue;
      for (const double at : {a, z}) {
        polygonal = nearer(polygonal, outer(k, at) / straight(at, k)),
        rounded = nearer(rounded, outer(k, at) / r.radius);
      }
    }
    return (rounded - 1) * part_.sense() >= (polygonal - 1) * part_.sense() / 2;
  }

  Part& part_;
  const OuterPieces& pieces_;
};

/// Position conditions at joints: the same width on both sides (Atlas eq. C.2).
void agree_at_joints(std::vector<Part>& parts) {
  for (std::size_t n = 0; n < parts.size(); ++n) {
    Part &p = parts[n], &next = parts[next_of(n, parts.size())];
    const double rho = radius_on(p.line.back(), p.total()), rho_next = radius_on(next.line.front(), 0);
    const double width = std::min(std::abs(p.ratio.back() - 1) * rho, std::abs(next.ratio.front() - 1) * rho_next);
    p.ratio.back() = 1 + p.sense() * width / rho, next.ratio.front() = 1 + next.sense() * width / rho_next;
  }
}

/// Widths beside one another may differ by at most the steepest slope: otherwise the room is reduced.
bool level(Part& part, double steepest) {
  bool any = false;
  const auto lower = [&](std::size_t k, std::size_t beside) {
    const double most = std::abs(part.ratio[beside] - 1) +
                        steepest * std::abs(part.ratio_angle[k] - part.ratio_angle[beside]);
    if (!(std::abs(part.ratio[k] - 1) > most)) return;
    part.ratio[k] = 1 + part.sense() * most, any = true;
  };
  for (std::size_t k = 1; k < part.ratio.size(); ++k) lower(k, k - 1);
  for (std::size_t k = part.ratio.size() - 1; k-- > 0;) lower(k, k + 1);
  return any;
}

}  // namespace

/// Lowering at joints goes round at most once.
void limit_slopes(std::vector<Part>& parts, double steepest) {
  agree_at_joints(parts);
  for (std::size_t round = 0; round <= parts.size(); ++round) {
    bool any = false;
    for (Part& part : parts) any = level(part, steepest) || any;
    if (!any) return;
    agree_at_joints(parts);
  }
}

void smooth_borders(std::vector<Part>& parts, std::vector<OuterPieces> pieces, OuterBorder kind) {
  for (std::size_t n = 0; n < parts.size(); ++n) {
    Part& part = parts[n];
    if (kind != OuterBorder::polygon) pieces[n] = divided_where_steep(part, divided_at_feet(pieces[n]));
    PartBorders borders(part, pieces[n]);
    const std::size_t count = pieces[n].angle.size() - 1;
    part.ratio_angle = pieces[n].angle;
    if (kind == OuterBorder::polygon) {
      for (std::size_t k = 0; k < count; ++k) part.outer_line.push_back(pieces[n].line(k));
      for (std::size_t k = 0; k <= count; ++k)
        part.ratio.push_back(pieces[n].radius[k] /
                             radius_on(part.line[interval_of(part.angle, pieces[n].angle[k])], pieces[n].angle[k]));
      continue;
    }
    borders.round_vertices();
    std::vector<double> bound;
    for (std::size_t k = 0; k < count; ++k) bound.push_back(borders.bound(k));
    if (kind == OuterBorder::cubic) {
      double b = bound[0];
      for (const double other : bound) b = borders.nearer(b, other);
      part.ratio_angle = {0, part.total()}, part.ratio = {b, b};
      continue;
    }
    part.ratio = {bound.front()};
    for (std::size_t k = 1; k < count; ++k) part.ratio.push_back(borders.nearer(bound[k - 1], bound[k]));
    part.ratio.push_back(bound.back());
  }
  if (kind != OuterBorder::polygon) limit_slopes(parts, thresholds::steepest_ratio);
}

}  // namespace carreau::atlas
