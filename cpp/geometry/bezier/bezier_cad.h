// SPDX-License-Identifier: BSD-3-Clause
// The evaluator of Bezier patches.
#pragma once

#include <vector>

#include "cad/cad.h"
#include "geometry/bezier/bezier_patch.h"

namespace carreau {

/// Face k, from 1, is patch k over the unit square. Its curves 1 to 4 are the sides of the square, counterclockwise from
/// the origin, each with parameters from 0 to 1.
class BezierCad final : public Cad {
 public:
  /// Patches with as many control points as their degrees require.
  explicit BezierCad(std::vector<BezierPatch> patches) : patches_(std::move(patches)) {}

  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override;
  Interval curve_interval(int face, int ic) override;
  CurveJet curve(int face, int ic, unsigned want, double t) override;
  /// The smaller radius of curvature; no answer where the patch is flat or degenerate.
  std::optional<double> surface_radius(int face, Vec2 uv) override;
  /// Radius of the side in space; no answer where it is straight or a point.
  std::optional<double> curve_radius(int face, int ic, double t) override;
  [[nodiscard]] bool reentrant() const noexcept override { return true; }

  /// Throws InvalidArgument when the face does not exist.
  [[nodiscard]] const BezierPatch& patch(int face) const;

 private:
  std::vector<BezierPatch> patches_;
};

}  // namespace carreau
