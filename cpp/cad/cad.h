// SPDX-License-Identifier: BSD-3-Clause
// The host's geometry as an interface for the engine.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "support/vec.h"

namespace carreau {

/// Requested derivatives; a set of bits.
enum Want : unsigned { want_position = 1, want_first = 2, want_second = 4 };

/// Position and derivatives of S(u, v); only the requested members are meaningful.
struct SurfaceJet {
  Vec3 s, su, sv, suu, suv, svv;
};

/// Position and derivatives of C(t) in the parameter plane; only the requested members are meaningful.
struct CurveJet {
  Vec2 c, ct, ctt;
};

struct Interval {
  double a = 0, b = 1;
};

/// Samples of a curve that bounds a face: uv[i] is the curve at t[i], and t increases. Between two samples the curve is a
/// graph over its chord.
struct BoundaryCurve {
  int ic = 0;
  std::vector<double> t;
  std::vector<Vec2> uv;
};

/// Number of calls of each routine of the host; one point of a batch counts as one call.
struct CallCounts {
  std::int64_t surf0 = 0, surf1 = 0, surf2 = 0, curv0 = 0, curv1 = 0, curv2 = 0, sizes = 0;
  [[nodiscard]] std::int64_t surface() const noexcept { return surf0 + surf1 + surf2; }
  friend bool operator==(const CallCounts&, const CallCounts&) = default;
};

/// The host's geometry (RT-0232 sec. 3.1). `face` is the reference of a face, `ic` the rank of a curve
/// in its face, from 1: exactly the arguments of the cad_m routines.
/// Implementations throw CallbackError when the host reports failure or returns a value that is not
/// finite. Called by the run's thread only, unless reentrant().
class Cad {
 public:
  virtual ~Cad() = default;

  /// Evaluates S and its derivatives at each point. uv.size() == out.size(). `want` combines bits of Want.
  virtual void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) = 0;
  /// Interval of definition [a, b] of a curve, a < b.
  virtual Interval curve_interval(int face, int ic) = 0;
  virtual CurveJet curve(int face, int ic, unsigned want, double t) = 0;

  /// Prescribed sizes; empty when the host does not answer (RT-0232 sec. 3.1.3 a).
  virtual std::optional<double> surface_size(int /*face*/, Vec2 /*uv*/) { return {}; }
  virtual std::optional<double> curve_size(int /*face*/, int /*ic*/, double /*t*/) { return {}; }
  virtual std::optional<double> point_size(int /*point*/) { return {}; }
  /// Radii of curvature given by the host (hgeo_flag = 2).
  virtual std::optional<double> surface_radius(int /*face*/, Vec2 /*uv*/) { return {}; }
  virtual std::optional<double> curve_radius(int /*face*/, int /*ic*/, double /*t*/) { return {}; }

  [[nodiscard]] virtual bool reentrant() const noexcept { return false; }
  /// Calls since the object was made; all zero without a count.
  [[nodiscard]] virtual CallCounts counts() const noexcept { return {}; }

  /// The Want bits that come from the host itself; the others are found by finite differences.
  [[nodiscard]] virtual unsigned surface_gives() const noexcept { return want_position | want_first | want_second; }
  [[nodiscard]] virtual unsigned curve_gives() const noexcept { return want_position | want_first | want_second; }
  /// Passes the box of a face's parameter domain, so that finite differences have the right steps and stay inside. Not
  /// while other threads evaluate.
  virtual void set_parameter_box(int /*face*/, Vec2 /*low*/, Vec2 /*high*/) {}
  /// Passes the curves that bound a face's parameter domain, which finite differences do not leave then. Not while other
  /// threads evaluate.
  virtual void set_boundary(int /*face*/, std::vector<BoundaryCurve> /*boundary*/) {}
};

/// One point.
inline SurfaceJet surface_at(Cad& cad, int face, unsigned want, Vec2 uv) {
  SurfaceJet jet;
  cad.surface(face, want, {&uv, 1}, {&jet, 1});
  return jet;
}

}  // namespace carreau
