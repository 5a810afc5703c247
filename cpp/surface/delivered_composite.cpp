#include "surface/delivered_composite.h"

#include <memory>

namespace carreau {

namespace {

// Edges of a unit mesh differ, by what the gradation allows and as much again as this.
constexpr double adjacent_lengths = 1.6;

// Edges keep the angle, triangles the distance (HDR sec. 4.3).
void set_geometric_limits(const SizeParameters& size, DeliveredOptions& options) {
  if (size.hgeo_flag == 0) return;
  const GeometricCriterion rule = size.geo_rule;
  const bool by_radius = rule == GeometricCriterion::radii && !size.geo_anisotropic;  // the angle's equation
  if (rule == GeometricCriterion::angle || rule == GeometricCriterion::both || by_radius)
    options.edge_angle_limit = size.angle_mesh;
  if (rule == GeometricCriterion::chord || rule == GeometricCriterion::both) options.deviation_limit = size.eps_chord;
}

}  // namespace

Delivered measure_composite(const Model& model, const Topology& topology, Cad& cad, const CompositeOptions& options,
                            const CompositeResult& result, Monitor& monitor) {
  SizeRules rules(model, topology, cad, options.size);
  // One face after the other is asked.
  std::unique_ptr<FaceMetric> prescribed;
  int prescribed_face = -1;
  const SizeLimits limits{.field = result.graded.get()};
  const PrescribedMetric metric{
      want_first | rules.surface_wants() | (limits.field != nullptr ? want_position : 0U),
      [&](int face, std::span<const Vec2> uv, std::span<const SurfaceJet> jets, std::span<Metric2> out) {
        if (face != prescribed_face) {
          const FaceInterfaces& interfaces = result.interfaces[face];
          prescribed =
              std::make_unique<FaceMetric>(face, rules, interfaces.plane, interfaces.physical, monitor, limits);
          prescribed_face = face;
        }
        prescribed->at(uv, jets, out);
      }};
  DeliveredOptions measure;
  measure.curve_size = result.curve_size;
  measure.law = rules.law();
  set_geometric_limits(options.size, measure);
  if (options.gradation > 0) {
    measure.gradation_limit = options.gradation;
    measure.length_ratio_limit = adjacent_lengths * options.gradation;
  }
  return measure_delivered(result.mesh, cad, metric, measure, monitor);
}

}  // namespace carreau
