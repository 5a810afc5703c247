// SPDX-License-Identifier: BSD-3-Clause
#include "cad/parameter_domain.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

#include "predicates/polygon_locator.h"
#include "support/infinity.h"
#include "support/rounding_of.h"

namespace carreau {

namespace {

/// Degrees. Supports keep an angle of one degree between a curve and its chord (RT-0232 sec. 3.3); steps keep three.
constexpr double min_angle = 3;
/// Degrees between successive chords; a larger angle is a corner, and a smaller one is added to the angle above.
constexpr double largest_bend = 15;
/// Share of a chord: an arc that makes one degree with its chord leaves it by .0044, a bend adds a quarter of its angle.
constexpr double min_margin = 0.01;

double cross2(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }
double angle_between(const Vec2& a, const Vec2& b) { return std::atan2(std::abs(cross2(a, b)), dot(a, b)); }

BoxTree::Box box_around(const Vec2& a, const Vec2& b, double margin) {
  BoxTree::Box box;
  box.add({a.x(), a.y(), 0}), box.add({b.x(), b.y(), 0});
  box.low -= Vec3{margin, margin, 0}, box.high += Vec3{margin, margin, 0};
  return box;
}

/// Share of a chord: places on both sides of its middle, by which a curve that is given twice is found.
constexpr double beside_middle = 1e-6;
/// Share of the extents, and of a chord: places of a curve after its calculation.
constexpr double on_curve = 1e-13;
/// Steps of Newton's method from the middle of a piece.
constexpr int newton_steps = 12;
constexpr unsigned everything = want_position | want_first | want_second;

double length_of(const std::vector<Vec3>& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += norm(points[i] - points[i - 1]);
  return length;
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double square = dot(d, d), share = square > 0 ? std::clamp(dot(p - a, d) / square, 0.0, 1.0) : 0;
  return norm(p - a - share * d);
}

}  // namespace

std::pair<Vec2, Vec2> box_of(std::span<const BoundaryCurve> boundary) {
  Vec2 low{infinity, infinity}, high{-infinity, -infinity};
  for (const BoundaryCurve& curve : boundary)
    for (const Vec2& p : curve.uv) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return {low, high};
}

void join_ends(std::vector<BoundaryCurve>& boundary) {
  const auto [low, high] = box_of(boundary);
  const Vec2 size = high - low;
  std::vector<Vec2*> ends;
  for (BoundaryCurve& curve : boundary) ends.push_back(&curve.uv.front()), ends.push_back(&curve.uv.back());
  std::vector<char> joined(ends.size(), 0);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (joined[i] != 0) continue;
    std::size_t nearest = i;
    double least = infinity;
    for (std::size_t j = i + 1; j < ends.size(); ++j)
      if (const double d = norm((*ends[j] - *ends[i]).cwiseQuotient(size)); joined[j] == 0 && d < least) least = d, nearest = j;
    *ends[nearest] = *ends[i];
    joined[i] = joined[nearest] = 1;
  }
}

ParameterDomain::ParameterDomain(std::vector<BoundaryCurve> boundary) {
  join_ends(boundary);
  const auto [low, high] = box_of(boundary);
  low_ = low, size_ = high - low;
  std::vector<Vec2> vertices;
  std::vector<std::pair<int, int>> chords;
  for (const BoundaryCurve& curve : boundary)
    for (std::size_t i = 0; i < curve.uv.size(); ++i) {
      vertices.push_back(scaled(curve.uv[i]));
      if (i > 0) chords.emplace_back(static_cast<int>(vertices.size()) - 2, static_cast<int>(vertices.size()) - 1);
    }
  const PolygonLocator polygon(vertices, chords);
  constexpr double degree = std::numbers::pi / 180;
  const auto chord = [&](std::size_t e) -> Vec2 { return vertices[chords[e].second] - vertices[chords[e].first]; };
  std::vector<BoxTree::Box> boxes;
  std::vector<Vec3> centres;
  for (std::size_t e = 0; e < chords.size(); ++e) {
    const Vec2 along = chord(e);
    const double length = norm(along);
    if (!(length > 0)) continue;
    double bend = 0;
    for (const std::size_t other : {e - 1, e + 1})
      if (other < chords.size() && (chords[other].second == chords[e].first || chords[other].first == chords[e].second))
        if (const double angle = angle_between(along, chord(other)); angle < largest_bend * degree) bend = std::max(bend, angle);
    const double side = polygon.inside_left_of(static_cast<int>(e)) ? 1 : -1;
    const Vec2 inward{-side * along.y() / length, side * along.x() / length};
    edges_.push_back({.a = vertices[chords[e].first], .b = vertices[chords[e].second], .inward = inward,
                      .margin = (min_margin + bend / 4) * length, .slack = std::sin(min_angle * degree + bend)});
    const Edge& edge = edges_.back();
    boxes.push_back(box_around(edge.a, edge.b, edge.margin));
    centres.push_back({(edge.a.x() + edge.b.x()) / 2, (edge.a.y() + edge.b.y()) / 2, 0});
  }
  tree_ = BoxTree(boxes, centres);
}

bool ParameterDomain::admits(const Vec2& from, std::span<const Vec2> to) const {
  const Vec2 p = scaled(from);
  BoxTree::Box reach = box_around(p, p, 0);
  for (const Vec2& uv : to) {
    const Vec2 q = scaled(uv);
    reach.add({q.x(), q.y(), 0});
  }
  bool admitted = true;
  tree_.all_that_meet([&](const BoxTree::Box& box) { return admitted && !box.is_apart(reach); },
                      [&](const BoxTree::Node& leaf) {
                        for (const std::int32_t k : tree_.things(leaf)) {
                          const Edge& edge = edges_[static_cast<std::size_t>(k)];
                          if (box_around(edge.a, edge.b, edge.margin).is_apart(reach)) continue;
                          for (const Vec2& uv : to) {
                            const Vec2 q = scaled(uv), step = q - p;
                            admitted = admitted && (dot(step, edge.inward) >= edge.slack * norm(step) || dot(q - edge.a, edge.inward) >= edge.margin);
                          }
                        }
                      });
  return admitted;
}

TrimmedDomain::TrimmedDomain(int face, std::vector<BoundaryCurve> boundary) : ref_(face) {
  const auto [low, high] = box_of(boundary);
  low_ = low, size_ = high - low;
  join_ends(boundary);
  for (const BoundaryCurve& curve : boundary) {
    std::vector<Vec3> in_square;
    for (const Vec2& p : curve.uv) in_square.push_back(scaled(p));
    const double whole = length_of(in_square);
    for (std::size_t i = 0; i < curve.uv.size(); ++i) {
      vertices_.push_back(curve.uv[i]);
      if (i == 0) continue;
      edges_.emplace_back(static_cast<int>(vertices_.size()) - 2, static_cast<int>(vertices_.size()) - 1);
      pieces_.push_back({curve.ic, curve.t[i - 1], curve.t[i], curve.t.front(), curve.t.back(),
                         beside_chord * norm(in_square[i] - in_square[i - 1]) + 1e-5 * whole});
    }
  }
  polygon_.emplace(vertices_, edges_);
  std::vector<BoxTree::Box> boxes(edges_.size());
  std::vector<Vec3> centres(edges_.size());
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const Vec3 p = scaled(vertices_[static_cast<std::size_t>(edges_[e].first)]), q = scaled(vertices_[static_cast<std::size_t>(edges_[e].second)]);
    const Vec3 margin{pieces_[e].margin, pieces_[e].margin, 0};
    boxes[e].add(p), boxes[e].add(q);
    boxes[e].low -= margin, boxes[e].high += margin;
    centres[e] = (p + q) / 2;
  }
  tree_ = BoxTree(boxes, centres);
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const Vec2 &p = vertices_[static_cast<std::size_t>(edges_[e].first)], &q = vertices_[static_cast<std::size_t>(edges_[e].second)];
    const Vec2 middle = (p + q) / 2, beside = beside_middle * Vec2{p.y() - q.y(), q.x() - p.x()};
    pieces_[e].both_sides_inside = polygon_->contains(middle + beside) && polygon_->contains(middle - beside);
  }
}

TrimmedDomain::Side TrimmedDomain::side_of(const Vec2& low, const Vec2& high) const {
  BoxTree::Box box;
  box.add(scaled(low)), box.add(scaled(high));
  bool near = false;
  tree_.all_that_meet([&](const BoxTree::Box& other) { return !near && !box.is_apart(other); },
                      [&](const BoxTree::Node& leaf) {
                        for (const std::int32_t e : tree_.things(leaf)) {
                          const auto& [a, b] = edges_[static_cast<std::size_t>(e)];
                          BoxTree::Box edge;
                          edge.add(scaled(vertices_[static_cast<std::size_t>(a)])), edge.add(scaled(vertices_[static_cast<std::size_t>(b)]));
                          const Vec3 margin{pieces_[static_cast<std::size_t>(e)].margin, pieces_[static_cast<std::size_t>(e)].margin, 0};
                          edge.low -= margin, edge.high += margin;
                          near = near || !box.is_apart(edge);
                        }
                      });
  if (near) return Side::crossing;
  return polygon_->contains((low + high) / 2) ? Side::inside : Side::outside;
}

double TrimmedDomain::distance_to(std::int32_t edge, const Vec3& p) const {
  const auto& [a, b] = edges_[static_cast<std::size_t>(edge)];
  return distance_to_segment(p, scaled(vertices_[static_cast<std::size_t>(a)]), scaled(vertices_[static_cast<std::size_t>(b)]));
}

// The closest place of a curve, in units of the square.
Vec2 TrimmedDomain::closest_of(const Piece& piece, const Vec2& uv, Cad& cad) const {
  double t = (piece.t0 + piece.t1) / 2;
  CurveJet jet = cad.curve(ref_, piece.ic, everything, t);
  for (int k = 0; k < newton_steps; ++k) {
    const Vec2 r = (jet.c - uv).cwiseQuotient(size_), d = jet.ct.cwiseQuotient(size_), dd = jet.ctt.cwiseQuotient(size_);
    const double slope = dot(r, d), speed = dot(d, d), bend = speed + dot(r, dd);
    if (!(speed > 0)) break;
    const double to = std::clamp(t - slope / (bend > 0.1 * speed ? bend : speed), piece.a, piece.b);
    if (std::abs(to - t) <= rounding_of::digits * (piece.b - piece.a)) break;
    t = to, jet = cad.curve(ref_, piece.ic, everything, t);
  }
  return jet.c;
}

// Beside an edge, in its direction and across it: a place, and the curve, which is a graph over the edge.
TrimmedDomain::Beside TrimmedDomain::beside(std::int32_t edge, const Vec2& uv, Cad& cad) const {
  const auto& [first, second] = edges_[static_cast<std::size_t>(edge)];
  const Piece& piece = pieces_[static_cast<std::size_t>(edge)];
  const Vec2 from = vertices_[static_cast<std::size_t>(first)], chord = (vertices_[static_cast<std::size_t>(second)] - from).cwiseQuotient(size_);
  const double length = norm(chord);
  if (!(length > 0)) return {};
  const auto along = [&](const Vec2& d) { return dot(d, chord) / length; };
  const auto across = [&](const Vec2& d) { return cross(chord, d) / length; };
  const Vec2 p = (uv - from).cwiseQuotient(size_);
  Beside beside{.share = along(p) / length, .place = across(p)};
  if (!(beside.share >= -on_curve && beside.share <= 1 + on_curve)) return beside;
  double low = piece.t0, high = piece.t1, t = low + std::clamp(beside.share, 0.0, 1.0) * (high - low);
  for (int k = 0; k < rounding_of::max_steps; ++k) {
    const CurveJet jet = cad.curve(ref_, piece.ic, want_position | want_first, t);
    const Vec2 q = (jet.c - from).cwiseQuotient(size_), d = jet.ct.cwiseQuotient(size_);
    const double off = along(p - q), speed = along(d);
    // The tangent differs from the curve by less than the way along it.
    beside.curve = speed > 0 ? across(q) + off * across(d) / speed : across(q);
    if (std::abs(off) <= on_curve * length || (speed > 0 && std::abs(beside.place - beside.curve) > std::abs(off))) break;
    (off > 0 ? low : high) = t;
    const double to = t + off / speed;
    const double next = speed > 0 && to > low && to < high ? to : (low + high) / 2;
    if (std::abs(next - t) <= rounding_of::digits * (piece.b - piece.a)) break;
    t = next;
  }
  return beside;
}

// The even-odd rule puts a place between a curve and its chord on the other side than the polygon reports.
bool TrimmedDomain::contains(const Vec2& uv, Cad& cad) const {
  const Vec3 p = scaled(uv);
  bool inside = polygon_->contains(uv), on_boundary = false;
  tree_.all_that_meet([&](const BoxTree::Box& box) { return !on_boundary && box.squared_distance(p) <= 0; },
                      [&](const BoxTree::Node& leaf) {
                        for (const std::int32_t e : tree_.things(leaf)) {
                          const Piece& piece = pieces_[static_cast<std::size_t>(e)];
                          if (on_boundary || piece.both_sides_inside || distance_to(e, p) > piece.margin) continue;
                          const auto [share, place, curve] = beside(e, uv, cad);
                          if (!(share >= -on_curve && share <= 1 + on_curve)) continue;
                          on_boundary = std::abs(place - curve) <= on_curve;
                          if (share >= 0 && share < 1 && place * curve > 0 && std::abs(place) < std::abs(curve)) inside = !inside;
                        }
                      });
  return inside || on_boundary;
}

std::optional<Vec2> TrimmedDomain::closest_from_outside(const Vec2& uv, Cad& cad) const {
  if (edges_.empty() || contains(uv, cad)) return {};
  const Vec3 p = scaled(uv);
  double nearest = infinity;
  std::int32_t edge = 0;
  tree_.nearest_first([&](std::size_t n) { return tree_.node(n).box.squared_distance(p); },
                      [&](double bound) { return bound <= nearest * nearest; },
                      [&](const BoxTree::Node& leaf) {
                        for (const std::int32_t e : tree_.things(leaf)) {
                          if (pieces_[static_cast<std::size_t>(e)].both_sides_inside) continue;
                          const double d = distance_to(e, p);
                          if (d < nearest || (d == nearest && e < edge)) nearest = d, edge = e;
                        }
                      });
  return closest_of(pieces_[static_cast<std::size_t>(edge)], uv, cad);
}

}  // namespace carreau
