// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/atlas/blended_surface.h"

#include <cmath>
#include <string>

#include "geometry/atlas/fold_check.h"
#include "support/error.h"
#include "support/work_bounds.h"

namespace carreau::atlas {
namespace {

SurfaceJet jet_of(const std::array<Jet, 3>& p) {
  SurfaceJet jet;
  for (int k = 0; k < 3; ++k) {
    const Jet& c = p[static_cast<std::size_t>(k)];
    jet.s[k] = c.f, jet.su[k] = c.u, jet.sv[k] = c.v, jet.suu[k] = c.uu, jet.suv[k] = c.uv, jet.svv[k] = c.vv;
  }
  return jet;
}

}  // namespace

BlendedSurface::BlendedSurface(Covering covering) : covering_(std::move(covering)), heights_(covering_) {
  for (const Chart& chart : covering_.charts()) {
    primitives_.push_back(primitive_of(coarse_heights(covering_, chart), chart.frame));
  }
  const std::vector<Primitive> before = primitives_;
  FoundFolds found;
  for (int round = 0; round < work_bounds::rounds; ++round) {
    // Folds that the grid misses are watched from the next round on.
    const FoldReport report = mend_folds(covering_, heights_, primitives_, found.places);
    if (round == 0) folds_ = report;
    folds_.folded_after = report.folded_after;
    folds_.mended_charts = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
      folds_.mended_charts += before[i].coefficient != primitives_[i].coefficient ? 1 : 0;
    FoundFolds rest = find_folds(*this, report.folded_after == 0);
    if (rest.first.empty()) return;
    found.first = std::move(rest.first);
    if (report.folded_after > 0) break;
    found.places.insert(found.places.end(), rest.places.begin(), rest.places.end());
  }
  throw DomainError(found.first);
}

template <typename Number>
std::array<Number, 3> BlendedSurface::onto(const std::vector<std::int32_t>& vertices,
                                           const std::array<Number, 3>& x) const {
  // The heights do not move points of the surface. The first step leaves a share of the distance, and the second a
  // share of that.
  return heights_.onto(vertices, heights_.onto(vertices, x));
}

template <typename Number>
std::array<Number, 3> BlendedSurface::placed(std::size_t triple, const Pair<Number>& place, int corner) const {
  const std::int32_t chart = covering_.triples()[triple].chart[static_cast<std::size_t>(corner)];
  return primitives_[static_cast<std::size_t>(chart)].at(
      covering_.from_t(static_cast<std::int32_t>(triple), corner, place));
}

template <typename Number>
std::array<Number, 3> BlendedSurface::blended(std::size_t triple, const Pair<Number>& place, int corner,
                                              const std::array<Number, 3>& own) const {
  const std::array<Number, 3> weights = Covering::weights(place);
  std::array<Number, 3> sum;
  for (int c = 0; c < 3; ++c) {
    const Number& weight = weights[static_cast<std::size_t>(c)];
    if (weight.f <= 0) continue;
    const std::array<Number, 3> p = c == corner ? own : placed(triple, place, c);
    for (std::size_t i = 0; i < 3; ++i) sum[i] = sum[i] + weight * p[i];
  }
  return onto(heights_.near_triple(triple), sum);
}

template <typename Number>
std::array<Number, 3> BlendedSurface::blended(std::size_t chart, const Pair<Number>& place) const {
  const std::array<Number, 3> own = primitives_[chart].at(place);
  const auto on = covering_.on_t(chart, place);
  if (!on) return onto(heights_.near_chart(chart), own);
  return blended(static_cast<std::size_t>(on->corner.triple), on->place, on->corner.corner, own);
}

SurfaceJet BlendedSurface::at_triple(std::size_t triple, const Vec2& place) const {
  const Pair<Jet> p = parameters_at<Jet>(place);
  return jet_of(blended(triple, p, 0, placed(triple, p, 0)));
}

SurfaceJet BlendedSurface::at(std::size_t chart, const Vec2& m, int order) const {
  if (order >= 2) return jet_of(blended(chart, parameters_at<Jet>(m)));
  const std::array<Slope, 3> p = blended(chart, parameters_at<Slope>(m));
  SurfaceJet jet;
  for (int k = 0; k < 3; ++k) {
    const Slope& c = p[static_cast<std::size_t>(k)];
    jet.s[k] = c.f, jet.su[k] = c.u, jet.sv[k] = c.v;
  }
  return jet;
}

CurveJet BlendedSurface::side(std::size_t chart, std::size_t k, double t) const {
  // In two triangles T unfolded about their common side it is straight: the points at equal distance from both ends of
  // the side.
  const double half_way = 1 / (2 * std::numbers::sqrt3);  // distance of the side's middle from T's middle
  const Jet along = half_way * Jet(t, 1, 0);
  const Polar<Jet> polar{sqrt(along * along + .25), static_cast<double>(k + 1) * sixth_turn + atan2(along, Jet(.5))};
  const Pair<Jet> m = covering_.charts()[chart].annulus.at(share_of(polar), polar.phi);
  return {value_of(m), {m[0].u, m[1].u}, {m[0].uu, m[1].uu}};
}

}  // namespace carreau::atlas
