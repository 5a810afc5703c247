#include <algorithm>
#include <limits>

#include "surface/composite.h"

namespace carreau {

ModelSupports build_supports(const Model& model, Cad& cad, double angle_smo, Monitor& monitor) {
  ModelSupports supports;
  constexpr double far = std::numeric_limits<double>::infinity();
  Vec3 low{far, far, far}, high{-far, -far, -far};
  for (const Face& face : model.faces) {
    auto& of_face = supports.of_face.emplace_back();
    for (int c = 0; c < static_cast<int>(face.curves.size()); ++c) {
      monitor.checkpoint();
      of_face.push_back(build_support(cad, face.ref, c + 1, {.angle_deg = angle_smo}));
      for (const Vec3& p : of_face.back().xyz) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      }
    }
  }
  supports.diag = low.x <= high.x ? norm(high - low) : 0;
  return supports;
}

CurveTraces traces_of(const ModelSupports& supports) {
  CurveTraces traces(supports.of_face.size());
  for (std::size_t f = 0; f < traces.size(); ++f)
    for (const CurveSupport& support : supports.of_face[f]) traces[f].push_back(support.xyz);
  return traces;
}

}  // namespace carreau
