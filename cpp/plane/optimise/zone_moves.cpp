// SPDX-License-Identifier: BSD-3-Clause
#include "plane/optimise/zone_moves.h"

#include <algorithm>
#include <utility>

#include "plane/kernel/thresholds.h"
#include "plane/optimise/star_cost.h"
#include "support/infinity.h"
#include "support/rounding_of.h"

namespace carreau::plane {

namespace {

constexpr double steps[] = {0.15, 0.05};  // units

// Goes from the place of v to the best of six at this distance, and so on as long as that helps.
void search_at(SearchZone& zone, int v, double step, int turns) {
  Vertex& P = zone.work.mesh.vertices[v];
  const UnitCircle circle(P.metric());
  for (int turn = 0; turn < turns; ++turn) {
    const FrozenStar star(zone.work, v, zone.star.link);
    const Vec2 centre = P.point();
    double best = star.cost(Vec2(0, 0), infinity, shape_cost, zone.shapes_asked);
    bool any = false;
    for (const Vec2& d : six_directions) {
      const Vec2 by = circle.vector(step * d);
      const double now = star.cost(by, best, shape_cost, zone.shapes_asked);
      if (!(now < best * (1 - rounding_of::sizes))) continue;
      const Vec2 to = centre + by;
      best = now, P.x = to.x(), P.y = to.y(), any = true;
    }
    if (!any) break;
  }
}

// Returns the cost of the star of v, and in `worst` the triangle that costs most.
double star_cost(SearchZone& zone, int v, std::size_t& worst) {
  const std::vector<std::int32_t>& link = zone.star.link;
  double sum = 0, most = 0;
  for (std::size_t k = 0; k < link.size(); ++k) {
    const double one = shape_cost(zone.shape(v, link[k], link[k + 1 < link.size() ? k + 1 : 0]));
    sum += one;
    if (one > most) most = one, worst = k;
  }
  return sum;
}

// The best place of v, whose star is collected; its old place, if no place is better. `in_vain`: steps of the first
// length.
Vec2 best_place(SearchZone& zone, int v, bool quick, bool in_vain) {
  Vertex& P = zone.work.mesh.vertices[v];
  std::vector<std::int32_t>& link = zone.star.link;
  const Vertex old = P;
  std::size_t worst = 0;
  const double before = star_cost(zone, v, worst);
  if (before < static_cast<double>(link.size()) * cheap_enough) return old.point();
  // The worst triangle is evaluated first: most moves need no more.
  std::rotate(link.begin(), link.begin() + static_cast<std::ptrdiff_t>(worst), link.end());
  for (const double step : steps) {
    if (in_vain && step == steps[0]) continue;
    search_at(zone, v, step, quick ? 1 : turns_a_step);
    if (quick) break;
  }
  const Vec2 found = P.point();
  if (found == old.point()) return found;
  const PlaceKey place = std::exchange(zone.places[v], key_of_place(found));
  const bool better = star_cost(zone, v, worst) < before;
  P = old, zone.places[v] = place;
  return better ? found : old.point();
}

// Returns whether v has moved.
bool move(SearchZone& zone, int v, bool quick) {
  const Triangulation& mesh = zone.work.mesh;
  if (mesh.vertices[v].triangle < 0 || !zone.star.collect(mesh, v)) return false;
  const Vec2 from = mesh.at(v);
  const PlaceKey star = key_of_star(v, zone.star.link, [&](int u) { return zone.places[u]; });
  const PlaceKey key = quick ? star : star + 1;
  Vec2 to{};
  if (const Vec2* known = zone.known_moves.find(key)) {
    to = *known;
  } else {
    const Vec2* quickly = quick ? nullptr : zone.known_moves.find(star);
    to = best_place(zone, v, quick, quickly != nullptr && *quickly == from);
    zone.known_moves.put(key, to);
  }
  if (to == from) return false;
  zone.place(v, to);
  return true;
}

// True if the diagonal ab of the quadrilateral c a d b, edge i of t, costs less after a swap.
bool wants_swap(SearchZone& zone, int t, int i, int d) {
  const Triangle& T = zone.work.mesh.triangles[t];
  const int c = T.v[i], a = T.v[next3[i]], b = T.v[prev3[i]];
  const PlaceKey key = key_of_diagonal(zone.places[c], zone.places[a], zone.places[b], zone.places[d]);
  if (const bool* known = zone.known_swaps.find(key)) return *known;
  bool swaps = false;
  if (zone.work.mesh.can_swap(t, i)) {
    const double before = (shape_cost(zone.shape(c, a, b)) + shape_cost(zone.shape(d, b, a))) * (1 - rounding_of::sizes);
    const double after = shape_cost(zone.shape(c, a, d));
    swaps = after < before && after + shape_cost(zone.shape(c, d, b)) < before;
  }
  zone.known_swaps.put(key, swaps);
  return swaps;
}

// Returns whether an edge was swapped.
bool swap(SearchZone& zone) {
  Triangulation& mesh = zone.work.mesh;
  bool any = false;
  for (const std::int32_t t : zone.triangles) mesh.triangles[t].mark = 1;
  for (const std::int32_t t : zone.triangles)
    for (int i = 0; i < 3; ++i) {
      const Triangle& T = mesh.triangles[t];
      if (T.v[0] < 0 || T.n[i] == no_edge || mesh.is_imposed(t, i)) continue;
      const Triangle& U = mesh.triangles[T.n[i] >> 2];
      if (U.mark != 0 && wants_swap(zone, t, i, U.v[T.n[i] & 3])) mesh.swap_edge(t, i), any = true;
    }
  for (const std::int32_t t : zone.triangles) mesh.triangles[t].mark = 0;
  return any;
}

}  // namespace

void relax_zone(SearchZone& zone, bool quick) {
  bool changed = swap(zone);
  for (const std::int32_t v : zone.movable) changed = move(zone, v, quick) || changed;
  if (!quick && changed) swap(zone);
}

}  // namespace carreau::plane
