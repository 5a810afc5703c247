// SPDX-License-Identifier: BSD-3-Clause
// Finite differences for derivatives that a host does not give.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <shared_mutex>
#include <utility>
#include <vector>

#include "cad/cad.h"
#include "cad/parameter_domain.h"
#include "cad/stencil.h"

namespace carreau {

/// Passes on the derivatives of `source` and finds the rest by differences of second order of accuracy. First
/// derivatives come from positions (relative error near 1e-10 for smooth functions). Second ones come from first ones
/// when they are given (1e-10), else from positions (1e-7). On curves the points stay in [a, b]. On surfaces they stay
/// in the face's box when it is known (set_parameter_box), else the steps are relative to max(1, |u|) and max(1, |v|).
/// They stay in the closed domain if its boundary is known (set_boundary): beside it formulas are one-sided, along
/// directions that lead inside if the directions of u and v do not. Then a place outside, between a curve and its chord,
/// does not reach the source either: places inside give its position, and the boundary beside it its derivatives.
/// Without a boundary, one-sided formulas replace values that are not finite or fail. If all formulas fail, the error is
/// a CallbackError at (u, v).
class DifferenceCad : public Cad {
 public:
  /// *_gives: the Want bits that `source` answers itself; want_position must be among them.
  DifferenceCad(std::unique_ptr<Cad> source, unsigned surface_gives, unsigned curve_gives);

  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override;
  Interval curve_interval(int face, int ic) override { return source_->curve_interval(face, ic); }
  CurveJet curve(int face, int ic, unsigned want, double t) override;
  std::optional<double> surface_size(int face, Vec2 uv) override { return source_->surface_size(face, uv); }
  std::optional<double> curve_size(int face, int ic, double t) override { return source_->curve_size(face, ic, t); }
  std::optional<double> point_size(int point) override { return source_->point_size(point); }
  std::optional<double> surface_radius(int face, Vec2 uv) override { return source_->surface_radius(face, uv); }
  std::optional<double> curve_radius(int face, int ic, double t) override { return source_->curve_radius(face, ic, t); }
  [[nodiscard]] bool reentrant() const noexcept override { return source_->reentrant(); }
  /// Calls of the source, differences included.
  [[nodiscard]] CallCounts counts() const noexcept override { return source_->counts(); }
  [[nodiscard]] unsigned surface_gives() const noexcept override { return surface_gives_; }
  [[nodiscard]] unsigned curve_gives() const noexcept override { return curve_gives_; }
  void set_parameter_box(int face, Vec2 low, Vec2 high) override;
  void set_boundary(int face, std::vector<BoundaryCurve> boundary) override;

 private:
  struct Box {
    Vec2 low, high;
  };
  /// Places that curves have returned: they lie on the boundary, without a search. Safe from several threads.
  class BoundaryPlaces {
   public:
    void add(const Vec2& uv) {
      if (!is_finite(uv)) return;  // NaN has no order
      const std::unique_lock lock(mutex_);
      places_.insert({uv.x(), uv.y()});
    }
    [[nodiscard]] bool contains(const Vec2& uv) const {
      const std::shared_lock lock(mutex_);
      return places_.contains({uv.x(), uv.y()});
    }

   private:
    mutable std::shared_mutex mutex_;
    std::set<std::array<double, 2>> places_;
  };
  /// `steps` proves quickly that steps stay inside, `places` decides by the curves.
  struct Domain {
    ParameterDomain steps;
    TrimmedDomain places;
    std::unique_ptr<BoundaryPlaces> known = std::make_unique<BoundaryPlaces>();
  };
  /// Plan of the differences for the missing bits: derivatives of order `want`, from order `from`.
  struct Task {
    unsigned missing = 0;
    unsigned from = want_position;
    double relative = 0;
    [[nodiscard]] bool second_from_position() const noexcept { return missing == want_second && from == want_position; }
  };
  /// Decides which steps are allowed.
  enum class Proof { none, steps, places };
  [[nodiscard]] Box box_at(int face, const Vec2& uv) const;
  void surface_inside(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out);
  SurfaceJet extrapolated(int face, unsigned want, const Vec2& uv, const Vec2& closest);
  void add_differences(int face, const Task& task, std::span<const Vec2> uv, std::span<SurfaceJet> out);
  bool add_differences_at(int face, const Task& task, Vec2 uv, DifferenceStep u, DifferenceStep v, Proof proof, SurfaceJet& out);
  void add_one_sided(int face, const Task& task, Vec2 uv, SurfaceJet& out);
  bool add_on_any_side(int face, const Task& task, Vec2 uv, DifferenceStep u, DifferenceStep v, Proof proof, SurfaceJet& out);
  bool add_along_directions(int face, const Task& task, Vec2 uv, DifferenceStep u, DifferenceStep v, Proof proof, SurfaceJet& out);
  bool add_from_inside(int face, const Task& task, Vec2 uv, DifferenceStep u, DifferenceStep v, Proof proof, SurfaceJet& out);
  void avoid_singular_boundary(int face, const Task& task, Vec2 uv, DifferenceStep u, DifferenceStep v, SurfaceJet& out);
  [[nodiscard]] const Domain* domain_of(int face) const;
  /// True if steps from uv to the points stay in the domain by `proof`; always if its boundary is not known.
  [[nodiscard]] bool admits(int face, Vec2 uv, std::span<const Vec2> points, Proof proof);

  std::unique_ptr<Cad> source_;
  unsigned surface_gives_, curve_gives_;
  std::map<int, Box> boxes_;
  std::map<int, Domain> domains_;
};

}  // namespace carreau
