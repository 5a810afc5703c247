// SPDX-License-Identifier: BSD-3-Clause
// The evaluator of a plane domain: S(u, v) = (u, v, 0), and arcs of splines.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "cad/cad.h"
#include "geometry/plane/plane_arcs.h"

namespace carreau {

/// Curve `ic` of a face is one of the arcs, with parameters from 0 to its number of pieces. Second derivatives jump
/// between pieces; a joint has the values of the piece behind. Both ends are exactly the points.
class PlaneCad final : public Cad {
 public:
  /// of_face: indices of arcs by the reference of a face and the rank of a curve in it.
  PlaneCad(std::vector<PlaneArc> arcs, std::map<int, std::vector<int>> of_face)
      : arcs_(std::move(arcs)), of_face_(std::move(of_face)) {}

  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override;
  Interval curve_interval(int face, int ic) override;
  CurveJet curve(int face, int ic, unsigned want, double t) override;
  [[nodiscard]] bool reentrant() const noexcept override { return true; }

  [[nodiscard]] const std::vector<PlaneArc>& arcs() const noexcept { return arcs_; }
  /// Index of the arc. Throws InvalidArgument when the face has no such curve.
  [[nodiscard]] int arc_of(int face, int ic) const;

 private:
  std::vector<PlaneArc> arcs_;
  std::map<int, std::vector<int>> of_face_;
};

}  // namespace carreau
