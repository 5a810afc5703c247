#include "plane/optimiser.h"

#include <algorithm>

namespace carreau::plane {

namespace {

// Relaxations of successive sweeps: long moves carry strain far, the short ones beside them take back the ripples that
// these leave (Chebyshev's semi-iteration, its longest moves cut off for the sake of triangles that turn over).
constexpr double far_first[] = {1.6, 1.6}, short_last[] = {1, 0.7};
constexpr double spread[] = {1, 2.5, 1.4, 0.7};
constexpr double settle[] = {1.6, 1}, spread_graded[] = {1, 4, 0.8}, spread_more[] = {1, 4, 0.8, 1.6, 0.7},
                 after_rescue[] = {0.7, 0.5};
constexpr double pull_even = 0.05, pull_graded = 0.1;
// Steps of a pair along its row.
constexpr int reach_even = 1, reach_graded = 3;

}  // namespace

Optimiser::Optimiser(Triangulation& mesh, int fixed, const Field& field, Monitor& monitor)
    : mesh_(mesh), shapes_(mesh, field), fixed_(fixed), field_(field), monitor_(monitor) {}

// By the change of the metric's determinant over a sample of the triangles: 1.3 is 7 % of the size, 4 is 40 %.
Optimiser::Sizes Optimiser::classify() const {
  constexpr std::size_t sample = 1000, fewest = 4000;  // triangles; the border decides on less
  constexpr double some_change = 1.3, rough_change = 4, rough_share = 0.004;
  const std::size_t n = mesh_.triangles.size(), step = std::max<std::size_t>(1, n / sample);
  std::size_t looked = 0, changing = 0, rough = 0;
  for (std::size_t t = 0; t < n; t += step, ++looked) {
    double low = 0, high = 0;
    for (int i = 0; i < 3; ++i) {
      const double det = determinant(mesh_.vertices[mesh_.triangles[t].v[i]].metric());
      low = i == 0 ? det : std::min(low, det), high = std::max(high, det);
    }
    changing += high > some_change * low ? 1 : 0;
    rough += high > rough_change * low ? 1 : 0;
  }
  if (n < fewest || static_cast<double>(rough) > rough_share * static_cast<double>(looked)) return Sizes::rough;
  return 2 * changing > looked ? Sizes::graded : Sizes::even;
}

void Optimiser::run() {
  swap_to_delaunay();
  swap_to_degree_six();
  const Sizes sizes = classify();
  if (sizes == Sizes::rough) {
    sweep_all(far_first, {.pull = 0, .by_size = false});
    sweep_all(short_last, {.pull = 0, .by_size = false});
  } else if (sizes == Sizes::even) {
    cancel_pairs(reach_even);
    sweep_all(spread, {.pull = pull_even, .by_size = false});
  } else {
    // Where pairs cancel, what they held apart must move: there is more to relax, and again after the rescue.
    const Aim aim{.pull = pull_graded, .by_size = true};
    cancel_pairs(reach_graded);
    sweep_all(settle, aim);
    thin_out();
    cancel_pairs(reach_graded);
    sweep_all(spread_graded, aim);
    sweep_all(spread_more, aim);
    swap_to_delaunay();
    rescue_worst();
    drop_removed();
    sweep_all(after_rescue, aim);
  }
  swap_to_delaunay();
  rescue_worst();
}

}  // namespace carreau::plane
