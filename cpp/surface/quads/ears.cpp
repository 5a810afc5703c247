// SPDX-License-Identifier: BSD-3-Clause
#include "surface/quads/ears.h"

#include <algorithm>
#include <array>

#include "surface/quads/quad_shape.h"

namespace carreau {

namespace {

// The corner whose sides go on smoothly into each other; -1: none.
int flat_corner(const QuadPatch& patch, const MixedCell& t) {
  if (patch.fixed[t[0]] == 0 || patch.fixed[t[1]] == 0 || patch.fixed[t[2]] == 0) return -1;  // those on curves are
  for (int k = 0; k < 3; ++k)
    if (std::binary_search(patch.flat.begin(), patch.flat.end(), std::array{t[k], t[(k + 1) % 3], t[(k + 2) % 3]}))
      return k;
  return -1;
}

// The vertex of a triangle beyond its side from a to b; -1: it has no such side.
std::int32_t apex(const MixedCell& t, std::int32_t a, std::int32_t b) {
  for (int k = 0; k < 3; ++k)
    if (t[k] == a && t[(k + 1) % 3] == b) return t[(k + 2) % 3];
  return -1;
}

bool turn_ear(FaceQuads& quads, MixedCell& ear, int corner) {
  const std::int32_t v = ear[corner], a = ear[(corner + 1) % 3], b = ear[(corner + 2) % 3];
  if (quads.side_between(a, b) != nullptr) return false;
  for (MixedCell& other : quads.patch.cells) {
    const std::int32_t c = apex(other, b, a);
    if (c < 0) continue;
    const MixedCell left{v, a, c, -1}, right{v, c, b, -1};
    if (!is_convex(quads.patch, left) || !is_convex(quads.patch, right)) return false;
    ear = left, other = right;
    return true;
  }
  return false;
}

}  // namespace

std::size_t turn_ears(FaceQuads& quads) {
  std::size_t count = 0;
  if (quads.patch.flat.empty()) return count;
  for (MixedCell& cell : quads.patch.cells)
    if (const int k = flat_corner(quads.patch, cell); k >= 0 && turn_ear(quads, cell, k)) ++count;
  return count;
}

}  // namespace carreau
