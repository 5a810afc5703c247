// SPDX-License-Identifier: BSD-3-Clause
// A host's geometry with verified values: every value is checked before the engine uses it.
#pragma once

#include "cad/call_counter.h"

namespace carreau {

/// Forwards calls and checks the results. Positions, derivatives and sizes must be finite; radii may be infinite but
/// not NaN; intervals must be finite with a < b. Throws a CallbackError that names face, curve, (u, v) or t and the
/// routine. Keeps a reference to `host`.
class CheckedCad : public Cad {
 public:
  explicit CheckedCad(Cad& host) : host_(host), before_(host.counts()) {}

  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override;
  Interval curve_interval(int face, int ic) override;
  CurveJet curve(int face, int ic, unsigned want, double t) override;
  std::optional<double> surface_size(int face, Vec2 uv) override;
  std::optional<double> curve_size(int face, int ic, double t) override;
  std::optional<double> point_size(int point) override;
  std::optional<double> surface_radius(int face, Vec2 uv) override;
  std::optional<double> curve_radius(int face, int ic, double t) override;
  [[nodiscard]] bool reentrant() const noexcept override { return host_.reentrant(); }
  /// Calls through this object: the host's own count when it keeps one (finite differences included), else one call for
  /// each requested routine and point.
  [[nodiscard]] CallCounts counts() const noexcept override;
  [[nodiscard]] unsigned surface_gives() const noexcept override { return host_.surface_gives(); }
  [[nodiscard]] unsigned curve_gives() const noexcept override { return host_.curve_gives(); }
  void set_parameter_box(int face, Vec2 low, Vec2 high) override { host_.set_parameter_box(face, low, high); }
  void set_boundary(int face, std::vector<BoundaryCurve> boundary) override { host_.set_boundary(face, std::move(boundary)); }

 private:
  Cad& host_;
  CallCounts before_;  // of the host, when this object was made
  CallCounter counter_;
};

}  // namespace carreau
