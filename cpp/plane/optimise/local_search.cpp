// SPDX-License-Identifier: BSD-3-Clause
#include "plane/optimise/local_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "plane/kernel/thresholds.h"
#include "plane/optimise/zone_moves.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "support/work_bounds.h"

namespace carreau::plane {

namespace {

struct Change {
  enum class Kind : std::uint8_t { none, swap, collapse, split } kind;
  std::int32_t a, b;   // swap, split: triangle and its edge; collapse: vertex
  double promise = 0;  // cost that is left when the zone was quickly relaxed
};

// Into the neighbour that leaves the least bad triangles.
bool collapse_best(SearchZone& zone, int v) {
  Triangulation& mesh = zone.work.mesh;
  if (!zone.star.collect(mesh, v) || has_imposed_spoke(mesh, zone.star, v)) return false;
  const int into = best_collapse(zone.star, min_collapse_quality, rounding_of::sizes,
                                 [&](int p, int q, int r, bool) { return zone.shape(p, q, r); });
  if (into < 0) return false;
  collapse(mesh, zone.star, v, into);
  return true;
}

bool apply(SearchZone& zone, const Change& change) {
  switch (change.kind) {
    case Change::Kind::none:
      return true;
    case Change::Kind::swap:
      if (!zone.work.mesh.can_swap(change.a, change.b)) return false;
      zone.work.mesh.swap_edge(change.a, change.b);
      return true;
    case Change::Kind::collapse:
      return collapse_best(zone, change.a);
    case Change::Kind::split:
      zone.split(change.a, change.b);
      return true;
  }
  return false;
}

std::vector<Change> list_changes(const SearchZone& zone, int t) {
  const Triangulation& mesh = zone.work.mesh;
  std::vector<Change> changes;
  const Triangle& T = mesh.triangles[t];
  for (int i = 0; i < 3; ++i) changes.push_back({Change::Kind::swap, t, i});
  if (zone.movable.empty()) return changes;  // a strip of one layer
  changes.push_back({Change::Kind::none, 0, 0});
  for (const std::int32_t v : zone.centre)
    if (v >= zone.work.fixed) changes.push_back({Change::Kind::collapse, v, 0});
  const auto may_split = [&](int s, int i) {
    const Triangle& S = mesh.triangles[s];
    return S.n[i] != no_edge && !mesh.is_imposed(s, i) &&
           mesh.squared_length(S.v[next3[i]], S.v[prev3[i]]) > min_split2;
  };
  for (int i = 0; i < 3; ++i) {
    if (may_split(t, i)) changes.push_back({Change::Kind::split, t, i});
    if (T.n[i] == no_edge || mesh.is_imposed(t, i)) continue;
    const int s = T.n[i] >> 2, k = T.n[i] & 3;
    for (const int j : {next3[k], prev3[k]})
      if (may_split(s, j)) changes.push_back({Change::Kind::split, s, j});
  }
  return changes;
}

// The previous state of the zone, and the required cost.
struct Target {
  ZoneCost before;
  bool on_surface;

  // The sum too: a mean is made better by good triangles more, whatever becomes of the bad ones.
  [[nodiscard]] bool is_met(const ZoneCost& now, double mean) const {
    return now.mean < mean && now.sum < before.sum && now.worst >= std::min(before.worst, searched_quality) &&
           now.longest2 <= std::max(before.longest2, longest_left2) &&
           now.shortest2 >= std::min(before.shortest2, shortest_left2) && !leaves_flat_spots(now);
  }
  [[nodiscard]] bool leaves_flat_spots(const ZoneCost& now) const {
    return on_surface && (now.across > before.across || now.turn2 > before.turn2 * (1 + rounding_of::sizes) ||
                          now.turns4 > before.turns4 * (1 + rounding_of::sizes));
  }
};

void keep_most_promising(SearchZone& zone, std::vector<Change>& changes, double mean) {
  if (changes.size() <= most_promising) return;
  for (Change& change : changes) {
    change.promise = infinity;
    if (apply(zone, change)) {
      relax_zone(zone, true);
      change.promise = std::round(zone.cost_of_shapes(2 * mean).mean / mean / rounding_of::sizes);
    }
    zone.restore();
  }
  std::stable_sort(changes.begin(), changes.end(),
                   [](const Change& p, const Change& q) { return p.promise < q.promise; });
  changes.resize(most_promising);
}

// Null: none meets the target.
const Change* best_of(SearchZone& zone, const std::vector<Change>& changes, const Target& target) {
  const Change* best = nullptr;
  double least = target.before.mean * (1 - change_gain);
  for (const Change& change : changes) {
    if (apply(zone, change)) {
      relax_zone(zone, false);
      const ZoneCost now = zone.cost(least);
      if (target.is_met(now, least)) best = &change, least = now.mean * (1 - rounding_of::sizes);
    }
    zone.restore();
  }
  return best;
}

// Returns true if something around t improved.
bool improve_around(SearchZone& zone, int t, bool on_surface) {
  zone.collect(t);
  const Target target{zone.cost(infinity), on_surface};
  std::vector<Change> changes = list_changes(zone, t);
  keep_most_promising(zone, changes, target.before.mean);
  const Change* best = best_of(zone, changes, target);
  if (best == nullptr) return false;
  apply(zone, *best);
  relax_zone(zone, false);
  ZoneCost now = zone.cost(infinity);
  for (int round = 1; round < relaxing_rounds; ++round) {
    relax_zone(zone, false);
    const ZoneCost next = zone.cost(infinity);
    const bool more = next.mean < now.mean * (1 - 2 * change_gain);
    now = next;
    if (!more) break;
  }
  if (target.is_met(now, target.before.mean)) return true;
  zone.restore();
  return false;
}

// Triangles to search around, worst first, by rounded shapes.
class BadTriangles {
 public:
  BadTriangles(const PlaneWork& work, const Settled& settled) : work_(work), in_vain_(work.mesh.triangles.size(), 0) {
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(work.mesh.triangles.size()); ++t)
      if (!settled.is_fine(t)) changed_.push_back(t);
  }

  /// Lists the triangles that have changed since the last call; the others are good, or a search around them has
  /// failed.
  [[nodiscard]] std::vector<std::pair<double, std::int32_t>> list() {
    std::sort(changed_.begin(), changed_.end());
    changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
    std::vector<std::pair<double, std::int32_t>> bad;
    for (const std::int32_t t : changed_) {
      const Triangle& T = work_.mesh.triangles[t];
      if (T.v[0] < 0 || T.done == Done::frozen || in_vain_[t] != 0) continue;
      const double q = work_.shapes.quality_at_centroid(T.v[0], T.v[1], T.v[2]);
      if (q < searched_quality) bad.emplace_back(std::round(q / rounding_of::sizes), t);
    }
    std::sort(bad.begin(), bad.end());
    changed_.clear();
    return bad;
  }
  void note_search(std::int32_t t) {
    in_vain_.resize(work_.mesh.triangles.size(), 0);
    in_vain_[t] = 1;
  }
  void note_changes(std::span<const std::int32_t> triangles) {
    for (const std::int32_t t : triangles) in_vain_[t] = 0;
    changed_.insert(changed_.end(), triangles.begin(), triangles.end());
  }

 private:
  const PlaneWork& work_;
  std::vector<char> in_vain_;
  std::vector<std::int32_t> changed_;
};

}  // namespace

void search_around_bad_triangles(PlaneWork& work, const Settled& settled, const SampledNormals* normals) {
  const Triangulation& mesh = work.mesh;
  if (!mesh.bends.empty()) return;
  const auto total = static_cast<std::int64_t>(mesh.triangles.size());
  const std::int64_t budget = search_shapes + search_shapes_a_triangle * total;
  std::int64_t allowed = first_search_shapes + first_search_shapes_a_triangle * total;
  std::optional<SearchZone> made;  // most meshes need none
  BadTriangles bad(work, settled);
  for (int pass = 0; pass < work_bounds::rounds; ++pass) {
    bool any = false;
    for (const auto& [rank, t] : bad.list()) {
      SearchZone& zone = made ? *made : made.emplace(work, normals);
      if (zone.shapes_asked > std::min(budget, allowed)) return;
      work.monitor.checkpoint();
      const Triangle& T = mesh.triangles[t];
      if (T.v[0] < 0 || work.shapes.quality_at_centroid(T.v[0], T.v[1], T.v[2]) > searched_quality) continue;
      const bool better = improve_around(zone, t, normals != nullptr);
      bad.note_search(t);
      if (!better) continue;
      // Each success raises the limit. [time only]
      allowed += 12'000;
      bad.note_changes(zone.triangles);
      any = true;
    }
    if (!any) break;
  }
}

}  // namespace carreau::plane
