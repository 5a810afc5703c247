// SPDX-License-Identifier: BSD-3-Clause
#include "projection/point_search.h"

#include <algorithm>
#include <cmath>

#include "support/infinity.h"

namespace carreau::projection {

PointSearch::PointSearch(const Entities& entities, std::int32_t only, const Vec3& x, double diagonal)
    : entities_(&entities), x_(x), diagonal_(diagonal) {
  best_.square = infinity;
  double bound = infinity;  // some point is not farther
  if (only >= 0)
    look_at(only, bound);
  else
    entities.tree.nearest_first([&](std::int32_t n) { return std::sqrt(entities.tree.node(static_cast<std::size_t>(n)).box.squared_distance(x)); },
                                [&](double least) { return least <= bound; },
                                [&](const BoxTree::Node& leaf) {
                                  for (const std::int32_t e : entities.tree.things(leaf)) look_at(e, bound);
                                });
  refine(bound);
  begin();
}

void PointSearch::look_at(std::int32_t entity, double& bound) {
  const Pieces& pieces = *entities_->pieces[static_cast<std::size_t>(entity)];
  pieces.tree.nearest_first(
      [&](std::int32_t n) { return std::sqrt(pieces.tree.node(static_cast<std::size_t>(n)).box.squared_distance(x_)); },
      [&](double least) { return least <= bound; },
      [&](const BoxTree::Node& leaf) {
        for (const std::int32_t k : pieces.tree.things(leaf)) {
          const double least = pieces.boxes[static_cast<std::size_t>(k)].squared_distance(x_);
          if (least > bound * bound) continue;
          Candidate& candidate = candidates_.emplace_back();
          candidate.entity = entity, candidate.piece = k;
          if (const CurveLeaf* curve = curve_of(candidate)) {
            const LeafPlace place = nearest_on(*curve, x_);
            candidate.start = place.parameters, candidate.distance = place.distance, candidate.error = curve->error;
            bound = std::min(bound, place.distance + curve->error);
          } else {
            const SurfaceLeaf& of = pieces.leaves[static_cast<std::size_t>(k)];
            candidate.sample = nearest_sample(of, x_);
            candidate.distance = std::sqrt(candidate.sample.square);
            candidate.error = of.cover;
            if (!of.cut) bound = std::min(bound, candidate.distance);
          }
        }
      });
}

// From the nearest samples to the nearest places of interpolations, in ascending order of the samples.
void PointSearch::refine(double& bound) {
  const auto ascending = [](const Candidate& a, const Candidate& b) {
    if (a.distance != b.distance) return a.distance < b.distance;
    return a.entity != b.entity ? a.entity < b.entity : a.piece < b.piece;
  };
  const auto drop = [&] {
    candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(), [&](const Candidate& c) { return c.distance - c.error > bound; }),
                      candidates_.end());
    std::sort(candidates_.begin(), candidates_.end(), ascending);
  };
  drop();
  for (Candidate& candidate : candidates_) {
    if (curve_of(candidate) != nullptr || candidate.distance - candidate.error > bound) continue;
    const Pieces& pieces = pieces_of(candidate);
    const auto k = static_cast<std::size_t>(candidate.piece);
    if (pieces.boxes[k].squared_distance(x_) > bound * bound) {
      candidate.distance = infinity;
      continue;
    }
    const SurfaceLeaf& leaf = pieces.leaves[k];
    const LeafPlace place = nearest_on(leaf, x_, candidate.sample);
    candidate.start = place.parameters, candidate.distance = place.distance, candidate.error = leaf.error;
    if (!leaf.cut) bound = std::min(bound, place.distance + leaf.error);  // else the place may lie outside of the domain
  }
  drop();
}

// Begins the descent of the next candidate that may be better than the best place.
void PointSearch::begin() {
  for (; next_ < candidates_.size(); ++next_) {
    const Candidate& candidate = candidates_[next_];
    if (best_.entity >= 0 && candidate.distance - candidate.error >= std::sqrt(best_.square) * (1 - 1e-15)) continue;
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
  const Candidate& candidate = candidates_[next_];
  if (const CurveLeaf* curve = curve_of(candidate)) return {curve->face, curve->curve, {descent_.place().x(), 0}};
  return {candidate.entity, -1, descent_.place()};
}

void PointSearch::take(const SurfaceJet& jet, const CurveJet& curve, Cad& cad) {
  if (descent_.take(jet)) return;
  const Candidate& candidate = candidates_[next_++];
  if (descent_.found()) {
    const Vec3 r = descent_.xyz() - x_;
    const double square = dot(r, r);
    const CurveLeaf* of = curve_of(candidate);
    const Pieces& pieces = pieces_of(candidate);
    if (square < best_.square && (of != nullptr || !pieces.domain || pieces.domain->contains(descent_.parameters(), cad))) {
      best_.entity = candidate.entity, best_.xyz = descent_.xyz(), best_.square = square;
      if (of != nullptr) {
        const double dt = descent_.beyond().x();
        best_.place = {of->face, of->curve, descent_.parameters()};
        best_.uv = curve.c + dt * curve.ct + (0.5 * dt * dt) * curve.ctt;
      } else {
        best_.place = {candidate.entity, -1, descent_.parameters()};
        best_.uv = descent_.parameters();
      }
    }
  }
  begin();
}

}  // namespace carreau::projection
