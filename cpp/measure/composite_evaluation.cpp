// SPDX-License-Identifier: BSD-3-Clause
#include "measure/composite_evaluation.h"

#include <memory>

#include "surface/improve/even_edges.h"
#include "surface/remesh/frame.h"

namespace carreau {

EvaluationOptions evaluation_options(const CompositeOptions& options, const CompositeResult& result, double angle_slack) {
  EvaluationOptions measure;
  measure.curve_size = result.curve_size;
  measure.curve_parameters = result.curve_parameters;
  const GeometricLimits geometric = geometric_limits(options.size);
  measure.edge_angle_limit = geometric.edge_angle_deg;
  measure.shortest_for_angle = geometric.shortest_divided;
  measure.deviation_limit = geometric.deviation;
  measure.atlas = {result.atlas.get(), result.feet};
  measure.bounds = options.measure_bounds;
  const bool by_direction = result.atlas != nullptr && result.atlas->by_direction();
  const SurfaceTolerances tolerances = surface_tolerances(options, by_direction, angle_slack);
  if (tolerances.deviation > 0) measure.deviation_tolerance = tolerances.deviation;
  measure.deviation_share = tolerances.share_of_size, measure.angle_tolerance = tolerances.angle_deg;
  measure.vertex_size = result.vertex_size;
  // Only meshes that are freed are held to them.
  if (result.mesh.independent) measure.bound_share_limit = 1;
  return measure;
}

MeshEvaluation evaluate_composite(const Model& model, const Topology& topology, Cad& cad,
                                  const CompositeOptions& options, const CompositeResult& result, Monitor& monitor) {
  SizeRules rules(model, topology, cad, options.size);
  // The faces are evaluated one after the other.
  std::unique_ptr<FaceMetric> prescribed;
  int prescribed_face = -1;
  const SizeLimits limits{.field = result.graded.get()};
  const PrescribedMetric metric{
      want_first | rules.surface_wants() | (limits.field != nullptr ? want_position : 0U),
      [&](int face, std::span<const Vec2> uv, std::span<const SurfaceJet> jets, std::span<Metric2> out) {
        if (face != prescribed_face) {
          prescribed = std::make_unique<FaceMetric>(face, rules, result.interfaces[face], monitor, limits);
          prescribed_face = face;
        }
        prescribed->at(uv, jets, out);
      }};
  EvaluationOptions measure = evaluation_options(options, result);
  measure.law = rules.law();
  if (options.gradation > 0) {
    measure.gradation_limit = options.gradation;
    measure.spaces = result.spaces;
    measure.length_ratio_limit = adjacent_lengths * options.gradation;
  }
  return evaluate_mesh(result.mesh, cad, metric, measure, monitor);
}

}  // namespace carreau
