// SPDX-License-Identifier: BSD-3-Clause
#include "surface/patch.h"

namespace carreau {

SampledDomain sampled_domain(const PlaneDomain& domain) {
  SampledDomain sampled{domain.vertices, {}};
  for (const PlaneEdge& edge : domain.edges)
    if (edge.kind != PlaneEdgeKind::internal) sampled.edges.emplace_back(edge.a, edge.b);
  return sampled;
}

}  // namespace carreau
