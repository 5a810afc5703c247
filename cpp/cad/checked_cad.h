// A host's geometry that can be trusted: every value is looked at before the engine sees it.
#pragma once

#include "cad/cad.h"

namespace carreau {

/// Passes calls on and checks what comes back: values that are not finite, intervals that are reversed or infinite are
/// a CallbackError that names face, curve, (u, v) or t and the routine. Counts calls. Keeps a reference to `host`.
class CheckedCad : public Cad {
 public:
  explicit CheckedCad(Cad& host) : host_(host) {}

  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override;
  Interval curve_interval(int face, int ic) override;
  CurveJet curve(int face, int ic, unsigned want, double t) override;
  std::optional<double> surface_size(int face, Vec2 uv) override;
  std::optional<double> curve_size(int face, int ic, double t) override;
  std::optional<double> point_size(int point) override;
  std::optional<double> surface_radius(int face, Vec2 uv) override;
  std::optional<double> curve_radius(int face, int ic, double t) override;
  [[nodiscard]] bool reentrant() const noexcept override { return host_.reentrant(); }
  /// One call for each routine (surf0, surf1, surf2, …) and point, as a cad_m module sees them.
  [[nodiscard]] CallCounts counts() const noexcept override { return counts_; }

 private:
  Cad& host_;
  CallCounts counts_;
};

}  // namespace carreau
