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

}  // namespace carreau
