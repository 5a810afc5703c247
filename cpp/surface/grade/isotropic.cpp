// SPDX-License-Identifier: BSD-3-Clause
// The part of the gradation that is about one size at each vertex.
#include <algorithm>
#include <cmath>

#include "support/infinity.h"
#include "surface/grade/kinds.h"
#include "surface/grade/thresholds.h"

namespace carreau::detail {

namespace {

using namespace thresholds::grade;

// Where some size is another vertex's, or some sample not what the corners of its triangle make of it, the
// prescribed sizes do not obey the gradation.
void find_rough(const GradingWork& work, std::size_t f, GradedFace& face) {
  const auto prescribed = [&](std::int32_t v) {
    return work.prescribed_h[work.graph.places[work.place_of[f] + v].vertex];
  };
  for (std::size_t t = 0; t < face.triangles.size(); ++t)
    for (const std::int32_t v : face.triangles[t])
      if (dot(face.front[v].line, face.front[v].line) > 0 || face.h[v] < (1 - roughness) * prescribed(v))
        face.smooth[t] = 0;
  for (const GradingWork::Sample& s : work.samples[f]) {
    double linear = 0;
    for (int i = 0; i < 3; ++i) linear += s.promised[i] * face.h[face.triangles[s.triangle][i]];
    if (std::abs(linear - s.h) > roughness * s.h) face.smooth[s.triangle] = 0;
  }
  widen_rough(face);
}

// A vertex that is the source of all its neighbours.
void find_size_minima(GradedFace& face) {
  std::vector<char> minimum(face.uv.size(), 1);
  for (const auto& t : face.triangles)
    for (int i = 0; i < 3; ++i)
      for (int k = 1; k < 3; ++k) {
        const std::int32_t v = t[i], w = t[(i + k) % 3];
        if (face.xyz[v] == face.xyz[w]) continue;  // a pole has several vertices
        const GradationFront& f = face.front[w];
        if (dot(f.line, f.line) == 0 || f.source_h != face.h[v]) minimum[v] = 0;
      }
  for (std::size_t v = 0; v < minimum.size() && face.size_minima.size() < most_size_minima; ++v)
    if (minimum[v] != 0) face.size_minima.push_back(face.uv[v]);
}

}  // namespace

// The sizes of curves are known at their vertices already.
void IsotropicGrading::run(const std::vector<SizeSamples>& /*raw*/, double slope) {
  fronts_ = grade_fronts(work_.graph, work_.h, work_.sources, slope, work_.monitor);
}

double IsotropicGrading::along(int place, const Vec3& /*direction*/) const noexcept {
  return fronts_.h[work_.graph.places[place].vertex];
}

void IsotropicGrading::give_to_face(std::size_t f) {
  GradedFace& face = work_.faces[f];
  for (std::size_t v = 0; v < face.uv.size(); ++v) {
    face.front.push_back(fronts_.front[work_.place_of[f] + v]);
    face.h.push_back(fronts_.h[work_.graph.places[work_.place_of[f] + v].vertex]);
  }
  find_rough(work_, f, face);
  find_size_minima(face);
}

double IsotropicGrading::at_node(std::size_t c, std::size_t node, const SizeSamples& /*raw*/) const {
  return fronts_.h[work_.node_of[c][node]];
}

double IsotropicGrading::between_nodes(std::size_t c, std::size_t k, double w, double h, double /*known*/,
                                       const GradedField& field) const {
  const DiscreteCurve& d = work_.curves[c];
  const std::vector<CurveUse>& uses = work_.model.topology.curves[c].uses;
  const Vec3 xyz = lerp(d.xyz[k], d.xyz[k + 1], w);
  for (std::size_t u = 0; u < uses.size(); ++u)
    h = std::min(h, field.size(uses[u].face, lerp(d.uv_of_use[u][k], d.uv_of_use[u][k + 1], w), xyz, infinity));
  return h;
}

}  // namespace carreau::detail
