// SPDX-License-Identifier: BSD-3-Clause
// Wanted sizes at points, on curves and on surfaces (RT-0232 sec. 3.1.3).
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "cad/cad.h"
#include "metric/metric3_algebra.h"
#include "metric/prescription.h"
#include "model/topology.h"
#include "size/geometric_metric.h"
#include "size/size_law.h"
#include "support/error.h"
#include "support/infinity.h"

namespace carreau {

/// Origin of physical sizes (hphy_flag).
enum class PhysicalSizes : std::uint8_t {
  ignored,
  uniform,  ///< hphydef
  asked     ///< from the host
};
/// Origin of geometric sizes (hgeo_flag).
enum class GeometricSizes : std::uint8_t {
  ignored,
  curvature,
  radii  ///< of the host
};
/// Mean of several sizes (hmean_flag).
enum class SizeMean : std::uint8_t { minimum, arithmetic, geometric };

/// Parameters that govern sizes; the session fills in defaults that depend on diag.
struct SizeParameters {
  PhysicalSizes physical = PhysicalSizes::uniform;
  GeometricSizes geometric = GeometricSizes::ignored;
  double hphydef = 0, hphymin = 0, hphymax = 0;
  double hgeomin = 0, hgeomax = 0;
  SizeMean mean = SizeMean::arithmetic;
  SizeLaw law = SizeLaw::linear;
  double angle_mesh = 8;  ///< degrees
  GeometricCriterion geo_rule = GeometricCriterion::angle;
  double eps_chord = 0;          ///< A0, model length; > 0 if geo_rule is chord or both
  bool geo_guarantee = false;    ///< sizes times guaranteed_angle_factor or guaranteed_chord_factor (thresholds.h)
  bool guarantee_triangles = false;  ///< geo_guarantee, and planes of triangles keep the angle as edges do (RT-0232 sec. 3.3)
  bool geo_anisotropic = false;  ///< sizes by both principal radii
  double anisotropy_max = 1000;  ///< largest ratio of geometric sizes in two directions, >= 1
  MetricCombination metric_combination = MetricCombination::intersection;
  /// Factor on the answers of hosts and sources, and on sizes by curvature: see enlarged().
  double enlargement = 1;
  /// Asked in this order unless physical sizes are ignored; their answers all count. Not owned.
  std::vector<PrescriptionSource*> sources = {};
};

/// Limits that a geometric rule sets to a mesh (HDR sec. 4.3); infinity: no limit.
struct GeometricLimits {
  double edge_angle_deg = infinity;  ///< of edges with tangent planes at their ends
  double triangle_angle_deg = infinity;  ///< of planes of triangles with tangent planes at their corners
  double deviation = infinity;       ///< A0 of triangles, model length
  double shortest_divided = 0;       ///< edges below it are as short as hgeomin permits, whatever they exceed

  [[nodiscard]] bool any() const noexcept { return std::isfinite(edge_angle_deg) || std::isfinite(deviation); }
};
GeometricLimits geometric_limits(const SizeParameters& size) noexcept;

/// The sizes multiplied by `factor`: for a mesh whose edges will be divided.
SizeParameters enlarged(SizeParameters size, double factor) noexcept;

/// The rule for geometric sizes, with the factors of guarantees and enlargement.
GeometricRule geometric_rule(const SizeParameters& size) noexcept;

/// Mean of several sizes. values not empty.
double mean_size(SizeMean kind, std::span<const double> values);

/// Smallest principal radius of curvature (absolute value) at a jet with first and second derivatives (RR-2928 sec.
/// 5.2.1, HDR sec. 4.4.2). Returns +infinity on a plane point; empty if the parametrisation is degenerate.
std::optional<double> smallest_radius(const SurfaceJet& jet) noexcept;

/// Radius of curvature of the space curve S(C(t)) from both jets with first and second derivatives; +infinity if the
/// curve is straight or does not move.
double curve_radius(const SurfaceJet& surface, const CurveJet& curve) noexcept;

/// The prescriptions at one point inside a curve, along its tangent.
struct CurveSizes {
  bool answered = false;  ///< the curve or a surface beside it answers; else `physical` is interpolated from the ends
  double physical = 0;    ///< clamped; +infinity when it is ignored
  double h = 0;           ///< with the geometric size
};

class SizeRules;

/// Faces at whose places other faces' sizes count, too.
class JoinedFaces {
 public:
  virtual ~JoinedFaces() = default;
  /// Intersects metrics of the parameter plane of a face (index in Model::faces) with the metrics of the faces joined to it.
  virtual void intersect(const SizeRules& rules, int face, std::span<const Vec2> uv, std::span<Metric2> metric) const = 0;
  virtual void lower(const SizeRules& rules, int face, std::span<const Vec2> uv, std::span<double> h) const = 0;
};

/// Size: double, or Metric2 of the tangent plane in an orthonormal basis (sizes_at_places.cpp).
template <typename Size>
class SizesAtPlaces;

/// Prescribed sizes and metrics of a model. Keeps references to the first three arguments of its constructor and caches
/// the sizes at points. A size that the host returns is clamped, whatever its sign (RT-0232 sec. 3.1.3 a); NaN and
/// infinity cause a CallbackError that names the routine, the entity and the value. A radius may have either sign; only
/// NaN is an error. A metric must be positive definite; its sizes in the tangent plane are clamped.
///
/// One field has two representations. If sizes are the same in all directions, each place has a number. If sizes differ
/// by direction (uses_metrics()), each place of a face has a metric of its tangent plane. Points and curves have the
/// sizes along the tangents of the curves. One set of functions computes both (sizes_at_places.cpp). The answers of
/// sources and size routines at one place are intersected, then combined with the geometric metric by
/// metric_combination. Without answers, the size is hphydef (PhysicalSizes::uniform) or interpolated as in the manual
/// (PhysicalSizes::asked). If the host is re-entrant and there are no sources, several threads may call const functions.
class SizeRules {
 public:
  /// Throws InvalidArgument if both sizes are ignored, bounds are not positive and ascending, angle_mesh lies outside
  /// ]0, 90], or anisotropy_max is below 1. Also if eps_chord is needed and not positive.
  SizeRules(const Model& model, const Topology& topology, Cad& cad, const SizeParameters& parameters);

  /// These rules with another host, and these sources.
  [[nodiscard]] SizeRules asking(Cad& cad) const { return {model_, topology_, cad, parameters_}; }

  /// The least size of each class of points (indices in Topology::points) holds at all its points, and sizes of faces that
  /// `faces` joins count for each other from now on. Null: none are joined. Not owned.
  void join(const std::vector<std::vector<int>>& points, const JoinedFaces* faces);

  /// Returns the Want bits that on_surface() needs in its jets.
  [[nodiscard]] unsigned surface_wants() const noexcept;

  /// The size, if it is uniform and no host is ever called.
  [[nodiscard]] std::optional<double> constant() const noexcept;

  [[nodiscard]] bool uses_curvature() const noexcept { return parameters_.geometric != GeometricSizes::ignored; }
  /// True if sources of prescriptions are evaluated.
  [[nodiscard]] bool asks_sources() const noexcept {
    return parameters_.physical != PhysicalSizes::ignored && !parameters_.sources.empty();
  }
  /// True if sizes may differ by direction or come from sources.
  [[nodiscard]] bool uses_metrics() const noexcept {
    return (uses_curvature() && parameters_.geo_anisotropic) || asks_sources();
  }
  /// Properties of the sources' fields: the largest accuracy(), and the steep places of a face (index in Model::faces).
  [[nodiscard]] double source_accuracy() const noexcept;
  [[nodiscard]] std::vector<Vec2> steep_places(int face) const;
  [[nodiscard]] std::vector<SteepPlace> steep_in_space() const;
  /// Parameters of a use of a curve at which sources report kinks.
  [[nodiscard]] std::vector<double> kinks_on_curve(const CurveUse& use) const;
  /// The variation of sizes between two known points.
  [[nodiscard]] SizeLaw law() const noexcept { return parameters_.law; }

  /// h = min of the clamped physical and geometric sizes at a corner point (index in Topology::points).
  double at_point(int point);

  /// The size at an interior point of a curve. `t` holds, for each use of the curve, the parameter of the same point.
  /// `r` in [0, 1]: fraction of the curve's length in space (for interpolation without answers).
  double on_curve(int curve, std::span<const double> t, double r);

  /// Computes the metrics of the parameter plane inside a face (index in Model::faces) at points whose jets hold first
  /// derivatives and surface_wants(). `fallback` returns the physical size, interpolated from the discretised
  /// interfaces, if the host does not answer; it is called only then, and clamped. If the parametrisation is degenerate,
  /// the geometric size is the size of the nearest regular point of the batch.
  void on_surface(int face, std::span<const Vec2> uv, std::span<const SurfaceJet> jets,
                  const std::function<double(Vec2)>& fallback, std::span<Metric2> metric) const;
  /// The same without the sizes of joined faces.
  void alone_on_surface(int face, std::span<const Vec2> uv, std::span<const SurfaceJet> jets,
                        const std::function<double(Vec2)>& fallback, std::span<Metric2> metric) const;
  /// Computes the sizes of rules without metrics; the jets need no more than surface_wants().
  void on_surface(int face, std::span<const Vec2> uv, std::span<const SurfaceJet> jets,
                  const std::function<double(Vec2)>& fallback, std::span<double> h) const;

  /// The surface of a face (index in Model::faces) at one point, with these Want bits.
  [[nodiscard]] SurfaceJet surface_jet(int face, unsigned want, const Vec2& uv) const;

  /// Returns the clamped physical size at a point, without the geometric size; +infinity if hphy_flag is 0.
  double physical_at_point(int point);

  /// The geometric size for a radius of curvature, clamped.
  [[nodiscard]] double clamped_geometric(double radius) const noexcept;

  /// Returns the size of on_curve() together with the physical size, which `fallback` of on_surface() interpolates.
  CurveSizes ask_on_curve(int curve, std::span<const double> t, double r);
  /// The physical size between the ends of a curve without answers.
  double interpolated_on_curve(int curve, double r);

 private:
  template <typename Size>
  friend class SizesAtPlaces;

  /// A corner of a face's domain.
  struct Corner {
    int face = 0;  ///< index in Model::faces
    Vec2 uv;
  };
  /// An end of a curve: the parameter of it in each use.
  struct CurveEnd {
    int curve = 0;
    std::vector<double> t;
  };

  [[nodiscard]] double clamped_physical(double h) const noexcept;
  [[nodiscard]] Where where_of(const CurveUse& use, double t) const;
  [[nodiscard]] double towards_middle(const CurveUse& use, double t) const;
  static std::optional<std::size_t> nearest_of(std::span<const std::size_t> sound, std::span<const Vec2> uv,
                                               const Vec2& p);
  std::optional<double> ask_surface(int face, const Vec2& uv) const;
  std::optional<double> ask_point(int point) const;
  std::optional<double> ask_curve(int curve, std::span<const double> t) const;
  std::optional<double> mean_of(const std::vector<double>& answers) const;
  std::optional<double> host_radius_of_surface(int face, const Vec2& uv) const;
  std::optional<double> host_radius_of_curve(int curve, std::span<const double> t) const;
  std::optional<double> radius_beside(const CurveUse& use, double t, const SurfaceJet* jet) const;
  std::optional<double> radius_in_face(int face, const Vec2& uv, const SurfaceJet* jet) const;
  std::vector<CurveEnd> ends_at(int point) const;
  std::vector<Corner> corners_of(const std::vector<CurveEnd>& ends) const;
  double radius_of_curve(int curve, std::span<const double> t, std::optional<SurfaceJet>& jet) const;
  [[nodiscard]] bool needs_positions() const noexcept;
  [[nodiscard]] bool asks_curves_only() const noexcept;

  double mean_of_answers_around(int point);
  double alone_physical_at_point(int point);
  double alone_at_point(int point);
  void alone_on_surface(int face, std::span<const Vec2> uv, std::span<const SurfaceJet> jets,
                        const std::function<double(Vec2)>& fallback, std::span<double> h) const;

  const Model& model_;
  const Topology& topology_;
  Cad& cad_;
  SizeParameters parameters_;
  GeometricRule rule_;
  std::vector<std::optional<double>> physical_at_point_, size_at_point_;
  std::map<int, std::vector<int>> joined_points_;  // by point: its class
  const JoinedFaces* joined_faces_ = nullptr;
};

}  // namespace carreau
