// SPDX-License-Identifier: BSD-3-Clause
// Curves of closed forms with the parts of a model that the curve steps need.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "analytic_cad.h"
#include "curve/discrete_curve.h"

namespace carreau::testing_cad {

/// A model of single curves, put together by hand.
struct Scene {
  AnalyticCad cad;
  Model model;
  Topology topology;
  std::vector<std::vector<CurveSupport>> supports;
  SizeParameters sizes;

  Scene() {
    sizes.hphydef = 0.1;
    sizes.hphymin = 1e-3;
    sizes.hphymax = 10;
    sizes.hgeomin = 1e-3;
    sizes.hgeomax = 10;
  }

  int add_face(int ref, Surface surface) {
    cad.surfaces[ref] = std::move(surface);
    Face face;
    face.ref = ref;
    model.faces.push_back(face);
    return static_cast<int>(model.faces.size()) - 1;
  }
  CurveUse add_use(int face, PlaneCurve curve, bool reversed = false) {
    auto& curves = model.faces[static_cast<std::size_t>(face)].curves;
    curves.push_back({CurveType::boundary, 1, 1, 2, 0});
    const int ic = static_cast<int>(curves.size());
    cad.curves[{model.faces[static_cast<std::size_t>(face)].ref, ic}] = std::move(curve);
    return {face, ic - 1, reversed};
  }
  void add_curve(std::vector<CurveUse> uses, bool closed = false, bool degenerate = false) {
    Curve curve;
    curve.ref = static_cast<int>(topology.curves.size()) + 1;
    curve.uses = std::move(uses);
    curve.degenerate = degenerate;
    curve.end1 = static_cast<int>(topology.points.size());
    curve.end2 = closed || degenerate ? curve.end1 : curve.end1 + 1;
    const int index = static_cast<int>(topology.curves.size());
    const CurveUse use = curve.uses.front();
    const int face = model.faces[static_cast<std::size_t>(use.face)].ref;
    const Interval i = cad.curve_interval(face, use.curve + 1);
    for (const double t : {i.a, i.b}) {
      CornerPoint p;
      p.ref = static_cast<int>(topology.points.size()) + 1;
      p.position = surface_at(cad, face, want_position, cad.curve(face, use.curve + 1, want_position, t).c).s;
      p.curves = {index};
      topology.points.push_back(p);
      if (curve.end2 == curve.end1) break;
    }
    topology.curves.push_back(std::move(curve));
  }
  void build() {
    supports.clear();
    for (const Face& face : model.faces) {
      supports.emplace_back();
      for (std::size_t c = 0; c < face.curves.size(); ++c) {
        supports.back().push_back(build_support(cad, face.ref, static_cast<int>(c) + 1, {}));
      }
    }
    cad.calls = {};
  }
  CurveModel curve_model() { return {model, topology, supports, cad}; }
  Vec3 lifted(const CurveUse& use, Vec2 uv) {
    return surface_at(cad, model.faces[static_cast<std::size_t>(use.face)].ref, want_position, uv).s;
  }
};

/// A side of the paraboloid, its two uses in two faces, the second at another pace and in the other direction.
inline Scene interface_between_two_faces(bool same_pace) {
  Scene s;
  const int first = s.add_face(1, paraboloid());
  const int second = s.add_face(2, paraboloid());
  const auto a = s.add_use(first, segment({-2.5, -2.5}, {2.5, -2.5}));
  const auto b = s.add_use(second,
                           same_pace ? segment({2.5, -2.5}, {-2.5, -2.5})
                                     : plane_curve({0, 1},
                                                   [](double t) {
                                                     const double w = t + 0.2 * std::sin(std::numbers::pi * t) *
                                                                              std::sin(std::numbers::pi * t);
                                                     return Vec2{2.5 - 5 * w, -2.5};
                                                   }),
                           true);
  s.add_curve({a, b});
  s.build();
  return s;
}

}  // namespace carreau::testing_cad
