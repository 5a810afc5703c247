// A row keeps the number of points of the one before; where the metric wants more or fewer, some are added or merged.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/placement/filler.h"

namespace carreau::plane {

namespace {

constexpr double merge_gap = 0.55, wide_gap = 1.5;
constexpr double narrow_gap = 0.6;
constexpr int strain_window = 5;

}  // namespace

double Filler::distance(const Candidate& p, const Candidate& q) const {
  if (mesh_.is_bent(p.a, q.a)) return distance_at_middle(p.p, q.p);
  return length(0.5 * (p.metric + q.metric), q.p - p.p);
}

void Filler::respace(bool closed) {
  const bool round = closed && chain_.size() > 3;
  if (chain_.size() >= 2) merge_and_extend(round);
  if (chain_.size() < 3) {
    row_.insert(row_.end(), chain_.begin(), chain_.end());
    return;
  }
  if (round) chain_.push_back(chain_.front());
  share_strain();
  if (round) row_.pop_back();
}

// Two candidates that nearly coincide become one; a wide gap is a corner to go round.
void Filler::merge_and_extend(bool closed) {
  spaced_.clear();
  const std::size_t n = chain_.size();
  bool merged_first = false;
  for (std::size_t i = 0; i < n; ++i) {
    spaced_.push_back(chain_[i]);
    const bool last = i + 1 == n;
    if (last && (!closed || merged_first)) break;
    const Candidate& after = last ? chain_.front() : chain_[i + 1];
    const double gap = distance(chain_[i], after);
    if (gap < merge_gap) {
      spaced_.back().p = 0.5 * (chain_[i].p + after.p);
      spaced_.back().metric = 0.5 * (chain_[i].metric + after.metric);
      if (last) {
        spaced_.front() = spaced_.back();
        spaced_.pop_back();
      }
      if (i == 0) merged_first = true;
      ++i;
    } else if (gap > wide_gap) {
      go_round_corner(chain_[i], after);
    }
  }
  chain_.swap(spaced_);
}

// Points at unit distance from the corner that the two front edges share, 60 degrees of the metric apart.
void Filler::go_round_corner(const Candidate& before, const Candidate& after) {
  const Vertex& corner = mesh_.vertices[after.a];
  const Metric2 m = corner.metric();
  const Vec2 u = before.p - corner.point(), v = after.p - corner.point();
  const double root = std::sqrt(std::max(determinant(m), 1e-300));
  // Clockwise from u to v.
  double angle = -std::atan2(root * cross(u, v), dot(m, u, v));
  if (angle < 0) angle += 2 * std::numbers::pi;
  const int pieces = static_cast<int>(angle / (std::numbers::pi / 3) + 0.4);
  const double lu = length(m, u);
  if (pieces < 2 || pieces > 5 || !(lu > 0)) return;
  // An orthonormal pair of the metric: e along u, f a quarter turn counterclockwise from it.
  const Vec2 e = (1 / lu) * u, f{-(m.b * e.x() + m.c * e.y()) / root, (m.a * e.x() + m.b * e.y()) / root};
  for (int k = 1; k < pieces; ++k) {
    const double a = -angle * k / pieces;
    const Vec2 d = std::cos(a) * e + std::sin(a) * f;
    const double l = length(0.5 * (m + field_.at(corner.point() + d)), d);
    const Candidate& near = 2 * k < pieces ? before : after;
    spaced_.push_back({corner.point() + (1 / l) * d, m, near.edge, near.a});
  }
}

// The misfit is summed up along the row, and when it makes a whole edge the last few intervals share one point more or
// less.
void Filler::share_strain() {
  const int n = static_cast<int>(chain_.size());
  gaps_.resize(chain_.size());
  for (int i = 0; i + 1 < n; ++i) gaps_[i] = distance(chain_[i], chain_[i + 1]);
  double strain = 0;
  int sent = 0;  // candidates before this one are in the row
  for (int i = 0; i + 1 < n; ++i) {
    if (gaps_[i] > wide_gap || gaps_[i] < narrow_gap) {
      strain = 0;
      while (sent <= i) row_.push_back(chain_[sent++]);
      continue;
    }
    strain += gaps_[i] - 1;
    if (std::abs(strain) <= strain_limit_) continue;
    const int low = std::max(sent, i - 2 * strain_window + 1), high = i + 1, intervals = high - low;
    if (intervals < 3) continue;
    const int wanted = intervals + (strain > 0 ? 1 : -1);
    while (sent <= low) row_.push_back(chain_[sent++]);
    double total = 0;
    for (int k = low; k < high; ++k) total += gaps_[k];
    int k = low;
    double before = 0;
    for (int q = 1; q < wanted; ++q) {
      const double target = total * q / wanted;
      while (k + 1 < high && before + gaps_[k] < target) before += gaps_[k++];
      const double w = (target - before) / gaps_[k];
      const Candidate& near = w < 0.5 ? chain_[k] : chain_[k + 1];
      row_.push_back({lerp(chain_[k].p, chain_[k + 1].p, w), near.metric, near.edge, near.a});
    }
    sent = high;
    strain -= strain > 0 ? 1 : -1;
  }
  while (sent < n) row_.push_back(chain_[sent++]);
}

}  // namespace carreau::plane
