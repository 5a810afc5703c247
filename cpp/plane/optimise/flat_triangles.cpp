// Triangles without area. Where straight edges cannot follow the field, a vertex put on an edge that is not swapped
// leaves a triangle between the edge and its own halves, whose lengths, each by a tensor of its own, speak for it, or
// against all that could take its place. There the plane alone decides.
#include <algorithm>

#include "plane/optimise/optimiser.h"
#include "predicates/predicates.h"

namespace carreau::plane {

namespace {

// Height over the longest side. Good triangles of metrics have the inverse of the metric's ratio, of some ten thousand
// at most; points put on edges are on them but for rounding.
constexpr double flat_height = 1e-7;

}  // namespace

// Over the longest side; 0 unless counterclockwise (exactly).
double Optimiser::height(int p, int q, int r) const {
  const Vec2 P = mesh_.at(p), Q = mesh_.at(q), R = mesh_.at(r);
  if (orientation(P, Q, R) <= 0) return 0;
  const Vec2 u = Q - P, v = R - P;
  return std::max(cross(u, v), 0.0) / std::max({dot(u, u), dot(v, v), dot(v - u, v - u)});
}

bool Optimiser::is_flat(int t) const {
  const Triangle& T = mesh_.triangles[t];
  return T.v[0] >= 0 && T.done != Done::frozen && height(T.v[0], T.v[1], T.v[2]) < flat_height;
}

// By the swap that leaves the higher triangles; whether none of the two is flat.
bool Optimiser::raise_by_swap(int t) {
  const Triangle& T = mesh_.triangles[t];
  int best = -1;
  double highest = flat_height;
  for (int i = 0; i < 3; ++i) {
    if (!mesh_.can_swap(t, i)) continue;
    const int c = T.v[i], a = T.v[next3[i]], b = T.v[prev3[i]], d = mesh_.triangles[T.n[i] >> 2].v[T.n[i] & 3];
    const double lower = std::min(height(c, a, d), height(c, d, b));
    if (lower > highest) highest = lower, best = i;
  }
  if (best < 0) return false;
  mesh_.swap_edge(t, best);
  return true;
}

// Where the edge under it is imposed, or all around is flat: by drawing a vertex that moves freely into a neighbour.
bool Optimiser::raise_by_removal(int t) {
  for (const std::int32_t v : Triangle(mesh_.triangles[t]).v) {
    if (v < fixed_ || !collect_star(v) || has_imposed_spoke(v)) continue;
    const auto n = static_cast<int>(ring_.size());
    int into = -1;
    double highest = flat_height;
    for (int k = 0; k < n; ++k) {
      double lowest = 1;
      for (int j = 1; j + 1 < n && lowest > highest; ++j)
        lowest = std::min(lowest, height(ring_[k], ring_[(k + j) % n], ring_[(k + j + 1) % n]));
      if (lowest > highest) highest = lowest, into = k;
    }
    if (into < 0) continue;
    collapse(v, into);
    return true;
  }
  return false;
}

// Of the triangles that the rescue has looked at: all others are good. What is raised may let its neighbours be, too.
void Optimiser::raise_flat() {
  std::sort(doubtful_.begin(), doubtful_.end());
  doubtful_.erase(std::unique(doubtful_.begin(), doubtful_.end()), doubtful_.end());
  std::erase_if(doubtful_, [this](std::int32_t t) { return !is_flat(t); });
  bool any = true;
  while (any) {
    monitor_.checkpoint();
    any = false;
    for (const std::int32_t t : doubtful_)
      if (is_flat(t)) any = raise_by_swap(t) || raise_by_removal(t) || any;
  }
}

}  // namespace carreau::plane
