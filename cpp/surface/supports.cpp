// SPDX-License-Identifier: BSD-3-Clause
#include "surface/supports.h"

#include <algorithm>

#include "support/infinity.h"
#include "support/stepped_tasks.h"

namespace carreau {

ModelSupports build_supports(const Model& model, Cad& cad, double angle_smo, int threads, Monitor& monitor,
                             std::vector<std::string>* failures) {
  ModelSupports supports;
  if (failures != nullptr) failures->assign(model.faces.size(), "");
  supports.of_face.resize(model.faces.size());
  const auto build = [&](std::size_t f, Monitor& of_task) {
    for (int c = 0; c < static_cast<int>(model.faces[f].curves.size()); ++c) {
      of_task.checkpoint();
      supports.of_face[f].push_back(build_support(cad, model.faces[f].ref, c + 1, {.angle_deg = angle_smo}));
    }
  };
  const auto build_or_say_why = [&](std::size_t f, Monitor& of_task) {
    try {
      build(f, of_task);
    } catch (const CallbackError& error) {
      if (failures == nullptr) throw;
      (*failures)[f] = error.what();
    }
  };
  run_each(model.faces.size(), !cad.reentrant(), threads, build_or_say_why, monitor);
  Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  // Free curves may extend beyond the box of the faces.
  const bool wires_alone =
      std::all_of(model.faces.begin(), model.faces.end(), [](const Face& face) { return face.is_wire(); });
  for (std::size_t f = 0; f < supports.of_face.size(); ++f) {
    if (model.faces[f].is_wire() && !wires_alone) continue;
    for (const CurveSupport& support : supports.of_face[f])
      for (const Vec3& p : support.xyz) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
  }
  supports.diag = low.x() <= high.x() ? norm(high - low) : 0;
  return supports;
}

CurveTraces traces_of(const ModelSupports& supports) {
  CurveTraces traces(supports.of_face.size());
  for (std::size_t f = 0; f < traces.size(); ++f)
    for (const CurveSupport& support : supports.of_face[f]) traces[f].push_back(support.xyz);
  return traces;
}

}  // namespace carreau
