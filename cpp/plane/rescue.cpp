// A few triangles stay bad where rows met: they are attacked one by one.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/optimiser.h"

namespace carreau::plane {

namespace {

constexpr double worst_quality = 0.6;  // triangles below are attacked
constexpr int rescue_passes = 3;
constexpr double gain = 1e-4;

}  // namespace

double Optimiser::worst_around(int v) const {
  double worst = 1;
  const int start = mesh_.vertices[v].triangle;
  int t = start;
  do {
    const Triangle& T = mesh_.triangles[t];
    worst = std::min(worst, mesh_.quality(T.v[0], T.v[1], T.v[2]));
    t = T.n[next3[mesh_.corner_of(t, v)]] >> 2;
  } while (t != start);
  return worst;
}

bool Optimiser::rescue_by_swap(int t) {
  for (int i = 0; i < 3; ++i) {
    if (!mesh_.can_swap(t, i)) continue;
    const Triangle &T = mesh_.triangles[t], &U = mesh_.triangles[T.n[i] >> 2];
    const int c = T.v[i], a = T.v[next3[i]], b = T.v[prev3[i]], d = U.v[T.n[i] & 3];
    const double before = std::min(mesh_.quality(c, a, b), mesh_.quality(d, b, a));
    if (std::min(mesh_.quality(c, a, d), mesh_.quality(c, d, b)) <= before + gain) continue;
    mesh_.swap_edge(t, i);
    return true;
  }
  return false;
}

// The best of places on shrinking circles, in the metric.
bool Optimiser::rescue_by_move(int v) {
  Vertex& P = mesh_.vertices[v];
  double best = worst_around(v);
  bool any = false;
  for (double step = 0.3; step > 0.02; step *= 0.5)
    for (int direction = 0; direction < 8; ++direction) {
      const Vertex kept = P;
      const double angle = direction * std::numbers::pi / 4;
      const double p = std::sqrt(P.a), q = P.b / p, r = std::sqrt(std::max(P.c - q * q, 1e-12 * P.c));
      const double dy = step * std::sin(angle) / r, dx = (step * std::cos(angle) - q * dy) / p;
      P.x += dx, P.y += dy;
      P.set_metric(field_.at(P.point()));
      const double now = worst_around(v);
      if (now > best + gain) {
        best = now;
        any = true;
      } else {
        P = kept;
      }
    }
  return any;
}

void Optimiser::rescue_worst() {
  for (int pass = 0; pass < rescue_passes; ++pass) {
    monitor_.checkpoint();
    bool any = false;
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh_.triangles.size()); ++t) {
      const Triangle& T = mesh_.triangles[t];
      if (T.done == Done::frozen || mesh_.quality(T.v[0], T.v[1], T.v[2]) >= worst_quality) continue;
      any = rescue_by_swap(t) || any;
      for (const std::int32_t v : mesh_.triangles[t].v)
        if (v >= fixed_) any = rescue_by_move(v) || any;
    }
    if (!any) break;
  }
}

}  // namespace carreau::plane
