// SPDX-License-Identifier: BSD-3-Clause
#include "projection/trimmed_domain.h"

#include <algorithm>
#include <cmath>

#include "projection/thresholds.h"
#include "support/infinity.h"

namespace carreau::projection {

namespace {

namespace limit = thresholds::projection;

bool bounds_face(const Face& face, std::size_t curve) { return face.curves[curve].type == CurveType::boundary; }

double length_of(const std::vector<Vec3>& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += norm(points[i] - points[i - 1]);
  return length;
}

/// For each end its vertex: pairs of nearest ends become one.
std::vector<int> joined_ends(const std::vector<Vec3>& ends) {
  std::vector<int> vertex(ends.size(), -1);
  int next = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (vertex[i] >= 0) continue;
    std::size_t nearest = i;
    double least = infinity;
    for (std::size_t j = i + 1; j < ends.size(); ++j)
      if (vertex[j] < 0 && norm(ends[j] - ends[i]) < least) least = norm(ends[j] - ends[i]), nearest = j;
    vertex[i] = vertex[nearest] = next++;
  }
  return vertex;
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
  const Vec2 near = limit::side_of_box * (high - low);
  for (std::size_t c = 0; c < supports.size(); ++c) {
    if (!bounds_face(face, c)) continue;
    for (const Vec2& p : supports[c].uv) {
      const Vec2 from = (p - low).cwiseMin(high - p);
      if (from.x() > near.x() && from.y() > near.y()) return false;
    }
  }
  return true;
}

TrimmedDomain::TrimmedDomain(const Face& face, const std::vector<CurveSupport>& supports) : ref_(face.ref) {
  const auto [low, high] = box_of_boundary(face, supports);
  low_ = low, size_ = high - low;
  std::vector<Vec3> ends;
  for (std::size_t c = 0; c < supports.size(); ++c)
    if (bounds_face(face, c)) ends.push_back(scaled(supports[c].uv.front())), ends.push_back(scaled(supports[c].uv.back()));
  const std::vector<int> vertex = joined_ends(ends);
  vertices_.resize(ends.size() / 2 + ends.size() % 2);
  std::size_t k = 0;
  for (std::size_t c = 0; c < supports.size(); ++c) {
    if (!bounds_face(face, c)) continue;
    const CurveSupport& support = supports[c];
    std::vector<Vec3> in_square;
    for (const Vec2& p : support.uv) in_square.push_back(scaled(p));
    const double whole = length_of(in_square);
    const int first = vertex[2 * k], last = vertex[2 * k + 1];
    vertices_[static_cast<std::size_t>(first)] = support.uv.front(), vertices_[static_cast<std::size_t>(last)] = support.uv.back();
    int before = first;
    for (std::size_t i = 1; i < support.uv.size(); ++i) {
      const bool ends_here = i + 1 == support.uv.size();
      const int here = ends_here ? last : static_cast<int>(vertices_.size());
      if (!ends_here) vertices_.push_back(support.uv[i]);
      edges_.emplace_back(before, here);
      pieces_.push_back({static_cast<int>(c), support.t[i - 1], support.t[i], support.t.front(), support.t.back(),
                         limit::beside_chord * norm(in_square[i] - in_square[i - 1]) + 1e-5 * whole});
      before = here;
    }
    ++k;
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
  const auto curve_at = [&](double t) { return cad.curve(ref_, piece.curve + 1, want_position | want_first | want_second, t); };
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
