// SPDX-License-Identifier: BSD-3-Clause
#include "projection/trimmed_domain.h"

#include <algorithm>
#include <cmath>

#include "cad/parameter_domain.h"
#include "projection/thresholds.h"
#include "support/infinity.h"
#include "support/rounding_of.h"

namespace carreau::projection {

namespace {

namespace limit = thresholds::projection;

bool bounds_face(const Face& face, std::size_t curve) { return face.curves[curve].type == CurveType::boundary; }

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

std::pair<Vec2, Vec2> box_of_boundary(const Face& face, const std::vector<CurveSupport>& supports) {
  Vec2 low{infinity, infinity}, high{-infinity, -infinity};
  for (std::size_t c = 0; c < supports.size(); ++c) {
    if (!bounds_face(face, c)) continue;
    for (const Vec2& p : supports[c].uv) low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  return {low, high};
}

bool is_box(const Face& face, const std::vector<CurveSupport>& supports, const Vec2& low, const Vec2& high) {
  const Vec2 near = rounding_of::places * (high - low);
  for (std::size_t c = 0; c < supports.size(); ++c) {
    if (!bounds_face(face, c)) continue;
    for (const Vec2& p : supports[c].uv) {
      const Vec2 from = (p - low).cwiseMin(high - p);
      if (from.x() > near.x() && from.y() > near.y()) return false;
    }
  }
  return true;
}

std::vector<BoundaryCurve> boundary_of(const Face& face, const std::vector<CurveSupport>& supports) {
  std::vector<BoundaryCurve> boundary;
  for (std::size_t c = 0; c < supports.size(); ++c)
    if (bounds_face(face, c)) boundary.push_back({static_cast<int>(c) + 1, supports[c].t, supports[c].uv});
  return boundary;
}

TrimmedDomain::TrimmedDomain(const Face& face, const std::vector<CurveSupport>& supports) : ref_(face.ref) {
  const auto [low, high] = box_of_boundary(face, supports);
  low_ = low, size_ = high - low;
  std::vector<BoundaryCurve> boundary = boundary_of(face, supports);
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
                         limit::beside_chord * norm(in_square[i] - in_square[i - 1]) + 1e-5 * whole});
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

bool TrimmedDomain::contains(const Vec2& uv, Cad& cad) const {
  const Vec3 p = scaled(uv);
  double nearest = infinity;
  std::int32_t edge = -1;
  tree_.all_that_meet([&](const BoxTree::Box& box) { return box.squared_distance(p) <= 0; },
                      [&](const BoxTree::Node& leaf) {
                        for (const std::int32_t e : tree_.things(leaf)) {
                          const auto& [a, b] = edges_[static_cast<std::size_t>(e)];
                          const double d = distance_to_segment(p, scaled(vertices_[static_cast<std::size_t>(a)]), scaled(vertices_[static_cast<std::size_t>(b)]));
                          if (d > pieces_[static_cast<std::size_t>(e)].margin) continue;
                          if (d < nearest || (d == nearest && e < edge)) nearest = d, edge = e;
                        }
                      });
  const bool of_polygon = polygon_->contains(uv);
  if (edge < 0) return of_polygon;
  // The closest point of the curve, in units of the square.
  const Piece& piece = pieces_[static_cast<std::size_t>(edge)];
  const auto curve_at = [&](double t) { return cad.curve(ref_, piece.ic, want_position | want_first | want_second, t); };
  const auto unit = [&](const Vec2& d) -> Vec2 { return {d.x() / size_.x(), d.y() / size_.y()}; };
  double t = (piece.t0 + piece.t1) / 2;
  CurveJet jet = curve_at(t);
  bool at_end = false;
  for (int k = 0; k < 12; ++k) {
    const Vec2 r = unit(jet.c - uv), d = unit(jet.ct), dd = unit(jet.ctt);
    const double slope = dot(r, d), speed = dot(d, d), bend = speed + dot(r, dd);
    if (!(speed > 0)) break;
    const double to = std::clamp(t - slope / (bend > 0.1 * speed ? bend : speed), piece.a, piece.b);
    at_end = to == piece.a || to == piece.b;
    if (std::abs(to - t) <= 1e-14 * (piece.b - piece.a)) break;
    t = to, jet = curve_at(t);
  }
  const Vec2 r = unit(uv - jet.c), d = unit(jet.ct);
  if (norm(r) <= 1e-13) return true;
  if (at_end || !(norm(d) > 0)) return of_polygon;
  return (cross(d, r) >= 0) == polygon_->inside_left_of(edge);
}

}  // namespace carreau::projection
