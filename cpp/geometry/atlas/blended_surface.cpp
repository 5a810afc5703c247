// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/atlas/blended_surface.h"

#include <cmath>

#include "geometry/atlas/fold_check.h"

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

BlendedSurface::BlendedSurface(Covering covering) : covering_(std::move(covering)) {
  for (const Chart& chart : covering_.charts()) {
    heights_.push_back(fine_heights(covering_, chart));
    primitives_.push_back(primitive_of(coarse_heights(covering_, chart), chart.frame));
  }
  const std::vector<Primitive> before = primitives_;
  folds_ = mend_folds(covering_, primitives_);
  for (std::size_t i = 0; i < before.size(); ++i)
    is_moved_.push_back(before[i].coefficient != primitives_[i].coefficient);
  require_no_folds(*this);
}

template <typename Number>
std::array<Number, 3> BlendedSurface::onto(std::size_t chart, const std::array<Number, 3>& x) const {
  const Frame& frame = covering_.charts()[chart].frame;
  const auto along = [&](const Vec3& axis) {
    return Number(axis.x() * (x[0] - frame.origin.x()) + axis.y() * (x[1] - frame.origin.y()) +
                  axis.z() * (x[2] - frame.origin.z()));
  };
  const Number missing = heights_[chart].at(Pair<Number>{along(frame.u), along(frame.v)}) - along(frame.normal);
  return {x[0] + frame.normal.x() * missing, x[1] + frame.normal.y() * missing, x[2] + frame.normal.z() * missing};
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
  std::array<Number, 3> sum, moved;
  for (int c = 0; c < 3; ++c) {
    const Number& weight = weights[static_cast<std::size_t>(c)];
    if (weight.f <= 0) continue;
    const std::array<Number, 3> p = c == corner ? own : placed(triple, place, c);
    for (std::size_t i = 0; i < 3; ++i) sum[i] = sum[i] + weight * p[i];
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (weights[k].f <= 0) continue;
    const std::array<Number, 3> p = onto(static_cast<std::size_t>(covering_.triples()[triple].chart[k]), sum);
    for (std::size_t i = 0; i < 3; ++i) moved[i] = moved[i] + weights[k] * p[i];
  }
  return moved;
}

template <typename Number>
std::array<Number, 3> BlendedSurface::blended(std::size_t chart, const Pair<Number>& place) const {
  const std::array<Number, 3> own = primitives_[chart].at(place);
  const auto on = covering_.on_t(chart, place);
  if (!on) return onto(chart, own);
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
