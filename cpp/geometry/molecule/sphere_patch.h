// SPDX-License-Identifier: BSD-3-Clause
// Parts of spheres in stereographic charts (HDR eq. 4.86).
#pragma once

#include "geometry/molecule/patch_cad.h"
#include "geometry/molecule/space_arc.h"

namespace carreau::molecule {

/// The sphere of a ball, projected from a pole that is not on the face onto the opposite tangent plane: eq. 4.86 with
/// its own axes. Outwards is away from the centre, or towards it.
class SpherePatch final : public Patch {
 public:
  /// `pole`: a unit vector. `border`: arcs on the sphere in the order of the face's curves.
  SpherePatch(const Ball& ball, const Vec3& pole, std::vector<SpaceArc> border, Side side = Side::outer);

  [[nodiscard]] SurfaceJet surface(const Vec2& uv) const override;
  [[nodiscard]] double radius(const Vec2&) const override { return ball_.radius; }
  [[nodiscard]] std::size_t curve_count() const override { return border_.size(); }
  [[nodiscard]] Interval interval(std::size_t curve) const override { return {border_[curve].a, border_[curve].b}; }
  [[nodiscard]] CurveJet curve(std::size_t curve, double t) const override;
  [[nodiscard]] double curve_radius(std::size_t curve) const override { return border_[curve].radius; }

 private:
  [[nodiscard]] Vec3 in_axes(const Vec3& v) const { return {dot(v, x_), dot(v, y_), dot(v, z_)}; }
  [[nodiscard]] Vec3 in_space(double x, double y, double z) const { return x * x_ + y * y_ + z * z_; }

  Ball ball_;
  Vec3 x_, y_, z_;  // z to the pole
  std::vector<SpaceArc> border_;
};

}  // namespace carreau::molecule
