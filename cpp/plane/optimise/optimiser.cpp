#include "plane/optimise/optimiser.h"

namespace carreau::plane {

namespace {

// Relaxations of successive sweeps: long moves carry strain far, the short ones beside them take back the ripples that
// these leave (Chebyshev's semi-iteration, its longest moves cut off for the sake of triangles that turn over).
constexpr double far_first[] = {1.6, 1.6}, short_last[] = {1, 0.7};
constexpr double spread[] = {1, 2.5, 1.4, 0.7}, settle[] = {1};
constexpr double pull_even = 0.05, pull_graded = 0.1;
// Steps of a pair along its row.
constexpr int reach_even = 1, reach_graded = 3;

}  // namespace

Optimiser::Optimiser(Triangulation& mesh, int fixed, const Field& field, Monitor& monitor)
    : mesh_(mesh), shapes_(mesh, field), fixed_(fixed), field_(field), monitor_(monitor) {}

void Optimiser::run() {
  swap_to_delaunay();
  swap_to_degree_six();
  const Sizes sizes = shapes_.classify();
  if (sizes == Sizes::rough) {
    sweep_all(far_first, {.pull = 0, .by_size = false});
    update_metrics();
    sweep_all(short_last, {.pull = 0, .by_size = false});
    update_metrics();
  } else if (sizes == Sizes::even) {
    cancel_pairs(reach_even);
    sweep_all(spread, {.pull = pull_even, .by_size = false});
    update_metrics();
  } else {
    // There is more to relax. Where pairs cancel, what they held apart must move, and again after the rescue. Metrics
    // follow once: to ask where sizes change costs as much as two sweeps, and gains nothing before the long one.
    const Aim aim{.pull = pull_graded, .by_size = true};
    cancel_pairs(reach_graded);
    sweep_all(settle, aim);
    thin_out();
    cancel_pairs(reach_graded);
    relax({.sweeps = 7, .slowest = 0.05}, aim);
    update_metrics();            // the others move little
    rescue_all(Needy::crowded);  // sweeps mend more of the others than single moves do
    drop_removed();
    relax({.sweeps = 2, .slowest = 0.5}, aim);
  }
  swap_to_delaunay();
  rescue_worst();
}

}  // namespace carreau::plane
