// SPDX-License-Identifier: BSD-3-Clause
#include "session/meshed.h"

#include <algorithm>

#include "cad/checked_cad.h"
#include "cad/part_cad.h"
#include "geometry/discrete/discrete_cad.h"
#include "measure/beside_patches.h"
#include "measure/composite_evaluation.h"
#include "measure/discrete_evaluation.h"
#include "model/geometries.h"
#include "projection/face_boundary.h"
#include "session/gluing.h"
#include "support/infinity.h"
#include "fields/part_monitor.h"
#include "surface/discrete/beside_patches.h"

namespace carreau {

namespace {

MeshEvaluation measure_patches(const Meshed& meshed, const CompositeResult& result, Cad& whole_cad, Monitor& monitor) {
  PartCad cad(whole_cad, parts_of(meshed.model));
  set_parameter_domains(meshed.model, meshed.supports, cad);
  return evaluate_composite(meshed.model, meshed.topology, cad, meshed.options, result, monitor);
}

MeshEvaluation measure_triangles(const Meshed& meshed, const CompositeOptions& options, const CompositeResult& result,
                                 Cad& cad, Monitor& monitor) {
  MeshEvaluation delivered = evaluate_discrete(*meshed.triangles, cad, options, result, monitor);
  if (meshed.bounds_to_input)
    bound_input_distances(meshed.triangles->discrete(), result.mesh, options.executor.threads, monitor, delivered);
  return delivered;
}

/// True if the host gave all curves of the face.
bool are_complete(const Face& face, const std::vector<CurveSupport>& supports) {
  return supports.size() == face.curves.size() && std::all_of(supports.begin(), supports.end(), [](const CurveSupport& s) { return s.t.size() > 1; });
}

}  // namespace

void set_parameter_domains(const Model& model, const ModelSupports& supports, Cad& cad) {
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    Vec2 low{infinity, infinity}, high{-infinity, -infinity};
    for (const CurveSupport& support : supports.of_face[f])
      for (const Vec2& p : support.uv) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    if (!(low.x() < high.x() && low.y() < high.y())) continue;
    cad.set_parameter_box(model.faces[f].ref, low, high);
    if ((cad.surface_gives() & (want_first | want_second)) == (want_first | want_second)) continue;
    const Face& face = model.faces[f];
    // Rectangles: the box is the domain.
    if (face.is_wire() || !are_complete(face, supports.of_face[f]) || projection::is_box(face, supports.of_face[f], low, high)) continue;
    cad.set_boundary(face.ref, projection::boundary_of(face, supports.of_face[f]));
  }
}

MeshEvaluation evaluate_meshed(const Meshed& meshed, const CompositeResult& result, const PartResults* parts,
                               Monitor& monitor) {
  CheckedCad cad(*meshed.cad);
  if (is_discrete(meshed.model)) return measure_triangles(meshed, meshed.options, result, cad, monitor);
  if (parts == nullptr) return measure_patches(meshed, result, cad, monitor);
  PartMonitor first(monitor, 0, share_of_patches), second(monitor, share_of_patches, 1);
  const MeshEvaluation patches = measure_patches(meshed, parts->patches, cad, first);
  const MeshEvaluation triangles = measure_triangles(meshed, parts->triangle_options, parts->triangles, cad, second);
  return beside_each_other(result.mesh, patches, triangles,
                           [&](std::size_t face) { return parts->is_of_triangles(face); });
}

}  // namespace carreau
