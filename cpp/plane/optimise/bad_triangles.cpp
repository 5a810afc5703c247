// The last pass: bad triangles, left where rows met or where sizes jump, are attacked one by one, with moves, swaps and
// removals of vertices that each make what they touch better.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "plane/optimise/optimiser.h"
#include "predicates/predicates.h"

namespace carreau::plane {

namespace {

constexpr double bad_quality = 0.8;
constexpr double suspect_quality = 0.85;  // in the mean metric of the vertices, which are at hand
constexpr double refine_quality = 0.45;   // below, shape goes before size
// Where the field bends, straight triangles have less area than their lengths say; half of it is well enough.
constexpr double straight_weight = 2 * 2 * std::numbers::sqrt3;
constexpr double look_again_quality = 0.7;  // of bent triangles, from which on their edges are integrated
constexpr int rescue_passes = 6;
constexpr double gain = 1e-3;
// Work is bounded by a multiple of the mesh: a boundary without any relation to the sizes leaves nothing but bad
// triangles. It is counted by shapes, since a fine boundary far from all other vertices gives stars of thousands; the
// least is a few tenths of a second.
constexpr std::int64_t shapes_a_triangle = 24, least_shapes = 4'000'000;
constexpr int triangles_between_checks = 1 << 16, shapes_between_checks = 1 << 15;
constexpr double short_edge_height = 0.9;       // of a vertex inserted over a short edge, in lengths of the edge
constexpr double longest_after_removal2 = 2.0;  // squared length
// Sizes that change much over a triangle leave edges that are too short: one of their vertices goes where no edge
// becomes too long and no triangle bad.
constexpr double crowded_length2 = 0.52, longest_crowded2 = 2.1, crowded_quality = 0.6;

// What moves make small: bad triangles weigh much; one that is turned over outweighs everything.
double penalty(double quality) noexcept {
  return quality > 0 ? 1 / (quality * quality) : std::numeric_limits<double>::infinity();
}

}  // namespace

// Q2 (HDR eq. 1.6) in the metric at the centroid: where sizes or the parametrisation change much over a triangle, its
// shape in space is that of the middle. 0 unless counterclockwise (exactly).
double Optimiser::shape(int p, int q, int r) const {
  const Vec2 P = mesh_.at(p), Q = mesh_.at(q), R = mesh_.at(r);
  if (orientation(P, Q, R) <= 0) return 0;
  const Metric2 m = field_.at((1.0 / 3) * (P + Q + R));
  const Vec2 u = Q - P, v = R - P;
  const double area = cross(u, v) * std::sqrt(std::max(determinant(m), 0.0));
  if (mesh_.is_bent(p, q, r)) {
    const auto shape_of = [&](const Lengths& l) {
      return std::min(l.quality(), straight_weight * area / (l.a + l.b + l.c));
    };
    const double roughly = shape_of(shapes_.lengths(p, q, r));
    // The tensor halfway says little of long edges that leave a thin layer and come back, or cross it.
    return roughly < look_again_quality ? shape_of(integrated_lengths(p, q, r)) : roughly;
  }
  return 2 * std::numbers::sqrt3 * area / (squared_length(m, u) + squared_length(m, v) + squared_length(m, u - v));
}

// By two points of Gauss on each edge.
Lengths Optimiser::integrated_lengths(int p, int q, int r) const {
  constexpr double first = 0.2113248654051871;
  const auto squared = [&](int a, int b) {
    const Vec2 A = mesh_.at(a), B = mesh_.at(b);
    const double one = carreau::squared_length(field_.at(lerp(A, B, first)), B - A);
    const double two = carreau::squared_length(field_.at(lerp(B, A, first)), B - A);
    return 0.25 * (one + two) + 0.5 * std::sqrt(one * two);
  };
  return {squared(q, r), squared(r, p), squared(p, q)};
}

bool Optimiser::collect_star(int v) {
  star_.clear();
  ring_.clear();
  const int start = mesh_.vertices[v].triangle;
  int t = start;
  do {
    const Triangle& T = mesh_.triangles[t];
    const int k = mesh_.corner_of(t, v);
    star_.push_back(t);
    ring_.push_back(T.v[next3[k]]);
    if (T.n[next3[k]] == no_edge) return false;
    t = T.n[next3[k]] >> 2;
  } while (t != start);
  return true;
}

// Of the star collected.
bool Optimiser::has_imposed_spoke(int v) const {
  return std::any_of(star_.begin(), star_.end(), [&](std::int32_t t) {
    return mesh_.triangles[t].imposed != 0 && mesh_.is_imposed(t, next3[mesh_.corner_of(t, v)]);
  });
}

double Optimiser::star_penalty(int v, double enough) { return star_sum(v, enough, penalty); }

bool Optimiser::rescue_by_swap(int t) {
  for (int i = 0; i < 3; ++i) {
    if (!mesh_.can_swap(t, i)) continue;
    const Triangle &T = mesh_.triangles[t], &U = mesh_.triangles[T.n[i] >> 2];
    const int c = T.v[i], a = T.v[next3[i]], b = T.v[prev3[i]], d = U.v[T.n[i] & 3];
    const double before = std::min(shape(c, a, b), shape(d, b, a));
    if (std::min(shape(c, a, d), shape(c, d, b)) <= before + gain) continue;
    next_.push_back(t);
    next_.push_back(T.n[i] >> 2);
    mesh_.swap_edge(t, i);
    return true;
  }
  return false;
}

// To the best of places around, at shrinking distances in the metric; whether that gains. Of the ring collected.
bool Optimiser::move_to_best(int v) {
  Vertex& P = mesh_.vertices[v];
  const double before = star_penalty(v, std::numeric_limits<double>::infinity());
  double best = before;
  for (double step = 0.24; step > 0.02; step *= 0.5) {
    const UnitCircle circle(P.metric());
    const Vec2 centre = P.point();
    for (const Vec2& d : six_directions) {
      const Vertex kept = P;
      const Vec2 to = centre + circle.vector(step * d);
      P.x = to.x(), P.y = to.y();
      // Shapes depend on it only where the field bends.
      if (!mesh_.bends.empty()) P.set_metric(field_.at(P.point()));
      const double now = star_penalty(v, best);
      if (now < best)
        best = now, P.set_metric(field_.at(P.point()));
      else
        P = kept;
    }
  }
  return best < before * (1 - gain);
}

bool Optimiser::rescue_by_move(int v) {
  if (!collect_star(v)) return false;
  const auto key = [&] { return key_of_star(v, [this](int u) { return key_of_place(mesh_.at(u)); }); };
  const PlaceKey star = key();
  if (failed_moves_.find(star) != nullptr) return false;
  if (!move_to_best(v)) {
    // Small steps that gain little are kept even so.
    if (key() == star) failed_moves_.put(star, true);
    return false;
  }
  next_.insert(next_.end(), star_.begin(), star_.end());
  return true;
}

// Removes a vertex that moves freely by drawing it into one of its neighbours, when no edge becomes long and the worst
// triangle better; where vertices are crowded it is enough that it does not become bad.
bool Optimiser::rescue_by_removal(int v, bool crowded) {
  if (!collect_star(v)) return false;
  const auto n = static_cast<int>(ring_.size());
  if (has_imposed_spoke(v)) return false;
  double worst = 1;
  for (int k = 0; k < n; ++k) worst = std::min(worst, shape(v, ring_[k], ring_[(k + 1) % n]));
  int into = -1;
  double best = crowded ? std::max(std::min(worst, crowded_quality) - gain, 0.0) : worst + gain;
  for (int k = 0; k < n; ++k) {
    const int u = ring_[k];
    double least = 1;
    for (int j = 1; j + 1 < n && least > best; ++j) {
      const int a = ring_[(k + j) % n], b = ring_[(k + j + 1) % n];
      least = std::min(least, shape(u, a, b));
      if (j > 1 && shapes_.squared_length(u, a) > (crowded ? longest_crowded2 : longest_after_removal2)) least = 0;
    }
    if (least > best) best = least, into = k;
  }
  if (into < 0) return false;
  collapse(v, into);
  return true;
}

// Draws v into its neighbour ring_[k]: the two triangles on that edge go.
void Optimiser::collapse(int v, int k) {
  const auto n = static_cast<int>(ring_.size());
  const int u = ring_[k], last = star_[(k + n - 1) % n], first = star_[k];
  const auto close = [&](int gone, int kept, bool kept_after) {
    // The outer edge of the triangle that goes takes the place of the edge between it and the kept one.
    const int outer = mesh_.corner_of(gone, v), corner = mesh_.corner_of(kept, v);
    const int i = kept_after ? prev3[corner] : next3[corner];
    const HalfEdge beyond = mesh_.triangles[gone].n[outer];
    Triangle& K = mesh_.triangles[kept];
    K.n[i] = beyond;
    const auto copy_bit = [&](std::uint8_t& bits, std::uint8_t from) {
      bits = static_cast<std::uint8_t>((bits & ~(1U << i)) | static_cast<unsigned>(from >> outer & 1) << i);
    };
    copy_bit(K.imposed, mesh_.triangles[gone].imposed);
    copy_bit(K.degenerate, mesh_.triangles[gone].degenerate);
    if (beyond != no_edge) mesh_.triangles[beyond >> 2].n[beyond & 3] = 4 * kept + i;
  };
  close(first, star_[(k + 1) % n], true);
  close(last, star_[(k + n - 2) % n], false);
  for (int j = 1; j + 1 < n; ++j) {
    const int t = star_[(k + j) % n];
    Triangle& T = mesh_.triangles[t];
    T.v[mesh_.corner_of(t, v)] = u;
    for (const std::int32_t w : T.v) mesh_.vertices[w].triangle = t;
    next_.push_back(t);
  }
  mesh_.vertices[v].triangle = -1;
  for (const int gone : {first, last}) mesh_.triangles[gone] = {};  // no vertices: removed
}

// A triangle on an edge much shorter than its sides: a new vertex over that edge, where triangles become better by it.
// Where an imposed edge is short and sizes are large, shape asks for points that size does not.
bool Optimiser::rescue_by_insertion(int t) {
  const Triangle& T = mesh_.triangles[t];
  const Vertex* V[3] = {&mesh_.vertices[T.v[0]], &mesh_.vertices[T.v[1]], &mesh_.vertices[T.v[2]]};
  const Metric2 m = (1.0 / 3) * (V[0]->metric() + V[1]->metric() + V[2]->metric());
  int i = 0;
  double l2[3];
  for (int k = 0; k < 3; ++k) l2[k] = squared_length(m, V[prev3[k]]->point() - V[next3[k]]->point());
  for (int k = 1; k < 3; ++k)
    if (l2[k] < l2[i]) i = k;
  const Vec2 a = V[next3[i]]->point(), b = V[prev3[i]]->point(), e = b - a;
  const double k = short_edge_height / std::sqrt(std::max(determinant(m), 1e-300));
  const Vec2 p{0.5 * (a.x() + b.x()) - k * (m.b * e.x() + m.c * e.y()), 0.5 * (a.y() + b.y()) + k * (m.a * e.x() + m.b * e.y())};
  return insert_to_improve(p, t, false);
}

// An edge of a bad triangle, or of one beside it, on which a vertex fits: the rows of two borders that meet at a corner
// may leave one triangle in the place of three.
bool Optimiser::rescue_by_halving(int t) {
  const Triangle T = mesh_.triangles[t];
  const auto halve = [&](int s, int i) {
    const Triangle& S = mesh_.triangles[s];
    const int a = S.v[next3[i]], b = S.v[prev3[i]];
    return !mesh_.is_imposed(s, i) && shapes_.squared_length(a, b) > longest_after_removal2 &&
           insert_to_improve(0.5 * (mesh_.at(a) + mesh_.at(b)), s, true);
  };
  for (int i = 0; i < 3; ++i) {
    if (halve(t, i)) return true;
    if (T.n[i] == no_edge || mesh_.is_imposed(t, i)) continue;
    const int s = T.n[i] >> 2, k = T.n[i] & 3;
    if (halve(s, next3[k]) || halve(s, prev3[k])) return true;
  }
  return false;
}

// A new vertex near p, at the best place for the triangles about it, if the worst of those becomes better. `spaced`:
// and if it makes no edge that is as short as those that go.
bool Optimiser::insert_to_improve(Vec2 p, int t, bool spaced) {
  const int start = is_finite(p) ? mesh_.locate(p, t) : -1;
  if (start < 0 || !mesh_.dig(p, field_.at(p), start, {})) return false;
  shapes_asked_ += static_cast<std::int64_t>(mesh_.cavity().size() + mesh_.rim().size());
  double before = 1, after = 1;
  PlaceKey key = 5 * key_of_place(p) + (spaced ? 1 : 0);
  for (const std::int32_t c : mesh_.cavity()) {
    const Triangle& C = mesh_.triangles[c];
    if (C.done == Done::frozen) return false;
    key +=
        key_of_triangle(key_of_place(mesh_.at(C.v[0])), key_of_place(mesh_.at(C.v[1])), key_of_place(mesh_.at(C.v[2])));
  }
  if (failed_points_.find(key) != nullptr) return false;
  for (const std::int32_t c : mesh_.cavity()) {
    const Triangle& C = mesh_.triangles[c];
    before = std::min(before, shape(C.v[0], C.v[1], C.v[2]));
  }
  const auto v = static_cast<std::int32_t>(mesh_.vertices.size());
  mesh_.vertices.push_back({p.x(), p.y()});
  if (!mesh_.bends.empty()) mesh_.bends.push_back(Bend::none);
  shapes_.set_metric(v);
  ring_.clear();
  for (const RimEdge& r : mesh_.rim()) ring_.push_back(mesh_.rim_point(r.a).v);
  if (spaced) {
    move_to_best(v);
    shapes_.set_metric(v);
  }
  for (std::size_t k = 0; k < ring_.size(); ++k) {
    after = std::min(after, shape(v, ring_[k], ring_[k + 1 < ring_.size() ? k + 1 : 0]));
    if (spaced && shapes_.squared_length(v, ring_[k]) < crowded_length2) after = 0;
  }
  if (after <= before + gain) {
    mesh_.vertices.pop_back();
    if (!mesh_.bends.empty()) mesh_.bends.pop_back();
    failed_points_.put(key, true);
    return false;
  }
  mesh_.fill(v);
  for (const std::int32_t s : mesh_.star()) next_.push_back(s);
  return true;
}

// An edge that is not imposed is much shorter than one.
bool Optimiser::is_crowded(int t) const {
  const Triangle& T = mesh_.triangles[t];
  for (int i = 0; i < 3; ++i)
    if (shapes_.squared_length(T.v[next3[i]], T.v[prev3[i]]) < crowded_length2 && !mesh_.is_imposed(t, i)) return true;
  return false;
}

// Removes an end of an edge that is much shorter than one.
bool Optimiser::thin_out_at(int t) {
  const Triangle& T = mesh_.triangles[t];
  for (int i = 0; i < 3; ++i) {
    if (shapes_.squared_length(T.v[next3[i]], T.v[prev3[i]]) >= crowded_length2 || mesh_.is_imposed(t, i)) continue;
    for (const int v : {T.v[next3[i]], T.v[prev3[i]]})
      if (v >= fixed_ && rescue_by_removal(v, true)) return true;
  }
  return false;
}

bool Optimiser::rescue(int t) {
  if (is_crowded(t)) {
    if (thin_out_at(t)) return true;
    const Triangle& T = mesh_.triangles[t];
    if (shape(T.v[0], T.v[1], T.v[2]) >= bad_quality) return false;
  }
  bool any = rescue_by_swap(t);
  for (int i = 0; i < 3; ++i) {
    const int v = mesh_.triangles[t].v[i];
    if (v >= fixed_) any = rescue_by_move(v) || any;
  }
  const Triangle& T = mesh_.triangles[t];
  if (shape(T.v[0], T.v[1], T.v[2]) >= bad_quality) return any;
  for (int i = 0; i < 3; ++i) {
    const int v = mesh_.triangles[t].v[i];
    if (v >= fixed_ && rescue_by_removal(v, false)) return true;
  }
  if (rescue_by_halving(t)) return true;
  if (shape(T.v[0], T.v[1], T.v[2]) >= refine_quality) return any;
  return rescue_by_insertion(t) || any;
}

// Neither crowded nor suspect, beyond any doubt of rounding: what is true of nearly all triangles, in one go.
bool Optimiser::is_good(const Triangle& T) const {
  constexpr double sure = 1 + 1e-9, quality2 = sure * suspect_quality * suspect_quality / 12;
  const Vertex &P = mesh_.vertices[T.v[0]], &Q = mesh_.vertices[T.v[1]], &R = mesh_.vertices[T.v[2]];
  const Metric2 mp = P.metric(), mq = Q.metric(), mr = R.metric(), pq = mp + mq, m = pq + mr;
  const Vec2 u = Q.point() - P.point(), v = R.point() - P.point(), w = v - u;
  const double shortest2 = std::min({squared_length(pq, u), squared_length(mq + mr, w), squared_length(mr + mp, v)});
  const double area = cross(u, v), sum = squared_length(m, u) + squared_length(m, v) + squared_length(m, w);
  return shortest2 > sure * 2 * crowded_length2 && area > 0 && area * area * determinant(m) > quality2 * sum * sum;
}

void Optimiser::rescue_all(Needy needy) {
  const auto total = static_cast<std::int32_t>(mesh_.triangles.size());
  const bool bends = !mesh_.bends.empty();
  const auto is_bad = [&](std::int32_t t) {
    const Triangle& T = mesh_.triangles[t];
    if (T.v[0] < 0 || T.done == Done::frozen || (!bends && is_good(T))) return false;
    if (is_crowded(t)) return true;
    if (needy == Needy::crowded) return false;
    // Lengths of bent triangles may tell of an area that they have not.
    const bool suspect = shapes_.is_bent(T) || shapes_.quality(T.v[0], T.v[1], T.v[2]) < suspect_quality;
    return suspect && shape(T.v[0], T.v[1], T.v[2]) < bad_quality;
  };
  work_.clear();
  for (std::int32_t t = 0; t < total; ++t) {
    if (t % triangles_between_checks == 0) monitor_.checkpoint();
    if (is_bad(t)) work_.push_back(t);
  }
  const std::int64_t budget = std::max(least_shapes, shapes_a_triangle * total);
  std::int64_t checked = 0;
  shapes_asked_ = 0;
  if (!work_.empty()) failed_moves_.open(), failed_points_.open();
  for (int pass = 0; pass < rescue_passes && !work_.empty() && shapes_asked_ <= budget; ++pass) {
    doubtful_.insert(doubtful_.end(), work_.begin(), work_.end());
    next_.clear();
    for (const std::int32_t t : work_) {
      if (shapes_asked_ > budget) break;
      if (shapes_asked_ > checked) {
        monitor_.checkpoint();
        checked = shapes_asked_ + shapes_between_checks;
      }
      if (is_bad(t)) needy == Needy::crowded ? thin_out_at(t) : rescue(t);
    }
    std::sort(next_.begin(), next_.end());
    next_.erase(std::unique(next_.begin(), next_.end()), next_.end());
    work_.swap(next_);
  }
  doubtful_.insert(doubtful_.end(), work_.begin(), work_.end());
}

void Optimiser::rescue_worst() {
  doubtful_.clear();
  rescue_all(Needy::bad);
  raise_flat();
}

}  // namespace carreau::plane
