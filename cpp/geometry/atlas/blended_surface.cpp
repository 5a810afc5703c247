// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/atlas/blended_surface.h"

#include <cmath>

namespace carreau::atlas {

BlendedSurface::BlendedSurface(Covering covering) : covering_(std::move(covering)) {
  for (const Chart& chart : covering_.charts())
    primitives_.push_back(primitive_of(fit_heights(covering_.surface(), chart), chart.frame));
  folds_ = mend_folds(covering_, primitives_);
}

template <typename Number>
std::array<Number, 3> BlendedSurface::blended(std::size_t chart, const Pair<Number>& place) const {
  const std::array<Number, 3> own = primitives_[chart].at(place);
  const auto on = covering_.on_t(chart, place);
  if (!on) return own;
  const std::array<Number, 3> weights = Covering::weights(on->place);
  const Triple& triple = covering_.triples()[static_cast<std::size_t>(on->corner.triple)];
  std::array<Number, 3> sum;
  for (int c = 0; c < 3; ++c) {
    const auto k = static_cast<std::size_t>(c);
    if (weights[k].f <= 0) continue;
    const std::array<Number, 3> p = c == on->corner.corner ? own
                                                           : primitives_[static_cast<std::size_t>(triple.chart[k])].at(
                                                                 covering_.from_t(on->corner.triple, c, on->place));
    for (std::size_t i = 0; i < 3; ++i) sum[i] = sum[i] + weights[k] * p[i];
  }
  return sum;
}

SurfaceJet BlendedSurface::at(std::size_t chart, const Vec2& m, int order) const {
  SurfaceJet jet;
  const auto put = [&](int k, const auto& c) { jet.s[k] = c.f, jet.su[k] = c.u, jet.sv[k] = c.v; };
  if (order < 2) {
    const std::array<Slope, 3> p = blended(chart, parameters_at<Slope>(m));
    for (int k = 0; k < 3; ++k) put(k, p[static_cast<std::size_t>(k)]);
    return jet;
  }
  const std::array<Jet, 3> p = blended(chart, parameters_at<Jet>(m));
  for (int k = 0; k < 3; ++k) {
    const Jet& c = p[static_cast<std::size_t>(k)];
    put(k, c), jet.suu[k] = c.uu, jet.suv[k] = c.uv, jet.svv[k] = c.vv;
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
