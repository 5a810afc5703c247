// SPDX-License-Identifier: BSD-3-Clause
// A host's geometry with verified values: every value is checked before the engine uses it.
#pragma once

#include <atomic>
#include <cstddef>

#include "cad/continued_cad.h"

namespace carreau {

/// Counts as CallCounts defines them; safe to advance from several threads (a host may be re-entrant).
class CallCounter {
 public:
  /// `points` evaluations of each routine that the Want bits stand for.
  void add_surface(unsigned want, std::size_t points) noexcept {
    const auto n = static_cast<std::int64_t>(points);
    if ((want & want_position) != 0) add(surf0_, n);
    if ((want & want_first) != 0) add(surf1_, n);
    if ((want & want_second) != 0) add(surf2_, n);
  }
  void add_curve(unsigned want) noexcept {
    if ((want & want_position) != 0) add(curv0_, 1);
    if ((want & want_first) != 0) add(curv1_, 1);
    if ((want & want_second) != 0) add(curv2_, 1);
  }
  void add_size() noexcept { add(sizes_, 1); }

  [[nodiscard]] CallCounts counts() const noexcept {
    return {.surf0 = surf0_.load(std::memory_order_relaxed),
            .surf1 = surf1_.load(std::memory_order_relaxed),
            .surf2 = surf2_.load(std::memory_order_relaxed),
            .curv0 = curv0_.load(std::memory_order_relaxed),
            .curv1 = curv1_.load(std::memory_order_relaxed),
            .curv2 = curv2_.load(std::memory_order_relaxed),
            .sizes = sizes_.load(std::memory_order_relaxed)};
  }

 private:
  using Count = std::atomic<std::int64_t>;
  static void add(Count& count, std::int64_t n) noexcept { count.fetch_add(n, std::memory_order_relaxed); }

  Count surf0_{0}, surf1_{0}, surf2_{0}, curv0_{0}, curv1_{0}, curv2_{0}, sizes_{0};
};

/// Forwards calls and checks the results. Positions, derivatives and sizes must be finite; radii may be infinite but
/// not NaN; intervals must be finite with a < b. Throws a CallbackError that names face, curve, (u, v) or t and the
/// routine. Keeps a reference to `host`.
class CheckedCad : public Cad, public ContinuedCad {
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
  [[nodiscard]] bool is_continued(int face) const noexcept override { return carreau::is_continued(host_, face); }
  void set_parameter_box(int face, Vec2 low, Vec2 high) override { host_.set_parameter_box(face, low, high); }
  void set_boundary(int face, std::vector<BoundaryCurve> boundary) override { host_.set_boundary(face, std::move(boundary)); }

 private:
  Cad& host_;
  CallCounts before_;  // of the host, when this object was made
  CallCounter counter_;
};

}  // namespace carreau
