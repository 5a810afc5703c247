// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane/plane_arcs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "geometry/plane/catmull_rom.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

std::string place(const Vec2& p) { return "(" + format_number(p.x()) + ", " + format_number(p.y()) + ")"; }

Where where_of(const PlaneDomainInput& input, int line) {
  Where where;
  where.file = input.source, where.line = line;
  return where;
}

[[noreturn]] void refuse_curve(const PlaneDomainInput& input, int curve, const std::string& sentence) {
  throw InvalidModel(where_of(input, input.curves[curve].line), name_of_curve(input, curve) + " " + sentence);
}

void check_values(const PlaneDomainInput& input, int p) {
  const PlanePoint& point = input.points[p];
  const auto refuse = [&](const std::string& sentence) {
    throw InvalidModel(where_of(input, point.line), name_of_point(input, p) + " " + sentence);
  };
  if (!is_finite(point.xy)) refuse("has a coordinate that is not finite");
  if (point.size && !(*point.size > 0 && std::isfinite(*point.size)))
    refuse("has the size " + format_number(*point.size) + "; sizes must be positive");
  if (point.metric &&
      !(point.metric->a > 0 && determinant(*point.metric) > 0 && std::isfinite(determinant(*point.metric))))
    refuse("has a metric that is not positive definite");
}

void check_points(const PlaneDomainInput& input) {
  std::vector<int> order(input.points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int p) { return std::pair{input.points[p].xy.x(), input.points[p].xy.y()}; };
  for (const int p : order) check_values(input, p);
  std::sort(order.begin(), order.end(), [&](int p, int q) { return std::pair{key(p), p} < std::pair{key(q), q}; });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (const int p = order[i - 1], q = order[i]; key(p) == key(q))
      throw InvalidModel(where_of(input, input.points[q].line),
                         name_of_point(input, p) + " and " + name_of_point(input, q) + " are at the same place " +
                             place(input.points[p].xy));
}

void check_indices(const PlaneDomainInput& input, int c) {
  const PlaneCurve& curve = input.curves[c];
  const int n = static_cast<int>(input.points.size());
  if (curve.points.size() < 2) refuse_curve(input, c, "passes fewer than two points");
  for (const int p : curve.points)
    if (p < 0 || p >= n) refuse_curve(input, c, "names the point " + std::to_string(p + 1) + ", which does not exist");
  for (const int p : {curve.before, curve.after})
    if (p < -1 || p >= n) refuse_curve(input, c, "names the point " + std::to_string(p + 1) + ", which does not exist");
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    if (curve.points[i - 1] == curve.points[i])
      refuse_curve(input, c, "passes " + name_of_point(input, curve.points[i]) + " twice in succession");
  for (const auto& tangent : {curve.tangent_start, curve.tangent_end})
    if (tangent && !is_finite(*tangent)) refuse_curve(input, c, "has a tangent that is not finite");
}

void check_arcs(const PlaneDomainInput& input, int c) {
  const PlaneCurve& curve = input.curves[c];
  if (curve.points.size() < 3 || curve.points.size() % 2 == 0)
    refuse_curve(input, c,
                 "of arcs passes " + std::to_string(curve.points.size()) +
                     " points; each arc has a start, a point between and an end, with which the next one starts");
}

CirclePiece circle_of(const PlaneDomainInput& input, int c, std::size_t rank) {
  const std::vector<int>& points = input.curves[c].points;
  const auto arc = arc_through(input.points[points[rank]].xy, input.points[points[rank + 1]].xy,
                               input.points[points[rank + 2]].xy);
  if (!arc)
    refuse_curve(input, c,
                 "has no arc through " + name_of_point(input, points[rank]) + ", " +
                     name_of_point(input, points[rank + 1]) + " and " + name_of_point(input, points[rank + 2]) +
                     ": they lie on one line");
  return *arc;
}

std::vector<CubicPiece> pieces_of(const PlaneDomainInput& input, const PlaneCurve& curve) {
  std::vector<Vec2> passed;
  for (const int p : curve.points) passed.push_back(input.points[p].xy);
  if (!curve.smooth) return straight_pieces(passed);
  SplineEnds ends{.before = {}, .after = {}, .tangent_start = curve.tangent_start, .tangent_end = curve.tangent_end};
  if (curve.before >= 0) ends.before = input.points[curve.before].xy;
  if (curve.after >= 0) ends.after = input.points[curve.after].xy;
  return catmull_rom(passed, ends);
}

void check_piece(const PlaneDomainInput& input, int c, std::size_t rank, const CubicPiece& piece,
                 std::vector<std::string>& warnings) {
  const PlaneCurve& curve = input.curves[c];
  const std::string which =
      "between " + name_of_point(input, curve.points[rank]) + " and " + name_of_point(input, curve.points[rank + 1]);
  if (const auto loop = loop_of(piece))
    refuse_curve(input, c,
                 "makes a loop " + which + ": it passes " + place(loop->at) + " twice, at t = " +
                     format_number(loop->t1) + " and " + format_number(loop->t2) + " of that piece");
  if (const auto t = cusp_of(piece))
    refuse_curve(input, c, "has a cusp " + which + ", at " + place(piece.at(*t)) + " (t = " + format_number(*t) + ")");
  if (turns_back(piece))
    warnings.push_back(where_of(input, curve.line).prefix() + name_of_curve(input, c) + " turns back " + which +
                       "; its control points may be wrong");
}

/// Marks the points at which a mesh has vertices: ends of curves, points of several curves, corners of polylines,
/// imposed points.
std::vector<char> vertices_of(const PlaneDomainInput& input) {
  std::vector<int> passes(input.points.size(), 0);
  std::vector<char> vertex(input.points.size(), 0);
  for (const PlaneCurve& curve : input.curves) {
    vertex[curve.points.front()] = vertex[curve.points.back()] = 1;
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const bool inner = curve.arcs ? i % 2 == 1 : curve.smooth;
      if (++passes[curve.points[i]] > 1 || !inner) vertex[curve.points[i]] = 1;
    }
  }
  for (std::size_t p = 0; p < input.points.size(); ++p)
    if (input.points[p].imposed) vertex[p] = 1;
  return vertex;
}

/// Ends are exactly the points: rounding of coefficients must not open loops.
void make_polyline(const PlaneDomainInput& input, PlaneArc& arc, double eps) {
  arc.polyline.clear();
  arc.parameter.clear();
  const auto add = [&](double t, const Vec2& p) {
    arc.parameter.push_back(t);
    arc.polyline.push_back(p);
  };
  for (std::size_t i = 0; i < arc.pieces.size(); ++i) {
    const auto at = static_cast<double>(i);
    add(at, input.points[arc.passed[i]].xy);
    for (const double t : subdivide(arc.pieces[i], eps)) add(at + t, arc.pieces[i].at(t));
  }
  add(static_cast<double>(arc.pieces.size()), input.points[arc.to].xy);
}

}  // namespace

std::string name_of_point(const PlaneDomainInput& input, int point) {
  const std::string& name = input.points[point].name;
  return "point " + (name.empty() ? std::to_string(point + 1) : "'" + name + "'");
}

std::string name_of_curve(const PlaneDomainInput& input, int curve) {
  const std::string& name = input.curves[curve].name;
  return "curve " + (name.empty() ? std::to_string(curve + 1) : "'" + name + "'");
}

Vec2 PlaneArc::at(double t) const noexcept {
  const auto last = static_cast<double>(pieces.size() - 1);
  const double i = std::clamp(std::floor(t), 0.0, last);
  return pieces[static_cast<std::size_t>(i)].at(t - i);
}

namespace {

void add_circles(const PlaneDomainInput& input, int c, const std::vector<char>& vertex, std::vector<PlaneArc>& arcs) {
  const std::vector<int>& points = input.curves[c].points;
  const auto add = [&](const CirclePiece& piece, int from, int to) {
    arcs.push_back({.curve = c, .pieces = {{piece}}, .passed = {from, to}, .from = from, .to = to, .polyline = {}, .parameter = {}});
  };
  for (std::size_t i = 0; i + 2 < points.size(); i += 2) {
    const CirclePiece arc = circle_of(input, c, i);
    if (vertex[points[i + 1]] == 0) {
      add(arc, points[i], points[i + 2]);
      continue;
    }
    const auto [before, behind] = cut_at(arc, input.points[points[i + 1]].xy);
    add(before, points[i], points[i + 1]);
    add(behind, points[i + 1], points[i + 2]);
  }
}

void add_pieces(const PlaneDomainInput& input, int c, const std::vector<char>& vertex, std::vector<PlaneArc>& arcs,
                std::vector<std::string>& warnings) {
  const PlaneCurve& curve = input.curves[c];
  const std::vector<CubicPiece> pieces = pieces_of(input, curve);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (curve.smooth) check_piece(input, c, i, pieces[i], warnings);
    const int here = curve.points[i];
    if (i == 0 || vertex[here] != 0)
      arcs.push_back(
          {.curve = c, .pieces = {}, .passed = {here}, .from = here, .to = 0, .polyline = {}, .parameter = {}});
    arcs.back().pieces.push_back({pieces[i]});
    arcs.back().passed.push_back(curve.points[i + 1]);
    arcs.back().to = curve.points[i + 1];
  }
}

}  // namespace

std::vector<PlaneArc> cut_into_arcs(const PlaneDomainInput& input, double eps, std::vector<std::string>& warnings) {
  check_points(input);
  const int curves = static_cast<int>(input.curves.size());
  for (int c = 0; c < curves; ++c) {
    check_indices(input, c);
    if (input.curves[c].arcs) check_arcs(input, c);
  }
  const std::vector<char> vertex = vertices_of(input);
  std::vector<PlaneArc> arcs;
  for (int c = 0; c < curves; ++c) {
    if (input.curves[c].arcs)
      add_circles(input, c, vertex, arcs);
    else
      add_pieces(input, c, vertex, arcs, warnings);
  }
  refine_polylines(input, arcs, eps);
  return arcs;
}

void refine_polylines(const PlaneDomainInput& input, std::vector<PlaneArc>& arcs, double eps) {
  for (PlaneArc& arc : arcs) make_polyline(input, arc, eps);
}

}  // namespace carreau
