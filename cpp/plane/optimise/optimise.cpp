// SPDX-License-Identifier: BSD-3-Clause
#include "plane/optimise/optimise.h"

#include <numeric>
#include <utility>
#include <vector>

#include "plane/kernel/thresholds.h"
#include "plane/optimise/bad_triangles.h"
#include "plane/optimise/degree_pairs.h"
#include "plane/optimise/degrees.h"
#include "plane/optimise/delaunay_swaps.h"
#include "plane/optimise/flat_triangles.h"
#include "plane/optimise/smoothing.h"

namespace carreau::plane {

namespace {

// Shares of successive passes: long moves carry strain far, the short ones beside them remove the ripples that these
// leave. This is Chebyshev's semi-iteration, with its longest moves cut off because triangles would turn over.
constexpr double far_first[] = {1.6, 1.6}, short_last[] = {1, 0.7};
constexpr double spread[] = {1, 2.5, 1.4, 0.7}, once[] = {1};

}  // namespace

Settled optimise(PlaneWork& work, std::size_t whole) {
  swap_to_delaunay(work);
  Degrees degrees = count_degrees(work);
  swap_to_degree_six(work, degrees);
  SmoothingArrays arrays;
  const Sizes sizes = work.shapes.classify(whole);
  if (sizes == Sizes::rough) {
    const SmoothingAim aim{.pull = 0, .by_size = false};
    smooth(work, arrays, far_first, aim);
    update_metrics(work);
    smooth(work, arrays, short_last, aim);
    update_metrics(work);
  } else if (sizes == Sizes::even) {
    cancel_degree_pairs(work, degrees, pair_reach_even);
    smooth(work, arrays, spread, {.pull = pull_even, .by_size = false});
    update_metrics(work);
  } else {
    // There is more to relax. After pairs have cancelled, the vertices between them must move, and again after the
    // removals. Metrics are updated once: evaluating them in graded sizes costs as much as two passes, and gains
    // nothing before the long one.
    const SmoothingAim aim{.pull = pull_graded, .by_size = true};
    cancel_degree_pairs(work, degrees, pair_reach_graded);
    smooth(work, arrays, once, aim);
    remove_surplus_vertices(work, degrees);
    cancel_degree_pairs(work, degrees, pair_reach_graded);
    smooth_evenly(work, arrays, {.passes = 7, .slowest = 0.05}, aim);
    update_metrics(work);
    remove_crowded_vertices(work);  // smoothing improves more of the bad ones than single moves do
    work.mesh.drop_removed();
    smooth_evenly(work, arrays, {.passes = 2, .slowest = 0.5}, aim);
  }
  Settled settled = swap_to_delaunay(work);
  if (raise_flat_triangles(work, mend_bad_triangles(work, settled))) settled.of.assign(work.mesh.triangles.size(), 0);
  return settled;
}

void mend_squares(PlaneWork& work) {
  std::vector<std::int32_t> all(work.mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  raise_flat_triangles(work, std::move(all));
}

}  // namespace carreau::plane
