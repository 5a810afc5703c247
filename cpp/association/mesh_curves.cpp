// SPDX-License-Identifier: BSD-3-Clause
#include "association/mesh_curves.h"

#include <algorithm>
#include <cstddef>

#include "support/error.h"

namespace carreau {

namespace {

void place_known(const CurveModel& model, const CurveParameters& known, DiscreteCurve& d) {
  const std::vector<CurveUse>& uses = model.curve(d.curve).uses;
  const auto owner = std::find_if(uses.begin(), uses.end(), [&](const CurveUse& use) {
    return model.face_ref(use) == known.face && use.curve + 1 == known.ic;
  });
  if (owner == uses.end()) throw InvalidArgument(Where{.curve = model.curve(d.curve).ref}.prefix() + "the model has no such curve of a face any more");
  d.owner = static_cast<int>(owner - uses.begin());
  const CurveSupport& support = model.support(*owner);
  std::vector<double> r, t(known.t.begin() + 1, known.t.end() - 1);
  for (const double at : t) {
    const double share = support.arc_at_t(at) / support.length();
    r.push_back(owner->reversed ? 1 - share : share);
  }
  place_vertices_at(d, r, t, model);
}

}  // namespace

DiscreteCurve undivided_curve(const CurveModel& model, std::size_t curve, const Vec3& from, const Vec3& to) {
  DiscreteCurve d;
  d.curve = static_cast<int>(curve);
  d.indivisible = model.curve(d.curve).degenerate || !(model.length(d.curve) > 0);
  d.r = {0, 1};
  d.sizes = {{0, 1}, {1, 1}, {1, 1}};
  d.size = d.physical = {1, 1};
  d.xyz = {from, to};
  place_vertices_at(d, {}, {}, model);
  return d;
}

std::vector<DiscreteCurve> curves_of_mesh(const CurveModel& model, const SurfaceMesh& mesh, const std::vector<CurveParameters>& parameters) {
  std::vector<DiscreteCurve> curves;
  for (std::size_t c = 0; c < model.topology.curves.size(); ++c) {
    const std::vector<std::int32_t>& chain = mesh.curves[c].vertices;
    if (chain.empty()) throw InvalidArgument(Where{.curve = mesh.curves[c].ref}.prefix() + "the mesh has no vertex on it");
    DiscreteCurve d = undivided_curve(model, c, mesh.vertices[chain.front()], mesh.vertices[chain.back()]);
    if (!d.indivisible) {
      if (c >= parameters.size() || parameters[c].t.size() != chain.size())
        throw InvalidArgument(Where{.curve = mesh.curves[c].ref}.prefix() + "the parameters of its vertices are not known: a narrow face has vanished there");
      place_known(model, parameters[c], d);
      for (std::size_t k = 0; k < chain.size(); ++k) d.xyz[k] = mesh.vertices[chain[k]];
    }
    curves.push_back(std::move(d));
  }
  return curves;
}

std::vector<CurveParameters> parameters_of_curves(const CurveModel& model, const std::vector<DiscreteCurve>& curves) {
  std::vector<CurveParameters> parameters;
  for (const DiscreteCurve& curve : curves) {
    parameters.emplace_back();
    if (curve.indivisible) continue;
    const auto owner = static_cast<std::size_t>(curve.owner);
    const CurveUse& use = model.curve(curve.curve).uses[owner];
    parameters.back() = {model.face_ref(use), use.curve + 1, curve.t_of_use[owner]};
  }
  return parameters;
}

}  // namespace carreau
