// SPDX-License-Identifier: BSD-3-Clause
// Moves of all vertices at once, each some of the way to the places at which its triangles would be equilateral.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plane/kernel/plane_work.h"

namespace carreau::plane {

/// The aim of moves.
struct SmoothingAim {
  double pull;   ///< 0: equilateral triangles; 1: unit lengths
  bool by_size;  ///< triangles are weighted by the inverse of the prescribed size
};

/// Passes that damp waves of the mesh evenly: all waves for which one pass returns `slowest` or more of the lack.
struct EvenDamping {
  int passes;
  double slowest;
};

/// Scratch, kept from one call to the next.
struct SmoothingArrays {
  /// For each triangle: the mean of its corners' metrics, scaled so that it turns a base into the height of the
  /// equilateral triangle on it. Also the weight of proposals, whose square is the root of the determinant of the sum
  /// of these metrics. In single precision, as vertices have them: passes read all of it time and again.
  struct Steady {
    float a, b, c, weight;
  };
  std::vector<Steady> steady;                 // if triangles count by size
  std::vector<double> heights;                // elsewhere: of equilateral triangles, over their bases
  std::vector<Vec2> proposals;                // by vertex, weighted and summed up
  std::vector<double> weights;                // their sums: exact, or places would shift by a share of the box
  std::vector<Vec2> before;                   // places before the last pass
  std::vector<std::int32_t> spoiled, undone;  // triangles spoiled by moves; vertices whose moves were taken back
};

/// One pass for each of `shares`, the share of the way that vertices go. Metrics stay as they are.
void smooth(PlaneWork& work, SmoothingArrays& arrays, std::span<const double> shares, SmoothingAim aim);

/// Passes with the shares and momenta of Chebyshev's iteration of second order. Metrics stay as they are.
void smooth_evenly(PlaneWork& work, SmoothingArrays& arrays, EvenDamping damping, SmoothingAim aim);

/// Asks the field again at all vertices that may have moved.
void update_metrics(PlaneWork& work);

}  // namespace carreau::plane
