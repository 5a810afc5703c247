// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/grid/ridges/ridges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "geometry/grid/differences.h"
#include "geometry/grid/ridges/thresholds.h"
#include "support/angles.h"
#include "support/rounding_of.h"

namespace carreau::grid {

namespace {

/// The larger principal curvature at a place, and how it changes along its direction.
struct Bend {
  bool known = false;
  double curvature = 0;  ///< absolute value
  Vec3 along;            ///< its direction, a unit vector of either sense
  double slope = 0;      ///< derivative of `curvature` along the direction
};

/// Derivatives by splines of a quantity at all nodes.
class Nodes {
 public:
  explicit Nodes(const CoonsSurface& surface) : surface_(surface), closed_{is_closed(true), is_closed(false)} {}

  [[nodiscard]] std::vector<Vec3> derivative(const std::vector<Vec3>& of, bool along_u) const {
    const std::size_t columns = surface_.u.size(), rows = surface_.v.size(), count = along_u ? columns : rows;
    const std::vector<double>& knots = along_u ? surface_.u : surface_.v;
    std::vector<Vec3> out(of.size());
    std::vector<Sample> line(count);
    std::vector<char> there(count);
    for (std::size_t k = 0; k < (along_u ? rows : columns); ++k) {
      const auto node = [&](std::size_t m) { return along_u ? m + columns * k : k + columns * m; };
      for (std::size_t m = 0; m < count; ++m) line[m] = {knots[m], of[node(m)]}, there[m] = is_finite(of[node(m)]) ? 1 : 0;
      const std::vector<Vec3> d = spline_derivatives(line, there, closed_[along_u ? 0 : 1]);
      for (std::size_t m = 0; m < count; ++m) out[node(m)] = there[m] != 0 ? d[m] : Vec3(Vec3::Constant(std::nan("")));
    }
    return out;
  }

 private:
  /// The first and the last line of nodes are one, and the surface is smooth there.
  [[nodiscard]] bool is_closed(bool along_u) const {
    const std::size_t count = along_u ? surface_.v.size() : surface_.u.size(), last = (along_u ? surface_.u.size() : surface_.v.size()) - 1;
    if (last < 3) return false;
    for (std::size_t k = 0; k < count; ++k) {
      const Node &a = along_u ? surface_.node(0, k) : surface_.node(k, 0), &b = along_u ? surface_.node(last, k) : surface_.node(k, last);
      const Vec3 &p = along_u ? a.su : a.sv, &q = along_u ? b.su : b.sv;
      if (is_finite(a.s) != is_finite(b.s) || norm(a.s - b.s) > 0 || norm(p - q) > rounding_of::sizes * norm(p)) return false;
    }
    return true;
  }

  const CoonsSurface& surface_;
  std::array<bool, 2> closed_;
};

/// Mean and principal curvatures from derivatives.
struct Forms {
  double e, f, g, l, m, p, area, mean, half;

  Forms(const Vec3& su, const Vec3& sv, const Vec3& suu, const Vec3& suv, const Vec3& svv)
      : e(dot(su, su)), f(dot(su, sv)), g(dot(sv, sv)), area(e * g - f * f) {
    const Vec3 n = cross(su, sv) / std::sqrt(area);
    l = dot(suu, n), m = dot(suv, n), p = dot(svv, n);
    mean = (e * p - 2 * f * m + g * l) / (2 * area);
    half = std::sqrt(std::max(0., mean * mean - (l * p - m * m) / area));
  }
  [[nodiscard]] bool singular() const { return !(area > rounding_of::heights * e * g); }
};

/// Both principal curvatures, the larger one first; NaN at singular nodes.
Vec3 curvatures_of(const Vec3& su, const Vec3& sv, const Vec3& suu, const Vec3& suv, const Vec3& svv) {
  const Forms forms(su, sv, suu, suv, svv);
  if (forms.singular()) return Vec3::Constant(std::nan(""));
  return {forms.mean + forms.half, forms.mean - forms.half, 0};
}

/// The principal curvature of larger absolute value, its direction, and its slope by the derivatives of both curvatures.
Bend bend_of(const Vec3& su, const Vec3& sv, const Vec3& suu, const Vec3& suv, const Vec3& svv, const Vec3& cu, const Vec3& cv) {
  const Forms forms(su, sv, suu, suv, svv);
  if (forms.singular()) return {};
  const double sign = forms.mean < 0 ? -1 : 1, k = forms.mean + sign * forms.half;
  // (l - k e, m - k f; m - k f, p - k g) has the direction in its kernel.
  const Vec2 first{k * forms.f - forms.m, forms.l - k * forms.e}, second{k * forms.g - forms.p, forms.m - k * forms.f};
  const Vec3 one = first.x() * su + first.y() * sv, other = second.x() * su + second.y() * sv;
  const Vec2 d = norm(one) > norm(other) ? first : second;
  const double length = std::max(norm(one), norm(other));
  const int which = sign > 0 ? 0 : 1;
  const double slope = sign * (d.x() * cu[which] + d.y() * cv[which]) / length;
  if (!(length > 0) || !std::isfinite(slope)) return {};
  return {true, std::abs(k), Vec3((d.x() * su + d.y() * sv) / length), slope};
}

/// The bicubic spline through the nodes of a surface, and both principal curvatures as splines through their values at nodes.
class Field {
 public:
  explicit Field(const CoonsSurface& surface)
      : geometry_{surface.u, surface.v, std::vector<Node>(surface.nodes.size()), surface.cells}, curvatures_(geometry_) {
    const Nodes nodes(surface);
    std::vector<Vec3> s;
    for (const Node& node : surface.nodes) s.push_back(node.s);
    const std::vector<Vec3> suu = fill(nodes, s, geometry_), svv = nodes.derivative(column(&Node::sv), false);
    std::vector<Vec3> both(s.size(), Vec3::Constant(std::nan("")));
    for (std::size_t k = 0; k < s.size(); ++k) {
      const Node& node = geometry_.nodes[k];
      if (is_finite(node.s)) both[k] = curvatures_of(node.su, node.sv, suu[k], node.suv, svv[k]);
    }
    fill(nodes, both, curvatures_);
    for (std::size_t k = 0; k < s.size(); ++k) {
      const Node &node = geometry_.nodes[k], &c = curvatures_.nodes[k];
      bends_.push_back(bend_of(node.su, node.sv, suu[k], node.suv, svv[k], c.su, c.sv));
    }
  }

  [[nodiscard]] const Bend& at_node(std::size_t node) const { return bends_[node]; }
  [[nodiscard]] Bend at(const Vec2& uv) const {
    const SurfaceJet s = geometry_.at(uv), c = curvatures_.at(uv);
    return bend_of(s.su, s.sv, s.suu, s.suv, s.svv, c.su, c.sv);
  }

 private:
  [[nodiscard]] std::vector<Vec3> column(Vec3 Node::*member) const {
    std::vector<Vec3> out;
    for (const Node& node : geometry_.nodes) out.push_back(node.*member);
    return out;
  }
  /// Returns second derivatives along u.
  static std::vector<Vec3> fill(const Nodes& nodes, const std::vector<Vec3>& values, CoonsSurface& to) {
    const std::vector<Vec3> u = nodes.derivative(values, true), v = nodes.derivative(values, false), uv = nodes.derivative(u, false);
    for (std::size_t k = 0; k < values.size(); ++k) to.nodes[k] = {values[k], u[k], v[k], uv[k]};
    return nodes.derivative(u, true);
  }

  CoonsSurface geometry_, curvatures_;
  std::vector<Bend> bends_;
};

using Edge = std::pair<std::size_t, std::size_t>;  // nodes, the smaller one first

/// A place where a line crosses an edge.
struct Crossing {
  Vec2 uv;
  std::vector<Edge> next;  ///< in the triangles on both sides
};

class Finder {
 public:
  Finder(const CoonsSurface& surface, double radius) : surface_(surface), radius_(radius), field_(surface) {}

  std::vector<std::vector<Vec3>> run(Monitor& monitor) {
    const std::size_t columns = surface_.u.size();
    for (std::size_t j = 0; j + 1 < surface_.v.size(); ++j) {
      monitor.checkpoint();
      for (std::size_t i = 0; i + 1 < columns; ++i) {
        if (!surface_.has_cell(i, j)) continue;
        const std::size_t a = i + columns * j, b = a + 1, c = b + columns, d = a + columns;
        triangle({a, b, c}), triangle({a, c, d});
      }
    }
    return lines();
  }

 private:
  [[nodiscard]] Vec2 uv(std::size_t node) const { return {surface_.u[node % surface_.u.size()], surface_.v[node / surface_.u.size()]}; }

  /// Adds the part of a line in a triangle.
  void triangle(const std::array<std::size_t, 3>& at) {
    std::array<double, 3> slope{};
    std::array<Vec3, 3> along;
    for (std::size_t k = 0; k < 3; ++k) {
      const Bend& bend = field_.at_node(at[k]);
      if (!bend.known) return;
      const double sign = k > 0 && dot(bend.along, along[0]) < 0 ? -1 : 1;
      along[k] = sign * bend.along;
      slope[k] = sign * (bend.slope == 0 ? std::numeric_limits<double>::min() : bend.slope);
      for (std::size_t m = 0; m < k; ++m)
        if (dot(along[k], along[m]) < angles::cosine_of_45) return;  // an umbilic is near
    }
    std::vector<std::pair<Edge, double>> ends;
    double curvature = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t m = (k + 1) % 3;
      if ((slope[k] < 0) == (slope[m] < 0)) continue;
      const double share = slope[k] / (slope[k] - slope[m]);
      ends.push_back({{at[k], at[m]}, share});
      curvature += ((1 - share) * field_.at_node(at[k]).curvature + share * field_.at_node(at[m]).curvature) / 2;
    }
    if (ends.size() != 2 || !(curvature * radius_ > 1)) return;
    // The second derivative of the curvature along its direction.
    const Vec3 p = surface_.nodes[at[1]].s - surface_.nodes[at[0]].s, q = surface_.nodes[at[2]].s - surface_.nodes[at[0]].s;
    const Vec3 mean = along[0] + along[1] + along[2], t = mean / norm(mean);
    const double pp = dot(p, p), pq = dot(p, q), qq = dot(q, q), det = pp * qq - pq * pq;
    if (!(det > 0)) return;
    const double x = (qq * dot(p, t) - pq * dot(q, t)) / det, y = (pp * dot(q, t) - pq * dot(p, t)) / det;
    const double bending = x * (slope[1] - slope[0]) + y * (slope[2] - slope[0]);
    if (!(bending < -thresholds::ridges::min_fall * curvature * curvature * curvature)) return;
    std::array<Edge, 2> keys;
    for (std::size_t k = 0; k < 2; ++k) {
      const Edge& edge = ends[k].first;
      keys[k] = std::minmax(edge.first, edge.second);
      if (crossings_.count(keys[k]) == 0) crossings_[keys[k]].uv = crossing(keys[k]);
    }
    crossings_[keys[0]].next.push_back(keys[1]), crossings_[keys[1]].next.push_back(keys[0]);
  }

  /// The place on an edge where the slope of the curvature is zero, by the method of false position (its form of Illinois).
  [[nodiscard]] Vec2 crossing(const Edge& edge) const {
    const Bend &a = field_.at_node(edge.first), &b = field_.at_node(edge.second);
    double x = 0, y = 1, at_x = a.slope, at_y = dot(a.along, b.along) < 0 ? -b.slope : b.slope;
    const Vec2 start = uv(edge.first), step = uv(edge.second) - start;
    for (int k = 0, side = 0; k < thresholds::ridges::max_evaluations && at_x != at_y; ++k) {
      const double t = (x * at_y - y * at_x) / (at_y - at_x);
      const Bend middle = field_.at(start + t * step);
      const double turn = dot(a.along, middle.along);
      if (!middle.known || std::abs(turn) < angles::cosine_of_45) break;
      const double value = turn < 0 ? -middle.slope : middle.slope;
      if (value == 0) return start + t * step;
      const bool left = (value < 0) == (at_x < 0);
      if (left) {
        x = t, at_x = value;
        if (side == 1) at_y /= 2;
      } else {
        y = t, at_y = value;
        if (side == -1) at_x /= 2;
      }
      side = left ? 1 : -1;
    }
    return start + (at_x == at_y ? 0.5 : (x * at_y - y * at_x) / (at_y - at_x)) * step;
  }

  std::vector<std::vector<Vec3>> lines() {
    std::vector<std::vector<Vec3>> all;
    for (const bool closed : {false, true})
      for (const auto& [edge, crossing] : crossings_) {
        if (used_.count(edge) != 0 || (!closed && crossing.next.size() != 1)) continue;
        const std::vector<Vec2> places = line_from(edge);
        if (is_border(places)) continue;
        std::vector<Vec3> line = thinned(places, closed);
        double length = 0;
        for (std::size_t k = 1; k < line.size(); ++k) length += norm(line[k] - line[k - 1]);
        if (line.size() > 1 && length > radius_) all.push_back(std::move(line));
      }
    return all;
  }

  std::vector<Vec2> line_from(const Edge& start) {
    std::vector<Vec2> line;
    for (std::optional<Edge> at = start; at;) {
      used_[*at] = true;
      const Crossing& crossing = crossings_.at(*at);
      line.push_back(crossing.uv);
      at.reset();
      for (const Edge& next : crossing.next)
        if (used_.count(next) == 0) at = next;
    }
    return line;
  }

  /// Returns whether most places are as near to the border of the grid as if they were on it: it is a curve already.
  [[nodiscard]] bool is_border(const std::vector<Vec2>& line) const {
    const auto near = [](const std::vector<double>& knots, double x) {
      const std::size_t n = knots.size();
      const double first = (x - knots[0]) / (knots[1] - knots[0]), last = (knots[n - 1] - x) / (knots[n - 1] - knots[n - 2]);
      return std::min(first, last) < thresholds::ridges::beside_border;
    };
    const auto count = std::count_if(line.begin(), line.end(), [&](const Vec2& p) { return near(surface_.u, p.x()) || near(surface_.v, p.y()); });
    return 2 * static_cast<std::size_t>(count) > line.size();
  }

  /// Places on the surface; a place nearer to the previous one than a share of the cells is left out. Both ends of open lines stay.
  [[nodiscard]] std::vector<Vec3> thinned(const std::vector<Vec2>& line, bool closed) const {
    std::vector<Vec3> kept;
    for (std::size_t k = 0; k < line.size(); ++k) {
      const SurfaceJet at = surface_.at(line[k]);
      const double step = thresholds::ridges::step * std::sqrt(norm(cross(at.su, at.sv)) * cell_area(line[k]));
      const bool last = k + 1 == line.size(), near = k > 0 && norm(at.s - kept.back()) < step;
      if (near && last && !closed && kept.size() > 1) kept.back() = at.s;
      if (near || (last && closed && norm(at.s - kept.front()) < step)) continue;
      kept.push_back(at.s);
    }
    if (closed) kept.push_back(kept.front());
    return kept;
  }

  [[nodiscard]] double cell_area(const Vec2& at) const {
    const auto width = [](const std::vector<double>& knots, double x) {
      const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, x);
      return *above - *(above - 1);
    };
    return width(surface_.u, at.x()) * width(surface_.v, at.y());
  }

  const CoonsSurface& surface_;
  double radius_;
  Field field_;
  std::map<Edge, Crossing> crossings_;
  std::map<Edge, bool> used_;
};

}  // namespace

std::vector<std::vector<Vec3>> find_ridges(const CoonsSurface& surface, double radius, Monitor& monitor) {
  return Finder(surface, radius).run(monitor);
}

}  // namespace carreau::grid
