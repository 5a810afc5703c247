// Single bad triangles that no single change mends: each change around them is tried with the moves and swaps that make
// room for it, worst triangles first, and the best one is kept.
#include <algorithm>
#include <cmath>
#include <limits>

#include "plane/optimise/optimiser.h"

namespace carreau::plane {

namespace {

// Triangles of a better shape are left alone: to try those below .92 costs twice as much and raises no worst one.
constexpr double tried_quality = 0.88;
constexpr int most_passes = 8;
// Work, counted by shapes, is bounded by a multiple of the mesh.
constexpr std::int64_t least_shapes = 16'000, shapes_a_triangle = 48;
// Where nothing helps, strips between fixed borders, there is an end sooner.
constexpr std::int64_t first_shapes = 2'400, first_shapes_a_triangle = 4, shapes_a_success = 12'000;
// Of the mean penalty of a neighbourhood.
constexpr double trial_gain = 0.01, settled_gain = 0.02;
constexpr int settling_rounds = 4;
// Cost of a triangle of Q2 .97: vertices amid such ones need not move.
constexpr double good_enough = 0.2;
// Trials that promise most are followed through.
constexpr std::size_t most_promising = 5;
// Squared lengths of the edges that a trial leaves, unless some were longer or shorter before.
constexpr double longest_left2 = 2.4, shortest_left2 = 0.4;
constexpr double least_split2 = 1.1;  // squared length of an edge that is split
// Square of the turn of the surface along an edge, as a chord of unit normals, that leaves no flat spot: 20 degrees.
constexpr double least_turn2 = 0.12;
constexpr double steps[] = {0.15, 0.05};
// What is better by less than this share is no better: where meshes are symmetric, the last bits of a host's numbers
// would decide.
constexpr double tie = 1e-6;

// The worst weigh most: 2.8 at .8, 0.36 at .95. Equilateral triangles cost nothing.
double cost(double quality) noexcept {
  if (!(quality > 0)) return std::numeric_limits<double>::infinity();
  const double inverse2 = 1 / (quality * quality);
  return inverse2 * inverse2 * inverse2 - 1;
}

}  // namespace

template <typename Use>
void Optimiser::for_star(int v, const Use& use) const {
  const int start = mesh_.vertices[v].triangle;
  int t = start;
  do {  // counterclockwise, until round or at the border
    use(t);
    const HalfEdge after = mesh_.triangles[t].n[next3[mesh_.corner_of(t, v)]];
    if (after == no_edge) break;
    t = after >> 2;
    if (t == start) return;
  } while (true);
  for (t = start;;) {
    const HalfEdge before = mesh_.triangles[t].n[prev3[mesh_.corner_of(t, v)]];
    if (before == no_edge) return;
    t = before >> 2;
    use(t);
  }
}

// The triangles around the corners of t and around their neighbours, and what else a change of these touches.
void Optimiser::collect_zone(int t) {
  Zone& z = zone_;
  z.triangles.clear(), z.movable.clear(), z.as_they_were.clear(), z.old_vertices.clear();
  z.centre = {mesh_.triangles[t].v[0], mesh_.triangles[t].v[1], mesh_.triangles[t].v[2]};
  z.seen.resize(mesh_.vertices.size(), 0);
  std::vector<std::int32_t>& known = z.vertices;
  known.assign(z.centre.begin(), z.centre.end());
  for (const std::int32_t v : known) z.seen[v] = 1;
  std::size_t done = 0;
  for (int ring = 0; ring < 2; ++ring) {
    const std::size_t end = known.size();
    for (; done < end; ++done) {
      if (known[done] >= fixed_) z.movable.push_back(known[done]);
      for_star(known[done], [&](int s) {
        Triangle& S = mesh_.triangles[s];
        if (S.mark != 0) return;
        S.mark = 1;
        z.triangles.push_back(s);
        for (const std::int32_t w : S.v)
          if (z.seen[w] == 0) z.seen[w] = 1, known.push_back(w);
      });
    }
  }
  for (const std::int32_t v : known) z.old_vertices.emplace_back(v, mesh_.vertices[v]), z.seen[v] = 0;
  for (const std::int32_t s : z.triangles) mesh_.triangles[s].mark = 0;
  for (const std::int32_t s : z.triangles) z.as_they_were.emplace_back(s, mesh_.triangles[s]);
  for (const std::int32_t s : z.triangles)
    for (const HalfEdge n : mesh_.triangles[s].n)
      if (n != no_edge) z.as_they_were.emplace_back(n >> 2, mesh_.triangles[n >> 2]);
  z.mesh_triangles = mesh_.triangles.size(), z.mesh_vertices = mesh_.vertices.size();
  z.own = z.triangles.size(), z.own_movable = z.movable.size();
}

void Optimiser::restore_zone() {
  Zone& z = zone_;
  mesh_.triangles.resize(z.mesh_triangles);
  mesh_.vertices.resize(z.mesh_vertices);
  for (const auto& [t, T] : z.as_they_were) mesh_.triangles[t] = T;
  places_.resize(z.mesh_vertices);
  for (const auto& [v, V] : z.old_vertices) mesh_.vertices[v] = V, places_[v] = key_of_place(V.point());
  z.triangles.resize(z.own);
  z.movable.resize(z.own_movable);
  next_.clear();  // what collapse() tells the rescue
}

// Once its mean is `enough` the rest does not matter.
Optimiser::ZoneCost Optimiser::cost_of_zone(double enough) {
  ZoneCost all;
  double sum = 0;
  int count = 0;
  for (const std::int32_t t : zone_.triangles)
    if (mesh_.triangles[t].v[0] >= 0 && mesh_.triangles[t].done != Done::frozen) ++count;
  const double most = enough * count;
  for (const std::int32_t t : zone_.triangles) {
    const Triangle& T = mesh_.triangles[t];
    if (T.v[0] < 0 || T.done == Done::frozen) continue;
    const double q = known_shape(T.v[0], T.v[1], T.v[2]);
    sum += cost(q);
    if (sum > most) break;
    all.worst = std::min(all.worst, q);
    for (int i = 0; i < 3; ++i) {
      if (mesh_.is_imposed(t, i)) continue;
      const std::int32_t a = T.v[next3[i]], b = T.v[prev3[i]];
      all.across += a < fixed_ && b < fixed_ ? 1 : 0;
      const double l2 = mesh_.squared_length(a, b);
      all.shortest2 = std::min(all.shortest2, l2), all.longest2 = std::max(all.longest2, l2);
      if (normals_ == nullptr) continue;
      const Vec3 turn = known_normal(a) - known_normal(b);
      const double turn2 = std::max(dot(turn, turn), least_turn2);
      all.turn2 = std::max(all.turn2, turn2), all.turns4 += turn2 * turn2 - least_turn2 * least_turn2;
    }
  }
  all.mean = count > 0 ? sum / count : 0, all.sum = sum;
  return all;
}

double Optimiser::known_shape(int p, int q, int r) {
  const PlaceKey key = key_of_triangle(places_[p], places_[q], places_[r]);
  if (const double* known = known_shapes_.find(key)) return *known;
  ++shapes_asked_;
  const double found = shape(p, q, r);
  known_shapes_.put(key, found);
  return found;
}

Vec3 Optimiser::known_normal(int v) {
  if (const Vec3* known = known_normals_.find(places_[v])) return *known;
  const Vec3 found = normals_->at(field_.outward(mesh_.at(v)));
  known_normals_.put(places_[v], found);
  return found;
}

double Optimiser::star_cost(int v, double enough) { return star_sum(v, enough, cost); }

void Optimiser::place(int v, Vec2 p) {
  Vertex& P = mesh_.vertices[v];
  P.x = p.x(), P.y = p.y();
  P.set_metric(field_.at(p));
  places_[v] = key_of_place(p);
}

// Where move_in_zone() finds the star of v, which is collected, to be best; its old place, if no other is better.
// `settled`: steps of the first length lead nowhere.
Vec2 Optimiser::best_place(int v, bool quick, bool settled) {
  Vertex& P = mesh_.vertices[v];
  const Vertex old = P;
  double best = 0, most = 0;
  std::size_t worst = 0;
  const std::size_t n = ring_.size();
  for (std::size_t k = 0; k < n; ++k) {
    const double one = cost(known_shape(v, ring_[k], ring_[k + 1 < n ? k + 1 : 0]));
    best += one;
    if (one > most) most = one, worst = k;
  }
  if (best < static_cast<double>(n) * good_enough) return old.point();
  // What is worst is asked first: most moves need no more.
  std::rotate(ring_.begin(), ring_.begin() + static_cast<std::ptrdiff_t>(worst), ring_.end());
  for (const double step : steps) {
    if (settled && step == steps[0]) continue;
    for (int turn = 0; turn < (quick ? 1 : 3); ++turn) {
      const UnitCircle circle(P.metric());
      const Vec2 centre = P.point();
      bool any = false;
      for (const Vec2& d : six_directions) {
        const Vec2 kept = P.point(), to = centre + circle.vector(step * d);
        P.x = to.x(), P.y = to.y();
        const double now = star_cost(v, best);
        if (now < best * (1 - tie))
          best = now, any = true;
        else
          P.x = kept.x(), P.y = kept.y();
      }
      if (!any) break;
    }
    if (quick) break;
  }
  const Vec2 found = P.point();
  P = old;
  return found;
}

void Optimiser::move_in_zone(int v, bool quick) {
  if (mesh_.vertices[v].triangle < 0 || !collect_star(v)) return;
  const Vec2 from = mesh_.at(v);
  const PlaceKey star = key_of_star(v, [this](int u) { return places_[u]; });
  const PlaceKey key = quick ? star : star + 1;
  Vec2 to{};
  if (const Vec2* known = known_moves_.find(key)) {
    to = *known;
  } else {
    const Vec2* quickly = quick ? nullptr : known_moves_.find(star);
    to = best_place(v, quick, quickly != nullptr && *quickly == from);
    known_moves_.put(key, to);
  }
  if (to != from) place(v, to);
}

void Optimiser::swap_in_zone() {
  for (const std::int32_t t : zone_.triangles) mesh_.triangles[t].mark = 1;
  for (const std::int32_t t : zone_.triangles)
    for (int i = 0; i < 3; ++i) {
      const Triangle& T = mesh_.triangles[t];
      if (T.v[0] < 0 || T.n[i] == no_edge || mesh_.is_imposed(t, i)) continue;
      const Triangle& U = mesh_.triangles[T.n[i] >> 2];
      if (U.mark == 0) continue;
      const int c = T.v[i], a = T.v[next3[i]], b = T.v[prev3[i]], d = U.v[T.n[i] & 3];
      const PlaceKey key = key_of_diagonal(places_[c], places_[a], places_[b], places_[d]);
      const bool* known = known_swaps_.find(key);
      bool swaps = known != nullptr && *known;
      if (known == nullptr) {
        if (mesh_.can_swap(t, i)) {
          const double before = (cost(known_shape(c, a, b)) + cost(known_shape(d, b, a))) * (1 - tie);
          const double after = cost(known_shape(c, a, d));
          swaps = after < before && after + cost(known_shape(c, d, b)) < before;
        }
        known_swaps_.put(key, swaps);
      }
      if (swaps) mesh_.swap_edge(t, i);
    }
  for (const std::int32_t t : zone_.triangles) mesh_.triangles[t].mark = 0;
}

// Moves and swaps. Quickly: to see what a trial promises.
void Optimiser::settle_zone(bool quick) {
  swap_in_zone();
  for (const std::int32_t v : zone_.movable) move_in_zone(v, quick);
  if (!quick) swap_in_zone();
}

// A vertex amid edge i of t, which is not imposed: two triangles become four.
void Optimiser::split_edge(int t, int i) {
  const Triangle T = mesh_.triangles[t], U = mesh_.triangles[T.n[i] >> 2];
  const int u = T.n[i] >> 2, j = T.n[i] & 3;
  const int c = T.v[i], a = T.v[next3[i]], b = T.v[prev3[i]], d = U.v[j];
  const auto m = static_cast<std::int32_t>(mesh_.vertices.size());
  const auto t2 = static_cast<std::int32_t>(mesh_.triangles.size()), u2 = t2 + 1;
  const Vec2 p = 0.5 * (mesh_.at(a) + mesh_.at(b));
  mesh_.vertices.push_back({p.x(), p.y()});
  mesh_.vertices.back().triangle = t;
  shapes_.set_metric(m);
  places_.push_back(key_of_place(p));
  // Edge 0 of each of the four is a half of the edge.
  const auto make = [&](int place, const Triangle& from, std::array<std::int32_t, 3> v, std::array<HalfEdge, 3> n,
                        int outer, int source) {
    Triangle& K = mesh_.triangles[place];
    K = {};
    K.done = from.done;
    for (int k = 0; k < 3; ++k) K.v[k] = v[k], K.n[k] = n[k];
    K.imposed = static_cast<std::uint8_t>((from.imposed >> source & 1U) << outer);
    K.degenerate = static_cast<std::uint8_t>((from.degenerate >> source & 1U) << outer);
    if (n[outer] != no_edge) mesh_.triangles[n[outer] >> 2].n[n[outer] & 3] = 4 * place + outer;
    for (const std::int32_t w : v) mesh_.vertices[w].triangle = place;
  };
  mesh_.triangles.resize(mesh_.triangles.size() + 2);
  make(t, T, {c, a, m}, {4 * u, 4 * t2 + 2, T.n[prev3[i]]}, 2, prev3[i]);
  make(t2, T, {c, m, b}, {4 * u2, T.n[next3[i]], 4 * t + 1}, 1, next3[i]);
  make(u, U, {d, m, a}, {4 * t, U.n[next3[j]], 4 * u2 + 1}, 1, next3[j]);
  make(u2, U, {d, b, m}, {4 * t2, 4 * u + 2, U.n[prev3[j]]}, 2, prev3[j]);
  zone_.triangles.push_back(t2), zone_.triangles.push_back(u2);
  zone_.movable.push_back(m);
}

// Into the neighbour that leaves the least bad triangles.
bool Optimiser::collapse_in_zone(int v) {
  if (!collect_star(v) || has_imposed_spoke(v)) return false;
  const auto n = static_cast<int>(ring_.size());
  int into = -1;
  double best = 0.05;
  for (int k = 0; k < n; ++k) {
    double least = 1;
    for (int j = 1; j + 1 < n && least > best; ++j)
      least = std::min(least, known_shape(ring_[k], ring_[(k + j) % n], ring_[(k + j + 1) % n]));
    if (least > best * (1 + tie)) best = least, into = k;
  }
  if (into < 0) return false;
  collapse(v, into);
  return true;
}

bool Optimiser::apply(const Trial& trial) {
  switch (trial.kind) {
    case Trial::Kind::settle:
      return true;
    case Trial::Kind::swap:
      if (!mesh_.can_swap(trial.a, trial.b)) return false;
      mesh_.swap_edge(trial.a, trial.b);
      return true;
    case Trial::Kind::collapse:
      return collapse_in_zone(trial.a);
    case Trial::Kind::split:
      split_edge(trial.a, trial.b);
      return true;
  }
  return false;
}

void Optimiser::list_trials(int t) {
  trials_.clear();
  const Triangle& T = mesh_.triangles[t];
  for (int i = 0; i < 3; ++i) trials_.push_back({Trial::Kind::swap, t, i, 0});
  if (zone_.movable.empty()) return;  // a strip of one layer
  trials_.push_back({Trial::Kind::settle, 0, 0, 0});
  for (const std::int32_t v : zone_.centre)
    if (v >= fixed_) trials_.push_back({Trial::Kind::collapse, v, 0, 0});
  const auto may_split = [&](int s, int i) {
    const Triangle& S = mesh_.triangles[s];
    return S.n[i] != no_edge && !mesh_.is_imposed(s, i) &&
           mesh_.squared_length(S.v[next3[i]], S.v[prev3[i]]) > least_split2;
  };
  for (int i = 0; i < 3; ++i) {
    if (may_split(t, i)) trials_.push_back({Trial::Kind::split, t, i, 0});
    if (T.n[i] == no_edge || mesh_.is_imposed(t, i)) continue;
    const int s = T.n[i] >> 2, k = T.n[i] & 3;
    for (const int j : {next3[k], prev3[k]})
      if (may_split(s, j)) trials_.push_back({Trial::Kind::split, s, j, 0});
  }
}

// Whether something was changed for the better around t.
bool Optimiser::improve_around(int t) {
  collect_zone(t);
  const ZoneCost before = cost_of_zone(std::numeric_limits<double>::infinity());
  const double longest2 = std::max(before.longest2, longest_left2);
  const double shortest2 = std::min(before.shortest2, shortest_left2);
  const auto leaves_flat_spots = [&](const ZoneCost& now) {
    return normals_ != nullptr && (now.across > before.across || now.turn2 > before.turn2 * (1 + tie) ||
                                   now.turns4 > before.turns4 * (1 + tie));
  };
  // The sum too: a mean is made better by good triangles more, whatever becomes of the bad ones.
  const auto is_better = [&](const ZoneCost& now, double than) {
    return now.mean < than && now.sum < before.sum && now.worst >= std::min(before.worst, tried_quality) &&
           now.longest2 <= longest2 && now.shortest2 >= shortest2 && !leaves_flat_spots(now);
  };
  list_trials(t);
  if (trials_.size() > most_promising) {
    for (Trial& trial : trials_) {
      trial.promise = std::numeric_limits<double>::infinity();
      if (apply(trial)) {
        settle_zone(true);
        trial.promise = std::round(cost_of_zone(2 * before.mean).mean / before.mean / tie);
      }
      restore_zone();
    }
    std::stable_sort(trials_.begin(), trials_.end(),
                     [](const Trial& p, const Trial& q) { return p.promise < q.promise; });
    trials_.resize(most_promising);
  }
  const Trial* best = nullptr;
  double least = before.mean * (1 - trial_gain);
  for (const Trial& trial : trials_) {
    if (apply(trial)) {
      settle_zone(false);
      const ZoneCost now = cost_of_zone(least);
      if (is_better(now, least)) best = &trial, least = now.mean * (1 - tie);
    }
    restore_zone();
  }
  if (best == nullptr) return false;
  apply(*best);
  settle_zone(false);
  ZoneCost now = cost_of_zone(std::numeric_limits<double>::infinity());
  for (int round = 1; round < settling_rounds; ++round) {
    settle_zone(false);
    const ZoneCost next = cost_of_zone(std::numeric_limits<double>::infinity());
    const bool more = next.mean < now.mean * (1 - settled_gain);
    now = next;
    if (!more) break;
  }
  if (is_better(now, before.mean)) return true;
  restore_zone();
  return false;
}

void Optimiser::improve_worst(const SampledNormals* normals) {
  if (!mesh_.bends.empty()) return;
  normals_ = normals;
  const auto total = static_cast<std::int64_t>(mesh_.triangles.size());
  const std::int64_t budget = least_shapes + shapes_a_triangle * total;
  std::int64_t allowed = first_shapes + first_shapes_a_triangle * total;
  shapes_asked_ = 0;
  places_.clear();
  for (const Vertex& V : mesh_.vertices) places_.push_back(key_of_place(V.point()));
  known_shapes_.open(), known_moves_.open(), known_swaps_.open(), known_normals_.open();
  std::vector<char> in_vain(mesh_.triangles.size(), 0);
  std::vector<std::pair<double, std::int32_t>> bad;
  for (int pass = 0; pass < most_passes; ++pass) {
    bad.clear();
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh_.triangles.size()); ++t) {
      const Triangle& T = mesh_.triangles[t];
      if (T.v[0] < 0 || T.done == Done::frozen || in_vain[t] != 0) continue;
      const double q = shape(T.v[0], T.v[1], T.v[2]);
      if (q < tried_quality) bad.emplace_back(std::round(q / tie), t);
    }
    std::sort(bad.begin(), bad.end());
    bool any = false;
    for (const auto& [rank, t] : bad) {
      if (shapes_asked_ > std::min(budget, allowed)) return;
      monitor_.checkpoint();
      const Triangle& T = mesh_.triangles[t];
      if (T.v[0] < 0 || shape(T.v[0], T.v[1], T.v[2]) > tried_quality) continue;
      const bool better = improve_around(t);
      in_vain.resize(mesh_.triangles.size(), 0);
      in_vain[t] = 1;
      if (!better) continue;
      allowed += shapes_a_success;
      for (const std::int32_t s : zone_.triangles) in_vain[s] = 0;
      any = true;
    }
    if (!any) break;
  }
}

}  // namespace carreau::plane
