// SPDX-License-Identifier: BSD-3-Clause
#include "surface/independent/edits/collapse_price.h"

#include <algorithm>
#include <vector>

#include "support/infinity.h"
#include "surface/independent/base/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::independent;

int is_out_of_range(const FreeMesh& mesh, std::int32_t v, std::int32_t w) {
  const double l = mesh.length(v, w);
  return l < shortest || l > longest ? 1 : 0;
}

// Returns whether the collapse makes, or has, a triangle with all corners on sharp lines.
bool spans_lines(const FreeMesh& mesh, std::int32_t gone, std::int32_t kept) {
  return std::ranges::any_of(mesh.mesh().fan(gone), [&](FreeMesh::Place p) {
    const auto& t = mesh.mesh().at(p);
    const bool on_lines = std::ranges::none_of(t, [&](std::int32_t w) { return w != gone && mesh.is_free(w); });
    return on_lines && (mesh.is_free(gone) || (!mesh.is_free(kept) && std::ranges::find(t, kept) == t.end()));
  });
}

}  // namespace

std::optional<double> cost_of_collapse(const FreeMesh& mesh, std::int32_t gone, std::int32_t kept,
                                       const TriangleShapes& before, const TriangleShapes& after) {
  const ShapeBudget& budget = mesh.budget;
  if (!(budget.price < infinity) || (!budget.is_limited() && !spans_lines(mesh, gone, kept))) return 0;
  TriangleShapes all = before;
  std::vector<std::int32_t> both;  // neighbours of the two ends
  for (const FreeMesh::Place p : mesh.mesh().fan(gone)) {
    const auto& t = mesh.mesh().at(p);
    if (t[0] != kept && t[1] != kept && t[2] != kept) continue;
    mesh.judge_shape(t[0], t[1], t[2], all);
    for (const std::int32_t w : t)
      if (w != gone && w != kept) both.push_back(w);
  }
  int gain = 0;
  for (const std::int32_t w : mesh.mesh().ring(gone)) {
    gain += is_out_of_range(mesh, gone, w);
    if (w != kept && std::ranges::find(both, w) == both.end()) gain -= is_out_of_range(mesh, kept, w);
  }
  const double cost = budget.cost(all, after);
  if (cost > budget.price * gain || !budget.affords(cost)) return {};
  return cost;
}

}  // namespace carreau
