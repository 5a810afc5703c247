// SPDX-License-Identifier: BSD-3-Clause
#include "plane/placement/respacing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/kernel/thresholds.h"

namespace carreau::plane {

namespace {

double distance(const Placement& placement, const Candidate& p, const Candidate& q) {
  if (placement.mesh.is_bent(p.a, q.a)) return placement.field.length_at_middle(p.p, q.p);
  return length(0.5 * (p.metric + q.metric), q.p - p.p);
}

// Points at unit distance from the corner that the two front edges share, 60 degrees of the metric apart.
void go_round_corner(const Placement& placement, const Candidate& before, const Candidate& after,
                     std::vector<Candidate>& to) {
  const Vertex& corner = placement.mesh.vertices[after.a];
  const Metric2 m = corner.metric();
  const Vec2 u = before.p - corner.point(), v = after.p - corner.point();
  const double root = std::sqrt(std::max(determinant(m), 1e-300));
  // Clockwise from u to v.
  double angle = -std::atan2(root * cross(u, v), dot(m, u, v));
  if (angle < 0) angle += 2 * std::numbers::pi;
  const int pieces = static_cast<int>(angle / (std::numbers::pi / 3) + corner_rounding);
  const double lu = length(m, u);
  if (pieces < 2 || pieces > 5 || !(lu > 0)) return;
  // An orthonormal pair of the metric: e along u, f a quarter turn counterclockwise from it.
  const Vec2 e = (1 / lu) * u, f{-(m.b * e.x() + m.c * e.y()) / root, (m.a * e.x() + m.b * e.y()) / root};
  for (int k = 1; k < pieces; ++k) {
    const double a = -angle * k / pieces;
    const Vec2 d = std::cos(a) * e + std::sin(a) * f;
    const double l = length(0.5 * (m + placement.field.at(corner.point() + d)), d);
    const Candidate& near = 2 * k < pieces ? before : after;
    to.push_back({corner.point() + (1 / l) * d, m, near.edge, near.a});
  }
}

// Two candidates that nearly coincide become one; a wide gap is a corner to go round.
void merge_and_extend(const Placement& placement, Layer& layer, bool closed) {
  std::vector<Candidate>&chain = layer.chain, &spaced = layer.spaced;
  spaced.clear();
  const std::size_t n = chain.size();
  bool merged_first = false;
  for (std::size_t i = 0; i < n; ++i) {
    spaced.push_back(chain[i]);
    const bool last = i + 1 == n;
    if (last && (!closed || merged_first)) break;
    const Candidate& after = last ? chain.front() : chain[i + 1];
    const double gap = distance(placement, chain[i], after);
    if (gap < merge_gap) {
      spaced.back().p = 0.5 * (chain[i].p + after.p);
      spaced.back().metric = 0.5 * (chain[i].metric + after.metric);
      if (last) {
        spaced.front() = spaced.back();
        spaced.pop_back();
      }
      if (i == 0) merged_first = true;
      ++i;
    } else if (gap > wide_gap) {
      go_round_corner(placement, chain[i], after, spaced);
    }
  }
  chain.swap(spaced);
}

// Adds or removes one point: `wanted` - 1 at equal distances between candidates low and high of the chain.
void share_evenly(Layer& layer, int low, int high, int wanted) {
  double total = 0;
  for (int k = low; k < high; ++k) total += layer.gaps[k];
  int k = low;
  double before = 0;
  for (int q = 1; q < wanted; ++q) {
    const double target = total * q / wanted;
    while (k + 1 < high && before + layer.gaps[k] < target) before += layer.gaps[k++];
    const double w = (target - before) / layer.gaps[k];
    const Candidate &p = layer.chain[k], &next = layer.chain[k + 1], &near = w < 0.5 ? p : next;
    layer.points.push_back({lerp(p.p, next.p, w), near.metric, near.edge, near.a});
  }
}

// The misfit is summed up along the chain, and when it makes a whole edge the last few intervals share one point more
// or less.
void share_strain(const Placement& placement, Layer& layer) {
  const std::vector<Candidate>& chain = layer.chain;
  std::vector<double>& gaps = layer.gaps;
  const int n = static_cast<int>(chain.size());
  gaps.resize(chain.size());
  for (int i = 0; i + 1 < n; ++i) gaps[i] = distance(placement, chain[i], chain[i + 1]);
  double strain = 0;
  int sent = 0;  // candidates before this one are among the points
  for (int i = 0; i + 1 < n; ++i) {
    if (gaps[i] > wide_gap || gaps[i] < narrow_gap) {
      strain = 0;
      while (sent <= i) layer.points.push_back(chain[sent++]);
      continue;
    }
    strain += gaps[i] - 1;
    if (std::abs(strain) <= layer.strain_limit) continue;
    const int low = std::max(sent, i - 2 * strain_window + 1), high = i + 1, intervals = high - low;
    if (intervals < 3) continue;
    while (sent <= low) layer.points.push_back(chain[sent++]);
    share_evenly(layer, low, high, intervals + (strain > 0 ? 1 : -1));
    sent = high;
    strain -= strain > 0 ? 1 : -1;
  }
  while (sent < n) layer.points.push_back(chain[sent++]);
}

}  // namespace

double strain_limit(const Field& field) {
  return field.measure() < large_mesh ? strain_limit_small : strain_limit_large;
}

void respace(const Placement& placement, Layer& layer, bool closed) {
  std::vector<Candidate>&chain = layer.chain, &points = layer.points;
  const bool round = closed && chain.size() > 3;
  if (chain.size() >= 2) merge_and_extend(placement, layer, round);
  if (chain.size() < 3) {
    points.insert(points.end(), chain.begin(), chain.end());
    return;
  }
  if (round) chain.push_back(chain.front());
  share_strain(placement, layer);
  if (round) points.pop_back();
}

}  // namespace carreau::plane
