// SPDX-License-Identifier: BSD-3-Clause
// The metric that is prescribed inside a face.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "cad/batches.h"
#include "gradation/graded_field.h"
#include "predicates/polygon_locator.h"
#include "size/size_rules.h"
#include "surface/patch.h"
#include "surface/sample/interface_sizes.h"

namespace carreau {

/// Keeps references to `rules`, `interfaces` and `monitor`. Used by one thread.
class FaceMetric {
 public:
  /// `face` is an index in Model::faces.
  FaceMetric(int face, const SizeRules& rules, const PlaneDomain& plane, const std::vector<double>& physical,
             Monitor& monitor, const SizeLimits& limits = {})
      : face_(face), rules_(rules), plane_(plane), physical_(physical), monitor_(monitor), limits_(limits) {}

  FaceMetric(int face, const SizeRules& rules, const FaceInterfaces& interfaces, Monitor& monitor,
             const SizeLimits& limits = {})
      : FaceMetric(face, rules, interfaces.plane, interfaces.physical, monitor, limits) {}

  /// The Want bits that the jets of at() must hold.
  [[nodiscard]] unsigned wants() const noexcept {
    return want_first | rules_.surface_wants() | (limits_.want_places() ? want_position : 0U) |
           (std::isfinite(limits_.lean) ? want_second : 0U);
  }

  /// Computes J^T J / h^2 (RR-2928 eq. 27) at each point, or the metrics that prescribed metrics induce (HDR eq. 4.64,
  /// 4.66), within the limits. Evaluates the host. If the parametrisation is degenerate, metrics that depend on the
  /// geometry are limits from inside the domain. Around a pole they differ from one meridian to the next. The metric of
  /// a point does not depend on the other points.
  void at(std::span<const Vec2> uv, std::span<const SurfaceJet> jets, std::span<Metric2> metric);

  /// Samples the metric at points of the face of reference `ref`. The jets hold the derivatives `want`, too. Calls
  /// use(rank, jet, metric) for each point, in order, and evaluates a batch at a time.
  template <typename Use>
  void sample(Cad& cad, int ref, unsigned want, std::span<const Vec2> uv, const Use& use) {
    std::vector<Metric2> metric(std::min(points_at_once, uv.size()));
    const auto prescribe = [&](std::size_t first, std::span<const Vec2> here, std::span<const SurfaceJet> jets) {
      at(here, jets, std::span(metric).first(here.size()));
      for (std::size_t k = 0; k < here.size(); ++k) use(first + k, jets[k], metric[k]);
    };
    for_batches(cad, ref, want | wants(), uv, monitor_, prescribe);
  }

  /// The limit at a point where the parametrisation is degenerate. Empty if it is also degenerate beside, or no place
  /// beside is inside the domain.
  [[nodiscard]] std::optional<TangentMetric> limit(Vec2 uv, const SurfaceJet& jet);

 private:
  [[nodiscard]] double interpolated(Vec2 uv);
  [[nodiscard]] std::optional<Vec2> beside(Vec2 uv, const SurfaceJet& jet);

  int face_;
  const SizeRules& rules_;
  const PlaneDomain& plane_;
  const std::vector<double>& physical_;
  Monitor& monitor_;
  SizeLimits limits_;
  std::optional<InterfaceSizes> interfaces_;  // built only when the host leaves a question open
  struct Inside {
    PolygonLocator locator;
    Vec2 middle, half;  // of the domain's box
  };
  std::optional<Inside> inside_;  // built only where the parametrisation is degenerate
};

/// The prescription inside a patch that is being meshed, within input.limits or without limits.
inline FaceMetric prescription_of(const PatchInput& input, const SizeRules& rules, Monitor& monitor) {
  return {input.face, rules, input.domain->plane, input.domain->physical, monitor, input.limits};
}
inline FaceMetric unlimited_prescription_of(const PatchInput& input, const SizeRules& rules, Monitor& monitor) {
  return {input.face, rules, input.domain->plane, input.domain->physical, monitor};
}

/// The size h of an isotropic metric J^T J / h^2; 0 where both derivatives vanish.
double isotropic_size(const SurfaceJet& jet, Metric2 metric) noexcept;

/// sqrt(h1 h2) of a metric of any kind; 0 where the parametrisation is degenerate.
double geometric_mean_size(const SurfaceJet& jet, Metric2 metric) noexcept;

/// Bounds metrics of a face in place. The jets hold first derivatives, and positions if there is a field. If the metrics
/// have directions and the parametrisation is degenerate, the smaller graded size counts.
void apply_limits(const SizeLimits& limits, bool isotropic, int face, std::span<const Vec2> uv,
                  std::span<const SurfaceJet> jets, std::span<Metric2> metric) noexcept;

}  // namespace carreau
