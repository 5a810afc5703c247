// SPDX-License-Identifier: BSD-3-Clause
#include "measure/curve_evaluation.h"

#include <array>
#include <cmath>
#include <limits>

namespace carreau {

void evaluate_curves(const SurfaceMesh& mesh, Cad& cad, std::span<const CurveParameters> parameters, Monitor& monitor,
                     MeshEvaluation& delivered) {
  const MeshEdges& edges = delivered.edges;
  std::vector<double>&deviation = delivered[EvaluationKind::curve_deviation].values,
      &angle = delivered[EvaluationKind::curve_angle].values;
  deviation.assign(edges.vertices.size(), std::numeric_limits<double>::quiet_NaN());
  angle = deviation;
  for (std::size_t e = 0; e < edges.vertices.size(); ++e) {
    if (edges.segment[e] < 0) continue;
    monitor.checkpoint();
    const auto [c, rank] = edges.segments[edges.segment[e]];
    if (static_cast<std::size_t>(c) >= parameters.size()) continue;
    const CurveMesh& curve = mesh.curves[c];
    const CurveParameters& known = parameters[c];
    if (known.t.size() != curve.vertices.size()) continue;
    const double from = known.t[rank], to = known.t[rank + 1];
    if (std::isnan(from) || std::isnan(to)) continue;
    std::array<Vec3, 3> nodes{mesh.vertices[curve.vertices[rank]], mesh.vertices[curve.vertices[rank + 1]], {}};
    const bool curved = !curve.mid.empty();
    if (curved) nodes[2] = mesh.mid_vertices[curve.mid[rank]];
    const EdgeAccuracy found =
        edge_accuracy(cad, known.face, known.ic, from, to, std::span(nodes).first(curved ? 3 : 2));
    deviation[e] = found.deviation, angle[e] = found.angle_deg;
  }
}

}  // namespace carreau
