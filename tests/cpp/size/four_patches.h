// SPDX-License-Identifier: BSD-3-Clause
// Four patches about a point, for tests of sizes.
#pragma once

#include <optional>

#include "../curve/analytic_cad.h"
#include "model/topology.h"
#include "size/size_rules.h"

namespace carreau::testing_cad {

inline SizeParameters parameters(int hphy, int hgeo) {
  SizeParameters p;
  p.physical = static_cast<PhysicalSizes>(hphy);
  p.geometric = static_cast<GeometricSizes>(hgeo);
  p.hphydef = 0.094;
  p.hphymin = 0.0094;
  p.hphymax = 0.94;
  p.hgeomin = 0.0094;
  p.hgeomax = 0.94;
  return p;
}

/// Four unit squares about the origin, as the four patches of RT-0232 sec. 6.2: faces 1, 4, 5, 8, in each the two
/// interface curves that end at the common point (reference 6).
struct FourPatches {
  AnalyticCad cad;
  Model model;
  Topology topology;

  explicit FourPatches(const Surface& surface = flat()) {
    const int refs[] = {1, 4, 5, 8};
    for (const int ref : refs) {
      cad.surfaces[ref] = surface;
      Face face;
      face.ref = ref;
      model.faces.push_back(face);
    }
    topology.points.push_back({6, {0, 0, 0}, {0, 1, 2, 3}});
    // Curve k lies between two faces and goes from the centre outwards; the second face sees it inwards.
    add_curve({0, 1}, 3, 1);   // 8-4 : 0.45
    add_curve({1, 0}, 1, 0);   // 4-1 : 0.075
    add_curve({0, -1}, 0, 2);  // 1-5 : 0.125
    add_curve({-1, 0}, 2, 3);  // 5-8 : 0.5
    cad.hphys = [](int face, Vec2) {
      return std::optional<double>(face == 1 ? 0.05 : face == 4 ? 0.1 : face == 5 ? 0.2 : 0.8);
    };
  }

  void add_curve(Vec2 end, int first, int second) {
    Curve curve;
    curve.ref = static_cast<int>(topology.curves.size()) + 1;
    curve.end1 = 0;
    curve.end2 = static_cast<int>(topology.points.size());
    for (const int f : {first, second}) {
      Face& face = model.faces[static_cast<std::size_t>(f)];
      const bool reversed = f == second;
      face.curves.push_back({CurveType::boundary, curve.ref, reversed ? 9 : 6, reversed ? 6 : 9, 0});
      const int ic = static_cast<int>(face.curves.size());
      cad.curves[{face.ref, ic}] = reversed ? segment(end, {0, 0}) : segment({0, 0}, end);
      curve.uses.push_back({f, ic - 1, reversed});
    }
    topology.points.push_back({10 + curve.ref, {end.x(), end.y(), 0}, {static_cast<int>(topology.curves.size())}});
    topology.curves.push_back(curve);
  }

  SizeRules rules(const SizeParameters& p) { return {model, topology, cad, p}; }
};

}  // namespace carreau::testing_cad
