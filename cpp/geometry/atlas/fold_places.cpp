// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/atlas/fold_places.h"

#include <algorithm>

#include "geometry/atlas/thresholds.h"

namespace carreau::atlas {

FoldPlace::Tangents FoldPlace::tangents(const std::vector<Primitive>& primitives) const {
  Tangents t;
  for (std::size_t c = 0; c < shares; ++c) {
    const std::array<Slope, 3> p = primitives[share[c].chart].at(share[c].at);
    const Slope& w = share[c].weight;
    for (int i = 0; i < 3; ++i) {
      const Slope& s = p[static_cast<std::size_t>(i)];
      t.by_u[i] += w.u * s.f + w.f * s.u, t.by_v[i] += w.v * s.f + w.f * s.v;
    }
  }
  return t;
}

Vec3 FoldPlace::point(const std::vector<Primitive>& primitives) const {
  Vec3 x(0, 0, 0);
  for (std::size_t c = 0; c < shares; ++c) {
    const std::array<double, 3> p = primitives[share[c].chart].at(pair_of(value_of(share[c].at)));
    x += share[c].weight.f * Vec3(p[0], p[1], p[2]);
  }
  return x;
}

double FoldPlace::jacobian(const std::vector<Primitive>& primitives) const {
  const Tangents t = tangents(primitives);
  return dot(cross(t.by_u, t.by_v), normal);
}

FoldGrid::FoldGrid(const Covering& covering, const std::vector<PlaceOfT>& given)
    : covering_(covering), given_(covering.triples().size()) {
  // Parts of the grid on each T: some 1500 places that charts share. Folds are narrow: of the T of joint.off with folds on this grid, a
  // grid of 24 parts misses two thirds, 48 parts three eighths.
  constexpr int n = 96;
  const auto is_shared = [](const Node& node) {
    return std::all_of(node.weight.begin(), node.weight.end(), [](const Slope& w) { return w.f < 1; });
  };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      const Node node = node_at((i * corner_of_t(1) + j * corner_of_t(2)) / n);
      if (is_shared(node)) nodes_.push_back(node);
    }
  for (const PlaceOfT& place : given)
    if (is_shared(node_at(place.at))) given_[place.triple].push_back(place.at);
}

FoldGrid::Node FoldGrid::node_at(const Vec2& place) {
  const Pair<Slope> p = parameters_at<Slope>(place);
  Node node{Covering::weights(p), {}};
  for (int c = 0; c < 3; ++c) {
    const Polar<Slope> polar = to_polar(c, p);
    node.place[static_cast<std::size_t>(c)] = {share_of(polar), polar.phi};
  }
  return node;
}

FoldPlace FoldGrid::place(std::size_t triple, const Node& node) const {
  const Triple& t = covering_.triples()[triple];
  FoldPlace place;
  double area = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    if (node.weight[c].f <= 0) continue;
    const auto i = static_cast<std::size_t>(t.chart[c]);
    const Chart& chart = covering_.charts()[i];
    const Pair<Slope> at = chart.annulus.at(node.place[c].l, Slope(node.place[c].phi + t.slot[c] * sixth_turn));
    place.share[place.shares++] = {i, node.weight[c], at};
    place.normal += node.weight[c].f * chart.frame.normal;
    area += node.weight[c].f * (at[0].u * at[1].v - at[0].v * at[1].u);
  }
  place.normal /= area * norm(place.normal);
  return place;
}

std::vector<FoldPlace> FoldGrid::of_pure_zone(std::size_t chart) const {
  const Chart& own = covering_.charts()[chart];
  std::vector<FoldPlace> list;
  const auto add = [&](const Vec2& m) {
    FoldPlace place;
    place.share[0] = {chart, Slope(1), parameters_at<Slope>(m)};
    place.shares = 1, place.normal = own.frame.normal;
    list.push_back(place);
  };
  const auto projected = [&](std::int32_t v) -> Vec2 {
    return own.frame.project(covering_.surface().vertices[static_cast<std::size_t>(v)]);
  };
  const auto is_member = [&](std::int32_t v) { return std::binary_search(own.members.begin(), own.members.end(), v); };
  for (const std::int32_t v : own.members) {
    add(projected(v));
    const auto& fan = covering_.fans().around(v);
    for (std::size_t k = 0; k < fan.size(); ++k) {
      const std::int32_t b = fan[k], c = fan[(k + 1) % fan.size()];
      if (v < b && is_member(b)) add((projected(v) + projected(b)) / 2);
      if (v < b && v < c && is_member(b) && is_member(c)) add((projected(v) + projected(b) + projected(c)) / 3);
    }
  }
  constexpr std::size_t a_corner = 16;
  for (std::size_t k = 0; k < a_corner * own.corners.size(); ++k)
    add(value_of(own.annulus.at(0., static_cast<double>(k) * sixth_turn / a_corner)));
  return list;
}

}  // namespace carreau::atlas
