// SPDX-License-Identifier: BSD-3-Clause
// Length of a segment in a field of metrics.
#pragma once

#include "metric/metric2.h"

namespace carreau {

/// Length of the segment (p, q) in the field `at` (Vec2 to Metric2): trapezoids, halved until none is longer than `lss`
/// (RR-2818 sec. 4.4; LSS of RT-0232 sec. 3.3, default 0.5). Halves at least once, unlike there, because both ends may
/// agree by symmetry if the middle does not. At most `depth` halvings. Allocates no memory.
template <typename Field>
double field_length(const Field& at, const Vec2& p, const Vec2& q, double lss = 0.5, int depth = 20) {
  const Vec2 d = q - p;
  const auto speed = [&](double t) { return length(at(lerp(p, q, t)), d); };
  struct FieldPiece {
    double start, width, end_speed;
  };
  // Left to right; the remaining pieces lie on the right, each at most as wide as the next: depth entries suffice.
  FieldPiece todo[64];
  depth = depth < 1 ? 1 : (depth > 60 ? 60 : depth);
  double narrowest = 1;
  for (int k = 0; k < depth; ++k) narrowest *= 0.5;
  int size = 0;
  double total = 0, left = speed(0);
  todo[size++] = {0, 1, speed(1)};
  while (size > 0) {
    const FieldPiece piece = todo[--size];
    const double trapezoid = piece.width * 0.5 * (left + piece.end_speed);
    if (piece.width < 1 && (trapezoid <= lss || piece.width <= narrowest)) {
      total += trapezoid;
      left = piece.end_speed;
      continue;
    }
    const double half = 0.5 * piece.width;
    todo[size++] = {piece.start + half, half, piece.end_speed};
    todo[size++] = {piece.start, half, speed(piece.start + half)};
  }
  return total;
}

}  // namespace carreau
