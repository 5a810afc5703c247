// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane/plane_cad.h"

#include <algorithm>
#include <cmath>

#include "support/error.h"

namespace carreau {

void PlaneCad::surface(int /*face*/, unsigned /*want*/, std::span<const Vec2> uv, std::span<SurfaceJet> out) {
  for (std::size_t i = 0; i < uv.size(); ++i) {
    out[i] = {};
    out[i].s = {uv[i].x(), uv[i].y(), 0};
    out[i].su = {1, 0, 0};
    out[i].sv = {0, 1, 0};
  }
}

int PlaneCad::arc_of(int face, int ic) const {
  const auto found = of_face_.find(face);
  if (found == of_face_.end() || ic < 1 || ic > static_cast<int>(found->second.size()))
    throw InvalidArgument({.face = face, .curve_index = ic}, "the plane domain has no such curve");
  return found->second[static_cast<std::size_t>(ic) - 1];
}

Interval PlaneCad::curve_interval(int face, int ic) {
  return {0, static_cast<double>(arcs_[arc_of(face, ic)].pieces.size())};
}

CurveJet PlaneCad::curve(int face, int ic, unsigned /*want*/, double t) {
  const PlaneArc& arc = arcs_[arc_of(face, ic)];
  const auto last = static_cast<double>(arc.pieces.size() - 1);
  const double i = std::clamp(std::floor(t), 0.0, last);
  const PlanePiece& piece = arc.pieces[static_cast<std::size_t>(i)];
  CurveJet jet{piece.at(t - i), piece.first(t - i), piece.second(t - i)};
  if (t <= 0) jet.c = arc.polyline.front();
  if (t >= last + 1) jet.c = arc.polyline.back();
  return jet;
}

}  // namespace carreau
