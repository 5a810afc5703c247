// SPDX-License-Identifier: BSD-3-Clause
// Parts of tori that a probe leaves between two balls (HDR sec. 4.6.2).
#pragma once

#include "geometry/molecule/arrangement.h"
#include "geometry/molecule/patch_cad.h"

namespace carreau::molecule {

/// The tube of a probe that rolls along a circle of two grown balls, cut by a half-plane of the circle's axis. At the
/// height radius sin(phi) along the axis it is rho - radius cos(phi) from it.
struct Tube {
  double rho = 0;            ///< radius of the circle
  double radius = 0;         ///< of the probe
  double low = 0, high = 0;  ///< phi where the probe touches the balls of ranks i and j
  /// The tube crosses the axis, and touches the balls on both sides of it: it is cut where phi = -tip and phi = tip.
  bool spindle = false;
  double tip = 0;

  [[nodiscard]] double from_axis(double phi) const { return rho - radius * std::cos(phi); }
};
Tube tube_of(const Circle& circle, double probe);

/// Area, and integrals of the normal (towards the probe) and of normal . (x - origin), of a part of a tube.
struct TorusMeasures {
  double area = 0, flux = 0;
};
TorusMeasures measure_torus(const Circle& circle, const Tube& tube, double a, double b, double low, double high,
                            const Vec3& origin);

/// The part from angle a to b and from phi = low to high. Its parameters are arc lengths: u on the longer of the two
/// circles, v on the probe's. Curves: the circle at low, the side at b, the circle at high, the side at a.
class TorusPatch final : public Patch {
 public:
  TorusPatch(const Circle& circle, const Tube& tube, double a, double b, double low, double high);

  [[nodiscard]] SurfaceJet surface(const Vec2& uv) const override;
  [[nodiscard]] double radius(const Vec2& uv) const override;
  [[nodiscard]] std::size_t curve_count() const override { return 4; }
  [[nodiscard]] Interval interval(std::size_t curve) const override;
  [[nodiscard]] CurveJet curve(std::size_t curve, double t) const override;
  [[nodiscard]] double curve_radius(std::size_t curve) const override;

 private:
  Circle circle_;
  Tube tube_;
  double a_, b_, low_, high_;
  double unit_;  // length of u for an angle of 1
};

}  // namespace carreau::molecule
