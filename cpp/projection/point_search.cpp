// SPDX-License-Identifier: BSD-3-Clause
#include "projection/point_search.h"

#include <algorithm>
#include <cmath>

#include "projection/thresholds.h"
#include "support/infinity.h"
#include "support/shares.h"

namespace carreau::projection {

namespace {

namespace limit = thresholds::projection;

// Inline, unlike the member of the box: a search calls it a hundred times.
inline double squared_distance(const BoxTree::Box& box, const Vec3& x) {
  double square = 0;
  for (int k = 0; k < 3; ++k) {
    const double low = box.low[k] - x[k], high = x[k] - box.high[k], beyond = low > high ? low : high;
    square += beyond > 0 ? beyond * beyond : 0;
  }
  return square;
}

}  // namespace

PointSearch::PointSearch(const PieceTree& tree, std::span<const Vec3> points, double diagonal, SearchGroup& group)
    : tree_(&tree), group_(&group), x_(points.front()), diagonal_(diagonal) {
  best_.square = nearest_sample_ = infinity;
  double bound = infinity;  // some point is not farther
  group.trial.clear();
  begin_at_predecessor(bound);
  const auto matters = [&](double least) { return least <= (1 + 1e-12) * bound * bound; };
  if (!(norm(x_ - group.centre) <= group.reach)) collect(points, bound);
  if (group.reach >= 0) {
    const double off = (1 + 1e-12) * norm(x_ - group.centre);
    for (const SearchGroup::Near& each : group.near) {
      if (each.distance > bound + off) continue;
      if (const double square = squared_distance(each.piece->box, x_); matters(square)) look_at(*each.piece, square, true, bound);
    }
  } else {
    tree.boxes().nearest_first([&](std::int32_t n) { return squared_distance(tree.boxes().node(static_cast<std::size_t>(n)).box, x_); }, matters,
                               [&](const BoxTree::Node& leaf) {
                                 for (const PieceTree::Piece& piece : tree.pieces(leaf))
                                   if (const double square = squared_distance(piece.box, x_); matters(square)) look_at(piece, square, false, bound);
                               });
  }
  refine(bound);
  next_ = group.kept.size();
  group.kept.insert(group.kept.end(), group.trial.begin(), group.trial.end());
  end_ = group.kept.size();
  begin();
}

// Collects the pieces for this point and the next ones, as many as lie in a small ball: their closest points are no farther from its centre
// than the bound there and twice its radius.
void PointSearch::collect(std::span<const Vec3> points, double bound) {
  SearchGroup& group = *group_;
  group.reach = -1;
  if (!(bound < infinity)) return;
  const Pieces& of_place = tree_->of(group.entity);
  const auto rank = static_cast<std::size_t>(group.piece);
  const bool on_leaf = rank < of_place.leaves.size();
  // Points so near to each other share their pieces. [time only]
  const double most = 0.08 * bound + 0.25 * (on_leaf ? of_place.leaves[rank].size : 0);
  Vec3 centre = x_;
  double reach = 0;
  for (std::size_t n = std::min<std::size_t>(points.size(), 32); n > 1; n = n / 2) {
    BoxTree::Box box;
    for (const Vec3& p : points.first(n)) box.add(p);
    const Vec3 middle = (box.low + box.high) / 2;
    if (norm(x_ - middle) > most) continue;
    double radius = 0;
    for (const Vec3& p : points.first(n)) radius = std::max(radius, norm(p - middle));
    if (radius > most) continue;
    centre = middle, reach = (1 + 1e-12) * radius;
    break;
  }
  double radius = bound + norm(x_ - centre);
  if (on_leaf && reach > 0) {
    const SurfaceLeaf& leaf = of_place.leaves[rank];
    const LeafPlace place = nearest_on(leaf, centre, (group.place - leaf.region.low).cwiseQuotient(leaf.region.size()), nullptr, infinity);
    radius = std::min(radius, std::max(place.distance + leaf.error + place.slack, std::sqrt(of_place.turned[rank].squared_distance(centre))));
  }
  group.near.clear();
  radius = (1 + 1e-12) * (radius + 2 * reach);
  const double square = radius * radius;
  bool few = true;
  tree_->boxes().all_that_meet([&](const BoxTree::Box& box) { return few && squared_distance(box, centre) <= square; },
                               [&](const BoxTree::Node& leaf) {
                                 for (const PieceTree::Piece& piece : tree_->pieces(leaf)) {
                                   double least = squared_distance(piece.box, centre);
                                   if (least > square) continue;
                                   if (piece.is_leaf) least = std::max(least, piece.turned.squared_distance(centre));
                                   if (least <= square) group.near.push_back({&piece, (1 - 1e-12) * std::sqrt(least)});
                                 }
                                 // If there are more pieces, each point searches on its own. [time only]
                                 few = group.near.size() <= 256;
                               });
  if (few) group.centre = centre, group.reach = reach;
}

// The place of the predecessor is near, and gives the bound that excludes most pieces.
void PointSearch::begin_at_predecessor(double& bound) {
  if (group_->entity < 0) return;
  Candidate& candidate = group_->trial.emplace_back(Candidate{group_->entity, group_->piece, {}, 0, 0, 0, false});
  if (const CurveLeaf* curve = curve_of(candidate)) {
    look_at(*curve, candidate, bound);
  } else {
    const SurfaceLeaf& leaf = pieces_of(candidate).leaves[static_cast<std::size_t>(candidate.piece)];
    candidate.floor = (1 - 1e-12) * std::sqrt(pieces_of(candidate).turned[static_cast<std::size_t>(candidate.piece)].squared_distance(x_));
    const NearestSample sample = nearest_sample(leaf, x_);
    candidate.start = (group_->place - leaf.region.low).cwiseQuotient(leaf.region.size());
    solve(candidate, &sample, bound);
    nearest_sample_ = candidate.distance;
  }
}

// `square`: of the distance of its box. `is_near`: the predecessor gave a good bound. Otherwise samples give one.
void PointSearch::look_at(const PieceTree::Piece& piece, double square, bool is_near, double& bound) {
  if (piece.entity == group_->entity && piece.rank == group_->piece) return;  // known
  const Pieces& pieces = tree_->of(piece.entity);
  const auto k = static_cast<std::size_t>(piece.rank);
  Candidate candidate{piece.entity, piece.rank, {}, 0, 0, 0, false};
  if (!piece.is_leaf) {
    candidate.floor = (1 - 1e-12) * std::sqrt(square);
    look_at(pieces.curves[k - pieces.leaves.size()], candidate, bound);
    return group_->trial.push_back(candidate);
  }
  const TurnedBox::Nearest nearest = piece.turned.nearest(x_);
  square = std::max(square, nearest.square);
  if (square > (1 + 1e-12) * bound * bound) return;
  candidate.floor = (1 - 1e-12) * std::sqrt(square);  // a sample may be a corner of a flat box
  if (is_near) {
    candidate.start = pieces.triangles ? place_of(nearest_sample(pieces.leaves[k], x_)) : nearest.share;
    solve(candidate, nullptr, bound);
    if (candidate.least() <= bound) group_->trial.push_back(candidate);
    return;
  }
  const SurfaceLeaf& leaf = pieces.leaves[k];
  const NearestSample sample = nearest_sample(leaf, x_);
  candidate.start = place_of(sample);
  candidate.distance = std::sqrt(sample.square);
  candidate.error = leaf.cover;
  if (!leaf.cut) {
    bound = std::min(bound, candidate.distance);
    if (candidate.distance < nearest_sample_) nearest_sample_ = candidate.distance, solve(candidate, nullptr, bound);  // a bound for the others
  }
  group_->trial.push_back(candidate);
}

void PointSearch::look_at(const CurveLeaf& curve, Candidate& candidate, double& bound) {
  const LeafPlace place = nearest_on(curve, x_);
  candidate.start = place.parameters, candidate.distance = place.distance, candidate.error = curve.error;
  bound = std::min(bound, place.distance + curve.error);
}

// From `start`, a share of the leaf, to the nearest place of the interpolation.
void PointSearch::solve(Candidate& candidate, const NearestSample* sample, double& bound) const {
  const SurfaceLeaf& leaf = pieces_of(candidate).leaves[static_cast<std::size_t>(candidate.piece)];
  const LeafPlace place = nearest_on(leaf, x_, candidate.start, sample, bound);
  candidate.start = place.parameters, candidate.distance = place.distance, candidate.error = leaf.error + place.slack, candidate.solved = true;
  // The interpolation may leave the box of a leaf that is small and bent; a place of a cut leaf may lie outside of the domain.
  if (!leaf.cut) bound = std::min(bound, std::max(place.distance + candidate.error, candidate.floor));
}

// Solves the candidates in ascending order.
void PointSearch::refine(double& bound) {
  std::vector<Candidate>& candidates = group_->trial;
  const auto ascending = [](const Candidate& a, const Candidate& b) {
    if (a.distance != b.distance) return a.distance < b.distance;
    return a.entity != b.entity ? a.entity < b.entity : a.piece < b.piece;
  };
  const auto drop = [&] {
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(), [&](const Candidate& c) { return c.least() > bound; }), candidates.end());
    if (candidates.size() > 1) std::sort(candidates.begin(), candidates.end(), ascending);
  };
  drop();
  for (Candidate& candidate : candidates)
    if (curve_of(candidate) == nullptr && !candidate.solved && candidate.least() <= bound) solve(candidate, nullptr, bound);
  drop();
  group_->entity = -1;
  for (const Candidate& candidate : candidates) {
    const bool is_curve = curve_of(candidate) != nullptr;
    if (!is_curve && pieces_of(candidate).leaves[static_cast<std::size_t>(candidate.piece)].cut) continue;
    group_->entity = candidate.entity, group_->piece = candidate.piece, group_->place = candidate.start;
    break;
  }
}

// The nearest place of a leaf on its border to another leaf is no minimum: from there the descent enters the leaf of the best place.
bool PointSearch::leads_to_best(const Candidate& c) const {
  const Pieces& pieces = pieces_of(c);
  if (c.entity != best_.entity || best_.place.curve >= 0 || curve_of(c) != nullptr || pieces.triangles) return false;
  const Region& leaf = pieces.leaves[static_cast<std::size_t>(c.piece)].region;
  const Vec2 size = leaf.size(), &best = best_.place.parameters;
  bool at_border = false;
  for (int k = 0; k < 2; ++k) {
    if (std::abs(best[k] - c.start[k]) > shares::notable * size[k]) return false;
    at_border = at_border || (c.start[k] <= leaf.low[k] && best[k] < leaf.low[k]) || (c.start[k] >= leaf.high[k] && best[k] > leaf.high[k]);
  }
  return at_border;
}

// Begins the descent of the next candidate that may be better than the best place.
void PointSearch::begin() {
  for (; next_ < end_; ++next_) {
    const Candidate& candidate = this->candidate();
    in_leaf_ = false;
    if (best_.entity >= 0 && (candidate.least() >= std::sqrt(best_.square) * (1 - 1e-15) || leads_to_best(candidate))) continue;
    const Pieces& pieces = pieces_of(candidate);
    if (const CurveLeaf* curve = curve_of(candidate)) {
      descent_ = Descent(x_, {{curve->a, 0}, {curve->b, 0}}, candidate.start, norm(curve->to - curve->from), diagonal_);
    } else {
      const SurfaceLeaf& leaf = pieces.leaves[static_cast<std::size_t>(candidate.piece)];
      descent_ = Descent(x_, pieces.triangles ? leaf.region : pieces.region, candidate.start, leaf.size, diagonal_);
    }
    return;
  }
}

PlaceRequest PointSearch::request() const {
  const Candidate& candidate = this->candidate();
  if (const CurveLeaf* curve = curve_of(candidate)) return {curve->face, curve->curve, {descent_.place().x(), 0}};
  return {candidate.entity, -1, descent_.place()};
}

void PointSearch::take(const SurfaceJet& jet, Cad& cad) {
  if (descent_.take(jet)) return;
  const Candidate& candidate = this->candidate();
  if (descent_.found()) {
    const Vec3 r = descent_.xyz() - x_;
    const double square = dot(r, r);
    const CurveLeaf* of = curve_of(candidate);
    const Pieces& pieces = pieces_of(candidate);
    const bool inside = of != nullptr || !pieces.domain || in_leaf_ || (square < best_.square && pieces.domain->contains(descent_.parameters(), cad));
    if (square < best_.square && !inside && !in_leaf_ && !pieces.leaves[static_cast<std::size_t>(candidate.piece)].cut) {
      // The descent has left the domain, and the leaf has not: its place is a bound that has excluded others.
      const SurfaceLeaf& leaf = pieces.leaves[static_cast<std::size_t>(candidate.piece)];
      descent_ = Descent(x_, leaf.region, candidate.start, leaf.size, diagonal_);
      in_leaf_ = true;
      return;
    }
    if (square < best_.square && inside) {
      best_.entity = candidate.entity, best_.xyz = descent_.xyz(), best_.square = square;
      best_.place = {of != nullptr ? of->face : candidate.entity, of != nullptr ? of->curve : -1, descent_.parameters()};
    }
  }
  ++next_;
  begin();
}

}  // namespace carreau::projection
