// SPDX-License-Identifier: BSD-3-Clause
// Curves in the parameter planes of faces that the library evaluates itself, beside a host's.
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "cad/cad.h"

namespace carreau {

/// A curve of cubic Hermite spans in (u, v). Its derivative may jump at the ends of spans.
struct EmbeddedCurve {
  std::vector<double> t;            ///< ascending
  std::vector<Vec2> uv;             ///< at t
  std::vector<Vec2> start, finish;  ///< derivatives at both ends of span i, between t[i] and t[i + 1]

  [[nodiscard]] CurveJet at(double t) const;
};

/// Curves by the reference of the face and their rank in it.
using EmbeddedCurves = std::map<std::pair<int, int>, std::shared_ptr<const EmbeddedCurve>>;

/// Passes everything on, except for the embedded curves. Prescribes no size on them.
class EmbeddedCad final : public Cad {
 public:
  EmbeddedCad(std::shared_ptr<Cad> host, EmbeddedCurves curves) : host_(std::move(host)), curves_(std::move(curves)) {}

  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override { host_->surface(face, want, uv, out); }
  Interval curve_interval(int face, int ic) override {
    const EmbeddedCurve* own = find(face, ic);
    return own != nullptr ? Interval{own->t.front(), own->t.back()} : host_->curve_interval(face, ic);
  }
  CurveJet curve(int face, int ic, unsigned want, double t) override {
    const EmbeddedCurve* own = find(face, ic);
    return own != nullptr ? own->at(t) : host_->curve(face, ic, want, t);
  }
  std::optional<double> surface_size(int face, Vec2 uv) override { return host_->surface_size(face, uv); }
  std::optional<double> curve_size(int face, int ic, double t) override {
    return find(face, ic) != nullptr ? std::nullopt : host_->curve_size(face, ic, t);
  }
  std::optional<double> point_size(int point) override { return host_->point_size(point); }
  std::optional<double> surface_radius(int face, Vec2 uv) override { return host_->surface_radius(face, uv); }
  std::optional<double> curve_radius(int face, int ic, double t) override {
    return find(face, ic) != nullptr ? std::nullopt : host_->curve_radius(face, ic, t);
  }
  [[nodiscard]] bool reentrant() const noexcept override { return host_->reentrant(); }
  [[nodiscard]] CallCounts counts() const noexcept override { return host_->counts(); }
  [[nodiscard]] unsigned surface_gives() const noexcept override { return host_->surface_gives(); }
  [[nodiscard]] unsigned curve_gives() const noexcept override { return host_->curve_gives(); }
  void set_parameter_box(int face, Vec2 low, Vec2 high) override { host_->set_parameter_box(face, low, high); }
  void set_boundary(int face, std::vector<BoundaryCurve> boundary) override { host_->set_boundary(face, std::move(boundary)); }

 private:
  [[nodiscard]] const EmbeddedCurve* find(int face, int ic) const {
    const auto found = curves_.find({face, ic});
    return found == curves_.end() ? nullptr : found->second.get();
  }

  std::shared_ptr<Cad> host_;
  EmbeddedCurves curves_;
};

}  // namespace carreau
