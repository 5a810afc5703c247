// Wanted sizes at points, on curves and on surfaces (RT-0232 sec. 3.1.3).
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "cad/cad.h"
#include "model/topology.h"

namespace carreau {

/// Variables of blsurf.env that govern sizes; defaults that depend on diag are filled in by the session.
struct SizeParameters {
  int hphy_flag = 1;  ///< 0 ignored, 1 hphydef, 2 asked from the host
  int hgeo_flag = 0;  ///< 0 ignored, 1 from curvature, 2 radii asked from the host
  double hphydef = 0, hphymin = 0, hphymax = 0;
  double hgeomin = 0, hgeomax = 0;
  int hmean_flag = 0;      ///< -1 minimum, 0 and 2 arithmetic, 1 geometric
  int hinterpol_flag = 0;  ///< 0 linear, 1 geometric, 2 sinusoidal
  double angle_mesh = 8;   ///< degrees
};

/// Factor between a radius of curvature and a size: 2 sin(angle) (HDR eq. 2.33, 4.35).
double size_per_radius(double angle_deg) noexcept;

/// Mean of several sizes according to hmean_flag. values not empty.
double mean_size(int hmean_flag, std::span<const double> values);

/// Smallest principal radius of curvature (absolute value) at a jet with first and second derivatives (RR-2928
/// sec. 5.2.1, HDR sec. 4.4.2); +infinity on a plane point; empty where the parametrisation is degenerate.
std::optional<double> smallest_radius(const SurfaceJet& jet) noexcept;

/// Radius of curvature of the space curve S(C(t)) from both jets with second derivatives; +infinity where straight.
double curve_radius(const SurfaceJet& surface, const CurveJet& curve) noexcept;

/// Sizes of a model. Caches what it asks from the host at points and along curves.
class SizeRules {
 public:
  SizeRules(const Model& model, const Topology& topology, Cad& cad, const SizeParameters& parameters);

  /// The Want bits that surface sizes need besides what the caller wants anyway (second derivatives when hgeo_flag =
  /// 1).
  [[nodiscard]] unsigned surface_wants() const noexcept;

  /// h = min of the clamped physical and geometric sizes at a corner point (index in Topology::points).
  double at_point(int point);

  /// Physical and geometric size at an interior point of a curve. `t` holds, for each use of the curve, the parameter
  /// of the same point. `r` in [0, 1]: fraction of the curve's length in space (for interpolation when nobody answers).
  double on_curve(int curve, std::span<const double> t, double r);

  /// Sizes inside a face, for points whose jets (want_first, and surface_wants()) are known. `fallback` gives the
  /// physical size where the host does not answer (interpolated from the discretised interfaces); called only then.
  void on_surface(int face, std::span<const Vec2> uv, std::span<const SurfaceJet> jets,
                  const std::function<double(Vec2)>& fallback, std::span<double> h);

  /// The physical size alone at a point / on a curve (what `fallback` interpolates), clamped.
  double physical_at_point(int point);
  double physical_on_curve(int curve, std::span<const double> t, double r);
};

}  // namespace carreau
