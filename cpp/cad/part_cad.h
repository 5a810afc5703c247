// SPDX-License-Identifier: BSD-3-Clause
// A host with curves that are used in parts.
#pragma once

#include <map>
#include <utility>

#include "cad/continued_cad.h"

namespace carreau {

/// The part of a host's curve from t = a to t = b.
struct CurvePart {
  int ic = 0;  ///< rank of the whole curve
  double a = 0, b = 1;
};

/// Passes everything on; curves (face, ic) in `parts` are replaced by the parts. Keeps a reference to `host`.
class PartCad final : public Cad, public ContinuedCad {
 public:
  using Parts = std::map<std::pair<int, int>, CurvePart>;
  PartCad(Cad& host, Parts parts) : host_(host), parts_(std::move(parts)) {}

  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override {
    host_.surface(face, want, uv, out);
  }
  Interval curve_interval(int face, int ic) override {
    const auto part = parts_.find({face, ic});
    if (part == parts_.end()) return host_.curve_interval(face, ic);
    return {part->second.a, part->second.b};
  }
  CurveJet curve(int face, int ic, unsigned want, double t) override {
    return host_.curve(face, whole(face, ic), want, t);
  }
  std::optional<double> surface_size(int face, Vec2 uv) override { return host_.surface_size(face, uv); }
  std::optional<double> curve_size(int face, int ic, double t) override {
    return host_.curve_size(face, whole(face, ic), t);
  }
  std::optional<double> point_size(int point) override { return host_.point_size(point); }
  std::optional<double> surface_radius(int face, Vec2 uv) override { return host_.surface_radius(face, uv); }
  std::optional<double> curve_radius(int face, int ic, double t) override {
    return host_.curve_radius(face, whole(face, ic), t);
  }
  [[nodiscard]] bool reentrant() const noexcept override { return host_.reentrant(); }
  [[nodiscard]] CallCounts counts() const noexcept override { return host_.counts(); }
  [[nodiscard]] unsigned surface_gives() const noexcept override { return host_.surface_gives(); }
  [[nodiscard]] unsigned curve_gives() const noexcept override { return host_.curve_gives(); }
  [[nodiscard]] bool is_continued(int face) const noexcept override { return carreau::is_continued(host_, face); }
  void set_parameter_box(int face, Vec2 low, Vec2 high) override { host_.set_parameter_box(face, low, high); }
  void set_boundary(int face, std::vector<BoundaryCurve> boundary) override {
    for (BoundaryCurve& curve : boundary) curve.ic = whole(face, curve.ic);
    host_.set_boundary(face, std::move(boundary));
  }

 private:
  [[nodiscard]] int whole(int face, int ic) const {
    const auto part = parts_.find({face, ic});
    return part == parts_.end() ? ic : part->second.ic;
  }

  Cad& host_;
  Parts parts_;
};

}  // namespace carreau
