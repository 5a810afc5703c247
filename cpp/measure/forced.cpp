// SPDX-License-Identifier: BSD-3-Clause
#include "measure/forced.h"

#include <vector>

namespace carreau {

void count_forced(const SurfaceMesh& mesh, double shortest, MeshEvaluation& d) {
  std::vector<char> on_curve(mesh.vertices.size(), 0);
  for (const CurveMesh& curve : mesh.curves)
    for (const std::int32_t v : curve.vertices) on_curve[v] = 1;
  Delivery &angle = d[EvaluationKind::edge_angle], &on_curves = d[EvaluationKind::curve_angle],
           &triangles = d[EvaluationKind::vertex_angle], &gradation = d[EvaluationKind::gradation];
  angle.shortest = on_curves.shortest = triangles.shortest = shortest;
  std::vector<char> is_shortest(d.edges.vertices.size(), 0);
  for (std::size_t e = 0; e < d.edges.vertices.size(); ++e) {
    const auto [a, b] = d.edges.vertices[e];
    is_shortest[e] = static_cast<char>(norm(mesh.vertices[b] - mesh.vertices[a]) <= angle.shortest);
    if (is_shortest[e] != 0 && angle.exceeds(angle.values[e])) ++angle.forced;
    if (is_shortest[e] != 0 && on_curves.exceeds(on_curves.values[e])) ++on_curves.forced;
    if (gradation.exceeds(gradation.values[e]) && d.edges.segment[e] < 0 && on_curve[a] != 0 && on_curve[b] != 0)
      ++gradation.forced;
  }
  for (std::size_t t = 0; t < d.edges.of_triangle.size(); ++t) {
    const auto [i, j, k] = d.edges.of_triangle[t];
    if (is_shortest[i] != 0 && is_shortest[j] != 0 && is_shortest[k] != 0 && triangles.exceeds(triangles.values[t]))
      ++triangles.forced;
  }
}

}  // namespace carreau
